//! `contained_by { box { ... } }` or `contained_by { sphere { ... } }`: the region in which a shape defined by
//! functions is searched for.

use super::{Cuboid, SpanEnd, Sphere};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// A box or a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Container {
    Box { low: DVec3, high: DVec3 },
    Sphere { centre: DVec3, radius: f64 },
}

/// Face number of a sphere. A box has two faces per axis: twice the axis for the lower one, and one more for the upper.
const SPHERE_FACE: u32 = 6;
/// Distance from a face up to which a point is on it.
const FACE_TOLERANCE: f64 = 1e-10;
/// Rounding of the length of a unit vector.
const UNIT_TOLERANCE: f64 = 4.0 * f64::EPSILON;

impl Container {
    /// Number of faces of both kinds of container.
    pub(super) const FACES: u32 = 7;

    /// The default box.
    pub(super) const DEFAULT: Container = Container::Box {
        low: DVec3::NEG_ONE,
        high: DVec3::ONE,
    };

    /// Reads the container after its keyword.
    ///
    /// # Errors
    /// Another shape, or malformed parameters.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Self> {
        args.open()?;
        let is_box = args.accept(Word::Box)?;
        if !is_box && !args.accept(Word::Sphere)? {
            return Err(args.expected("`box` or `sphere` in `contained_by`"));
        }
        args.open()?;
        let container = if is_box {
            let Bounds { min, max } = super::Geometry::bounds(&Cuboid::read(args)?);
            Container::Box {
                low: min,
                high: max,
            }
        } else {
            let Sphere { centre, radius } = Sphere::read(args)?;
            Container::Sphere { centre, radius }
        };
        args.close()?;
        args.close()?;
        Ok(container)
    }

    pub(super) fn bounds(&self) -> Bounds {
        match *self {
            Container::Box { low, high } => Bounds {
                min: low,
                max: high,
            },
            Container::Sphere { centre, radius } => {
                let radius = DVec3::splat(radius.abs());
                Bounds {
                    min: centre - radius,
                    max: centre + radius,
                }
            }
        }
    }

    /// Inside test, surface included.
    pub(super) fn contains(&self, point: DVec3) -> bool {
        match *self {
            Container::Box { low, high } => point.cmpge(low).all() && point.cmple(high).all(),
            Container::Sphere { centre, radius } => {
                (point - centre).length_squared() <= radius * radius
            }
        }
    }

    /// True if a root of the function at this point has the normal of the container: on a sphere, within POV-Ray's absolute
    /// tolerance, which is the same for all sizes, but not on a box.
    pub(super) fn takes_in(&self, point: DVec3) -> bool {
        match *self {
            Container::Box { .. } => false,
            Container::Sphere { centre, radius } => {
                (point.distance(centre) - radius).abs() < FACE_TOLERANCE
            }
        }
    }

    /// The outward normal of a face.
    pub(super) fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        match *self {
            Container::Box { .. } => {
                let mut normal = DVec3::ZERO;
                normal[(face / 2) as usize % 3] = if face % 2 == 1 { 1.0 } else { -1.0 };
                normal
            }
            Container::Sphere { centre, .. } => point - centre,
        }
    }

    /// The entry and exit of a ray's line.
    pub(super) fn chord(&self, ray: &Ray) -> Option<[SpanEnd; 2]> {
        match *self {
            Container::Box { low, high } => box_chord(ray, low, high),
            Container::Sphere { centre, radius } => {
                // In this form, for a unit direction as it is, the ends have POV-Ray's last digits.
                let (dir, length) = match ray.dir.length() {
                    length if (length - 1.0).abs() < UNIT_TOLERANCE => (ray.dir, 1.0),
                    length => (ray.dir / length, length),
                };
                let to_centre = centre - ray.origin;
                let middle = to_centre.dot(dir);
                let half_sq = radius * radius - to_centre.length_squared() + middle * middle;
                (half_sq > 0.0).then(|| {
                    let half = half_sq.sqrt();
                    [
                        SpanEnd::new((middle - half) / length, SPHERE_FACE),
                        SpanEnd::new((middle + half) / length, SPHERE_FACE),
                    ]
                })
            }
        }
    }
}

fn box_chord(ray: &Ray, low: DVec3, high: DVec3) -> Option<[SpanEnd; 2]> {
    let mut enter = SpanEnd::new(f64::NEG_INFINITY, 0);
    let mut leave = SpanEnd::new(f64::INFINITY, 0);
    for (axis, lower) in [(0, 0), (1, 2), (2, 4)] {
        let (origin, dir) = (ray.origin[axis], ray.dir[axis]);
        if dir == 0.0 {
            if origin < low[axis] || origin > high[axis] {
                return None;
            }
            continue;
        }
        let at_low = SpanEnd::new((low[axis] - origin) / dir, lower);
        let at_high = SpanEnd::new((high[axis] - origin) / dir, lower + 1);
        let (near, far) = if dir > 0.0 {
            (at_low, at_high)
        } else {
            (at_high, at_low)
        };
        if near.t > enter.t {
            enter = near;
        }
        if far.t < leave.t {
            leave = far;
        }
    }
    (enter.t < leave.t && enter.t.is_finite() && leave.t.is_finite()).then_some([enter, leave])
}
