//! Mirror images, as POV-Ray 3.7.0.10 shows them.

use super::shows;

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
fn conserve_energy_darkens_transmission() {
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
fn fresnel_takes_the_interior_entered_last_for_the_one_behind() {
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 1 fresnel } } interior { ior 1.5 } }plane { <0, 0, 1>, -20 pigment { rgb 1 } finish { ambient 1 diffuse 0 } }",
        [0.080674, 0.080674, 0.080674],
    );
    shows(
        0.3,
        0.2,
        "sphere { 0, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 1 fresnel } } interior { ior 1.5 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }",
        [0.008072, 0.036301, 0.016129],
    );
    shows(
        0.3,
        0.2,
        "sphere { <0, 0, -5>, 4.5 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.2 } }sphere { <0, 0, -5>, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 1 fresnel } } interior { ior 1.5 } }plane { <0, 0, 1>, -20 pigment { rgb 1 } finish { ambient 1 diffuse 0 } }",
        [0.0, 0.0, 0.0],
    );
    shows(
        0.3,
        0.2,
        "sphere { <0, 0, -5>, 1 pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 1 fresnel } } interior { ior 1.5 } }sphere { <0, 0, -5>, 4.5 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.2 } }plane { <0, 0, 1>, -20 pigment { rgb 1 } finish { ambient 1 diffuse 0 } }",
        [0.012802, 0.012802, 0.012802],
    );
}

#[test]
fn fresnel_in_a_layer_and_conserved_energy() {
    shows(
        0.7,
        0.4,
        "sphere { 0, 1 texture { pigment { rgb <0.5, 0.6, 0.4> } } texture { pigment { rgbt <0.8, 0.6, 0.4, 0.5> } finish { reflection { 1 fresnel } conserve_energy } } interior { ior 1.9 } }plane { <0, 0, -1>, 20 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }plane { <0, 0, 1>, 20 pigment { rgb <0.5, 0.3, 0.1> } finish { ambient 1 diffuse 0 } }",
        [0.124376, 0.093751, 0.050004],
    );
}
