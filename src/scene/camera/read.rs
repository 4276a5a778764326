//! Reading a `camera` block.
//!
//! From version 3.5 on the order of the words does not matter: vectors first, then `angle`, `look_at`, the scale of
//! an orthographic view, and all transforms together at the end. Before, each word acts where it stands.

use super::{Camera, KINDS, Projection, bumps::Bumps, cylinder::Roll, mesh_camera::MeshCamera};
use crate::base::args::{Args, Parse, Word, declared, not_built, transform_step};
use crate::base::math::Transform;
use crate::base::source::{Diagnostic, Span};
use crate::scene::texture::Normal;
use glam::DVec3;

/// The first language version in which the order of the words does not matter.
const FIRST_WITHOUT_ORDER: f64 = 3.5;
/// A vector whose components are all below this has no direction; POV-Ray's value.
const NO_DIRECTION: f64 = 1e-10;
/// The height of a `spherical` picture as a share of its width, where only one angle is given.
const HALF: f64 = 0.5;

/// What a block asks for that takes effect at its end.
#[derive(Default)]
struct Pending {
    angle_deg: Option<f64>,
    /// True if there is an `angle`, be it one of 0, which opens the view to nothing else.
    has_angle: bool,
    look_at: Option<(DVec3, Span)>,
    has_frame: bool,
    transform: Option<Transform>,
}

impl Camera {
    /// The camera of a block. `base` is the default camera; before version 3.5 it is the camera written before.
    ///
    /// # Errors
    /// A malformed value, a word that is not built yet, `angle` out of bounds, or `look_at` equal to `location`.
    pub fn read(args: &mut dyn Args, base: &Camera) -> Parse<Camera> {
        args.open()?;
        let mut is_named = false;
        let mut camera = match declared::<Camera>(args)? {
            Some(known) => {
                is_named = true;
                Camera::clone(&known)
            }
            None => base.clone(),
        };
        if args.version() < FIRST_WITHOUT_ORDER {
            camera.read_in_order(args)?;
            camera.blur.focus(&camera.frame);
            return Ok(camera);
        }
        let mut pending = Pending::default();
        if !is_named {
            while let Some(word) = args.word()?
                && camera.read_projection(word, args)?
            {}
        }
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                let before = pending.transform.unwrap_or(Transform::IDENTITY);
                pending.transform = Some(before.then(&step.transform()));
            } else if is_named {
                return Err(args.expected("a transform or `}` after the name of a camera"));
            } else {
                camera.read_item(args, &mut pending)?;
            }
        }
        if !is_named {
            camera.finish(args, &pending)?;
            camera.blur.focus(&camera.frame);
        }
        if let Some(transform) = &pending.transform {
            camera.transform(transform);
        }
        if let Some(meshes) = &mut camera.meshes {
            meshes.look(&camera.frame);
        }
        Ok(camera)
    }

    /// One parameter of a block in which the order does not matter.
    fn read_item(&mut self, args: &mut dyn Args, pending: &mut Pending) -> Parse<()> {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of `camera` or `}`"));
        };
        match word {
            Word::Angle => {
                pending.angle_deg = self.read_angle(args)?;
                pending.has_angle = true;
            }
            Word::LookAt => pending.look_at = Some(look_at(args)?),
            Word::Up | Word::Right => {
                self.read_vector(word, args)?;
                pending.has_frame = true;
            }
            _ if KINDS.iter().any(|kind| kind.0 == word) => {
                return Err(Box::new(
                    Diagnostic::error(args.span(), format!("`{word}` must come first in `camera`"))
                        .with_hint("Write it right after `camera {`."),
                ));
            }
            _ if self.read_vector(word, args)? => {}
            _ if self.blur.read_item(word, args)? || self.read_bumps(word, args)? => {}
            _ => return Err(unknown(word, args)),
        }
        Ok(())
    }

    /// A parameter that is a plain vector.
    fn read_vector(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let slot = match word {
            Word::Location => &mut self.frame.location,
            Word::Direction => &mut self.frame.direction,
            Word::Up => &mut self.frame.up,
            Word::Right => &mut self.frame.right,
            Word::Sky => &mut self.sky,
            _ => return Ok(false),
        };
        args.accept(word)?;
        *slot = args.vector()?;
        Ok(true)
    }

    /// `normal`.
    fn read_bumps(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if word != Word::Normal {
            return Ok(false);
        }
        args.accept(word)?;
        self.bumps = Some(Bumps::new(Normal::read(args, None)?));
        Ok(true)
    }

    fn read_projection(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let Some((_, projection)) = KINDS.iter().find(|kind| kind.0 == word) else {
            return Ok(false);
        };
        args.accept(word)?;
        self.projection = *projection;
        self.meshes = None;
        if word == Word::MeshCamera {
            self.meshes = Some(MeshCamera::read(args)?);
        }
        if word == Word::Cylinder {
            let at = args.span();
            let number = args.float()?;
            let Some(roll) = Roll::of_number(number) else {
                let message = format!("`cylinder` cameras have the types 1 to 4, not {number}");
                return Err(Box::new(Diagnostic::error(
                    at.to(args.last_span()),
                    message,
                )));
            };
            self.projection = Projection::Cylinder(roll);
        }
        Ok(true)
    }

    /// `angle` and its degrees, which only some projections bound; to those 0 is as if it were not there.
    fn read_angle(&mut self, args: &mut dyn Args) -> Parse<Option<f64>> {
        let at = args.span();
        args.accept(Word::Angle)?;
        let degrees = args.float()?;
        if let Projection::Spherical(vertical) = &mut self.projection {
            let has_comma = args.comma()?;
            *vertical = if has_comma || args.at_expression()? {
                args.float()?.to_radians()
            } else {
                HALF * degrees.to_radians()
            };
        }
        let is_flat = matches!(
            self.projection,
            Projection::Perspective | Projection::Orthographic
        );
        let bound = if degrees < 0.0 {
            "must not be negative"
        } else if is_flat && degrees >= 180.0 {
            "must be less than 180 degrees"
        } else {
            return Ok((degrees > 0.0 || !is_flat).then_some(degrees));
        };
        Err(Box::new(Diagnostic::error(
            at.to(args.last_span()),
            format!("`angle` {bound}, but it is {degrees}"),
        )))
    }

    /// Applies what waits for the end of the block, except the transforms.
    fn finish(&mut self, args: &mut dyn Args, pending: &Pending) -> Parse<()> {
        if let Some(degrees) = pending.angle_deg {
            self.open_to(degrees);
        }
        if let Some((point, at)) = pending.look_at {
            self.aim(args, point, at)?;
        }
        let is_orthographic = self.projection == Projection::Orthographic;
        if is_orthographic && (pending.has_angle || !pending.has_frame) {
            self.fit_orthographic();
        }
        Ok(())
    }

    /// A block in which each word acts where it stands, as before version 3.5.
    fn read_in_order(&mut self, args: &mut dyn Args) -> Parse<()> {
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                let transform = step.transform();
                self.look_at = transform.world_from_object.transform_point3(self.look_at);
                self.transform(&transform);
                continue;
            }
            let Some(word) = args.word()? else {
                return Err(args.expected("a parameter of `camera` or `}`"));
            };
            match word {
                Word::MeshCamera => return Err(unknown(word, args)),
                Word::Angle => {
                    let degrees = self.read_angle(args)?;
                    if let Some(degrees) = degrees
                        && self.projection != Projection::Orthographic
                    {
                        self.open_to(degrees);
                    }
                }
                Word::LookAt => {
                    let (point, at) = look_at(args)?;
                    self.aim(args, point, at)?;
                }
                Word::Orthographic => {
                    self.read_projection(word, args)?;
                    self.fit_orthographic();
                }
                _ if self.read_vector(word, args)?
                    || self.read_projection(word, args)?
                    || self.blur.read_item(word, args)?
                    || self.read_bumps(word, args)? => {}
                _ => return Err(unknown(word, args)),
            }
        }
        Ok(())
    }

    /// Makes the picture span `degrees` from left to right.
    fn open_to(&mut self, degrees: f64) {
        self.angle = Some(degrees.to_radians());
        if matches!(
            self.projection,
            Projection::Perspective | Projection::Orthographic
        ) {
            let frame = &mut self.frame;
            let length = frame.right.length() / (2.0 * (0.5 * degrees).to_radians().tan());
            frame.direction = frame.direction.normalize_or(DVec3::Z) * length;
        }
    }

    /// Aims the camera at the point of a `look_at`.
    fn aim(&mut self, args: &mut dyn Args, point: DVec3, at: Span) -> Parse<()> {
        match self.turn_to(point) {
            None => Err(Box::new(
                Diagnostic::error(at, "`look_at` is the same point as `location`")
                    .with_hint("Move one of the two: the camera needs a direction."),
            )),
            Some(has_sky) => {
                if !has_sky {
                    args.warn(Diagnostic::warning(
                        at,
                        "the camera looks along `sky`; it keeps its `right`",
                    ));
                }
                Ok(())
            }
        }
    }

    /// Turns the camera so that `point` is in the middle and `sky` points up; lengths and handedness stay. False if it
    /// looks along `sky`, which then gives no direction; `None` if it stands at the point.
    pub(super) fn turn_to(&mut self, point: DVec3) -> Option<bool> {
        let frame = &mut self.frame;
        let handedness = frame.up.cross(frame.direction).dot(frame.right);
        let forward = (point - frame.location).try_normalize()?;
        let mut sideways = self.sky.cross(forward);
        let has_sky = !sideways.abs().cmplt(DVec3::splat(NO_DIRECTION)).all();
        if !has_sky {
            sideways = frame.right;
        }
        let sideways = sideways.normalize_or(DVec3::X);
        let upward = forward.cross(sideways);
        let width = frame.right.length();
        frame.direction = forward * frame.direction.length();
        frame.up = upward * frame.up.length();
        frame.right = sideways * if handedness > 0.0 { width } else { -width };
        self.look_at = point;
        self.blur.look(&self.frame);
        Some(has_sky)
    }
}

/// `look_at` with its point, and where it stands.
fn look_at(args: &mut dyn Args) -> Parse<(DVec3, Span)> {
    let at = args.span();
    args.accept(Word::LookAt)?;
    let point = args.vector()?;
    Ok((point, at.to(args.last_span())))
}

/// The error for a word that no camera has, or that is not built yet.
fn unknown(word: Word, args: &mut dyn Args) -> Box<Diagnostic> {
    if matches!(word, Word::Normal | Word::MeshCamera) {
        not_built(args, word)
    } else {
        args.expected("a parameter of `camera` or `}`")
    }
}
