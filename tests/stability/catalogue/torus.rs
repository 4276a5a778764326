//! Tori: thin, far, fat, edge-on, absolute radii, stretched (items 1 to 4, 8, 9).

use crate::case::Case;
use crate::model::{Camera, Model, Step, V, torus};

/// A view down on the ring where it crosses the x axis.
fn close_up(minor: f64) -> Camera {
    Camera {
        location: [1.0, 1.0, 0.0],
        direction: [0.0, -1.0, 0.0],
        right: [5.0 * minor, 0.0, 0.0],
        up: [0.0, 0.0, 4.0 * minor],
        is_flat: false,
    }
}

/// An oblique view from a distance, with the window as wide as the torus.
fn slanted(distance: f64, width: f64) -> Camera {
    let location: V = [0.0, 0.6 * distance, -0.8 * distance];
    Camera::at(location, [0.0; 3], width / distance)
}

pub(crate) fn add(all: &mut Vec<Case>) {
    for minor in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
        let light = [1.0 + 2.0 * minor, 3.0 * minor, 0.5 * minor];
        all.push(Case::model(
            1,
            format!("torus 1, {minor:e} close up"),
            Model::flat(close_up(minor), vec![torus(1.0, minor)]),
        ));
        all.push(Case::model(
            47,
            format!("torus 1, {minor:e} close up, lit from beside"),
            Model::lit(close_up(minor), light, vec![torus(1.0, minor)]),
        ));
    }
    for distance in [1e3, 1e5, 1e6, 1e8] {
        all.push(Case::model(
            2,
            format!("torus 1, .3 from {distance:e}"),
            Model::flat(slanted(distance, 3.0), vec![torus(1.0, 0.3)]),
        ));
    }
    for (major, minor) in [(1.0, 1.0), (1.0, 1.0 + 1e-7), (0.5, 1.0), (1.0, 50.0)] {
        let size = major + minor;
        all.push(Case::model(
            3,
            format!("torus {major}, {minor} from above"),
            Model::flat(slanted(3.0 * size, 2.6 * size), vec![torus(major, minor)]),
        ));
        all.push(Case::model(
            3,
            format!("torus {major}, {minor} lit"),
            Model::lit(
                slanted(3.0 * size, 2.6 * size),
                [5.0 * size, 7.0 * size, -3.0 * size],
                vec![torus(major, minor)],
            ),
        ));
    }
    all.push(Case::model(
        4,
        "torus edge-on from its own plane",
        Model::flat(Camera::ahead([0.0, 0.0, -4.0], 0.8), vec![torus(1.0, 0.25)]),
    ));
    for (major, minor) in [(1e-3, 3e-4), (1e-4, 3e-5), (1e6, 3e5), (1e4, 3e3)] {
        all.push(Case::model(
            8,
            format!("torus {major:e}, {minor:e}"),
            Model::lit(
                slanted(4.0 * major, 3.0 * major),
                [5.0 * major, 7.0 * major, -3.0 * major],
                vec![torus(major, minor)],
            ),
        ));
    }
    let shear = [1.0, 0.0, 0.0, 1e6, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let stretched = [
        ("scale <1,1e-3,1>", Step::Scale([1.0, 1e-3, 1.0]), 3.0),
        ("scale <1e-6,1,1e6>", Step::Scale([1e-6, 1.0, 1e6]), 3.0),
        ("sheared by 1e6", Step::Matrix(shear), 3.0),
        ("mirrored", Step::Scale([-1.0, 1.0, 1.0]), 3.0),
    ];
    for (name, step, width) in stretched {
        let camera = match name {
            "scale <1e-6,1,1e6>" => Camera {
                location: [0.0, 4.0, 0.0],
                direction: [0.0, -1.0, 0.0],
                right: [0.75e-6, 0.0, 0.0],
                up: [0.0, 0.0, 0.75e6],
                is_flat: false,
            },
            "sheared by 1e6" => Camera {
                location: [0.0, 0.0, -4.0],
                direction: [0.0, 0.0, 1.0],
                right: [2e5, 0.0, 0.0],
                up: [0.0, 0.2, 0.0],
                is_flat: false,
            },
            _ => slanted(4.0, width),
        };
        let ring = torus(1.0, 0.25).step(step);
        all.push(Case::model(
            9,
            format!("torus {name}"),
            Model::flat(camera, vec![ring.clone()]),
        ));
        if name == "mirrored" {
            all.push(Case::model(
                9,
                format!("torus {name}, lit"),
                Model::lit(camera, [5.0, 7.0, -3.0], vec![ring]),
            ));
        }
    }
}
