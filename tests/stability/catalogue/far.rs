//! Sizes, distances and positions far from one (items 10 to 17, 43 to 46, 49, 54).

use crate::case::{Asks, Case};
use crate::model::{
    BLUE, Camera, GREEN, Kind, Model, Object, RED, V, cone, csg, cuboid, cylinder, plane, sphere,
    torus,
};

/// Every kind of solid on a floor, with shadows on each other.
pub(crate) fn all_solids() -> Model {
    let quadric = [1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.25];
    let objects = vec![
        plane([0.0, 1.0, 0.0], -1.0),
        csg(
            "difference",
            vec![
                cuboid([-0.75, -1.0, -0.75], [0.75, 0.5, 0.75]).colored(RED),
                sphere([0.0, 0.25, -0.75], 0.625).colored(GREEN),
                cylinder([0.0, -2.0, 0.0], [0.0, 2.0, 0.0], 0.25).colored(BLUE),
            ],
        )
        .translate([-1.5, 0.0, 0.5]),
        torus(0.75, 0.25)
            .colored([1.0, 1.0, 0.0])
            .translate([0.5, -0.75, -0.5]),
        cone([2.0, -1.0, 1.0], 0.75, [2.0, 1.0, 1.0], 0.125).colored([0.0, 1.0, 1.0]),
        Object::new(Kind::Quadric(quadric))
            .colored([1.0, 0.0, 1.0])
            .translate([0.5, 0.25, 1.5]),
        sphere([1.5, 1.25, 0.25], 0.375).colored([1.0, 0.5, 0.0]),
    ];
    let camera = Camera::at([0.0, 2.0, -6.0], [0.25, -0.25, 0.0], 0.9);
    Model::lit(camera, [-4.0, 6.0, -5.0], objects)
}

/// A sphere of this radius at distance 1 that fills most of the picture.
fn close_sphere(radius: f64) -> Model {
    let mut camera = Camera::ahead([0.0, 0.0, -1.0], 3.0 * radius);
    // Not through the middle of a pixel.
    camera.location[0] = radius / 64.0;
    Model::flat(camera, vec![sphere([0.0; 3], radius)])
}

pub(crate) fn add(all: &mut Vec<Case>) {
    floors(all);
    scales(all);
    written_far_away(all);
    for radius in [1e-4, 1.2e-5, 1e-6, 1e-7, 1e-9] {
        all.push(Case::model(
            11,
            format!("sphere of radius {radius:e}"),
            close_sphere(radius),
        ));
    }
    for distance in [1e5, 1e6, 2e7, 1e9] {
        let camera = Camera::ahead([0.01, 0.0, -distance], 3.0 / distance);
        let model = Model::flat(camera, vec![sphere([0.0; 3], 1.0)]);
        all.push(Case::model(
            11,
            format!("sphere of radius 1 from {distance:e}"),
            model.with_margin(1e-5),
        ));
    }
    angles(all);
    for distance in [1e4, 1e6, 1e7, 1e8, 1e9] {
        let unit = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0];
        let camera = Camera::ahead([distance, 0.0, -4.0], 0.8);
        let model = |object: Object| {
            Model::flat(camera, vec![object.translate([distance, 0.0, 0.0])])
                .with_margin(f64::max(1e-6, 4e-16 * distance * 60.0))
        };
        all.push(Case::model(
            15,
            format!("quadric at {distance:e}"),
            model(Object::new(Kind::Quadric(unit))),
        ));
        all.push(Case::model(
            15,
            format!("sphere at {distance:e}"),
            model(sphere([0.0; 3], 1.0)),
        ));
    }
    turns(all);
    for flat in [1e-3, 1e-5, 1e-7, 1e-9] {
        let camera = Camera {
            location: [0.01, 2.0, 0.0],
            direction: [0.0, -1.0, 0.0],
            right: [1.5, 0.0, 0.0],
            up: [0.0, 0.0, 1.1],
            is_flat: false,
        };
        let disc = sphere([0.0; 3], 1.0).scale([1.0, flat, 1.0]);
        all.push(Case::model(
            17,
            format!("sphere scaled <1,{flat:e},1>"),
            Model::flat(camera, vec![disc]),
        ));
    }
    for narrowing in [1e-3, 1e-5, 1e-7, 1e-9, 1e-12, 1e-15] {
        let camera = Camera::at([0.3, 2.0, -5.0], [0.0; 3], 0.8);
        let near = cone([0.0, -1.0, 0.0], 1.0, [0.0, 1.0, 0.0], 1.0 - narrowing);
        all.push(Case::model(
            43,
            format!("cone narrower by {narrowing:e}"),
            Model::lit(camera, [3.0, 4.0, -5.0], vec![near]),
        ));
    }
    let needle = Camera::ahead([0.0, 0.5, -2.0], 1e-9);
    all.push(Case::model(
        43,
        "cone of radius 1e-9",
        Model::flat(needle, vec![cone([0.0; 3], 1e-9, [0.0, 1.0, 0.0], 0.0)]),
    ));
    for (length, radius) in [(1e6, 1e-3), (1e6, 1e-6), (1e-6, 1e6)] {
        let camera = Camera {
            location: [0.0, 0.1 * length, -4.0 * radius],
            direction: [0.0, 0.0, 1.0],
            right: [5.0 * radius, 0.0, 0.0],
            up: [0.0, 2.5 * length, 0.0],
            is_flat: true,
        };
        let long = cylinder([0.0, -length, 0.0], [0.0, length, 0.0], radius);
        all.push(Case::model(
            44,
            format!("cylinder {length:e} long, {radius:e} wide"),
            Model::flat(camera, vec![long]),
        ));
    }
    for half in [1e-4, 1e-5, 1e-6, 1e-7, 1e-9] {
        let camera = Camera::at([0.8, 0.9, -1.05], [0.0; 3], 3.0 * half);
        let tiny = cuboid([-half; 3], [half; 3]);
        all.push(Case::model(
            45,
            format!("box of half size {half:e}"),
            Model::flat(camera, vec![tiny]),
        ));
    }
    for (name, size) in [("1", 1.0), ("1e-3", 1e-3), ("1e6", 1e6)] {
        let camera = Camera::at([0.0, 0.5 * size, -4.0 * size], [0.0; 3], 0.7);
        let light = [8.0 * size, 3.0 * size, -0.5 * size];
        all.push(Case::model(
            46,
            format!("terminator of a sphere of radius {name}"),
            Model::lit(camera, light, vec![sphere([0.0; 3], size)]),
        ));
        all.push(Case::model(
            47,
            format!("terminator of a torus of radius {name}"),
            Model::lit(camera, light, vec![torus(size, 0.25 * size)]),
        ));
    }
    horizons(all);
    for (name, power) in [
        ("1e-300", -300),
        ("1e-150", -150),
        ("1e-20", -20),
        ("1e20", 20),
        ("1e150", 150),
    ] {
        let unit = 10f64.powi(power);
        let mut model = all_solids();
        // The coefficients of a quadric are no lengths that could be scaled.
        model.objects.remove(4);
        all.push(Case::model(
            54,
            format!("every length times {name}"),
            model.scaled(unit),
        ));
    }
}

fn floors(all: &mut Vec<Case>) {
    for (name, radius) in [("1e5", 1e5), ("1e7", 1e7), ("1e9", 1e9), ("1e12", 1e12)] {
        let camera = Camera::at([0.0, 1.6, -5.0], [0.0, 0.5, 0.0], 1.0);
        let floor = sphere([0.0, -radius, 0.0], radius);
        let resting_sphere = sphere([0.0, 1.0, 0.0], 1.0).colored(RED);
        let model = Model::lit(
            camera,
            [4.0, 8.0, -3.0],
            vec![floor.clone(), resting_sphere],
        );
        // The exact height of the floor is known to half a rounding of its radius.
        let margin = f64::max(1e-6, 4e-16 * radius * 40.0);
        all.push(Case::model(
            10,
            format!("floor sphere of radius {name}, ball of 1"),
            model.with_margin(margin),
        ));
        let small = Camera::at([0.0, 1.6e-3, -5e-3], [0.0, 5e-4, 0.0], 1.0);
        let speck = sphere([0.0, 1e-3, 0.0], 1e-3).colored(RED);
        if radius < 1e10 {
            let model = Model::lit(small, [4e-3, 8e-3, -3e-3], vec![floor, speck]);
            all.push(Case::model(
                10,
                format!("floor sphere of radius {name}, ball of 1e-3"),
                model.with_margin(1e3 * margin),
            ));
        }
    }
}

fn scales(all: &mut Vec<Case>) {
    for power in [-20, -12, -6, -5, -4, -3, 3, 5, 6, 7, 12, 20] {
        let case = Case::model(
            13,
            format!("the room times 1e{power}"),
            all_solids().scaled(10f64.powi(power)),
        );
        all.push(if [-20, -6, -4, 6, 20].contains(&power) {
            case
        } else {
            case.slow()
        });
    }
    for power in [3, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 20, 100] {
        let by = 10f64.powi(power);
        let case = Case::model(
            14,
            format!("the room moved by 1e{power}"),
            all_solids().moved([by, 0.5 * by, -by]),
        );
        all.push(if [6, 8, 15, 20].contains(&power) {
            case
        } else {
            case.slow()
        });
    }
}

/// The same solids far away in their own coordinates, which are multiples of an eighth.
fn written_far_away(all: &mut Vec<Case>) {
    for power in [9, 12, 15] {
        let by = 10f64.powi(power);
        all.push(Case::model(
            14,
            format!("the room written at 1e{power}"),
            all_solids().moved_in_numbers([by, 0.5 * by, -by]),
        ));
    }
}

fn angles(all: &mut Vec<Case>) {
    for angle in [1.0, 1e-3, 1e-5, 1e-7, 1e-9] {
        let width = 2.0 * (0.5f64 * f64::to_radians(angle)).tan();
        let mut camera = Camera::ahead([0.0, 0.0, -1e3], width);
        camera.location[0] = 4.0 * width;
        let tiny_sphere = sphere([0.0; 3], 400.0 * width);
        all.push(Case::model(
            12,
            format!("camera angle of {angle:e} degrees"),
            Model::flat(camera, vec![tiny_sphere]),
        ));
    }
    let wide = 2.0 * f64::tan(f64::to_radians(0.5 * 179.999));
    let camera = Camera::ahead([0.01, 0.0, -3.0], wide);
    let wall = cuboid([-1.2e5, -0.7e5, 0.0], [1.5e5, 1.1e5, 1.0]);
    let view = Model::flat(camera, vec![wall]);
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#default { finish { ambient 1 diffuse 0 } }\n";
    let same = |name: &str, text: String, like: String| {
        let within = 0.0;
        Case::new(12, name, Asks::Same { text, like, within })
    };
    all.push(same(
        "camera angle of 179.999 degrees as a word",
        format!(
            "{head}camera {{ location <0.01, 0, -3> direction z right x up 0.75*y angle 179.999 }}\n\
             box {{ <-1.2e5, -0.7e5, 0>, <1.5e5, 1.1e5, 1> pigment {{ rgb 1 }} }}\n"
        ),
        view.text(),
    ));
    all.push(Case::model(12, "camera angle of 179.999 degrees", view));
    let lone_sphere = "sphere { 0, 1 pigment { rgb 1 } }\n";
    all.push(same(
        "camera angle of 0 degrees is none",
        format!("{head}camera {{ location <0.3, 0.2, -4> angle 0 look_at 0 }}\n{lone_sphere}"),
        format!("{head}camera {{ location <0.3, 0.2, -4> look_at 0 }}\n{lone_sphere}"),
    ));
    let camera = Camera {
        right: [1e4, 0.0, 0.0],
        ..Camera::ahead([0.01, 0.0, -3.0], 1.0)
    };
    let stretched_sphere = sphere([0.0; 3], 1.0).scale([1e4, 1.0, 1.0]);
    all.push(Case::model(
        12,
        "window 1e4 wide",
        Model::flat(camera, vec![stretched_sphere]),
    ));
}

fn turns(all: &mut Vec<Case>) {
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#default { finish { ambient 1 diffuse 0 } }\n\
        camera { location <0.3, 1, -4> right 1.2*x up 0.9*y look_at 0 }\n";
    let body = "difference { box { -1, 1 } cylinder { -2*z, 2*z, 0.5 pigment { rgb <1, 0, 0> } } pigment { rgb 1 }";
    let mut nested = format!("{head}#declare A = {body} }}\n");
    nested.push_str("#for (I, 1, 1000) #declare A = object { A translate 0.001*x } #end object { A translate -1*x }\n");
    let turned = format!("{head}{body} #for (I, 1, 1000) rotate 0.36*<0,1,0> #end }}\n");
    let plain = format!("{head}{body} }}\n");
    let same = |text: String| Asks::Same {
        text,
        like: plain.clone(),
        within: 0.02,
    };
    all.push(
        Case::new(16, "1000 turns of 0.36 degrees", same(turned))
            .allowing(1, "the catalogue allows a pixel: the turns add up to 1e-13"),
    );
    all.push(
        Case::new(16, "object in object, 1000 deep", same(nested)).allowing(
            1,
            "the catalogue allows a pixel: a thousand steps of 0.001 are not 1",
        ),
    );
}

fn horizons(all: &mut Vec<Case>) {
    let low: V = [0.0, 1e-6, 0.0];
    let up: V = [0.0, 1.0, 0.0];
    for (name, camera, height) in [
        ("seen from 1e-6 above", Camera::ahead(low, 1e-4), -1e-6),
        (
            "seen from 1e6 above",
            Camera::ahead([0.0, 1e6, 0.0], 1.0),
            0.0,
        ),
        (
            "seen from 1e12 above",
            Camera::ahead([0.0, 1e12, 0.0], 1.0),
            0.0,
        ),
    ] {
        all.push(Case::model(
            49,
            format!("plane {name}"),
            Model::flat(camera, vec![plane(up, height)]),
        ));
    }
    let camera = Camera::at([0.0, 1.0, 0.0], [0.0, 1.0 + 1e9, 1e9], 0.5);
    let far = sphere([0.0, 1e9, 1e9], 1e8);
    all.push(Case::model(
        49,
        "ball of 1e8 at 1.4e9 over a plane",
        Model::flat(camera, vec![far, plane(up, 0.0)]),
    ));
}
