//! Finding what a ray may meet among many things with bounds: at first by asking each of them.

use crate::math::{Bounds, Ray};
use glam::DVec3;

/// A collection of things with bounds, by their numbers.
#[derive(Debug)]
pub struct Bvh {
    bounds: Vec<Bounds>,
}

impl Bvh {
    /// The collection of things with these bounds.
    #[must_use]
    pub fn build(bounds: &[Bounds]) -> Self {
        Bvh {
            bounds: bounds.to_vec(),
        }
    }

    fn numbers(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.bounds).map(|(number, _)| number)
    }

    /// Asks the things that a ray may meet; each is told how far it matters and gives a new limit.
    pub fn nearest(&self, _ray: &Ray, _from: f64, to: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        self.numbers().fold(to, |far, number| visit(number, far));
    }

    /// Asks the things that a ray may meet until one says yes.
    pub fn any(&self, _ray: &Ray, _from: f64, _to: f64, visit: impl FnMut(u32) -> bool) -> bool {
        self.numbers().any(visit)
    }

    /// Tells the things whose bounds may hold a point.
    pub fn around(&self, _point: DVec3, visit: impl FnMut(u32)) {
        self.numbers().for_each(visit);
    }
}
