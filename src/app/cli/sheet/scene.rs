//! The scenes of a sheet: a moved shape among the axes, and all moved shapes side by side.

use super::transforms::Move;
use crate::app::cli::options::long_options::Size;
use crate::base::word::Word;
use std::fmt::Write;

/// The shape of a sheet in the scene language.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    /// The name of its folder.
    pub(super) name: String,
    /// Declares `Shape`.
    pub(super) declaration: String,
    /// A file that the declaration includes: its name and its text.
    pub(super) file: Option<(String, String)>,
}

const TEXTURE: &str = "\
#declare Looks = texture {
  pigment { gradient <1, 0.7, 0.4> color_map { [0 rgb <1, 0.35, 0.2>] [1 rgb <0.2, 0.5, 1>] } scale 5 translate -2.5 }
  finish { ambient 0.2 diffuse 0.7 phong 0.4 }
}
";

/// x is red, y is green, z is blue; the thick end is the positive one.
const AXES: &str = "\
#declare Axes = union {
  cylinder { -2.2*x, 2.2*x, 0.03 pigment { rgb <1, 0.1, 0.1> } }
  cone { 2.2*x, 0.1, 2.5*x, 0 pigment { rgb <1, 0.1, 0.1> } }
  cylinder { -2.2*y, 2.2*y, 0.03 pigment { rgb <0.1, 0.7, 0.1> } }
  cone { 2.2*y, 0.1, 2.5*y, 0 pigment { rgb <0.1, 0.7, 0.1> } }
  cylinder { -2.2*z, 2.2*z, 0.03 pigment { rgb <0.15, 0.3, 1> } }
  cone { 2.2*z, 0.1, 2.5*z, 0 pigment { rgb <0.15, 0.3, 1> } }
  finish { ambient 0.5 diffuse 0.5 }
}
";

const SETTINGS: &str = "global_settings { assumed_gamma 1 }\n";
const BACKGROUND: &str = "background { rgb <0.75, 0.8, 0.85> }\n";

/// Columns of the overview.
const COLUMNS: u32 = 8;
/// Space for each object in the overview.
const SPACING: f64 = 5.4;

impl Subject {
    /// True if POV-Ray 3.7 lacks the shape.
    pub(super) fn needs_3_8(&self) -> bool {
        Word::since_3_8().any(|word| word.spelling() == self.name)
    }

    /// The language version of the scenes.
    fn version(&self) -> &'static str {
        if self.needs_3_8() { "3.8" } else { "3.7" }
    }

    /// The scene of one transform.
    pub(super) fn scene(&self, moved: &Move, Size(width, height): Size) -> String {
        let shown = if moved.text.is_empty() {
            "as it is"
        } else {
            &moved.text
        };
        let ratio = f64::from(width) / f64::from(height);
        format!(
            "// {}: {shown}\n#version {};\n{SETTINGS}\
             camera {{ location <3.2, 2.8, -6> right {ratio}*x look_at 0 angle 52 }}\n\
             light_source {{ <2, 6, -8> rgb 1 }}\n{BACKGROUND}\n{TEXTURE}\n{AXES}\n{}\n\
             object {{ Axes }}\nobject {{ Shape texture {{ Looks }} {} }}\n",
            self.name,
            self.version(),
            self.declaration,
            moved.text
        )
    }

    /// The scene of all transforms.
    pub(super) fn overview(&self, moves: &[Move], Size(width, height): Size) -> String {
        let rows = u32::try_from(moves.len())
            .unwrap_or(u32::MAX)
            .div_ceil(COLUMNS);
        let ratio = f64::from(width) / f64::from(height);
        let across = SPACING * f64::from(COLUMNS).max(f64::from(rows) * ratio);
        let mut text = format!(
            "// {}: all transforms\n#version {};\n{SETTINGS}\
             camera {{ orthographic location <0, 0, -40> direction z right {across}*x up {}*y }}\n\
             light_source {{ <-60, 90, -120> rgb 1 parallel point_at 0 }}\n{BACKGROUND}\n{TEXTURE}\n{}\n",
            self.name,
            self.version(),
            across / ratio,
            self.declaration
        );
        for (number, moved) in (0_u32..).zip(moves) {
            let column = f64::from(number % COLUMNS) - 0.5 * f64::from(COLUMNS - 1);
            let row = 0.5 * f64::from(rows - 1) - f64::from(number / COLUMNS);
            let offset = (column * SPACING, row * SPACING);
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "object {{ Shape texture {{ Looks }} {} rotate 28*y rotate -22*x translate <{}, {}, 0> }}",
                moved.text, offset.0, offset.1
            );
        }
        text
    }
}
