//! Builds a scene as plain data, without any file, and renders it: `cargo run --release --example build_scene -- PICTURE.png`

use glam::DVec3;
use povr::base::color::{Color, Rgb};
use povr::base::options::RenderOptions;
use povr::output::{self, EncodeOptions, Format, Target};
use povr::render::{self, Earlier};
use povr::scene::camera::Camera;
use povr::scene::light::Light;
use povr::scene::shape::{Plane, Shape, Sphere};
use povr::scene::texture::{Finish, Layer, Pigment, PigmentKind};
use povr::scene::{Attached, Kind, Object, Scene};
use povr::world;
use std::error::Error;
use std::sync::Arc;

/// An object of one colour.
fn object(shape: Shape, rgb: Rgb) -> Arc<Object> {
    let layer = Layer {
        pigment: Pigment {
            kind: PigmentKind::Plain(Color::opaque(rgb)),
            ..Pigment::default()
        },
        finish: Arc::new(Finish {
            phong: 0.6,
            ..Finish::default()
        }),
        ..Layer::default()
    };
    let mut object = Object::new(Kind::Shape(Arc::new(shape)));
    object.texture = Some(Attached {
        what: Arc::new(layer.into()),
        after: 0,
    });
    Arc::new(object)
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).unwrap_or("spheres.png".into());
    let mut scene = Scene {
        camera: Camera::perspective(DVec3::new(0.0, 2.5, -8.0), DVec3::Y, 4.0 / 3.0)
            .ok_or("the camera needs a direction")?,
        ..Scene::default()
    };
    let light = Light::point(DVec3::new(-10.0, 20.0, -15.0), Rgb::WHITE);
    scene.objects.push(Arc::new(Object::new(Kind::Light {
        light: Arc::new(light),
        looks_like: None,
        projected_through: None,
    })));
    let ground = Plane::new(DVec3::Y, 0.0);
    scene
        .objects
        .push(object(Shape::Plane(ground), Rgb::new(0.5, 0.6, 0.5)));
    for i in 0..5_u8 {
        let share = f32::from(i) / 4.0;
        let sphere = Sphere {
            centre: DVec3::new(f64::from(i) * 1.6 - 3.2, 0.75, 0.0),
            radius: 0.75,
        };
        let rgb = Rgb::new(0.9 - 0.7 * share, 0.3, 0.2 + 0.7 * share);
        scene.objects.push(object(Shape::Sphere(sphere), rgb));
    }

    let render = RenderOptions::of_size(640, 480);
    let working = scene.working_gamma();
    let world = world::compile(scene, &render);
    let drawn = render::render(&world, &render, Earlier::default(), &|_| {});
    let options = EncodeOptions {
        working,
        ..EncodeOptions::new(Format::PNG)
    };
    output::write(&drawn.film, &Target::File(path.into()), &options)?;
    Ok(())
}
