//! Layers, transparency, refraction and attenuation, as POV-Ray 3.7.0.10 shows them.

use super::{shows, shows_in_36, world};
use crate::base::math::Ray;
use crate::base::math::sampling::random::Random;
use crate::world::{Occlusion, Query, QueryScratch, RayKind, TransmissiveHit, World};
use glam::DVec3;

#[test]
fn highlights_disregard_transparency() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbt <0.8, 0.6, 0.4, 0.5> } finish { ambient 0.1 diffuse 0.3 specular 0.5 roughness 0.1 phong 0.2 phong_size 5 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.858671, 0.690867, 0.530037],
    );
}

#[test]
fn layers_let_lower_layers_through() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } finish { specular 0.5 roughness 0.1 } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } finish { phong 0.3 phong_size 5 } } }",
        [0.738552, 0.559838, 0.362921],
    );
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } finish { reflection 0.5 } } texture { pigment { rgbt <0.8, 0.6, 0.4, 0.25> } finish { reflection 0.25 } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.564736, 0.986755, 0.486854],
    );
}

#[test]
fn surfaces_transmit_light() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.373526, 0.217029, 0.113054],
    );
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbft <0.8, 0.6, 0.4, 0.25, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.423636, 0.244388, 0.10428],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.300008, 0.100008],
    );
}

#[test]
fn before_version_3_7_filter_takes_the_brightest_channel_from_the_surface() {
    shows_in_36(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.432227, 0.255039, 0.134859],
    );
    shows_in_36(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbft <0.8, 0.6, 0.4, 0.25, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.459358, 0.267918, 0.117937],
    );
}

#[test]
fn light_refracts() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } interior { ior 1.5 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.272953, 0.096727, 0.018402],
    );
    shows(
        0.7,
        0.3,
        "sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } interior { ior 1.1 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.117433, 0.271687, 0.057282],
    );
    shows(
        0.3,
        0.1,
        "sphere { 0, 1 pigment { rgbt 1 } interior { ior 1.5 } }sphere { <0.1, 0, 0.2>, 0.6 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.2 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.300008, 0.100008],
    );
    shows(
        0.3,
        0.1,
        "sphere { 0, 1 pigment { rgbt 1 } interior { ior 1.5 } }sphere { <0.1, 0, 0.6>, 0.6 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.2 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.300008, 0.100008],
    );
}

#[test]
fn refraction_of_an_old_finish_scales_what_comes_through() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { refraction 0.5 ior 1.3 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.036805, 0.073228, 0.017685],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { refraction 2 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.362402, 0.058717],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { ior 1.3 } interior { ior 1.7 } }plane { <0, 0, 1>, 20 pigment { checker rgb <0.5, 0.3, 0.1> rgb <0.2, 0.9, 0.4> scale 3 translate <0.5, 0.7, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.117433, 0.271687, 0.057282],
    );
}

#[test]
fn total_reflection_is_whole_and_alone() {
    shows(
        0.0,
        0.0,
        "plane { <0, -0.8, 1>, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> }  interior { ior 1.9  } } plane { <0, 1, 0>, -8 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 }  } plane { <0, -1, 0>, -8 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 }  }",
        [0.207996, 0.906004, 0.403998],
    );
    shows(
        0.0,
        0.0,
        "plane { <0, -0.8, 1>, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { reflection 0.5 } interior { ior 1.9  } } plane { <0, 1, 0>, -8 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 }  } plane { <0, -1, 0>, -8 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 }  }",
        [0.207996, 0.906004, 0.403998],
    );
    shows(
        0.0,
        0.0,
        "plane { <0, -0.8, 1>, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> }  interior { ior 1.9 fade_distance 3 fade_power 2 } } plane { <0, 1, 0>, -8 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 }  } plane { <0, -1, 0>, -8 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 }  }",
        [0.045151, 0.17319, 0.078309],
    );
    shows(
        0.0,
        0.0,
        "plane { <0, -0.8, 1>, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { refraction 0.5 } interior { ior 1.9  } } plane { <0, 1, 0>, -8 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 }  } plane { <0, -1, 0>, -8 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 }  }",
        [0.108003, 0.456001, 0.203998],
    );
}

#[test]
fn a_totally_reflected_ray_counts_as_reflected() {
    shows(
        0.0,
        0.0,
        "plane { <0, -0.8, 1>, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> }  interior { ior 1.9  } } plane { <0, 1, 0>, -8 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } no_reflection } plane { <0, -1, 0>, -8 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } no_reflection }",
        [0.007996, 0.005997, 0.003998],
    );
    shows(
        0.0,
        0.0,
        "plane { <0, -0.8, 1>, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> }  interior { ior 1.9  } } plane { <0, 1, 0>, -8 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } no_image } plane { <0, -1, 0>, -8 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } no_image }",
        [0.207996, 0.906004, 0.403998],
    );
}

#[test]
fn light_fades_in_interiors() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 fade_color rgb <1, 0.5, 0> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.18349, 0.022324],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt <1, 1, 1, 0.5> } finish { ambient 0.4 diffuse 0 } interior { fade_distance 1 fade_power 2 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.327901, 0.316747, 0.305577],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 1001 fade_color rgb <0.9, 0.5, 0> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.414908, 0.118044, 0.015488],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 } }sphere { 0, 0.5 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.372091, 0.223255, 0.074418],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection 0.5 } interior { fade_distance 1 fade_power 2 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.125002, 0.074998, 0.024994],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 } }sphere { <0, 0, 0.5>, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.123079, 0.073854, 0.024613],
    );
    shows(
        0.0,
        0.0,
        "sphere { <0, 0, -5>, 2 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.100008, 0.059998, 0.020005],
    );
}

#[test]
fn interior_texture_covers_the_inside() {
    shows(
        0.3,
        0.2,
        "sphere { <0, 0, -5>, 2 pigment { rgb 1 } interior_texture { pigment { rgb <0.2, 0.4, 0.6> } finish { ambient 1 } } }",
        [0.2, 0.4, 0.6],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt <1, 1, 1, 0.5> } interior_texture { pigment { rgb <0.2, 0.4, 0.6> } finish { ambient 1 } } }",
        [0.149996, 0.250004, 0.349996],
    );
}

#[test]
fn a_camera_in_a_half_space_is_inside_its_interior() {
    shows(
        0.3,
        0.2,
        "plane { <0, 0, 1>, 0 pigment { rgbt 1 } interior { ior 1.5 fade_distance 2 fade_power 2 } finish { reflection { 1 fresnel } } } plane { <0, 0.5, 1>, 9 pigment { checker rgb 1 rgb 0.3 } finish { ambient 1 diffuse 0 } }",
        [0.041382, 0.041382, 0.041382],
    );
}

/// The distances of the surfaces that a shadow ray passes, from one to the next.
fn passed_one_by_one(world: &World, query: &Query, scratch: &mut QueryScratch) -> Vec<f64> {
    let (mut query, mut t, mut passed) = (*query, 0.0, Vec::new());
    while let Some(hit) = world.next_transmissive_hit(&query, scratch) {
        t += hit.t;
        passed.push(t);
        query.ray.origin = hit.point;
        query.origin_surface = Some(hit.spawn_surface);
        query.t_max -= hit.t;
    }
    passed
}

#[test]
fn light_passes_joints_of_one_glass_once() {
    let declared = "#declare Glass = material { texture { pigment { rgbf <0.9, 0.8, 0.7, 0.9> } }
        interior { ior 1.5 } }
        #declare Dim = material { texture { pigment { rgbf <0.9, 0.8, 0.7, 0.9> } }
        interior { ior 1.5 fade_distance 1 fade_power 2 } }
        #declare Other = material { texture { pigment { rgbf <0.5, 0.8, 0.7, 0.9> } } }";
    let stack = "cylinder { 0, y, 1 material { Glass } } cone { y, 1, 2*y, 0.5 material { High } }
        sphere { 3*y, 1 material { Glass } }";
    let nested =
        "cylinder { 0, 2*y, 1 material { Glass } } cylinder { 0, y, 0.7 material { Glass } }";
    for (text, joints_pass) in [
        (stack.replace("High", "Glass"), true),
        (nested.to_owned(), true),
        (stack.replace("High", "Other"), false),
        (stack.replace("High", "Dim"), false),
    ] {
        let text = format!("light_source {{ 9*y, 1 }} {declared} {text}");
        let world = world(&text, 3.7, false);
        let (mut scratch, mut rng) = (QueryScratch::default(), Random::new(5));
        for _ in 0..200 {
            let from = DVec3::new(0.2 * rng.uniform(), -1.0, 0.2 * rng.uniform());
            let to_light = DVec3::new(0.0, 9.0, 0.0) - from;
            let query = Query {
                ray: Ray::new(from, to_light.normalize()),
                origin_surface: None,
                t_max: to_light.length(),
                kind: RayKind::Shadow,
            };
            let occlusion = world.occlusion(&query, 0, &mut scratch);
            assert_eq!(occlusion, Occlusion::Transmissive);
            let passed = world.transmissive_hits(&query, &mut scratch);
            assert_eq!(passed.is_some(), joints_pass, "{text}");
            let Some(passed) = passed else { continue };
            let passed: Vec<f64> = passed.iter().map(TransmissiveHit::t).collect();
            let expected = passed_one_by_one(&world, &query, &mut scratch);
            assert_eq!(
                passed.len(),
                expected.len(),
                "{text} {passed:?} {expected:?}"
            );
            let are_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
            assert!(
                passed.iter().zip(&expected).all(are_near),
                "{passed:?} {expected:?}"
            );
        }
    }
}
