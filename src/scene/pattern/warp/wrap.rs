//! `warp { cylindrical }`, `spherical`, `toroidal` and `planar`: the xy plane of the pattern wrapped about a body.

use super::{Warp, Warping};
use crate::base::args::{Args, Parse, Word};
use crate::scene::pattern::Settings;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// What the plane is wrapped about.
#[derive(Clone, Copy, Debug)]
enum Body {
    Cylinder,
    Sphere,
    /// With the radius of its middle circle.
    Torus(f64),
    /// With the value of the third coordinate.
    Plane(f64),
}

#[derive(Clone, Copy, Debug)]
struct Wrap {
    body: Body,
    /// The normal of the pattern's plane.
    orientation: DVec3,
    /// How the pattern grows with the distance: its exponent.
    growth: f64,
}

/// `cylindrical`.
pub(super) fn cylindrical(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    read(Body::Cylinder, args)
}

/// `spherical`.
pub(super) fn spherical(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    read(Body::Sphere, args)
}

/// `toroidal`.
pub(super) fn toroidal(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    read(Body::Torus(1.0), args)
}

/// `planar`.
pub(super) fn planar(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let mut warp = Wrap {
        body: Body::Plane(0.0),
        orientation: DVec3::Z,
        growth: 0.0,
    };
    if args.at_expression()? {
        warp.orientation = args.vector()?.normalize_or_zero();
        args.comma()?;
        warp.body = Body::Plane(args.float()?);
    }
    Ok(Box::new(warp))
}

fn read(body: Body, args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let mut warp = Wrap {
        body,
        orientation: DVec3::Z,
        growth: 0.0,
    };
    loop {
        if args.accept(Word::Orientation)? {
            warp.orientation = args.vector()?.normalize_or_zero();
        } else if args.accept(Word::DistExp)? {
            warp.growth = args.float()?;
        } else if let Body::Torus(radius) = &mut warp.body
            && args.accept(Word::MajorRadius)?
        {
            *radius = args.float()?;
        } else {
            return Ok(Box::new(warp));
        }
    }
}

impl Warp for Wrap {
    fn prepare(&self, _settings: &Settings) -> Box<dyn Warping> {
        Box::new(*self)
    }
}

impl Warping for Wrap {
    fn moved(&self, p: DVec3) -> DVec3 {
        let growth = |distance: f64| match self.growth {
            0.0 => 1.0,
            1.0 => distance,
            exponent => distance.powf(exponent),
        };
        let flat = (p.x * p.x + p.z * p.z).sqrt();
        let turn = turn(p.x, p.z);
        let wrapped = match self.body {
            Body::Cylinder => DVec3::new(turn * growth(flat), p.y, flat),
            Body::Sphere => {
                let distance = p.length();
                let height = if distance == 0.0 {
                    0.0
                } else {
                    (p.y / distance).clamp(-1.0, 1.0).asin()
                };
                let factor = growth(distance);
                DVec3::new(turn * factor, (0.5 + height / PI) * factor, distance)
            }
            Body::Torus(radius) => {
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
            Body::Plane(distance) => DVec3::new(p.x, p.y, distance),
        };
        oriented(wrapped, self.orientation)
    }
}

/// The angle of (x, z) from +x towards +z, in turns from 0 to 1.
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

/// A point whose plane has this normal instead of z.
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
    fn a_cylinder_takes_the_angle_for_x() {
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
