//! What moves a point on its way to a pattern: transforms and warps in the order of the scene.
//!
//! The list is walked from its end: what is written last acts first on the point. `turbulence` of the old form is not
//! in the list; it acts last of all, wherever it stands.

use super::Settings;
use super::warp::{self, Warp, Warping};
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::noise::{Octaves, vector_turbulence};
use crate::base::math::{Step, Transform, shorten};
use glam::{DAffine3, DMat3, DVec3};

/// Beyond this no coordinate goes, so that sums and products of a few stay finite; POV-Ray's value.
const FARTHEST: f64 = 1e17;

/// Transforms and warps of a pattern in the order in which they are written.
#[derive(Clone, Debug, Default)]
pub struct WarpChain {
    links: Vec<Link>,
    /// The steps behind the last warp.
    steps: Vec<Step>,
}

/// A warp with the transforms before it.
#[derive(Clone, Debug)]
struct Link {
    before: Vec<Step>,
    warp: Box<dyn Warp>,
}

/// A chain ready to move points.
#[derive(Debug, Default)]
pub struct PreparedWarpChain {
    /// In the order in which they act on a point.
    movements: Vec<WarpStep>,
    turbulence: Option<(DVec3, Octaves)>,
}

#[derive(Debug)]
enum WarpStep {
    Transform(DAffine3),
    Warp(Box<dyn Warping>),
}

impl WarpChain {
    /// Adds a transform.
    pub fn push(&mut self, step: &Step) {
        self.steps.push(step.clone());
        shorten(&mut self.steps, 0);
    }

    /// The steps behind the last warp.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Reads `word`, the next token, with its value if it is `warp` or a transform, and says whether it was.
    ///
    /// # Errors
    /// A malformed value.
    pub fn read(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if let Some(step) = transform_step(args)? {
            self.push(&step);
            return Ok(true);
        }
        if word != Word::Warp {
            return Ok(false);
        }
        let warp = warp::read(args)?;
        let before = std::mem::take(&mut self.steps);
        self.links.push(Link { before, warp });
        Ok(true)
    }

    /// The form for drawing: `after` are the transforms of what carries the pattern.
    #[must_use]
    pub fn prepare(
        &self,
        after: &[Step],
        turbulence: Option<(DVec3, Octaves)>,
        settings: &Settings,
    ) -> PreparedWarpChain {
        let mut chain = PreparedWarpChain {
            movements: Vec::new(),
            turbulence,
        };
        let all: Vec<Step> = self.steps.iter().chain(after).cloned().collect();
        chain.push(&all);
        for link in self.links.iter().rev() {
            let warp = WarpStep::Warp(link.warp.prepare(settings));
            chain.movements.push(warp);
            chain.push(&link.before);
        }
        chain
    }
}

impl PreparedWarpChain {
    fn push(&mut self, steps: &[Step]) {
        let inverse = Transform::from_steps(steps).object_from_world;
        if inverse != DAffine3::IDENTITY {
            self.movements.push(WarpStep::Transform(inverse));
        }
    }

    /// The point of the pattern for a point outside.
    #[must_use]
    #[inline]
    pub fn moved(&self, point: DVec3) -> DVec3 {
        let mut point = point;
        for movement in &self.movements {
            point = match movement {
                WarpStep::Transform(inverse) => inverse.transform_point3(point),
                WarpStep::Warp(warp) => warp.moved(point),
            };
        }
        if let Some((amount, octaves)) = &self.turbulence {
            point += *amount * vector_turbulence(point, octaves);
        }
        point.clamp(DVec3::splat(-FARTHEST), DVec3::splat(FARTHEST))
    }
}

impl PreparedWarpChain {
    /// How normals turn on their way to the pattern and back, made one long after each transform if `is_unit`. Warps leave
    /// them as they are.
    #[must_use]
    pub fn turns(&self, is_unit: bool) -> Turns {
        let transforms = self.movements.iter().filter_map(|movement| match movement {
            WarpStep::Transform(inverse) => Some(inverse.matrix3),
            WarpStep::Warp(_) => None,
        });
        let turn = |inverse: DMat3| Turn {
            to_pattern: inverse.inverse().transpose(),
            back: inverse.transpose(),
            is_unit,
        };
        Turns(transforms.map(turn).collect())
    }
}

/// How normals turn on their way to a pattern, in the order in which the transforms act on points.
#[derive(Clone, Debug, Default)]
pub struct Turns(Vec<Turn>);

/// What one transform does to normals.
#[derive(Clone, Copy, Debug)]
struct Turn {
    to_pattern: DMat3,
    back: DMat3,
    /// True if the normal is made one long behind it; otherwise bumps keep their slope when they are scaled.
    is_unit: bool,
}

impl Turns {
    /// These turns and then others.
    #[must_use]
    pub fn then(&self, others: &Turns) -> Turns {
        Turns(self.0.iter().chain(&others.0).copied().collect())
    }

    /// Tells whether unit normals are one long in pattern space too.
    #[must_use]
    pub fn is_unit(&self) -> bool {
        self.0.iter().all(|turn| turn.is_unit)
    }

    /// A normal in pattern space.
    #[must_use]
    pub fn to_pattern(&self, normal: DVec3) -> DVec3 {
        self.0.iter().fold(normal, |normal, turn| {
            sized(turn.to_pattern * normal, turn.is_unit)
        })
    }

    /// The way back.
    #[must_use]
    pub fn back(&self, normal: DVec3) -> DVec3 {
        let turns = self.0.iter().rev();
        turns.fold(normal, |normal, turn| {
            sized(turn.back * normal, turn.is_unit)
        })
    }
}

fn sized(normal: DVec3, is_unit: bool) -> DVec3 {
    if is_unit {
        normal.normalize_or_zero()
    } else {
        normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn moved(text: &str, after: &[Step], point: DVec3) -> DVec3 {
        let mut args = TextArgs::new(text);
        let mut chain = WarpChain::default();
        while let Some(word) = args.word().unwrap() {
            assert!(chain.read(word, &mut args).unwrap(), "{word}");
        }
        let prepared = chain.prepare(after, None, &Settings::default());
        prepared.moved(point)
    }

    #[test]
    fn what_is_written_last_acts_first_on_a_point() {
        let point = moved("scale 2 translate 1", &[], DVec3::splat(5.0));
        assert_eq!(point, DVec3::splat(2.0));
        let after = [Step::Translate(DVec3::X)];
        assert_eq!(moved("scale 2", &after, DVec3::X), DVec3::ZERO);
    }

    #[test]
    fn a_warp_stands_in_the_order_of_the_transforms() {
        let point = DVec3::new(3.5, 0.0, 0.0);
        let repeated = moved("scale 2 warp { repeat <1, 0, 0> }", &[], point);
        assert_eq!(repeated.x, 0.25);
        let repeated = moved("warp { repeat <1, 0, 0> } scale 2", &[], point);
        assert_eq!(repeated.x, 0.75);
    }

    #[test]
    fn points_stay_finite() {
        let far = moved("", &[], DVec3::splat(f64::MAX));
        assert_eq!(far, DVec3::splat(FARTHEST));
    }
}
