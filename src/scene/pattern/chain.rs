//! The mapping from a shading point to pattern space: transforms and warps in the order of the scene.
//!
//! The list is applied from its end: the item written last acts first on the point. `turbulence` outside of a `warp`
//! block is not in the list; it acts after all others, wherever it is written.

use super::Settings;
use super::warp::{self, Turbulence, Warp, WarpEval};
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::{Step, Transform, merge_steps};
use glam::{DAffine3, DMat3, DVec3};

/// Coordinates are clamped to this size, so that sums and products of several stay finite; POV-Ray's value.
const MAX_COORDINATE: f64 = 1e17;

/// Transforms and warps of a pattern in the order in which they are written.
#[derive(Clone, Debug, Default)]
pub struct WarpChain {
    links: Vec<Link>,
    /// The transforms after the last warp.
    steps: Vec<Step>,
}

/// A warp with the transforms written before it.
#[derive(Clone, Debug)]
struct Link {
    before: Vec<Step>,
    warp: Box<dyn Warp>,
}

/// A chain prepared for evaluation.
#[derive(Debug, Default)]
pub struct PreparedWarpChain {
    /// In the order in which they act on a point.
    steps: Vec<WarpStep>,
    turbulence: Option<Turbulence>,
}

#[derive(Debug)]
enum WarpStep {
    Transform {
        inverse: DAffine3,
        /// The linear part of the forward matrix, which turns normals: a product of the steps' matrices, not inverted.
        forward: DMat3,
    },
    Warp(Box<dyn WarpEval>),
}

impl WarpChain {
    /// Adds a transform.
    pub fn push(&mut self, step: &Step) {
        self.steps.push(step.clone());
        merge_steps(&mut self.steps, 0);
    }

    /// The transforms after the last warp.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Reads `word`, the next token, with its value if it is `warp` or a transform. Returns whether it was.
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

    /// The chain prepared for evaluation. `after` holds the transforms of the object or texture with the pattern.
    #[must_use]
    pub(super) fn prepare(
        &self,
        after: &[Step],
        turbulence: Option<Turbulence>,
        settings: &Settings,
    ) -> PreparedWarpChain {
        let mut chain = PreparedWarpChain {
            steps: Vec::new(),
            turbulence,
        };
        let all: Vec<Step> = self.steps.iter().chain(after).cloned().collect();
        chain.push(&all);
        for link in self.links.iter().rev() {
            let warp = WarpStep::Warp(link.warp.prepare(settings));
            chain.steps.push(warp);
            chain.push(&link.before);
        }
        chain
    }
}

impl PreparedWarpChain {
    fn push(&mut self, steps: &[Step]) {
        let transform = Transform::from_steps(steps);
        if transform.object_from_world != DAffine3::IDENTITY {
            self.steps.push(WarpStep::Transform {
                inverse: transform.object_from_world,
                forward: transform.world_from_object.matrix3,
            });
        }
    }

    /// True if turbulence displaces points.
    #[must_use]
    pub fn is_turbulent(&self) -> bool {
        self.turbulence.is_some()
    }

    /// The point in pattern space for a shading point.
    #[must_use]
    #[inline]
    pub fn to_pattern_space(&self, point: DVec3) -> DVec3 {
        let mut point = self.before_turbulence(point);
        if let Some(turbulence) = &self.turbulence {
            point = turbulence.moved(point);
        }
        within_limits(point)
    }

    /// Four points in pattern space.
    #[must_use]
    pub fn to_pattern_space_x4(&self, points: &[DVec3; 4]) -> [DVec3; 4] {
        let mut points = points.map(|point| self.before_turbulence(point));
        if let Some(turbulence) = &self.turbulence {
            points = turbulence.moved_x4(&points);
        }
        points.map(within_limits)
    }

    /// The point after the transforms and warps, before the turbulence.
    #[inline]
    fn before_turbulence(&self, point: DVec3) -> DVec3 {
        let mut point = point;
        for step in &self.steps {
            point = match step {
                WarpStep::Transform { inverse, .. } => inverse.transform_point3(point),
                WarpStep::Warp(warp) => warp.moved(point),
            };
        }
        point
    }
}

#[inline]
fn within_limits(point: DVec3) -> DVec3 {
    point.clamp(DVec3::splat(-MAX_COORDINATE), DVec3::splat(MAX_COORDINATE))
}

impl PreparedWarpChain {
    /// The transforms of normals to and from pattern space, with normalization after each if `is_unit`. Warps do not
    /// change normals.
    #[must_use]
    pub fn normal_transforms(&self, is_unit: bool) -> NormalTransforms {
        let transforms = self.steps.iter().filter_map(|step| match step {
            WarpStep::Transform { inverse, forward } => Some(NormalTransform {
                to_pattern: forward.transpose(),
                from_pattern: inverse.matrix3.transpose(),
                is_unit,
            }),
            WarpStep::Warp(_) => None,
        });
        NormalTransforms(transforms.collect())
    }
}

/// Transforms of normals to and from pattern space, in the order in which the transforms act on points.
#[derive(Clone, Debug, Default)]
pub struct NormalTransforms(Vec<NormalTransform>);

/// The action of one transform on normals.
#[derive(Clone, Copy, Debug)]
struct NormalTransform {
    to_pattern: DMat3,
    from_pattern: DMat3,
    /// True if the normal is normalized afterwards; otherwise bumps keep their slope when they are scaled.
    is_unit: bool,
}

impl NormalTransforms {
    /// These transforms, then others.
    #[must_use]
    pub fn then(&self, others: &NormalTransforms) -> NormalTransforms {
        NormalTransforms(self.0.iter().chain(&others.0).copied().collect())
    }

    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// True if unit normals stay unit vectors in pattern space.
    #[must_use]
    pub fn is_unit(&self) -> bool {
        self.0.iter().all(|transform| transform.is_unit)
    }

    /// Takes a normal to pattern space.
    #[must_use]
    pub fn to_pattern(&self, normal: DVec3) -> DVec3 {
        self.0.iter().fold(normal, |normal, transform| {
            normalized_if(transform.to_pattern * normal, transform.is_unit)
        })
    }

    /// Takes a normal back from pattern space.
    #[must_use]
    pub fn from_pattern(&self, normal: DVec3) -> DVec3 {
        let transforms = self.0.iter().rev();
        transforms.fold(normal, |normal, transform| {
            normalized_if(transform.from_pattern * normal, transform.is_unit)
        })
    }
}

fn normalized_if(normal: DVec3, is_unit: bool) -> DVec3 {
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
        prepared.to_pattern_space(point)
    }

    #[test]
    fn the_last_written_transform_acts_first_on_a_point() {
        let point = moved("scale 2 translate 1", &[], DVec3::splat(5.0));
        assert_eq!(point, DVec3::splat(2.0));
        let after = [Step::Translate(DVec3::X)];
        assert_eq!(moved("scale 2", &after, DVec3::X), DVec3::ZERO);
    }

    #[test]
    fn warps_and_transforms_act_in_their_order() {
        let point = DVec3::new(3.5, 0.0, 0.0);
        let repeated = moved("scale 2 warp { repeat <1, 0, 0> }", &[], point);
        assert_eq!(repeated.x, 0.25);
        let repeated = moved("warp { repeat <1, 0, 0> } scale 2", &[], point);
        assert_eq!(repeated.x, 0.75);
    }

    #[test]
    fn points_stay_finite() {
        let far = moved("", &[], DVec3::splat(f64::MAX));
        assert_eq!(far, DVec3::splat(MAX_COORDINATE));
    }
}
