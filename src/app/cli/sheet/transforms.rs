//! The transforms of a sheet: all elementary ones, and compositions in both orders.

/// A transform: its file name, and its text in the scene language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Move {
    /// `rotate_x_90`.
    pub(super) name: String,
    /// `rotate 90*x`.
    pub(super) text: String,
}

impl Move {
    /// The heading of its group on the page.
    pub(super) fn group(&self) -> &'static str {
        let steps = self.text.matches(['*', '<']).count();
        match self.name.split('_').next().unwrap_or_default() {
            _ if steps > 1 => "Two steps, in both orders",
            _ if self.name.ends_with("_0") => "As it is",
            "translate" => "Translated",
            "rotate" => "Rotated",
            "mirror" => "Mirrored",
            "scale" => "Scaled",
            "shear" => "Sheared",
            _ => "As it is",
        }
    }
}

/// The amount by which axes are sheared.
const SHEAR: &str = "0.5";

/// All transforms, in the order of the sheet.
pub(super) fn all() -> Vec<Move> {
    let mut moves = vec![made("none", "")];
    for axis in ["x", "y", "z"] {
        moves.push(made(
            &format!("translate_{axis}"),
            &format!("translate 0.8*{axis}"),
        ));
    }
    for axis in ["x", "y", "z"] {
        for angle in [0, 90, 180, 270] {
            let name = format!("rotate_{axis}_{angle}");
            moves.push(made(&name, &format!("rotate {angle}*{axis}")));
        }
    }
    for (number, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let mirror = format!("scale {}", along(number, "-1"));
        moves.push(made(&format!("mirror_{axis}"), &mirror));
    }
    for (number, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let scale = format!("scale {}", along(number, "1.6"));
        moves.push(made(&format!("scale_{axis}"), &scale));
    }
    for (moved, by) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
        let axes = ["x", "y", "z"];
        let name = format!("shear_{}{}", axes[moved], axes[by]);
        moves.push(made(&name, &shear(moved, by)));
    }
    let pairs = [
        ("rotate", "rotate 40*z", "translate", "translate 0.8*x"),
        ("rotate", "rotate 40*z", "scale", "scale <1.6, 1, 1>"),
        ("rotate", "rotate 40*z", "mirror", "scale <-1, 1, 1>"),
        ("rotate", "rotate 40*z", "shear", &shear(0, 1)),
        ("scale", "scale <1.6, 1, 1>", "translate", "translate 0.5*x"),
    ];
    for (first, a, second, b) in pairs {
        moves.push(made(&format!("{first}_{second}"), &format!("{a} {b}")));
        moves.push(made(&format!("{second}_{first}"), &format!("{b} {a}")));
    }
    moves
}

fn made(name: &str, text: &str) -> Move {
    Move {
        name: name.to_owned(),
        text: text.to_owned(),
    }
}

/// A vector of ones except along an axis.
fn along(axis: usize, value: &str) -> String {
    let mut parts = ["1"; 3];
    parts[axis] = value;
    format!("<{}>", parts.join(", "))
}

/// The matrix that adds a multiple of one coordinate to another. Its rows are the images of the axes.
fn shear(moved: usize, by: usize) -> String {
    let mut rows = [["0"; 3]; 4];
    for (axis, row) in rows.iter_mut().take(3).enumerate() {
        row[axis] = "1";
    }
    rows[by][moved] = SHEAR;
    format!("matrix <{}>", rows.map(|row| row.join(", ")).join(",  "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_apart() {
        let mut names: Vec<String> = all().into_iter().map(|one| one.name).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
        assert_eq!(count, 38);
    }

    #[test]
    fn all_are_in_groups() {
        let groups: Vec<&str> = all().iter().map(Move::group).collect();
        let count = |group| groups.iter().filter(|one| **one == group).count();
        assert_eq!(
            (count("As it is"), count("Translated"), count("Rotated")),
            (4, 3, 9)
        );
        assert_eq!(
            (count("Mirrored"), count("Scaled"), count("Sheared")),
            (3, 3, 6)
        );
        assert_eq!(count("Two steps, in both orders"), 10);
    }

    #[test]
    fn a_shear_moves_x_with_y() {
        assert_eq!(
            shear(0, 1),
            "matrix <1, 0, 0,  0.5, 1, 0,  0, 0, 1,  0, 0, 0>"
        );
    }
}
