//! Every primitive, camera and light with meaningless or extreme numbers: it is rejected with a message, or it is drawn
//! without NaN or infinity (items 29 to 32).

use crate::case::{Asks, Case};
use povr::base::word::Word;
use povr::scene::shape::Shape;

/// Values that replace each number in turn.
const ODD: [&str; 11] = [
    "0", "-1", "1e-320", "-1e-300", "1e-30", "1e30", "1e308", "-1e308", "1e400", "(0/0)", "(1/0)",
];

/// Each primitive in each of its forms, by its first word; numbers in brackets are replaced. Every word that begins a
/// shape is here (tested below).
const PRIMITIVES: &[(&str, &str)] = &[
    ("", "sphere { <[0],0,[0]>, [1] }"),
    ("", "box { <[-1],[-1],-1>, <[1],[1],1> }"),
    ("", "cylinder { <0,[-1],0>, <[0],[1],0>, [0.5] }"),
    ("open", "cylinder { <0,[-1],0>, <[0],[1],0>, [0.5] open }"),
    ("", "cone { <0,[-1],0>, [1], <[0],[1],0>, [0.2] }"),
    ("open", "cone { <0,[-1],0>, [1], <[0],[1],0>, [0.2] open }"),
    ("", "torus { [0.7], [0.25] }"),
    ("", "plane { <[0],[1],0>, [-0.5] }"),
    ("", "disc { <[0],0,0>, <[0],[0],[1]>, [1], [0.3] }"),
    (
        "",
        "triangle { <[-1],[-1],0>, <[1],[-1],0>, <[0],[1],[0]> }",
    ),
    (
        "",
        "smooth_triangle { <[-1],-1,0>, <0,[0],[1]>, <[1],-1,0>, <[0],0,[1]>, <0,[1],0>, <0,0,[1]> }",
    ),
    (
        "",
        "polygon { 5, <[-1],-1,0>, <[1],[-1],0>, <1,1,0>, <-1,1,0>, <[-1],-1,0> }",
    ),
    ("", "quadric { <[1],[1],[1]>, <[0],0,0>, <[0],0,0>, [-1] }"),
    ("", "poly { [2], <[1],[0],0,[0],1,0,[0],1,0,[-1]> }"),
    (
        "",
        "polynomial { 2, xyz(2,0,0): [1], xyz(0,2,0): [1], xyz(0,0,2): 1, xyz(0,0,[0]): [-1] }",
    ),
    (
        "of degree 6",
        "poly { 6, <[1],0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,\
         0,0,0,0,0,0,0,0,0,0,0,0,0,0,[1],0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,[1],0,0,0,0,0,[-1]> }",
    ),
    (
        "",
        "cubic { <[0],0,0,[1],0,0,0,0,0,0,0,0,0,[1],0,0,0,0,[0],[-1]> }",
    ),
    (
        "",
        "quartic { <[1],0,0,0,[2],0,0,2,0,[-2.1],0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,[1.9],0,0,0,0,[1],0,-2.1,0,[0.9]> }",
    ),
    ("", "superellipsoid { <[0.3],[0.5]> }"),
    (
        "",
        "blob { threshold [0.6] sphere { <[0.4],0,0>, [1], [1] } cylinder { <[0],-1,0>, <0,[1],0>, [0.6], [1] } }",
    ),
    (
        "of many",
        "blob { threshold [0.3] #for (I, 0, 11) sphere { <cos(I), sin(I), [0]>, [0.5], [1] } #end }",
    ),
    (
        "linear",
        "lathe { linear_spline 4, <[0.2],[-1]>, <[1],0>, <[0.5],[1]>, <0,1> }",
    ),
    (
        "quadratic",
        "lathe { quadratic_spline 5, <0,[-1.5]>, <[0.2],-1>, <[1],0>, <[0.5],[1]>, <0.2,1.2> }",
    ),
    (
        "cubic",
        "lathe { cubic_spline 6, <0,[-1.5]>, <[0.2],-1>, <[1],0>, <[0.5],[1]>, <[0.2],1.2>, <0,1.5> }",
    ),
    (
        "of Bezier curves",
        "lathe { bezier_spline 4, <[0.2],[-1]>, <[1],-0.5>, <[1.2],[0.5]>, <[0.1],1> }",
    ),
    (
        "",
        "sor { 5, <[0],-1.5>, <[0.5],[-1]>, <[0.8],0>, <0.5,[1]>, <0,[1.5]> }",
    ),
    (
        "linear",
        "prism { linear_sweep linear_spline [-1], [1], 5, <[-1],-1>, <[1],[-1]>, <1,1>, <-1,1>, <[-1],-1> }",
    ),
    (
        "conic",
        "prism { conic_sweep linear_spline [0.1], [1], 5, <[-1],-1>, <[1],[-1]>, <1,1>, <-1,1>, <[-1],-1> }",
    ),
    (
        "cubic",
        "prism { cubic_spline [-1], [1], 7, <[1],-1>, <-1,[-1]>, <-1,1>, <[1],1>, <1,-1>, <-1,[-1]>, <-1,1> }",
    ),
    (
        "of Bezier curves",
        "prism { bezier_spline [-1], [1], 8, <[-1],0>, <-1,[1]>, <1,1>, <[1],0>, <1,0>, <1,[-1]>, <-1,-1>, <[-1],0> }",
    ),
    ("", "ovus { [1], [0.6] }"),
    ("", "lemon { <0,[-1],0>, [0.3], <[0],1,0>, [0], [2] }"),
    (
        "open",
        "lemon { <0,[-1],0>, [0.3], <[0],1,0>, [0], [2] open }",
    ),
    ("type 0", PATCH_0),
    ("type 1", PATCH_1),
    (
        "linear",
        "sphere_sweep { linear_spline 3, <[-1],0,0>, [0.3], <0,[1],0>, [0.4], <[1],0,0>, [0.2] }",
    ),
    (
        "of B-splines",
        "sphere_sweep { b_spline 4, <[-1],0,0>, [0.3], <0,[1],0>, [0.4], <[1],0,0>, [0.2], <1,[1],0>, [0.2] tolerance [0.01] }",
    ),
    (
        "cubic",
        "sphere_sweep { cubic_spline 4, <[-1],0,0>, [0.3], <0,[1],0>, [0.4], <[1],0,0>, [0.2], <1,[1],0>, [0.2] }",
    ),
    (
        "",
        "mesh { triangle { <[-1],[-1],0>, <[1],-1,0>, <0,[1],[0]> } \
         smooth_triangle { <[-1],1,0>, <[0],0,[1]>, <1,[1],0>, <0,0,[1]>, <0,0,[1]>, <0,[0],-1> } \
         inside_vector <[0],[1],0> }",
    ),
    (
        "",
        "mesh2 { vertex_vectors { 3, <[-1],[-1],0>, <[1],-1,0>, <0,[1],[0]> } \
         normal_vectors { 3, <[0],0,[-1]>, <0,0,-1>, <0,[0],-1> } uv_vectors { 3, <[0],0>, <[1],0>, <0,1> } \
         face_indices { [1], <[0],1,2> } }",
    ),
    ("", "height_field { png \"Mount1.png\" water_level [0.2] }"),
    (
        "smooth",
        "height_field { png \"test.png\" smooth water_level [0.2] scale <[2],1,[2]> translate -1 }",
    ),
    (
        "",
        "text { ttf \"cyrvetic.ttf\" \"A&\" [0.3], <[0.1],[0]> }",
    ),
    (
        "",
        "isosurface { function { x*x + y*y + z*z - [1] } contained_by { box { <[-2],-2,-2>, [2] } } \
         threshold [0] accuracy [0.01] max_gradient [5] }",
    ),
    (
        "in a ball",
        "isosurface { function { pow(x, [2]) + y*y/[1] - z } contained_by { sphere { <[0],0,0>, 1.5 } } \
         evaluate [1], [1.2], [0.9] open max_trace [3] }",
    ),
    (
        "",
        "parametric { function { [1]*cos(u)*sin(v) } function { cos(v)/[1] } function { sin(u)*sin(v) } \
         <[0],0>, <6.3,[3.2]> contained_by { sphere { 0, [1.1] } } accuracy [0.05] max_gradient [1] }",
    ),
    (
        "of quaternions",
        "julia_fractal { <[-0.08],[0],-0.8,-0.03> quaternion sqr max_iteration [5] precision [15] slice <[0],0,0,[1]>, [0] }",
    ),
    (
        "hypercomplex",
        "julia_fractal { <[-0.08],[0],-0.8,-0.03> hypercomplex pwr([2], [0]) max_iteration 5 precision [15] }",
    ),
    (
        "",
        "union { box { <[-1],-1,-1>, [1] } sphere { <0,0,[-1]>, [0.8] } }",
    ),
    (
        "",
        "merge { box { <[-1],-1,-1>, [1] } sphere { <0,0,[-1]>, [0.8] } }",
    ),
    (
        "",
        "intersection { box { <[-1],-1,-1>, [1] } sphere { <0,0,[-1]>, [0.8] } }",
    ),
    (
        "",
        "difference { box { <[-1],-1,-1>, [1] } sphere { <0,0,[-1]>, [0.8] } }",
    ),
    (
        "",
        "object { sphere { 0, [1] bounded_by { box { [-1], <1,[1],1> } } clipped_by { plane { <[0],1,0>, [0.5] } } } }",
    ),
];

const PATCH_0: &str = "bicubic_patch { type 0 u_steps 2 v_steps 2 flatness [0.1] <[-1],-1,0>,<-0.3,[-1],0>,<0.3,-1,0>,\
    <1,-1,[0]>,<-1,-0.3,0>,<-0.3,-0.3,[1]>,<0.3,-0.3,1>,<1,-0.3,0>,<-1,0.3,0>,<-0.3,0.3,1>,<0.3,0.3,[1]>,<1,0.3,0>,\
    <-1,1,0>,<-0.3,1,0>,<0.3,[1],0>,<[1],1,0> }";

const PATCH_1: &str = "bicubic_patch { type 1 u_steps [2] v_steps [2] flatness [0] uv_vectors <[0],0> <1,0> <1,1> <0,[1]> \
    <[-1],-1,0>,<-0.3,[-1],0>,<0.3,-1,0>,<1,-1,[0]>,<-1,-0.3,0>,<-0.3,-0.3,[1]>,<0.3,-0.3,1>,<1,-0.3,0>,\
    <-1,0.3,0>,<-0.3,0.3,1>,<0.3,0.3,[1]>,<1,0.3,0>,<-1,1,0>,<-0.3,1,0>,<0.3,[1],0>,<[1],1,0> }";

/// Transforms of a sphere and a box.
const TRANSFORMS: [&str; 3] = [
    "scale <[1],[1],[1]>",
    "translate <[0],[0],[0]> rotate <[0],[10],0>",
    "matrix <[1],[0],0, 0,[1],[0], 0,0,[1], [0],0,0>",
];

/// Every kind of camera; directions of zero length, parallel vectors and a `look_at` equal to the location arise from
/// the numbers.
const CAMERAS: &[&str] = &[
    "camera { perspective location <[0.11],[0.13],[-4]> direction [1]*z right <[1.2],0,[0]> up <0,[0.9],[0]> }",
    "camera { perspective location <0,[0],[-4]> sky <[0],[1],[0]> angle [40] look_at <[0],0,[0]> }",
    "camera { orthographic location <[0.11],[0.13],[-4]> direction [1]*z right <[3],0,0> up <0,[2],0> }",
    "camera { orthographic location <0,[0],[-4]> angle [40] look_at <[0],0,[0]> }",
    "camera { fisheye location <0.1,[0],[-4]> angle [140] look_at <[0],0,[0]> }",
    "camera { ultra_wide_angle location <0.1,[0],[-4]> right [1.3]*x angle [90] look_at <[0],0,[0]> }",
    "camera { omnimax location <0.1,[0],[-4]> direction [1]*z look_at <[0],0,[0]> }",
    "camera { panoramic location <0.1,[0],[-4]> right [1.3]*x direction [1]*z look_at <[0],0,[0]> }",
    "camera { spherical location <0.1,[0],[-4]> angle [300], [120] look_at <[0],0,[0]> }",
    "camera { cylinder [1] location <0.1,[0],[-4]> angle [90] up [1]*y look_at <[0],0,[0]> }",
    "camera { cylinder 2 location <0.1,[0],[-4]> angle [90] right [1.3]*x look_at <[0],0,[0]> }",
    "camera { cylinder 3 location <0.1,[0],[-4]> angle [90] up [1]*y look_at <[0],0,[0]> }",
    "camera { cylinder 4 location <0.1,[0],[-4]> angle [90] right [1.3]*x look_at <[0],0,[0]> }",
    "camera { perspective location <0.1,[0],[-4]> look_at 0 focal_point <[0],0,[1]> aperture [0.4] blur_samples [4] \
     confidence [0.9] variance [0.01] }",
    "camera { perspective location -4*z look_at 0 rotate <[10],0,0> scale <[1],1,[1]> translate <[0],0,0> }",
];

/// Every kind of light.
const LIGHTS: &[(&str, &str)] = &[
    (
        "point light",
        "light_source { <[-4],[6],[-8]>, rgb <[1],1,[1]> fade_distance [3] fade_power [2] }",
    ),
    (
        "spotlight",
        "light_source { <[-4],6,[-8]>, rgb 1 spotlight radius [20] falloff [30] tightness [2] point_at <[0],[0],[0]> }",
    ),
    (
        "cylindrical light",
        "light_source { <[-4],6,[-8]>, rgb 1 cylinder radius [1] falloff [2] tightness [0] point_at <[0],[0],[0]> }",
    ),
    (
        "parallel light",
        "light_source { <[-4],6,[-8]>, rgb 1 parallel point_at <[0],[0],[0]> }",
    ),
    (
        "area light",
        "light_source { <[-4],6,[-8]>, rgb 1 area_light <[2],0,[0]>, <0,[2],0>, [3], [3] adaptive [1] jitter }",
    ),
    (
        "round area light",
        "light_source { <[-4],6,[-8]>, rgb 1 area_light <[2],0,[0]>, <0,[2],0>, [3], [3] circular orient area_illumination }",
    ),
    (
        "light inside the sphere",
        "light_source { <[0],[0],[0]>, rgb 1 } light_source { <0,[1],0>, rgb 1 shadowless }",
    ),
    (
        "light with a body",
        "light_source { <[-1],1,-2>, rgb 1 looks_like { sphere { 0, [0.1] } } fade_distance [1] fade_power [3] }",
    ),
    (
        "light through a hole",
        "light_source { <[-1],2,-2>, rgb 1 projected_through { disc { <0,[1],-1>, <0,[1],1>, [0.5] } } }",
    ),
    (
        "finish",
        "light_source { <-4,6,-8>, rgb 1 } sphere { x, 0.5 finish { ambient [0.1] diffuse [0.6] brilliance [1] phong [1] \
         phong_size [40] specular [1] roughness [0.01] metallic [1] reflection { [0.1], [0.5] falloff [1] exponent [1] } \
         crand [0.1] irid { [0.3] thickness [0.5] turbulence [0.2] } } }",
    ),
    (
        "interior",
        "light_source { <-4,6,-8>, rgb 1 } sphere { x, 0.5 pigment { rgbt [0.9] } interior { ior [1.5] dispersion [1.1] \
         dispersion_samples [3] caustics [1] fade_distance [1] fade_power [2] fade_color rgb [0.5] } }",
    ),
    (
        "fog",
        "light_source { <-4,6,-8>, rgb 1 } fog { fog_type 2 distance [5] rgbt <[0.5],0.5,0.5,[0.1],[0]> fog_offset [0] \
         fog_alt [1] turbulence [0.1] up <[0],[1],0> }",
    ),
    (
        "sky and rainbow",
        "light_source { <-4,6,-8>, rgb 1 } sky_sphere { pigment { gradient <[0],[1],0> scale [1] } } rainbow { angle [40] \
         width [5] distance [100] direction <[0],[0],[1]> color_map { Bow } }",
    ),
    (
        "global settings",
        "global_settings { adc_bailout [0.01] max_trace_level [5] ambient_light rgb [1] assumed_gamma [1] } light_source { 9*y, 1 }",
    ),
];

const HEAD: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n\
    camera { location <0.11, 0.13, -4> right 1.2*x up 0.9*y direction z }\nlight_source { <-4, 6, -8>, rgb 1 }\n\
    #default { pigment { checker rgb 1, rgbf <0.5, 0.5, 0.5, 0.5> } finish { phong 0.5 reflection 0.2 } }\n\
    plane { y, -2 }\n";
/// For cameras.
const INTERIOR: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\nlight_source { <-4, 6, -8>, rgb 1 }\n\
    #default { pigment { checker rgb 1, rgbf <0.5, 0.5, 0.5, 0.5> } finish { phong 0.5 reflection 0.2 } }\n\
    plane { y, -2 } sphere { 0, 1 } box { <1,-2,1>, <2,2,2> }\n";
/// For lights.
const LIGHTLESS: &str = "#version 3.7;\n#declare Bow = color_map { [0 rgb 1] [1 rgbt 1] }\nglobal_settings { assumed_gamma 1 }\n\
    camera { location <0.11, 0.13, -4> right 1.2*x up 0.9*y direction z }\n\
    #default { pigment { checker rgb 1, rgbf <0.5, 0.5, 0.5, 0.5> } finish { phong 0.5 reflection 0.2 } }\n\
    plane { y, -2 } sphere { 0, 1 } box { <1,-2,1>, <2,2,2> }\n";

pub(crate) fn add(all: &mut Vec<Case>) {
    let words = Shape::WORDS.iter().map(|word| word.spelling());
    let is_covered = |word: &&str| PRIMITIVES.iter().any(|(_, text)| first_word(text) == *word);
    let missing: Vec<&str> = words.filter(|word| !is_covered(word)).collect();
    assert!(
        missing.is_empty(),
        "not asked with odd numbers: {missing:?}"
    );
    for (kind, template) in PRIMITIVES {
        let word = first_word(template).replace('_', " ");
        let kind = if kind.is_empty() {
            String::new()
        } else {
            format!(", {kind},")
        };
        let is_of_3_8 = Word::since_3_8().any(|new| new.spelling() == word);
        let head = if is_of_3_8 {
            HEAD.replace("3.7", "3.8")
        } else {
            HEAD.to_owned()
        };
        let question = case(
            format!("{word}{kind} with odd numbers"),
            replaced(&head, template),
        );
        // Some of its numbers request the highest number of pieces.
        let is_slow = word == "parametric";
        all.push(if is_slow { question.slow() } else { question });
    }
    let huge = "isosurface { function { x*x + y*y - z } contained_by { sphere { 0, 1e30 } } evaluate 1, 1.2, 0.9 }";
    all.push(
        case(
            "isosurface in a ball of 1e30".to_owned(),
            vec![format!("{HEAD}{huge}\n")],
        )
        .slow(),
    );
    for template in TRANSFORMS {
        for body in ["sphere { 0, 1", "box { -1, 1", "torus { 1, 0.3"] {
            let texts = replaced(HEAD, &format!("{body} {template} }}"));
            let (word, shape) = (first_word(template), first_word(body));
            all.push(case(format!("{shape} under odd {word}"), texts));
        }
    }
    for template in CAMERAS {
        let kind = template.split([' ', ';']).nth(2).unwrap_or_default();
        all.push(case(
            format!("camera with odd numbers: {kind}"),
            replaced(INTERIOR, template),
        ));
    }
    for (kind, template) in LIGHTS {
        let texts = replaced(LIGHTLESS, template);
        all.push(case(format!("{kind} with odd numbers"), texts));
    }
}

fn first_word(text: &str) -> &str {
    text.split(' ').next().unwrap_or_default()
}

fn case(name: String, texts: Vec<String>) -> Case {
    Case::new(31, name, Asks::Sound(texts))
        .without_pov_ray("asked one by one where the catalogue names them")
}

/// A scene for each number in brackets and each value that replaces it.
fn replaced(head: &str, template: &str) -> Vec<String> {
    let parts: Vec<&str> = template.split(['[', ']']).collect();
    let mut texts = Vec::new();
    for slot in (1..parts.len()).step_by(2) {
        for odd in ODD {
            let body: String = parts
                .iter()
                .enumerate()
                .map(|(number, part)| if number == slot { odd } else { *part })
                .collect();
            texts.push(format!("{head}{body}\n"));
        }
    }
    texts
}
