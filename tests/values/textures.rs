//! Parsing of textures; the scenes draw nothing.

use crate::{agree, refused};

/// Declarations of each value under a name.
fn declared(values: &[&str]) -> Vec<String> {
    let known = "#declare N0 = normal { bumps 2 } #declare P0 = pigment { boxed } #declare D0 = density { boxed }
#declare T1 = texture { pigment { rgb 1 } } #declare T2 = texture { T1 } texture { T1 }
#declare T3 = texture { gradient x texture_map { [0 T1] [1 T1] } }
#declare NM = normal_map { [0 N0] [1 N0 scale 2] } #declare SM = slope_map { [0 <0,1>] [1 <1,1>] }
#declare TM = texture_map { [0 pigment { rgb 1 }] } #declare DM = density_map { [0 boxed] [1 D0] }
#declare PM = pigment_map { [0 boxed] [1 P0] }";
    let scene = |value: &&str| format!("{known}\n#declare A = {value}\n#debug \"= read\\n\"");
    values.iter().map(scene).collect()
}

fn are_read(topic: &str, values: &[&str]) {
    let scenes = declared(values);
    agree(
        topic,
        &scenes.iter().map(String::as_str).collect::<Vec<_>>(),
    );
}

fn are_refused(topic: &str, values: &[&str]) {
    let scenes = declared(values);
    refused(
        topic,
        &scenes.iter().map(String::as_str).collect::<Vec<_>>(),
    );
}

#[test]
fn parts_of_a_texture_by_their_names_alone() {
    are_read(
        "textures/names_alone",
        &[
            "texture { P0 }",
            "texture { P0 N0 }",
            "texture { N0 }",
            "texture { P0 pigment { rgb 1 } scale 2 }",
            "texture { N0 P0 finish { ambient 1 } }",
        ],
    );
}

#[test]
fn normals() {
    are_read(
        "textures/normals",
        &[
            "normal { bumps 0.3 scale 2 }",
            "normal { gradient x, 0.3 }",
            "normal { checker normal { bumps }, normal { dents 1 } scale 2 }",
            "normal { brick 0.5 brick_size 2 mortar .1 }",
            "normal { bumps accuracy 0.3 no_bump_scale }",
            "normal { facets .3 coords 1 size .2 metric 1 }",
            "normal { wood slope_map { [0 <0,1>] [0.5 <1,0>] [1 <0,-1>] } }",
            "normal { wood normal_map { [0 bumps 1] [1 dents scale 2] } scale 2 turbulence .5 }",
            "normal { average normal_map { [bumps 1] [2 dents scale 2] } }",
            "normal { function { x } .3 }",
            "normal { bump_map { png \"/usr/share/povray-3.7/include/povmap.png\" bump_size 3 interpolate 2 } 2 }",
            "normal { bump_size 1.5 }",
            "normal { N0 scale 2 }",
            "normal { wood normal_map { NM } }",
            "normal { wood slope_map { SM } }",
            "normal { object { sphere { 0, 1 } normal { bumps } normal { dents } } }",
        ],
    );
}

#[test]
fn normals_refused() {
    are_refused(
        "textures/normals_refused",
        &[
            "normal { bumps dents }",
            "normal { bumps normal { bumps } }",
            "normal { crackle solid .3 }",
            "normal { wood color_map { [0 rgb 1] } }",
            "normal { average }",
            "normal { wood normal_map { [0 Nothing] } }",
            "normal { rgb 1 }",
            "normal { wood normal_map { SM } }",
        ],
    );
}

#[test]
fn patterned_textures() {
    are_read(
        "textures/patterned",
        &[
            "texture { gradient x texture_map { [0 T1] [1 T2 scale 2] } turbulence .5 no_bump_scale }",
            "texture { gradient x texture_map { [0 T1 finish { phong 1 }] [1 normal { bumps }] } }",
            "texture { gradient x texture_map { [0 checker texture { T1 } texture { T2 } scale 2] [1 T1] } }",
            "texture { gradient x texture_map { TM } }",
            "texture { checker texture { T1 }, texture { T2 } scale 3 }",
            "texture { checker }",
            "texture { brick texture { T1 } texture { T2 } mortar .2 rotate x }",
            "texture { object { sphere { 0, 1 } texture { T1 } texture { T2 } } }",
            "texture { average texture_map { [T1] [2 T2] } }",
            "texture { T3 scale 2 }",
            "texture { tiles { texture { T1 } tile2 texture { T2 } } scale 2 }",
            "texture { material_map { png \"/usr/share/povray-3.7/include/povmap.png\" interpolate 2 texture { T1 } texture { T2 } } }",
            "texture { function { x } texture_map { [0 T1] } }",
        ],
    );
}

#[test]
fn patterned_textures_refused() {
    are_refused(
        "textures/patterned_refused",
        &[
            "texture { gradient x }",
            "texture { gradient x color_map { [0 rgb 1] } }",
            "texture { gradient x texture_map { [0 texture { T1 }] [1 T1] } }",
            "texture { gradient x texture_map { [0 T1 T1] } }",
            "texture { gradient x texture_map { [0 T1] } pigment { rgb 1 } }",
            "texture { pigment { rgb 1 } gradient x texture_map { [0 T1] } }",
            "texture { T1 gradient x texture_map { [0 T1] } }",
            "texture { T3 pigment { rgb 1 } }",
            "texture { checker T1 T2 }",
            "texture { checker texture { T1 } texture { T2 } texture { T1 } }",
            "texture { tiles { texture { T1 } } }",
            "texture { tiles { texture { T1 }, tile2 texture { T1 } } }",
            "texture { material_map { png \"/usr/share/povray-3.7/include/povmap.png\" once } }",
            "texture { T3 } texture { T1 }",
            "texture { T1 } texture { T3 }",
            "material { texture { T3 } texture { T3 } }",
            "texture { texture { T1 } }",
        ],
    );
}

#[test]
fn maps_of_densities_are_no_maps_of_pigments() {
    are_read(
        "textures/densities",
        &[
            "density { gradient x density_map { [0 D0] [1 D0 scale 2] } }",
            "density { average density_map { [D0] [2 D0 scale 2] [boxed] } }",
            "pigment { gradient x pigment_map { PM } }",
        ],
    );
    are_refused(
        "textures/densities_refused",
        &[
            "density { P0 }",
            "pigment { D0 }",
            "density { gradient x pigment_map { [0 boxed] [1 rgb 1] } }",
            "density { gradient x density_map { [0 P0] [1 rgb 1] } }",
            "pigment { gradient x density_map { [0 rgb 1] [1 rgb 1] } }",
            "pigment { gradient x pigment_map { DM } }",
            "pigment { gradient x pigment_map { [0 D0] [1 rgb 1] } }",
        ],
    );
}

#[test]
fn weights_of_a_mean_may_be_left_out() {
    are_read(
        "textures/weights",
        &[
            "pigment { average pigment_map { [gradient y color_map { [0 rgb 0] [1 rgb 1] }] [2 bozo] } }",
            "pigment { average pigment_map { [P0] [P0 scale 2] [(1+1) P0] [x.x P0] [-1 P0] [,P0] } }",
            "pigment { average pigment_map { [function { y } color_map { [0 rgb 0] [1 rgb 1] }] } }",
        ],
    );
    are_refused(
        "textures/weights_refused",
        &[
            "pigment { average pigment_map { [rgb 1] } }",
            "pigment { average pigment_map { [<1,0,0>] } }",
            "pigment { gradient x pigment_map { [gradient y] [1 rgb 1] } }",
        ],
    );
}

#[test]
fn colours_stand_without_a_word() {
    agree(
        "textures/colours",
        &[
            r#"#declare A = finish { reflection { <0,1,0>, <0,0,1> fresnel on } } #debug "= ok\n""#,
            r#"#declare C = array[2] { rgb 1, rgb x } #declare P = pigment { C[1] } #debug "= ok\n""#,
            r#"light_source { 1 } light_source { 1 shadowless } light_source { 1 <1,1,1> } #debug "= ok\n""#,
        ],
    );
    refused(
        "textures/colours_refused",
        &[
            "#declare C = array[2] { <1,1,1>, x } #declare P = pigment { C[1] }",
            "light_source { 1 Foo }",
        ],
    );
}
