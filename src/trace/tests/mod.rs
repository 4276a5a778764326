//! Single points of small scenes against POV-Ray 3.7.0.10, as it writes them with `+FN16 File_Gamma=1.0`.
//!
//! Each scene stands as POV-Ray read it, but for the head that [`HEAD`] and [`view`] put before it. The picture has
//! one pixel, whose ray runs along z. The readers of the elements read the texts.

mod glass;
mod light;
mod mirrors;
mod settings;

use super::{Sample, Tracer};
use crate::args::text::TextArgs;
use crate::args::{Args, Parse, Word};
use crate::camera::Camera;
use crate::color::{Color, Rgb};
use crate::compile::{Flags, Globals, InteriorId, Scratch, Solid, Surface, World};
use crate::interior::Interior;
use crate::light::Light;
use crate::math::{Bounds, Ray, Step};
use crate::shape::{Crossing, Geometry, Root, Start};
use crate::texture::{Layer, Texture};
use glam::DVec3;
use std::sync::Arc;

/// What POV-Ray reads before each scene, with the version of the test.
const HEAD: &str = "global_settings { assumed_gamma 1 }";
/// Two steps of the sixteen bits.
const TOLERANCE: f64 = 2.0 / 65_535.0;

/// A camera whose only ray starts at `<x, y, -5>` along z.
fn view(x: f64, y: f64) -> String {
    format!(
        "camera {{ orthographic location <{x}, {y}, -5> right <0.001, 0, 0> up <0, 0.001, 0> }}"
    )
}

struct Ball {
    centre: DVec3,
    radius: f64,
}

impl Geometry for Ball {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let to_centre = self.centre - ray.origin;
        let nearest = to_centre.dot(ray.dir);
        let half_sq = self.radius * self.radius - (to_centre - nearest * ray.dir).length_squared();
        if half_sq > 0.0 {
            roots.push(root(nearest - half_sq.sqrt(), Crossing::Enter));
            roots.push(root(nearest + half_sq.sqrt(), Crossing::Leave));
        }
        Start::Outside
    }

    fn normal(&self, point: DVec3, _face: u16) -> DVec3 {
        point - self.centre
    }

    fn contains(&self, point: DVec3) -> bool {
        (point - self.centre).length_squared() < self.radius * self.radius
    }

    fn bounds(&self) -> Bounds {
        Bounds::new(self.centre - self.radius, self.centre + self.radius)
    }

    fn absorb(&mut self, _step: &Step) -> bool {
        false
    }
}

struct HalfSpace {
    normal: DVec3,
    distance: f64,
}

impl Geometry for HalfSpace {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let speed = ray.dir.dot(self.normal);
        if speed != 0.0 {
            let t = (self.distance - ray.origin.dot(self.normal)) / speed;
            let crossing = if speed < 0.0 {
                Crossing::Enter
            } else {
                Crossing::Leave
            };
            roots.push(root(t, crossing));
        }
        if speed > 0.0 {
            Start::Inside
        } else {
            Start::Outside
        }
    }

    fn normal(&self, _point: DVec3, _face: u16) -> DVec3 {
        self.normal
    }

    fn contains(&self, point: DVec3) -> bool {
        point.dot(self.normal) < self.distance
    }

    fn bounds(&self) -> Bounds {
        Bounds::EVERYTHING
    }

    fn absorb(&mut self, _step: &Step) -> bool {
        false
    }
}

fn root(t: f64, crossing: Crossing) -> Root {
    Root {
        t,
        crossing,
        face: 0,
        is_visible: true,
    }
}

/// The world of a text with `camera`, `background`, `light_source`, `sphere`, `plane` and `global_settings`.
fn world(text: &str, version: f64) -> Parse<World> {
    let mut args = TextArgs::new(text).at_version(version);
    let mut world = World {
        camera: Camera::default(),
        solids: Vec::new(),
        lights: Vec::new(),
        surfaces: Vec::new(),
        interiors: Vec::new(),
        background: Color::from_components([0.0, 0.0, 0.0, 0.0, 1.0]),
        globals: Globals {
            adc_bailout: 1.0 / 255.0,
            max_trace_level: 5,
            ambient_light: Rgb::WHITE,
            rules_37: version >= 3.7,
            has_alpha: false,
        },
    };
    while let Some(word) = args.word()? {
        args.accept(word)?;
        match word {
            Word::Camera => world.camera = Camera::read(&mut args, &Camera::default())?,
            Word::LightSource => world.lights.push(Light::read(&mut args)?),
            Word::Background => {
                args.open()?;
                world.background = args.color()?;
                args.close()?;
            }
            Word::GlobalSettings => read_globals(&mut world.globals, &mut args)?,
            _ => read_object(word, &mut world, &mut args)?,
        }
    }
    assert!(args.is_done(), "the test reads all of its scene");
    Ok(world)
}

fn read_globals(globals: &mut Globals, args: &mut TextArgs) -> Parse<()> {
    args.open()?;
    while !args.accept_close()? {
        if args.accept(Word::MaxTraceLevel)? {
            let asked = args.float()?;
            let level = (1..=5).find(|&level| f64::from(level) == asked);
            globals.max_trace_level = level.ok_or_else(|| args.expected("a level up to 5"))?;
        } else if args.accept(Word::AmbientLight)? {
            globals.ambient_light = args.color()?.rgb;
        } else if args.accept(Word::AdcBailout)? {
            globals.adc_bailout = args.float()?;
        } else {
            return Err(args.expected("a setting"));
        }
    }
    Ok(())
}

fn read_object(word: Word, world: &mut World, args: &mut TextArgs) -> Parse<()> {
    args.open()?;
    let vector = args.vector()?;
    args.comma()?;
    let length = args.float()?;
    let geometry: Box<dyn Geometry + Send + Sync> = match word {
        Word::Sphere => Box::new(Ball {
            centre: vector,
            radius: length,
        }),
        _ => Box::new(HalfSpace {
            normal: vector.normalize(),
            distance: length,
        }),
    };
    let default = Layer::default();
    let mut texture: Option<Texture> = None;
    let mut inside: Option<Texture> = None;
    let mut interior = Interior::default();
    let mut flags = Flags::default();
    while !args.accept_close()? {
        let word = args.word()?.expect("the test has words where words belong");
        if matches!(word, Word::Pigment | Word::Finish) {
            let own = texture.get_or_insert_with(|| Texture::from(default.clone()));
            own.top_mut().read_part(word, args)?;
            continue;
        }
        args.accept(word)?;
        match word {
            Word::Texture => {
                let upper = Texture::read(args, &default)?;
                match &mut texture {
                    Some(lower) => lower.lay_over(upper, args.version()),
                    None => texture = Some(upper),
                }
            }
            Word::InteriorTexture => inside = Some(Texture::read(args, &default)?),
            Word::Interior => interior = Interior::read(args)?,
            Word::NoImage => flags.no_image = true,
            Word::NoShadow => flags.no_shadow = true,
            Word::NoReflection => flags.no_reflection = true,
            Word::DoubleIlluminate => flags.double_illuminate = true,
            _ => return Err(args.expected("a part of an object")),
        }
    }
    let texture = texture.unwrap_or_else(|| Texture::from(default));
    interior.take_from_finishes(texture.layers().iter().map(|layer| &layer.finish));
    let id = u32::try_from(world.interiors.len()).expect("tests have few objects");
    world.interiors.push(interior);
    world.surfaces.push(Surface {
        texture: Arc::new(texture.prepare(&[])),
        inside_texture: inside.map(|texture| Arc::new(texture.prepare(&[]))),
        interior: InteriorId(id),
        flags,
    });
    world.solids.push(Solid {
        geometry,
        surface: id,
    });
    Ok(())
}

/// The sample of the only ray of a scene, for quality 9 if no other is given.
fn sample(
    at: (f64, f64),
    text: &str,
    change: impl FnOnce(&mut World),
    quality: u8,
    version: f64,
) -> Sample {
    let mut world = world(&(view(at.0, at.1) + text), version).expect("the scene is right");
    change(&mut world);
    Tracer::new(&world, quality).pixel(0.0, 0.0, 1, 1, &mut Scratch::default())
}

fn assert_close(text: &str, found: Rgb, expected: [f64; 3]) {
    let found = [found.r, found.g, found.b].map(|c| f64::from(c).clamp(0.0, 1.0));
    let is_close = found
        .iter()
        .zip(expected)
        .all(|(a, b)| (a - b).abs() <= TOLERANCE);
    assert!(
        is_close,
        "{text}\nfound {found:?}, POV-Ray has {expected:?} after {HEAD}"
    );
}

/// The scene seen from `<x, y, -5>` along z has this colour in POV-Ray.
fn shows(x: f64, y: f64, text: &str, expected: [f64; 3]) {
    assert_close(text, sample((x, y), text, |_| {}, 9, 3.7).rgb, expected);
}

/// The same with `#version 3.6;` before it.
fn shows_in_36(x: f64, y: f64, text: &str, expected: [f64; 3]) {
    assert_close(text, sample((x, y), text, |_| {}, 9, 3.6).rgb, expected);
}

/// The same with `#version 3.1;` before it.
fn shows_in_31(x: f64, y: f64, text: &str, expected: [f64; 3]) {
    assert_close(text, sample((x, y), text, |_| {}, 9, 3.1).rgb, expected);
}

/// The same with `+Q` and a quality.
fn shows_at_quality(quality: u8, text: &str, expected: [f64; 3]) {
    assert_close(
        text,
        sample((0.0, 0.0), text, |_| {}, quality, 3.7).rgb,
        expected,
    );
}

/// The same with `+UA`: red, green, blue, not multiplied by alpha, and alpha.
fn shows_with_alpha(version: f64, text: &str, expected: [f64; 4]) {
    let sample = sample(
        (0.0, 0.0),
        text,
        |world| world.globals.has_alpha = true,
        9,
        version,
    );
    let alpha = f64::from(1.0 - sample.transmit);
    assert!(
        (alpha - expected[3]).abs() <= TOLERANCE,
        "{text}\nalpha is {alpha}"
    );
    let pure = if alpha > 0.0 { 1.0 / alpha } else { 0.0 };
    assert_close(
        text,
        sample.rgb * pure,
        [expected[0], expected[1], expected[2]],
    );
}

#[test]
fn a_thousand_panes_do_not_use_up_the_stack() {
    let pane = |i: u16| {
        format!(
            "plane {{ <0, 0, 1>, {i} pigment {{ rgbt 1 }} finish {{ ambient 0.001 diffuse 0 }} }}"
        )
    };
    let text: String = (0..1000).map(pane).collect();
    let seen = sample((0.0, 0.0), &text, |_| {}, 9, 3.7);
    assert_eq!((seen.rgb, seen.transmit), (Rgb::BLACK, 1.0));
}

#[test]
fn two_mirrors_end_at_the_trace_level() {
    let text = "global_settings { max_trace_level 5 }
        plane { <0, 0, -1>, 0 pigment { rgb 1 } finish { ambient 0.125 diffuse 0 reflection 1 } }
        plane { <0, 0, -1>, 6 pigment { rgb 1 } finish { ambient 0.125 diffuse 0 reflection 1 } }";
    // The camera stands between them, at z = -5.
    let seen = sample((0.0, 0.0), text, |_| {}, 9, 3.7);
    assert_eq!(seen.rgb, Rgb::splat(5.0 * 0.125));
}

#[test]
fn a_camera_without_a_ray_sees_nothing() {
    let world = world(
        "camera { direction 0 right 0 up 0 } background { rgb 1 }",
        3.7,
    );
    let seen = Tracer::new(&world.expect("the scene is right"), 9).pixel(
        0.0,
        0.0,
        1,
        1,
        &mut Scratch::default(),
    );
    assert_eq!((seen.rgb, seen.transmit), (Rgb::BLACK, 1.0));
}
