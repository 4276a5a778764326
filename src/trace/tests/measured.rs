//! What POV-Ray 3.7.0.10 shows.

use super::{shows, shows_at_quality, shows_in_31, shows_in_36, shows_with_alpha};

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
fn highlights_disregard_transparency() {
    shows(
        0.3,
        0.2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbt <0.8, 0.6, 0.4, 0.5> } finish { ambient 0.1 diffuse 0.3 specular 0.5 roughness 0.1 phong 0.2 phong_size 5 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.858671, 0.690867, 0.530037],
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
fn light_shines_through() {
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
fn the_adc_bailout_stops_faint_rays() {
    shows(
        0.3,
        0.2,
        "global_settings { adc_bailout 0.3 } sphere { 0, 1 pigment { rgbt <0.8, 0.6, 0.4, 0.5> } finish { ambient 0 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.0, 0.0, 0.0],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 reflection 0.0038 } }plane { <0, 0, -1>, 20 pigment { rgb 100 } finish { ambient 1 } }",
        [0.0, 0.0, 0.0],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0 diffuse 0 reflection 0.00395 } }plane { <0, 0, -1>, 20 pigment { rgb 100 } finish { ambient 1 } }",
        [0.394995, 0.394995, 0.394995],
    );
}

#[test]
fn trace_level_1_is_the_last() {
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 1 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } finish { reflection 0.6 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.039994, 0.029999, 0.020005],
    );
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 1 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { reflection 0.3 } interior { ior 1.5 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.007996, 0.005997, 0.003998],
    );
}

#[test]
fn trace_level_2_is_the_last() {
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 2 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } finish { reflection 0.6 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.265599, 0.611398, 0.270405],
    );
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 2 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { reflection 0.3 } interior { ior 1.5 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.073762, 0.27924, 0.125444],
    );
}

#[test]
fn trace_level_3_is_the_last() {
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 3 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } finish { reflection 0.6 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.290562, 0.663233, 0.281437],
    );
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 3 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { reflection 0.3 } interior { ior 1.5 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.334691, 0.367697, 0.138827],
    );
}

#[test]
fn trace_level_4_is_the_last() {
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 4 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } finish { reflection 0.6 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.32282, 0.674907, 0.283742],
    );
    shows(
        0.3,
        0.2,
        "global_settings { max_trace_level 4 } sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.9> } finish { reflection 0.3 } interior { ior 1.5 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.366308, 0.446723, 0.154513],
    );
}

#[test]
fn a_mirror_adds_its_image() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection <0.5, 0.4, 0.3> } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.179995, 0.420005, 0.160006],
    );
    shows(
        0.6,
        0.3,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.2, 0.9 falloff 2 } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.129351, 0.282063, 0.138689],
    );
    shows(
        0.6,
        0.3,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { rgb <0.1, 0.2, 0.3>, rgb <0.9, 0.8, 1> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.141344, 0.379522, 0.232349],
    );
}

#[test]
fn fresnel_mirrors_go_by_the_index_of_refraction() {
    shows(
        0.6,
        0.3,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.1, 0.9 fresnel } } interior { ior 1.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.107576, 0.184115, 0.095155],
    );
    shows(
        0.6,
        0.3,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.9 fresnel } } interior { ior 1.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.088533, 0.098375, 0.057053],
    );
    shows(
        0.6,
        0.3,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.9 fresnel } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows(
        0.6,
        0.3,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 1 fresnel } } interior { ior 1.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.509468, 0.342641, 0.118944],
    );
}

#[test]
fn the_exponent_of_a_mirror_darkens_or_brightens() {
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.5 exponent 2 } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.303609, 0.53434, 0.356222],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection 0.5 reflection_exponent 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.100008, 0.465003, 0.119997],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.5 exponent 0 } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.080003, 0.059998, 0.039994],
    );
}

#[test]
fn a_metallic_mirror_takes_the_colour_of_the_pigment() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.8 metallic } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.208225, 0.494011, 0.169345],
    );
    shows(
        0.8,
        0.3,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { reflection { 0.3, 0.8 metallic 0.5 } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.324575, 0.191424, 0.078706],
    );
}

#[test]
fn conserved_energy_is_missing_behind() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt <0.8, 0.6, 0.4, 0.5> } finish { reflection <0.5, 0.2, 0.7> conserve_energy } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.208591, 0.304097, 0.318746],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbt <0.8, 0.6, 0.4, 0.5> } finish { reflection <0.5, 0.2, 0.7> conserve_energy } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.152499, 0.233997, 0.306004],
    );
}

#[test]
fn light_bends() {
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
fn the_inside_may_look_different() {
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
fn objects_hide_from_some_rays() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 1 } no_image }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.300008, 0.100008],
    );
    shows(
        0.0,
        0.0,
        "sphere { <0, 0, -3>, 0.5 pigment { rgbt <1, 1, 1, 0.5> } }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 1 } no_image }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.2, 0.149996, 0.100008],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb 1 } finish { ambient 1 } no_reflection }",
        [0.0, 0.0, 0.0],
    );
    shows(
        0.0,
        0.0,
        "sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb 1 } finish { ambient 1 } no_image }",
        [0.500008, 0.500008, 0.500008],
    );
}

#[test]
fn patterns_colour_surfaces() {
    shows(
        0.11,
        0.27,
        "plane { <0, 0, 1>, 0 pigment { checker rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        -0.77,
        1.3,
        "plane { <0, 0, 1>, 0 pigment { checker rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        2.35,
        -1.1,
        "plane { <0, 0, 1>, 0 pigment { checker rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [0.300008, 1.0, 0.4],
    );
    shows(
        -1.9,
        -0.6,
        "plane { <0, 0, 1>, 0 pigment { checker rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [0.300008, 1.0, 0.4],
    );
    shows(
        3.3,
        2.8,
        "plane { <0, 0, 1>, 0 pigment { checker rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        0.11,
        0.27,
        "plane { <0, 0, 1>, 0 pigment { hexagon rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> rgb <0.5, 0.6, 1> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        -0.77,
        1.3,
        "plane { <0, 0, 1>, 0 pigment { hexagon rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> rgb <0.5, 0.6, 1> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        2.35,
        -1.1,
        "plane { <0, 0, 1>, 0 pigment { hexagon rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> rgb <0.5, 0.6, 1> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        -1.9,
        -0.6,
        "plane { <0, 0, 1>, 0 pigment { hexagon rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> rgb <0.5, 0.6, 1> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        3.3,
        2.8,
        "plane { <0, 0, 1>, 0 pigment { hexagon rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> rgb <0.5, 0.6, 1> scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [0.300008, 1.0, 0.4],
    );
    shows(
        0.11,
        0.27,
        "plane { <0, 0, 1>, 0 pigment { brick rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> brick_size <2, 1, 1> mortar 0.2 scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [0.300008, 1.0, 0.4],
    );
    shows(
        -0.77,
        1.3,
        "plane { <0, 0, 1>, 0 pigment { brick rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> brick_size <2, 1, 1> mortar 0.2 scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
    shows(
        2.35,
        -1.1,
        "plane { <0, 0, 1>, 0 pigment { brick rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> brick_size <2, 1, 1> mortar 0.2 scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [0.300008, 1.0, 0.4],
    );
    shows(
        -1.9,
        -0.6,
        "plane { <0, 0, 1>, 0 pigment { brick rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> brick_size <2, 1, 1> mortar 0.2 scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [0.300008, 1.0, 0.4],
    );
    shows(
        3.3,
        2.8,
        "plane { <0, 0, 1>, 0 pigment { brick rgb <1, 0.1, 0.2> rgb <0.3, 1, 0.4> brick_size <2, 1, 1> mortar 0.2 scale 0.7 rotate <30, 40, 50> } finish { ambient 1 diffuse 0 } }",
        [1.0, 0.100008, 0.2],
    );
}

#[test]
fn the_background_shows_where_nothing_is() {
    shows(
        0.3,
        0.2,
        "background { rgb <0.1, 0.2, 0.3> }",
        [0.100008, 0.2, 0.300008],
    );
    shows(
        0.3,
        0.2,
        "background { rgbt <0.5, 0.6, 0.7, 0.25> }",
        [0.375006, 0.450004, 0.525002],
    );
    shows(
        0.0,
        0.0,
        "background { rgbt <0.5, 0.6, 0.7, 0.25> }sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 reflection 0.5 } }",
        [0.187503, 0.224994, 0.262501],
    );
}

#[test]
fn before_version_3_7_the_background_is_opaque() {
    shows_in_36(
        0.0,
        0.0,
        "background { rgbt <0.5, 0.6, 0.7, 0.25> }",
        [0.500008, 0.6, 0.700008],
    );
    shows_in_36(
        0.0,
        0.0,
        "background { rgbt <0.5, 0.6, 0.7, 0.25> }sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 reflection 0.5 } }",
        [0.250004, 0.300008, 0.349996],
    );
}

#[test]
fn alpha_is_what_covers_the_background() {
    shows_with_alpha(
        3.7,
        "background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }",
        [0.469764, 0.563729, 0.657679, 0.691829],
    );
    shows_with_alpha(
        3.7,
        "sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }",
        [0.080003, 0.059998, 0.039994, 1.0],
    );
    shows_with_alpha(3.7, "", [0.0, 0.0, 0.0, 0.0]);
    shows_with_alpha(
        3.7,
        "background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }sphere { 0, 1 pigment { rgbt <1, 1, 1, 0.5> } finish { ambient 0 diffuse 0 } }",
        [0.088029, 0.105638, 0.123247, 0.922957],
    );
    shows_with_alpha(
        3.7,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power 2 } }",
        [0.0, 0.0, 0.0, 0.8],
    );
    shows_with_alpha(
        3.7,
        "background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 reflection 0.5 } }",
        [0.250004, 0.300008, 0.349996, 1.0],
    );
    shows_with_alpha(
        3.7,
        "background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.5 } }",
        [0.469764, 0.563729, 0.657679, 0.691829],
    );
    shows_with_alpha(
        3.7,
        "global_settings { max_trace_level 1 } background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }",
        [0.0, 0.0, 0.0, 1.0],
    );
    shows_with_alpha(
        3.6,
        "background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }",
        [0.0, 0.0, 0.0, 0.0],
    );
    shows_with_alpha(
        3.6,
        "background { rgbft <0.5, 0.6, 0.7, 0.1, 0.25> }sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 reflection 0.5 } }",
        [0.250004, 0.300008, 0.349996, 1.0],
    );
}

#[test]
fn a_low_quality_leaves_out_much() {
    shows_at_quality(
        0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.8, 0.6, 0.4],
    );
    shows_at_quality(
        0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.100008, 0.2, 0.300008],
    );
    shows_at_quality(
        0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.8, 0.6, 0.4],
    );
    shows_at_quality(
        0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.8, 0.6, 0.4],
    );
    shows_at_quality(
        0,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.6, 0.4],
    );
    shows_at_quality(
        1,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.8, 0.6, 0.4],
    );
    shows_at_quality(
        1,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.100008, 0.2, 0.300008],
    );
    shows_at_quality(
        1,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.8, 0.6, 0.4],
    );
    shows_at_quality(
        1,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.8, 0.6, 0.4],
    );
    shows_at_quality(
        1,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.500008, 0.6, 0.4],
    );
    shows_at_quality(
        2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.695659, 0.515099, 0.352026],
    );
    shows_at_quality(
        2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.057206, 0.103914, 0.140139],
    );
    shows_at_quality(
        2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.457633, 0.311757, 0.186862],
    );
    shows_at_quality(
        2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.228824, 0.155886, 0.093431],
    );
    shows_at_quality(
        2,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        3,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.695659, 0.515099, 0.352026],
    );
    shows_at_quality(
        3,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.057206, 0.103914, 0.140139],
    );
    shows_at_quality(
        3,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.457633, 0.311757, 0.186862],
    );
    shows_at_quality(
        3,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.228824, 0.155886, 0.093431],
    );
    shows_at_quality(
        3,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        4,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.695659, 0.515099, 0.352026],
    );
    shows_at_quality(
        4,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.057206, 0.103914, 0.140139],
    );
    shows_at_quality(
        4,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows_at_quality(
        4,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.228824, 0.155886, 0.093431],
    );
    shows_at_quality(
        4,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        5,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.695659, 0.515099, 0.352026],
    );
    shows_at_quality(
        5,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.057206, 0.103914, 0.140139],
    );
    shows_at_quality(
        5,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows_at_quality(
        5,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.228824, 0.155886, 0.093431],
    );
    shows_at_quality(
        5,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        6,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.695659, 0.515099, 0.352026],
    );
    shows_at_quality(
        6,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.457633, 0.311757, 0.186862],
    );
    shows_at_quality(
        6,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows_at_quality(
        6,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.356283, 0.203677, 0.104494],
    );
    shows_at_quality(
        6,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        7,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.695659, 0.515099, 0.352026],
    );
    shows_at_quality(
        7,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.457633, 0.311757, 0.186862],
    );
    shows_at_quality(
        7,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows_at_quality(
        7,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.356283, 0.203677, 0.104494],
    );
    shows_at_quality(
        7,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        8,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.795666, 0.965103, 0.552026],
    );
    shows_at_quality(
        8,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.457633, 0.311757, 0.186862],
    );
    shows_at_quality(
        8,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows_at_quality(
        8,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.356283, 0.203677, 0.104494],
    );
    shows_at_quality(
        8,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
    shows_at_quality(
        9,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.2 diffuse 0.5 specular 0.3 emission 0.1 reflection 0.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.795666, 0.965103, 0.552026],
    );
    shows_at_quality(
        9,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> quick_color rgb <0.1, 0.2, 0.3> } }",
        [0.457633, 0.311757, 0.186862],
    );
    shows_at_quality(
        9,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgb <0.8, 0.6, 0.4> } }sphere { <1.5, 2, -5.5>, 0.4 pigment { rgb 1 } }",
        [0.080003, 0.059998, 0.039994],
    );
    shows_at_quality(
        9,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 pigment { rgbf <0.8, 0.6, 0.4, 0.5> } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.356283, 0.203677, 0.104494],
    );
    shows_at_quality(
        9,
        "light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.343221, 0.249409, 0.1308],
    );
}

#[test]
fn versions_up_to_3_1_do_not_filter_in_upper_layers() {
    shows_in_31(
        0.3,
        0.2,
        "sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } finish { ambient 1 diffuse 0 } } texture { pigment { rgbf <0.8, 0.6, 0.4, 0.5> } finish { ambient 1 diffuse 0 } } }",
        [0.650004, 0.6, 0.4],
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
