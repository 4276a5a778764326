//! Light of surfaces, light on them, highlights and shadows, as POV-Ray 3.7.0.10 shows them.

use super::shows;

#[test]
fn ambient_and_emission_are_light_of_the_surface() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient <0.1, 0.2, 0.3> emission 0.25 diffuse 0 } }",
        [0.280003, 0.269993, 0.220005],
    );
    shows(
        0.3,
        0.2,
        "global_settings { ambient_light rgb <0.5, 1, 2> } sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.5 diffuse 0 } }",
        [0.2, 0.300008, 0.4],
    );
}

#[test]
fn diffuse_light_falls_with_the_cosine() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }",
        [0.504875, 0.343252, 0.205234],
    );
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { diffuse 0.7 brilliance 3 } }",
        [0.559503, 0.37966, 0.226474],
    );
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { diffuse albedo 0.3 brilliance 3 } }",
        [0.491005, 0.334005, 0.199832],
    );
}

#[test]
fn diffuse_from_behind_has_its_own_strength() {
    shows(
        0.3,
        0.2,
        "light_source { <1, 2, 10>, rgb 1 } plane { <0, 0, 1>, 0 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0.5, 0.25 brilliance 2 specular 0.5 } }",
        [0.192813, 0.14461, 0.096407],
    );
    shows(
        0.3,
        0.2,
        "light_source { <1, 2, 10>, rgb 1 } plane { <0, 0, 1>, 0 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0.5 specular 0.5 roughness 0.5 } double_illuminate }",
        [0.397284, 0.299092, 0.2009],
    );
}

#[test]
fn phong_is_a_highlight() {
    shows(
        0.2,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 phong 0.8 phong_size 3 } }",
        [0.704784, 0.626474, 0.548165],
    );
    shows(
        0.2,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 phong albedo 0.3 phong_size 5 } }",
        [0.781674, 0.69482, 0.607965],
    );
    shows(
        0.17,
        0.21,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 phong 0.8 phong_size 80 } }",
        [0.599084, 0.532525, 0.465949],
    );
}

#[test]
fn specular_is_a_highlight() {
    shows(
        0.2,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 specular 0.8 roughness 0.1 } }",
        [0.706966, 0.628412, 0.549859],
    );
    shows(
        0.2,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 specular albedo 0.3 roughness 0.2 } }",
        [0.256794, 0.22826, 0.199725],
    );
    shows(
        0.2,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 specular 0.25 roughness 0 } }",
        [0.224994, 0.2, 0.175006],
    );
}

#[test]
fn metallic_gives_highlights_the_colour_of_the_pigment() {
    shows(
        0.2,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 specular 0.8 roughness 0.1 metallic } }",
        [0.566018, 0.377844, 0.220996],
    );
    shows(
        0.5,
        0.5,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 phong 0.8 phong_size 3 metallic 0.5 } }",
        [0.046128, 0.036484, 0.027955],
    );
}

#[test]
fn light_fades_with_distance() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb 1 fade_distance 8 fade_power 2 }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }",
        [0.439811, 0.329854, 0.219898],
    );
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb 1 fade_distance 8 fade_power 1.5 }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }",
        [0.46717, 0.350378, 0.233585],
    );
}

#[test]
fn a_shadowless_light_has_no_shadow_and_no_highlight() {
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb 1 shadowless }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { specular 0.8 roughness 0.2 } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.499596, 0.374701, 0.24979],
    );
}

#[test]
fn lights_add_up_and_may_be_negative() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-3, 4, -10>, rgb <-0.2, 0.1, 0.3> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }",
        [0.428717, 0.371817, 0.262348],
    );
}

#[test]
fn an_opaque_object_casts_a_shadow() {
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } no_shadow }",
        [0.457633, 0.311757, 0.186862],
    );
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <3.6, 4.8, -12.4>, 0.4 pigment { rgb 1 } }",
        [0.457633, 0.311757, 0.186862],
    );
}

#[test]
fn shadows_are_tinted_by_what_they_pass() {
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgbf <1, 0.5, 0.2, 0.8> } }",
        [0.321691, 0.100282, 0.043763],
    );
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 texture { pigment { rgbt <1, 1, 1, 0.5> } } texture { pigment { rgbf <1, 0.5, 0.2, 0.7> } } }",
        [0.126253, 0.067704, 0.040726],
    );
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgbt <1, 1, 1, 0.003> } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows(
        0.0,
        0.0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgbt <1, 1, 1, 0.5> } interior_texture { pigment { rgbt <1, 1, 1, 0.25> } } }",
        [0.127199, 0.091463, 0.05835],
    );
}

#[test]
fn shadows_fade_in_interiors() {
    shows(
        0.0,
        0.0,
        "plane { <0, 0, 1>, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } } light_source { <0, 0, -10>, rgb 1 }sphere { <0, 0, -3>, 1 pigment { rgbt 1 } no_image interior { fade_distance 1 fade_power 2 } }",
        [0.2, 0.2, 0.2],
    );
    shows(
        0.0,
        0.0,
        "plane { <0, 0, 1>, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } } light_source { <0, 0, -10>, rgb 1 }sphere { <0, 0, -3>, 1 pigment { rgbt 1 } no_image interior { fade_distance 1 fade_power 2 fade_color rgb <0.2, 0.5, 1> } }sphere { <0, 0, -3>, 0.5 pigment { rgbt 1 } no_image }",
        [0.839994, 0.900008, 1.0],
    );
    shows(
        0.0,
        0.0,
        "plane { <0, 0, 1>, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } } light_source { <0, 0, -10>, rgb 1 }sphere { <0, 0, 0>, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 } }",
        [0.500008, 0.500008, 0.500008],
    );
}
