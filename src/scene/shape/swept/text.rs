//! `text { ttf "font.ttf" "string" thickness, offset }`: letters of a TrueType font as solids between two planes.
//!
//! The letters stand on y = 0, from z = 0 to the thickness, one em high. Their sides are the quadratic curves of the
//! font. As POV-Ray does, the whole is turned by a thousandth of a degree about each axis, which shows in its extents.
//! Error bound: roots lie within 2 roundings of the problem's size from the surface (`tests/stability`, item 51).
//! `internal` fonts are those that come with POV-Ray and are searched like any other.
//!
//! Missing: `charset utf8` looks for letters in another order of tables; fonts of other kinds than TrueType.

mod font;
mod outline;

use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray, Step, rotation};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Crossing, Geometry, Root, Start, first_visible, read};
use font::Letter;
use glam::{DMat3, DVec3};
use smallvec::SmallVec;
use std::sync::Arc;

/// POV-Ray turns every text by so many degrees about each axis.
const TURN_DEG: f64 = 0.001;
/// POV-Ray's boxes of letters are so much deeper than the letters, in both directions.
const BOX_SLACK: f64 = 1e-6;
/// The fonts that are called by a number.
const INTERNAL: [&str; 3] = ["timrom.ttf", "cyrvetic.ttf", "crystal.ttf"];
/// The font of all other numbers.
const INTERNAL_OTHER: &str = "povlogo.ttf";
/// Letters of one text; each of them may have hundreds of faces, which are counted in 32 bits.
const MOST_LETTERS: usize = 100_000;

/// The faces of a letter before its sides: the one at z = 0 and the one opposite.
const FRONT: u32 = 0;
const BACK: u32 = 1;
const CAPS: u32 = 2;

/// Letters. Copies share them.
#[derive(Clone, Debug, PartialEq)]
pub struct Text(Arc<Line>);

/// A line of letters, before it is turned.
#[derive(Clone, Debug)]
struct Line {
    letters: Vec<Letter>,
    /// For each letter the number of its first face.
    first_faces: Vec<u32>,
    /// The near and the far plane.
    depth: [f64; 2],
    /// Over the boxes of the letters.
    tree: Bvh,
    bounds: Bounds,
    /// Whether the boxes of two letters overlap.
    overlaps: bool,
    /// Whether it is one letter, which lies in its box as that stands in the font.
    is_alone: bool,
    /// From the object to the line.
    turn: DMat3,
}

impl PartialEq for Line {
    /// The rest follows from these.
    fn eq(&self, other: &Self) -> bool {
        self.letters == other.letters && self.depth == other.depth
    }
}

/// Enter and leave of letters on a ray.
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
        if text.chars().count() > MOST_LETTERS {
            let message = format!("a text has at most {MOST_LETTERS} letters");
            return Err(Box::new(Diagnostic::error(args.last_span(), message)));
        }
        let thickness = read::number(args, "the thickness of the text")?;
        let offset = read::vector(args, "the offset of the text")?;
        let letters = font::set(&bytes, &text, offset).map_err(|why| {
            let message = format!("cannot read the font `{name}`: {why}");
            Diagnostic::error(at, message).with_hint("give the name of a TrueType font")
        })?;
        Ok(Text(Arc::new(Line::new(letters, thickness))))
    }

    /// The ray in the space of the line.
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
        let is_alone = match &letters[..] {
            [letter] => {
                let (low, high) = letter.outline.bounds();
                letter.low.cmple(low).all() && letter.high.cmpge(high).all()
            }
            _ => false,
        };
        Line {
            is_alone,
            tree: Bvh::build(&boxes),
            letters,
            first_faces,
            depth,
            bounds,
            overlaps,
            turn: turn.transpose(),
        }
    }

    /// The letter of a face, and which face of the letter it is.
    fn letter(&self, face: u32) -> (&Letter, u32) {
        let number = self.first_faces.partition_point(|first| *first <= face) - 1;
        (&self.letters[number], face - self.first_faces[number])
    }

    /// Visits the letters that a ray may meet beyond `from`, with how far the ray is followed, until nothing is left of
    /// it. `visit` says how far that is from then on.
    #[inline(always)]
    fn each(
        &self,
        lanes: SimdLevel,
        ray: &Ray,
        (from, to): (f64, f64),
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        if self.is_alone {
            // The box around the text, in which the ray is, is hardly larger than that of its letter.
            visit(0, to);
        } else {
            self.tree.nearest_in(lanes, ray, (from, to), visit);
        }
    }

    /// Where a ray is in a letter between `from` and `to`. An end that lies beyond them stands at `from` or `to`, or
    /// farther off.
    #[inline(always)]
    fn spans(&self, lanes: SimdLevel, number: u32, ray: &Ray, (from, to): (f64, f64)) -> Spans {
        let letter = &self.letters[number as usize];
        let origin = ray.origin - letter.at;
        let [low, high] = self.depth.map(|depth| depth - origin.z);
        let (near, far) = if ray.dir.z > 0.0 {
            ((low / ray.dir.z, FRONT), (high / ray.dir.z, BACK))
        } else if ray.dir.z < 0.0 {
            ((high / ray.dir.z, BACK), (low / ray.dir.z, FRONT))
        } else if low <= 0.0 && high >= 0.0 {
            ((f64::NEG_INFINITY, FRONT), (f64::INFINITY, BACK))
        } else {
            return Spans::new();
        };
        let mut spans = Spans::new();
        let stretch = [near.0.max(from), far.0.min(to)];
        let is_there = near.0 < far.0 && stretch[0] < stretch[1];
        if !is_there {
            return spans;
        }
        let first = self.first_faces[number as usize];
        let mut push = |enter: (f64, u32), leave: (f64, u32)| {
            let enter = if enter.0 > near.0 { enter } else { near };
            let leave = if leave.0 < far.0 { leave } else { far };
            if enter.0 < leave.0 {
                let on_letter = |(t, face)| (t, first + face);
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
        let found = letter.outline.crossings(lanes, line, stretch);
        let mut entered = found.starts_inside.then_some((stretch[0], near.1));
        for (t, side) in found.places {
            let place = (t, CAPS + side);
            match entered.take() {
                Some(enter) => push(enter, place),
                None => entered = Some(place),
            }
        }
        if let Some(enter) = entered {
            push(enter, (stretch[1], far.1));
        }
        spans
    }

    /// Appends the roots of a ray beyond `from`.
    fn push_roots(&self, ray: &Ray, from: f64, roots: &mut Vec<Root>) {
        let first = roots.len();
        let mut all = Spans::new();
        let to = f64::INFINITY;
        with_widest(
            #[inline(always)]
            |lanes| {
                self.each(lanes, ray, (from, to), |letter, _| {
                    all.extend(self.spans(lanes, letter, ray, (from, to)));
                    to
                });
            },
        );
        push_union(&mut all, roots);
        let beyond = roots[first..].iter().position(|root| root.t > from);
        roots.drain(first..beyond.map_or(roots.len(), |beyond| first + beyond));
    }

    fn contains(&self, point: DVec3) -> bool {
        self.tree.around(point, |letter| {
            let letter = &self.letters[letter as usize];
            let at = point - letter.at;
            let is_between = self.depth[0] <= at.z && at.z <= self.depth[1];
            is_between && letter.outline.contains(at.truncate())
        })
    }
}

/// Appends the spans of overlapping letters as one solid: what lies within another letter only touches.
fn push_union(spans: &mut [[Root; 2]], roots: &mut Vec<Root>) {
    let first = roots.len();
    roots.extend(spans.iter().flatten());
    let found = &mut roots[first..];
    // Where one ends and another begins it goes on.
    let order = |root: &Root| root.crossing == Crossing::Leave;
    found.sort_by(|a, b| {
        let by_t = a.t.total_cmp(&b.t);
        by_t.then(order(a).cmp(&order(b))).then(a.face.cmp(&b.face))
    });
    let mut around = 0;
    for root in found {
        let is_enter = root.crossing == Crossing::Enter;
        let is_inner = if is_enter { around > 0 } else { around > 1 };
        if is_inner {
            root.crossing = Crossing::Touch;
        }
        around = if is_enter { around + 1 } else { around - 1 };
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
                self.0.each(lanes, &ray, (from, to), |letter, end| {
                    let spans = self.0.spans(lanes, letter, &ray, (from, end));
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

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
