//! `text { ttf "font.ttf" "string" thickness, offset }`: extruded glyphs of a TrueType font.
//!
//! The letters stand on y = 0, extend from z = 0 to the thickness, and are one em high. Their sides are the quadratic
//! curves of the font. As in POV-Ray, the whole is rotated by a thousandth of a degree about each axis, which shows in
//! its extents. Error bound: roots lie within 2 roundings of the problem's size from the surface (`tests/stability`,
//! item 51). `internal` fonts are those that come with POV-Ray and are searched for like any other.
//!
//! Missing: `charset utf8`, which looks up characters in another order of tables; fonts of other kinds than TrueType.

mod font;
mod outline;

use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray, Step, rotation};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Crossing, Geometry, Root, SpanEnd, Start, first_visible, read};
use font::Letter;
use glam::{DMat3, DVec3};
use smallvec::SmallVec;
use std::sync::Arc;

/// POV-Ray rotates every text by this angle about each axis.
const TURN_DEG: f64 = 0.001;
/// POV-Ray's boxes of letters are deeper than the letters by this, in both directions.
const BOX_SLACK: f64 = 1e-6;
/// The fonts selected by number.
const INTERNAL: [&str; 3] = ["timrom.ttf", "cyrvetic.ttf", "crystal.ttf"];
/// The font of all other numbers.
const INTERNAL_OTHER: &str = "povlogo.ttf";
/// Maximum number of letters of a text; each may have hundreds of faces, which have 32-bit numbers.
const MAX_LETTERS: usize = 100_000;

/// Face numbers of a letter: the cap at z = 0, the opposite cap, then the sides.
const FRONT: u32 = 0;
const BACK: u32 = 1;
const CAPS: u32 = 2;

/// A text. Copies share its letters.
#[derive(Clone, Debug, PartialEq)]
pub struct Text(Arc<Line>);

/// A line of letters, before the rotation.
#[derive(Clone, Debug)]
struct Line {
    letters: Vec<Letter>,
    /// Per letter, the number of its first face.
    first_faces: Vec<u32>,
    /// The near and the far plane.
    depth: [f64; 2],
    /// BVH over the boxes of the letters.
    tree: Bvh,
    bounds: Bounds,
    /// True if the boxes of two letters overlap.
    overlaps: bool,
    /// True for a single letter whose outline lies within its box from the font.
    is_single: bool,
    /// True if the normals of the sides point inward, as those of POV-Ray 3.7 do.
    has_inward_sides: bool,
    /// From object space to the space of the line.
    turn: DMat3,
}

impl PartialEq for Line {
    /// The rest follows from these.
    fn eq(&self, other: &Self) -> bool {
        self.letters == other.letters && self.depth == other.depth
    }
}

/// Spans of a ray inside letters.
type Spans = SmallVec<[[Root; 2]; 8]>;

impl Text {
    /// Reads `ttf "font" "string" thickness, offset`, or `internal number` for the font.
    ///
    /// # Errors
    /// A font that is missing or no TrueType font; a malformed or non-finite parameter.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let (name, at) = read_font(args)?;
        let bytes = args.file_named("the font", &name, &[".ttf", ".TTF"])?;
        args.comma()?;
        let text = args.string()?;
        if text.chars().count() > MAX_LETTERS {
            let message = format!("a text has at most {MAX_LETTERS} letters");
            return Err(Box::new(Diagnostic::error(args.last_span(), message)));
        }
        let thickness = read::number(args, "the thickness of the text")?;
        let offset = read::vector(args, "the offset of the text")?;
        let letters = font::set(&bytes, &text, offset).map_err(|why| {
            let message = format!("cannot read the font `{name}`: {why}");
            Diagnostic::error(at, message).with_hint("Give the name of a TrueType font.")
        })?;
        let line = Line {
            has_inward_sides: !args.is_for_3_8(),
            ..Line::new(letters, thickness)
        };
        Ok(Text(Arc::new(line)))
    }

    /// Transforms a ray to the space of the line.
    fn to_line(&self, ray: &Ray) -> Ray {
        Ray::new(self.0.turn * ray.origin, self.0.turn * ray.dir)
    }
}

fn read_font(args: &mut dyn Args) -> Parse<(String, crate::base::source::Span)> {
    if args.accept(Word::Internal)? {
        let number = args.float()?.trunc();
        let mut names = (1..).zip(INTERNAL);
        let known = names.find(|(of, _)| f64::from(*of) == number);
        let name = known.map_or(INTERNAL_OTHER, |(_, name)| name);
        return Ok((name.to_owned(), args.last_span()));
    }
    if !args.accept(Word::Ttf)? {
        return Err(args.expected("`ttf` or `internal` in `text`"));
    }
    let name = args.string()?;
    Ok((name, args.last_span()))
}

impl Line {
    fn new(letters: Vec<Letter>, thickness: f64) -> Self {
        let turn = rotation(DVec3::splat(TURN_DEG));
        let depth = [thickness.min(0.0), thickness.max(0.0)];
        let boxes: Vec<Bounds> = letters
            .iter()
            .map(|letter| Bounds {
                min: letter.low.extend(depth[0]) + letter.at,
                max: letter.high.extend(depth[1]) + letter.at,
            })
            .collect();
        let turned = glam::DAffine3::from_mat3(turn);
        let whole = boxes
            .iter()
            .fold(Bounds::EMPTY, |sum, next| sum.union(next));
        let slack = BOX_SLACK * DVec3::Z;
        let whole = Bounds {
            min: whole.min - slack,
            max: whole.max + slack,
        };
        let bounds = whole.transformed(&turned);
        let mut first_faces = Vec::new();
        let mut faces = 0;
        for letter in &letters {
            first_faces.push(faces);
            let sides = u32::try_from(letter.outline.len()).unwrap_or(0);
            faces = u32::saturating_add(faces, CAPS + sides);
        }
        let mut by_start: Vec<&Bounds> = boxes.iter().collect();
        by_start.sort_by(|a, b| a.min.x.total_cmp(&b.min.x));
        let overlaps = by_start
            .windows(2)
            .any(|pair| pair[1].min.x <= pair[0].max.x);
        let is_single = match &letters[..] {
            [letter] => {
                let (low, high) = letter.outline.bounds();
                letter.low.cmple(low).all() && letter.high.cmpge(high).all()
            }
            _ => false,
        };
        Line {
            is_single,
            tree: Bvh::build(&boxes),
            letters,
            first_faces,
            depth,
            bounds,
            overlaps,
            has_inward_sides: false,
            turn: turn.transpose(),
        }
    }

    /// The letter of a face, and the face number within the letter.
    fn letter(&self, face: u32) -> (&Letter, u32) {
        let number = self.first_faces.partition_point(|first| *first <= face) - 1;
        (&self.letters[number], face - self.first_faces[number])
    }

    /// Visits the letters that a ray may hit beyond `from`, with the current end of the ray; `visit` returns the new
    /// end.
    #[inline(always)]
    fn each(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        from: f64,
        to: f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        if self.is_single {
            // The box of the text, which the ray has hit, is hardly larger than that of its letter.
            visit(0, to);
        } else {
            self.tree.nearest_in(lanes, ray, (from, to), visit);
        }
    }

    /// Spans of a ray inside a letter between `from` and `to`. An end beyond these is reported at `from` or `to`, or
    /// farther off.
    #[inline(always)]
    fn spans(&self, lanes: SimdLevel, number: u32, ray: &Ray, from: f64, to: f64) -> Spans {
        let letter = &self.letters[number as usize];
        let origin = ray.origin - letter.at;
        let [low, high] = self.depth.map(|depth| depth - origin.z);
        let (near, far) = if ray.dir.z > 0.0 {
            (
                SpanEnd::new(low / ray.dir.z, FRONT),
                SpanEnd::new(high / ray.dir.z, BACK),
            )
        } else if ray.dir.z < 0.0 {
            (
                SpanEnd::new(high / ray.dir.z, BACK),
                SpanEnd::new(low / ray.dir.z, FRONT),
            )
        } else if low <= 0.0 && high >= 0.0 {
            (
                SpanEnd::new(f64::NEG_INFINITY, FRONT),
                SpanEnd::new(f64::INFINITY, BACK),
            )
        } else {
            return Spans::new();
        };
        let mut spans = Spans::new();
        if self.depth[0] == self.depth[1] {
            spans.extend(
                self.sheet(number, ray, near.t)
                    .filter(|_| near.t > from && near.t < to),
            );
            return spans;
        }
        let interval = [near.t.max(from), far.t.min(to)];
        let is_hit = near.t < far.t && interval[0] < interval[1];
        if !is_hit {
            return spans;
        }
        let first = self.first_faces[number as usize];
        let mut push = |enter: SpanEnd, leave: SpanEnd| {
            let enter = if enter.t > near.t { enter } else { near };
            let leave = if leave.t < far.t { leave } else { far };
            if enter.t < leave.t {
                let on_letter = |end: SpanEnd| SpanEnd::new(end.t, first + end.face);
                spans.extend(crate::scene::shape::span(
                    on_letter(enter),
                    on_letter(leave),
                ));
            }
        };
        let line = [origin.truncate(), ray.dir.truncate()];
        if line[1] == glam::DVec2::ZERO {
            if letter.outline.contains(line[0]) {
                push(near, far);
            }
            return spans;
        }
        let hits = letter.outline.crossings(lanes, line, interval);
        let mut entered = hits
            .starts_inside
            .then_some(SpanEnd::new(interval[0], near.face));
        for (t, side) in hits.list {
            let end = SpanEnd::new(t, CAPS + side);
            match entered.take() {
                Some(enter) => push(enter, end),
                None => entered = Some(end),
            }
        }
        if let Some(enter) = entered {
            push(enter, SpanEnd::new(interval[1], far.face));
        }
        spans
    }

    /// A ray through the plane of a text without thickness: both ends of its span lie on the back, as in POV-Ray.
    #[cold]
    fn sheet(&self, number: u32, ray: &Ray, t: f64) -> Option<[Root; 2]> {
        let letter = &self.letters[number as usize];
        let at = ray.origin - letter.at + t * ray.dir;
        let end = SpanEnd::new(t, self.first_faces[number as usize] + BACK);
        let is_hit = t.is_finite() && letter.outline.contains(at.truncate());
        is_hit
            .then(|| crate::scene::shape::span(end, end))
            .flatten()
    }

    /// Appends the roots of a ray beyond `from`.
    fn push_roots(&self, ray: &Ray, from: f64, roots: &mut Vec<Root>) {
        let first = roots.len();
        let mut all = Spans::new();
        let to = f64::INFINITY;
        with_widest(
            #[inline(always)]
            |lanes| {
                self.each(lanes, ray, from, to, |letter, _| {
                    all.extend(self.spans(lanes, letter, ray, from, to));
                    to
                });
            },
        );
        push_union(&mut all, roots);
        let beyond = roots[first..].iter().position(|root| root.t > from);
        roots.drain(first..beyond.map_or(roots.len(), |beyond| first + beyond));
    }

    fn contains(&self, point: DVec3) -> bool {
        self.tree.visit_containing(point, |letter| {
            let letter = &self.letters[letter as usize];
            let at = point - letter.at;
            let is_between = self.depth[0] <= at.z && at.z <= self.depth[1];
            is_between && letter.outline.contains(at.truncate())
        })
    }
}

/// Appends the union of the spans of overlapping letters: roots within another letter become `Touch`.
fn push_union(spans: &mut [[Root; 2]], roots: &mut Vec<Root>) {
    let first = roots.len();
    roots.extend(spans.iter().flatten());
    let own = &mut roots[first..];
    // Where one letter ends and another begins, the union continues.
    let order = |root: &Root| root.crossing == Crossing::Leave;
    own.sort_by(|a, b| {
        let by_t = a.t.total_cmp(&b.t);
        by_t.then(order(a).cmp(&order(b))).then(a.face.cmp(&b.face))
    });
    let mut depth = 0;
    for root in own {
        let is_enter = root.crossing == Crossing::Enter;
        let is_inner = if is_enter { depth > 0 } else { depth > 1 };
        if is_inner {
            root.crossing = Crossing::Touch;
        }
        depth = if is_enter { depth + 1 } else { depth - 1 };
    }
}

impl Geometry for Text {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        self.0
            .push_roots(&self.to_line(ray), f64::NEG_INFINITY, roots);
        Start::Outside
    }

    fn roots_from(&self, ray: &Ray, from: f64, _enough: f64, roots: &mut Vec<Root>) -> bool {
        self.0.push_roots(&self.to_line(ray), from, roots);
        false
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if self.0.overlaps {
            let mut roots = Vec::new();
            self.roots(ray, &mut roots);
            return first_visible(&roots, from, to);
        }
        let ray = self.to_line(ray);
        let mut best: Option<Root> = None;
        with_widest(
            #[inline(always)]
            |lanes| {
                self.0.each(lanes, &ray, from, to, |letter, end| {
                    let spans = self.0.spans(lanes, letter, &ray, from, end);
                    let Some(root) = first_visible(spans.as_flattened(), from, end) else {
                        return end;
                    };
                    best = Some(root);
                    root.t
                });
            },
        );
        best
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let (letter, face) = self.0.letter(face);
        let outward = match face {
            FRONT => DVec3::NEG_Z,
            BACK => DVec3::Z,
            side => {
                let at = self.0.turn * point - letter.at;
                letter
                    .outline
                    .normal(side - CAPS, at.truncate())
                    .extend(0.0)
            }
        };
        self.0.turn.transpose() * outward
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.contains(self.0.turn * point)
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let is_side = self.0.letter(face).1 >= CAPS;
        (is_side && self.0.has_inward_sides).then(|| -self.normal(point, face))
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
