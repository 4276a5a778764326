//! Parser of `camera` blocks.
//!
//! From version 3.5 on, the order of the parameters does not matter: vectors are applied first, then `angle`,
//! `look_at`, the scale of an orthographic camera, and finally all transforms together. Before 3.5, each parameter
//! takes effect where it is written.

use super::{Camera, KINDS, Projection, bumps::Bumps, cylinder::Roll, mesh_camera::MeshCamera};
use crate::base::args::{Args, Parse, Word, declared, not_built, transform_step};
use crate::base::math::Transform;
use crate::base::math::conditioning::Normalization;
use crate::base::source::{Diagnostic, Span};
use crate::scene::texture::Normal;
use glam::DVec3;
use std::sync::Arc;

/// The first language version in which the order of the parameters does not matter.
const FIRST_WITHOUT_ORDER: f64 = 3.5;
/// A vector with all components below this has no direction; POV-Ray's value.
const NO_DIRECTION: f64 = 1e-10;
/// The vertical angle of a `spherical` camera as a fraction of the horizontal one, if only one angle is given.
const VERTICAL_FRACTION: f64 = 0.5;

/// Parameters that take effect at the end of the block.
#[derive(Default)]
struct Pending {
    angle_deg: Option<f64>,
    /// True if `angle` is given. It scales an orthographic camera even if it is 0, which has no other effect.
    has_angle: bool,
    look_at: Option<(DVec3, Span)>,
    has_frame: bool,
    transform: Option<Transform>,
}

impl Camera {
    /// Reads a `camera` block. `base` is the default camera; before version 3.5 it is the previous camera of the scene.
    ///
    /// # Errors
    /// A malformed value, an unsupported parameter, `angle` out of range, or `look_at` equal to `location`.
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
            camera.blur.update_distance(&camera.frame);
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
            camera.blur.update_distance(&camera.frame);
        }
        if let Some(transform) = &pending.transform {
            camera.transform(transform);
        }
        if let Some(meshes) = &mut camera.meshes {
            meshes.apply_frame(&camera.frame);
        }
        Ok(camera)
    }

    /// Reads a parameter, for versions in which the order does not matter.
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

    /// Reads a vector parameter; false if `word` is none.
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
        if let (Some(functions), Word::Location | Word::Direction) = (&mut self.functions, word)
            && Arc::make_mut(functions).read_item(word, args)?
        {
            return Ok(true);
        }
        *slot = args.vector()?;
        Ok(true)
    }

    /// Reads `normal`; false for other words.
    fn read_bumps(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if word != Word::Normal {
            return Ok(false);
        }
        args.accept(word)?;
        self.bumps = Some(Bumps::new(Normal::read(args, None)?));
        Ok(true)
    }

    /// Reads a projection keyword and its parameters; false if `word` is none.
    fn read_projection(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let Some((_, projection)) = KINDS.iter().find(|kind| kind.0 == word) else {
            return Ok(false);
        };
        args.accept(word)?;
        let before = std::mem::replace(&mut self.projection, *projection);
        let meshes_before = self.meshes.take();
        if word == Word::MeshCamera {
            self.meshes = Some(MeshCamera::read(args)?);
        }
        self.functions = (word == Word::UserDefined).then(Arc::default);
        if word == Word::Cylinder {
            let at = args.span();
            let number = args.float()?;
            let at = at.to(args.last_span());
            let message = format!("`cylinder` cameras have the types 1 to 4, not {number}");
            self.projection = match Roll::of_number(number) {
                Some(roll) => Projection::Cylinder(roll),
                None if args.version() < FIRST_WITHOUT_ORDER => {
                    let warning = Diagnostic::warning(at, message);
                    args.warn(warning.with_hint("The projection stays as it was."));
                    self.meshes = meshes_before;
                    before
                }
                None => return Err(Box::new(Diagnostic::error(at, message))),
            };
        }
        Ok(true)
    }

    /// Reads `angle`, in degrees. Perspective and orthographic cameras need less than 180 and ignore 0.
    fn read_angle(&mut self, args: &mut dyn Args) -> Parse<Option<f64>> {
        let at = args.span();
        args.accept(Word::Angle)?;
        let degrees = args.float()?;
        if let Projection::Spherical(vertical) = &mut self.projection {
            *vertical = if args.has_next_value()? {
                args.float()?.to_radians()
            } else {
                VERTICAL_FRACTION * degrees.to_radians()
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

    /// Applies the pending parameters except the transforms.
    fn finish(&mut self, args: &mut dyn Args, pending: &Pending) -> Parse<()> {
        if let Some(degrees) = pending.angle_deg {
            self.set_angle(degrees);
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

    /// Reads the rest of a block before version 3.5: each parameter takes effect where it is written.
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
            if word == Word::Spherical {
                let reason = "before version 3.5 there is no spherical camera";
                let at = args.span();
                args.refused_by_povray(at, reason, "Write `#version 3.5;` above.");
            }
            match word {
                Word::MeshCamera => return Err(unknown(word, args)),
                Word::Angle => {
                    let degrees = self.read_angle(args)?;
                    if let Some(degrees) = degrees
                        && self.projection != Projection::Orthographic
                    {
                        self.set_angle(degrees);
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

    /// Sets the horizontal angle of view.
    fn set_angle(&mut self, degrees: f64) {
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
        match self.turn_to(point, Normalization::of_version(args.is_for_3_8())) {
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

    /// Turns the camera so that `point` is in the centre of the image and `sky` points up, preserving lengths and
    /// handedness. False if the view direction is parallel to `sky`, which then has no effect; `None` if the point is
    /// the camera's location.
    pub(super) fn turn_to(&mut self, point: DVec3, rule: Normalization) -> Option<bool> {
        let frame = &mut self.frame;
        let handedness = frame.up.cross(frame.direction).dot(frame.right);
        let forward = rule.unit_or_zero(point - frame.location);
        if forward == DVec3::ZERO {
            return None;
        }
        let mut sideways = self.sky.cross(forward);
        let has_sky = !sideways.abs().cmplt(DVec3::splat(NO_DIRECTION)).all();
        if !has_sky {
            sideways = frame.right;
        }
        let sideways = match rule.unit_or_zero(sideways) {
            DVec3::ZERO => DVec3::X,
            unit => unit,
        };
        let upward = forward.cross(sideways);
        let width = frame.right.length();
        frame.direction = forward * frame.direction.length();
        frame.up = upward * frame.up.length();
        frame.right = sideways * if handedness > 0.0 { width } else { -width };
        self.look_at = point;
        self.blur.reset_distance(&self.frame);
        Some(has_sky)
    }
}

/// Reads `look_at`: its point and its source span.
fn look_at(args: &mut dyn Args) -> Parse<(DVec3, Span)> {
    let at = args.span();
    args.accept(Word::LookAt)?;
    let point = args.vector()?;
    Ok((point, at.to(args.last_span())))
}

/// The error for an unknown or unsupported parameter.
fn unknown(word: Word, args: &mut dyn Args) -> Box<Diagnostic> {
    if matches!(word, Word::Normal | Word::MeshCamera) {
        not_built(args, word)
    } else {
        args.expected("a parameter of `camera` or `}`")
    }
}
