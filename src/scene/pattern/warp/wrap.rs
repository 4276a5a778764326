//! `warp { cylindrical }`, `spherical`, `toroidal` and `planar`: the xy plane of the pattern wrapped around a
//! surface.

use super::{Warp, WarpEval};
use crate::base::args::{Args, Parse, Word};
use crate::scene::pattern::Settings;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The surface around which the plane is wrapped.
#[derive(Clone, Copy, Debug)]
enum Surface {
    Cylinder,
    Sphere,
    /// With the major radius.
    Torus(f64),
    /// With the third coordinate of all points.
    Plane(f64),
}

#[derive(Clone, Copy, Debug)]
struct Wrap {
    surface: Surface,
    /// The normal of the plane of the pattern.
    orientation: DVec3,
    /// `dist_exp`: the pattern grows with this power of the distance.
    growth: f64,
}

/// `cylindrical`.
pub(super) fn cylindrical(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    read(Surface::Cylinder, args)
}

/// `spherical`.
pub(super) fn spherical(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    read(Surface::Sphere, args)
}

/// `toroidal`.
pub(super) fn toroidal(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    read(Surface::Torus(1.0), args)
}

/// `planar`.
pub(super) fn planar(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let mut warp = Wrap {
        surface: Surface::Plane(0.0),
        orientation: DVec3::Z,
        growth: 0.0,
    };
    if args.at_expression()? {
        warp.orientation = args.vector()?.normalize_or_zero();
        args.comma()?;
        warp.surface = Surface::Plane(args.float()?);
    }
    Ok(Box::new(warp))
}

fn read(surface: Surface, args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let mut warp = Wrap {
        surface,
        orientation: DVec3::Z,
        growth: 0.0,
    };
    loop {
        if args.accept(Word::Orientation)? {
            warp.orientation = args.vector()?.normalize_or_zero();
        } else if args.accept(Word::DistExp)? {
            warp.growth = args.float()?;
        } else if let Surface::Torus(radius) = &mut warp.surface
            && args.accept(Word::MajorRadius)?
        {
            *radius = args.float()?;
        } else {
            return Ok(Box::new(warp));
        }
    }
}

impl Warp for Wrap {
    fn prepare(&self, _settings: &Settings) -> Box<dyn WarpEval> {
        Box::new(*self)
    }
}

impl WarpEval for Wrap {
    fn moved(&self, p: DVec3) -> DVec3 {
        let growth = |distance: f64| match self.growth {
            0.0 => 1.0,
            1.0 => distance,
            exponent => distance.powf(exponent),
        };
        let flat = (p.x * p.x + p.z * p.z).sqrt();
        let turn = turn(p.x, p.z);
        let wrapped = match self.surface {
            Surface::Cylinder => DVec3::new(turn * growth(flat), p.y, flat),
            Surface::Sphere => {
                let distance = p.length();
                let height = if distance == 0.0 {
                    0.0
                } else {
                    (p.y / distance).clamp(-1.0, 1.0).asin()
                };
                let factor = growth(distance);
                DVec3::new(turn * factor, (0.5 + height / PI) * factor, distance)
            }
            Surface::Torus(radius) => {
                let out = flat - radius;
                let distance = (out * out + p.y * p.y).sqrt();
                let angle = if distance == 0.0 {
                    0.0
                } else {
                    (-out / distance).clamp(-1.0, 1.0).acos()
                };
                let angle = if p.y > 0.0 { TAU - angle } else { angle };
                let factor = growth(distance);
                DVec3::new(turn * factor, angle / TAU * factor, distance)
            }
            Surface::Plane(distance) => DVec3::new(p.x, p.y, distance),
        };
        oriented(wrapped, self.orientation)
    }
}

/// The angle of (x, z) from +x towards +z, in turns from 0 to 1; 0 at the origin.
fn turn(x: f64, z: f64) -> f64 {
    let length = (x * x + z * z).sqrt();
    if length == 0.0 {
        return 0.0;
    }
    let angle = (x / length).clamp(-1.0, 1.0).acos();
    if z < 0.0 {
        (TAU - angle) / TAU
    } else {
        angle / TAU
    }
}

/// Reorients a point from a plane with the normal z to one with the normal `o`.
fn oriented(p: DVec3, o: DVec3) -> DVec3 {
    DVec3::new(
        o.x * p.z + o.y * p.x + o.z * p.x,
        o.x * p.y - o.y * p.z + o.z * p.y,
        -o.x * p.x + o.y * p.y + o.z * p.z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cylinder_maps_the_angle_to_x() {
        let mut args = crate::base::args::text::TextArgs::new("dist_exp 1");
        let warp = cylindrical(&mut args)
            .unwrap()
            .prepare(&Settings::default());
        assert_eq!(
            warp.moved(DVec3::new(0.0, 5.0, 2.0)),
            DVec3::new(0.5, 5.0, 2.0)
        );
        assert_eq!(warp.moved(DVec3::ZERO), DVec3::ZERO);
    }
}
