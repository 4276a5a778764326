//! Settings, quality, background, alpha, versions, patterns, and a scene that combines them, as POV-Ray 3.7.0.10 shows
//! them.

use super::{shows, shows_at_quality, shows_in_31, shows_in_36, shows_with_alpha};

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
fn the_background_shows_where_rays_miss() {
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
fn a_scene_with_everything() {
    shows(
        -1.7,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.108904, 0.010788, 0.021378],
    );
    shows(
        -1.7,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.246677, 0.277607, 0.432029],
    );
    shows(
        -1.7,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.329686, 0.374151, 0.587793],
    );
    shows(
        -1.7,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.52163, 0.050278, 0.096788],
    );
    shows(
        -0.9,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.18967, 0.02356, 0.038056],
    );
    shows(
        -0.9,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.159564, 0.291646, 0.288273],
    );
    shows(
        -0.9,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.260731, 0.352636, 0.499046],
    );
    shows(
        -0.9,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.69688, 0.065049, 0.120821],
    );
    shows(
        -0.35,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.188159, 0.345373, 0.316472],
    );
    shows(
        -0.35,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.308568, 0.487892, 0.417075],
    );
    shows(
        -0.35,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.35021, 0.400549, 0.409583],
    );
    shows(
        -0.35,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.206378, 0.273289, 0.271885],
    );
    shows(
        0.15,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.199588, 0.344121, 0.313085],
    );
    shows(
        0.15,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.249729, 0.393576, 0.353506],
    );
    shows(
        0.15,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.304555, 0.443748, 0.337224],
    );
    shows(
        0.15,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.234607, 0.343923, 0.275563],
    );
    shows(
        0.55,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.231815, 0.348608, 0.340749],
    );
    shows(
        0.55,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.164096, 0.245167, 0.226734],
    );
    shows(
        0.55,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.179538, 0.260319, 0.244236],
    );
    shows(
        0.55,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.215381, 0.270573, 0.269581],
    );
    shows(
        0.85,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.2, 0.300008, 0.4],
    );
    shows(
        0.85,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.189212, 0.326848, 0.230564],
    );
    shows(
        0.85,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.172656, 0.2701, 0.209812],
    );
    shows(
        0.85,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.2, 0.300008, 0.4],
    );
    shows(
        1.35,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.44802, 0.323171, 0.188617],
    );
    shows(
        1.35,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.563333, 0.438987, 0.277058],
    );
    shows(
        1.35,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.2, 0.300008, 0.4],
    );
    shows(
        1.35,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.2, 0.300008, 0.4],
    );
    shows(
        1.75,
        -0.7,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.364706, 0.248753, 0.163027],
    );
    shows(
        1.75,
        -0.15,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.527535, 0.387198, 0.254215],
    );
    shows(
        1.75,
        0.45,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.2, 0.300008, 0.4],
    );
    shows(
        1.75,
        0.8,
        "background { rgb <0.2, 0.3, 0.4> } light_source { <3, 4, -10>, rgb <0.9, 0.8, 0.7> }light_source { <-5, 7, -3>, rgb 0.4 fade_distance 10 fade_power 1 } plane { <0, 1, 0>, -1 pigment { checker rgb <1, 0.9, 0.8> rgb <0.2, 0.1, 0.3> } finish { reflection 0.2 } }sphere { 0, 1 pigment { rgbf <0.9, 1, 0.95, 0.85> } finish { specular 0.4 roughness 0.01 reflection { 0.05, 0.6 fresnel } conserve_energy } interior { ior 1.5 fade_distance 3 fade_power 1 fade_color rgb <0.2, 0.9, 0.5> } }sphere { <1.5, -0.5, 1>, 0.5 pigment { rgb <0.8, 0.6, 0.4> } finish { phong 0.5 metallic reflection { 0.3 metallic } } }sphere { <-1.2, 0, 2>, 1 pigment { hexagon rgb <1, 0.1, 0.2> rgbt <0.3, 1, 0.4, 0.5> rgb <0.5, 0.6, 1> scale 0.3 } }",
        [0.2, 0.300008, 0.4],
    );
}
