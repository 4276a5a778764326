//! Exact pixels of a model, by numbers of 77 digits: every surface is a polynomial along the ray, solids follow from
//! its signs between the roots, and there are no tolerances.
//!
//! Coincident faces have the same root and enclose nothing: CSG is evaluated without them (regularised), and where
//! several visible faces coincide each of their colours is right.

use super::model::{Camera, Kind, Model, Object, SHADE, Step, V, WHITE};
use super::wide::{Polynomial, Vector, Wide, cross, dot, minus, plus, times, vector, wide};

/// Roots nearer to each other than this fraction of their distance are one.
const SAME: f64 = 1e-55;

/// A line.
#[derive(Clone)]
struct Line {
    origin: Vector,
    dir: Vector,
}

/// A solid along a line: inside where all of its polynomials are negative.
struct Leaf {
    polynomials: Vec<Polynomial>,
    /// The interval that contains it, if that is known.
    within: Option<(Wide, Wide)>,
    color: V,
}

/// The combination of the leaves of an object; leaves by number.
enum Tree {
    Leaf(usize),
    All(Vec<Tree>),
    Any(Vec<Tree>),
    Not(Box<Tree>),
}

/// An object along a line.
struct Solid {
    leaves: Vec<Leaf>,
    tree: Tree,
}

/// The possible colours of a pixel.
pub(crate) type Shown = Vec<V>;

/// A model prepared for queries.
pub(crate) struct Oracle<'a> {
    model: &'a Model,
}

impl<'a> Oracle<'a> {
    pub(crate) fn new(model: &'a Model) -> Self {
        Oracle { model }
    }

    /// The colours at the centre of a pixel.
    pub(crate) fn shown(&self, x: u32, y: u32) -> Shown {
        self.shown_beside(x, y, [0.0, 0.0])
    }

    /// True if a colour is wrong at a pixel; `None` where the answer changes within the margin.
    pub(crate) fn is_wrong(&self, x: u32, y: u32, right: impl Fn(&Shown) -> bool) -> Option<bool> {
        let around = [[1.0, 0.3], [-0.77, 0.71], [-0.2, -1.0]];
        let mut answers =
            around.map(|by| right(&self.shown_beside(x, y, by.map(|d| d * self.model.margin))));
        answers.sort_unstable();
        (answers[0] == answers[2]).then_some(!answers[0])
    }

    fn shown_beside(&self, x: u32, y: u32, by: [f64; 2]) -> Shown {
        let line = line(&self.model.camera, self.model.size, x, y, by);
        let mut nearest: Option<(Wide, Vec<V>, usize, i32)> = None;
        for (number, object) in self.model.objects.iter().enumerate() {
            let solid = Solid::along(object, &line);
            let Some((t, colors, before)) = solid.first() else {
                continue;
            };
            match &mut nearest {
                Some((best, all, _, _)) if is_same(best, &t) => all.extend(colors),
                Some((best, ..)) if *best < t => {}
                _ => nearest = Some((t, colors, number, before)),
            }
        }
        let Some((t, mut colors, number, before)) = nearest else {
            return vec![[0.0; 3]];
        };
        if let Some(light) = self.model.light {
            let point = plus(&line.origin, &times(&line.dir, &t));
            if !self.is_lit(&point, light, number, before) {
                colors.iter_mut().for_each(|c| *c = c.map(|x| x * SHADE));
            }
        }
        colors
    }

    /// True if light reaches a point on the surface of an object, on the side with the inside state `before`.
    fn is_lit(&self, point: &Vector, light: V, own: usize, before: i32) -> bool {
        let to_light = Line {
            origin: point.clone(),
            dir: minus(&vector(light), point),
        };
        for (number, object) in self.model.objects.iter().enumerate() {
            let solid = Solid::along(object, &to_light);
            let states = solid.states(&wide(1.0));
            if states.iter().any(|state| *state != states[0]) {
                return false;
            }
            if number == own && states[0] != before {
                return false;
            }
        }
        true
    }
}

fn is_same(a: &Wide, b: &Wide) -> bool {
    (a - b).abs() <= a.abs() * wide(SAME)
}

/// The line through a point of a pixel.
fn line(camera: &Camera, size: (u32, u32), x: u32, y: u32, by: [f64; 2]) -> Line {
    let share = |at: u32, of: u32, by: f64| {
        let middle = wide(2.0 * f64::from(at) + 1.0 - f64::from(of)) / wide(2.0 * f64::from(of));
        middle + wide(by) / wide(f64::from(of))
    };
    let u = share(x, size.0, by[0]);
    let v = -share(y, size.1, by[1]);
    let off = plus(
        &times(&vector(camera.right), &u),
        &times(&vector(camera.up), &v),
    );
    let (location, direction) = (vector(camera.location), vector(camera.direction));
    if camera.is_flat {
        Line {
            origin: plus(&location, &off),
            dir: direction,
        }
    } else {
        Line {
            origin: location,
            dir: plus(&direction, &off),
        }
    }
}

impl Solid {
    fn along(object: &Object, line: &Line) -> Solid {
        let mut leaves = Vec::new();
        let tree = tree(object, line, object.color.unwrap_or(WHITE), &mut leaves);
        Solid { leaves, tree }
    }

    /// The sign changes of the polynomials ahead, in order, with the number of the leaf.
    fn crossings(&self) -> Vec<(Wide, usize)> {
        let mut crossings = Vec::new();
        for (number, leaf) in self.leaves.iter().enumerate() {
            for polynomial in &leaf.polynomials {
                let all = match &leaf.within {
                    Some((low, high)) => polynomial.sign_changes_between(low, high),
                    None => polynomial.sign_changes(),
                };
                let ahead = all.into_iter().filter(|t| t.sign() > 0);
                crossings.extend(ahead.map(|t| (t, number)));
            }
        }
        crossings.sort_by(|a, b| a.0.partial_cmp(&b.0).expect("numbers have an order"));
        crossings
    }

    /// The first visible surface ahead: its distance, its colours, and the inside state before it.
    fn first(&self) -> Option<(Wide, Vec<V>, i32)> {
        let crossings = self.crossings();
        let (first, _) = crossings.first()?;
        let mut before = self.state(&(first / &wide(2.0)));
        let mut at = 0;
        while at < crossings.len() {
            let t = &crossings[at].0;
            let mut end = at + 1;
            while end < crossings.len() && is_same(t, &crossings[end].0) {
                end += 1;
            }
            let middle = match crossings.get(end) {
                Some((next, _)) => (t + next) / wide(2.0),
                None => t * &wide(2.0),
            };
            let after = self.state(&middle);
            if after != before {
                let mut colors: Vec<V> = Vec::new();
                for (_, leaf) in &crossings[at..end] {
                    if !colors.contains(&self.leaves[*leaf].color) {
                        colors.push(self.leaves[*leaf].color);
                    }
                }
                return Some((t.clone(), colors, before));
            }
            before = after;
            at = end;
        }
        None
    }

    /// The inside states along the line from 0 to `end`, interval by interval.
    fn states(&self, end: &Wide) -> Vec<i32> {
        let start = end * &wide(SAME);
        let mut ends = vec![wide(0.0)];
        for (t, _) in self.crossings() {
            if t > start && t < *end && !is_same(&t, &ends[ends.len() - 1]) {
                ends.push(t);
            }
        }
        ends.push(end.clone());
        ends.windows(2)
            .map(|pair| self.state(&((&pair[0] + &pair[1]) / wide(2.0))))
            .collect()
    }

    fn state(&self, t: &Wide) -> i32 {
        i32::from(self.holds(&self.tree, t))
    }

    fn holds(&self, tree: &Tree, t: &Wide) -> bool {
        match tree {
            Tree::Leaf(number) => {
                let mut all = self.leaves[*number].polynomials.iter();
                all.all(|polynomial| polynomial.at(t).sign() <= 0)
            }
            Tree::All(parts) => parts.iter().all(|part| self.holds(part, t)),
            Tree::Any(parts) => parts.iter().any(|part| self.holds(part, t)),
            Tree::Not(part) => !self.holds(part, t),
        }
    }
}

/// The tree of an object along a line, whose leaves are added to `leaves`.
fn tree(object: &Object, line: &Line, color: V, leaves: &mut Vec<Leaf>) -> Tree {
    let line = to_object(&object.steps, line);
    if let Kind::Csg(word, parts) = &object.kind {
        let mut below: Vec<Tree> = parts
            .iter()
            .map(|part| tree(part, &line, part.color.unwrap_or(color), leaves))
            .collect();
        return match *word {
            "union" | "merge" => Tree::Any(below),
            "intersection" => Tree::All(below),
            "difference" => {
                let cut = below.split_off(1);
                below.extend(cut.into_iter().map(|part| Tree::Not(Box::new(part))));
                Tree::All(below)
            }
            other => panic!("no combination: {other}"),
        };
    }
    let (polynomials, within) = match reach(&object.kind) {
        None => (polynomials(&object.kind, &line), None),
        Some(reach) => {
            let around = distance_sq(&line.origin, &line.dir)
                .plus(&constant(-(wide(reach) * wide(reach))))
                .sign_changes();
            match <[Wide; 2]>::try_from(around) {
                Ok([low, high]) => (polynomials(&object.kind, &line), Some((low, high))),
                // Inside nowhere, and nothing to solve.
                Err(_) => (vec![constant(wide(1.0))], None),
            }
        }
    };
    leaves.push(Leaf {
        polynomials,
        within,
        color,
    });
    Tree::Leaf(leaves.len() - 1)
}

/// The largest distance from the origin of a solid whose polynomial is not solved by a formula.
fn reach(kind: &Kind) -> Option<f64> {
    match kind {
        Kind::Torus(major, minor) => Some(1.01 * (major + minor)),
        Kind::Superellipsoid(_) => Some(1.8),
        _ => None,
    }
}

/// The line in the space before these steps.
fn to_object(steps: &[Step], line: &Line) -> Line {
    let mut line = line.clone();
    for step in steps.iter().rev() {
        match step {
            Step::Translate(by) => line.origin = minus(&line.origin, &vector(*by)),
            Step::Scale(by) => {
                let by = vector(*by);
                let shrink = |v: &Vector| [0, 1, 2].map(|i| &v[i] / &by[i]);
                line = Line {
                    origin: shrink(&line.origin),
                    dir: shrink(&line.dir),
                };
            }
            Step::Rotate(degrees) => {
                // The inverse rotation: about z, y, x. Sines of doubles are as exact as the scene's own numbers.
                for axis in [2, 1, 0] {
                    let (sine, cosine) = sine_and_cosine(-degrees[axis]);
                    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                    for v in [&mut line.origin, &mut line.dir] {
                        let turned = &v[a] * &cosine - &v[b] * &sine;
                        v[b] = &v[a] * &sine + &v[b] * &cosine;
                        v[a] = turned;
                    }
                }
            }
            Step::Matrix(m) => {
                let row = |i: usize| vector([m[i], m[i + 1], m[i + 2]]);
                let rows = [row(0), row(3), row(6)];
                let origin = minus(&line.origin, &row(9));
                line = Line {
                    origin: solved(&rows, &origin),
                    dir: solved(&rows, &line.dir),
                };
            }
        }
    }
    line
}

/// Sine and cosine of degrees, exact for right angles.
fn sine_and_cosine(degrees: f64) -> (Wide, Wide) {
    let (sine, cosine) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    };
    (wide(sine), wide(cosine))
}

/// The factors of the rows that give a vector.
fn solved(rows: &[Vector; 3], v: &Vector) -> Vector {
    let normals = [
        cross(&rows[1], &rows[2]),
        cross(&rows[2], &rows[0]),
        cross(&rows[0], &rows[1]),
    ];
    let volume = dot(&rows[0], &normals[0]);
    normals.map(|normal| dot(&normal, v) / volume.clone())
}

/// A coordinate along the line.
fn coordinate(line: &Line, axis: usize) -> Polynomial {
    Polynomial(vec![line.origin[axis].clone(), line.dir[axis].clone()])
}

/// A linear function along the line.
fn linear(line: &Line, normal: &Vector, at_zero: Wide) -> Polynomial {
    Polynomial(vec![
        dot(normal, &line.origin) + at_zero,
        dot(normal, &line.dir),
    ])
}

/// The square of the distance from the origin along the line.
fn distance_sq(p: &Vector, d: &Vector) -> Polynomial {
    Polynomial(vec![dot(p, p), dot(p, d) * wide(2.0), dot(d, d)])
}

fn constant(x: Wide) -> Polynomial {
    Polynomial(vec![x])
}

fn negative(p: &Polynomial) -> Polynomial {
    p.scaled(&wide(-1.0))
}

fn polynomials(kind: &Kind, line: &Line) -> Vec<Polynomial> {
    match kind {
        Kind::Sphere(centre, radius) => {
            let p = minus(&line.origin, &vector(*centre));
            let radius = wide(*radius);
            vec![distance_sq(&p, &line.dir).plus(&constant(-(&radius * &radius)))]
        }
        Kind::Box(a, b) => (0..3)
            .flat_map(|axis| {
                let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
                let along = coordinate(line, axis);
                [
                    negative(&along).plus(&constant(wide(low))),
                    along.plus(&constant(-wide(high))),
                ]
            })
            .collect(),
        Kind::Cylinder(base, apex, radius) => round(line, *base, *apex, [*radius, *radius]),
        Kind::Cone(base, from, apex, to) => round(line, *base, *apex, [*from, *to]),
        Kind::Torus(major, minor) => vec![ring(line, *major, *minor)],
        Kind::Plane(normal, distance) => {
            let normal = vector(*normal);
            let length = dot(&normal, &normal).sqrt();
            vec![linear(line, &normal, -(wide(*distance) * length))]
        }
        Kind::Quadric(c) => {
            let [x, y, z] = [0, 1, 2].map(|axis| coordinate(line, axis));
            let terms = [
                x.times(&x),
                y.times(&y),
                z.times(&z),
                x.times(&y),
                x.times(&z),
                y.times(&z),
                x,
                y,
                z,
                constant(wide(1.0)),
            ];
            vec![sum(&terms, c)]
        }
        Kind::Quartic(c) => {
            let axes = [0, 1, 2].map(|axis| coordinate(line, axis));
            vec![sum(&quartic_terms(&axes), &c[..])]
        }
        Kind::Superellipsoid(power) => {
            let mut total = constant(wide(-1.0));
            for axis in 0..3 {
                let along = coordinate(line, axis);
                let mut term = constant(wide(1.0));
                for _ in 0..*power {
                    term = term.times(&along);
                }
                total = total.plus(&term);
            }
            vec![total]
        }
        Kind::Blob(threshold) => {
            // (1 - r²)² = threshold.
            let radius_sq = wide(1.0) - wide(*threshold).sqrt();
            vec![distance_sq(&line.origin, &line.dir).plus(&constant(-radius_sq))]
        }
        Kind::Csg(..) => Vec::new(),
    }
}

fn sum(terms: &[Polynomial], factors: &[f64]) -> Polynomial {
    terms
        .iter()
        .zip(factors)
        .filter(|(_, factor)| **factor != 0.0)
        .fold(constant(wide(0.0)), |sum, (term, factor)| {
            sum.plus(&term.scaled(&wide(*factor)))
        })
}

/// The 35 terms of `quartic` in the order of the language.
fn quartic_terms(axes: &[Polynomial; 3]) -> Vec<Polynomial> {
    let power = |axis: usize, n: usize| {
        (0..n).fold(constant(wide(1.0)), |product, _| product.times(&axes[axis]))
    };
    let mut terms = Vec::new();
    for x in (0..=4).rev() {
        for y in (0..=4 - x).rev() {
            for z in (0..=4 - x - y).rev() {
                terms.push(power(0, x).times(&power(1, y)).times(&power(2, z)));
            }
        }
    }
    terms
}

/// A cylinder or cone: `|across|² · L⁴ <= (r₀ + k·h)² · L⁴` between the caps, with `h` along the axis in lengths of it.
fn round(line: &Line, base: V, apex: V, radii: [f64; 2]) -> Vec<Polynomial> {
    let axis = minus(&vector(apex), &vector(base));
    let length_sq = dot(&axis, &axis);
    let p = minus(&line.origin, &vector(base));
    let about = Line {
        origin: p.clone(),
        dir: line.dir.clone(),
    };
    let height = linear(&about, &axis, wide(0.0)).scaled(&(wide(1.0) / length_sq.clone()));
    let across =
        distance_sq(&cross(&p, &axis), &cross(&line.dir, &axis)).scaled(&(wide(1.0) / length_sq));
    let [from, to] = radii.map(wide);
    let width = height.scaled(&(&to - &from)).plus(&constant(from));
    vec![
        across.plus(&negative(&width.times(&width))),
        negative(&height),
        height.plus(&constant(wide(-1.0))),
    ]
}

/// `(ρ² + y² + R² − r²)² − 4R²ρ²`.
fn ring(line: &Line, major: f64, minor: f64) -> Polynomial {
    let (major, minor) = (wide(major), wide(minor));
    let all = distance_sq(&line.origin, &line.dir);
    let height = coordinate(line, 1);
    let flat = all.plus(&negative(&height.times(&height)));
    let whole = all.plus(&constant(&major * &major - &minor * &minor));
    whole
        .times(&whole)
        .plus(&negative(&flat.scaled(&(&major * &major * wide(4.0)))))
}
