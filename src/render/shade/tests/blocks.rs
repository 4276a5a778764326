//! Blocks of pixels match single pixels, and the fast path matches the general path, bit for bit.

use super::*;
use crate::render::shade::{BLOCK, BlockScratch};

/// Compares every pixel of a picture of some blocks, traced in blocks and on its own.
fn assert_same(text: &str) {
    assert_same_at((75, 53), text);
}

/// The same with a picture of `size`, columns and rows.
fn assert_same_at(size: (u32, u32), text: &str) {
    let world = world(text, 3.7, false);
    let tracer = Tracer::new(&world, 9);
    let mut long = Tracer::new(&world, 9);
    long.fast_paths.packets = false;
    long.fast_paths.queues_all_surfaces = false;
    let (mut scratch, mut single) = (BlockScratch::default(), Scratch::default());
    let mut drawn = 0;
    for top in (0..size.1).step_by(BLOCK as usize) {
        for left in (0..size.0).step_by(BLOCK as usize) {
            let columns = left..(left + BLOCK).min(size.0);
            let rows = top..(top + BLOCK).min(size.1);
            tracer.block(
                &columns,
                &rows,
                size,
                &mut scratch,
                |[right, down], sample| {
                    let (x, y) = (left + u32::from(right), top + u32::from(down));
                    let alone = long.pixel(f64::from(x), f64::from(y), size.0, size.1, &mut single);
                    assert_eq!(sample, alone, "at {x}, {y}");
                    drawn += 1;
                },
            );
        }
    }
    assert_eq!(drawn, size.0 * size.1);
}

#[test]
fn many_small_things_under_two_lights() {
    assert_same(
        "camera { location <0, 3, -9> look_at 0 angle 60 }
        light_source { <-8, 9, -9>, 1 } light_source { <1, 0.5, -1>, 0.5 }
        plane { y, -1.5 pigment { checker rgb 1 rgb 0.2 } finish { diffuse 0.6, 0.3 } }
        #local R = seed(4);
        #for (I, 1, 120)
          sphere { <rand(R), rand(R), rand(R)> * 6 - 3, 0.1 + 0.4 * rand(R) pigment { rgb 1 } finish { phong 1 } }
          box { 0, <0.4, 0.2, 0.3> rotate 360 * rand(R) translate <rand(R), rand(R), rand(R)> * 6 - 3
            pigment { rgbt <1, 0.5, 0.5, 0.3> } }
        #end",
    );
}

#[test]
fn solids_under_area_lights_and_a_point_light() {
    let perspective = "location <0, 3, -9> look_at 0 angle 50";
    let orthographic = "orthographic location <0, 3, -9> right <8, 0, 0> up <0, 6, 0> look_at 0";
    let second = "light_source { <4, 2, -9>, 0.5 area_light <1, 0, 0>, <0, 1, 0>, 2, 3 jitter }";
    for (camera, settings, more) in [
        (perspective, "", ""),
        (orthographic, "", ""),
        (perspective, "jitter", ""),
        (orthographic, "jitter", ""),
        (perspective, "jitter", second),
    ] {
        assert_same(&format!(
            "camera {{ {camera} }}
            light_source {{ <4, 9, -5>, 1 area_light <1.5, 0, 0>, <0, 0, 1.5>, 4, 4 adaptive 1 {settings} }}
            light_source {{ <-8, 5, -9>, 0.4 }} {more}
            plane {{ y, -1.5 pigment {{ checker rgb 1 rgb 0.2 }} }}
            #local R = seed(4);
            #for (I, 1, 40)
              #local P = <rand(R), rand(R), rand(R)> * 5 - 2.5;
              sphere {{ P, 0.1 + 0.5 * rand(R) pigment {{ rgb 1 }} finish {{ phong 1 reflection 0.2 * mod(I, 2) }} }}
              cylinder {{ P, P + 1, 0.2 pigment {{ rgbt <1, 0.5, 0.5, 0.3> }} normal {{ bumps 0.5 }} }}
            #end",
        ));
    }
}

#[test]
fn solids_that_touch_and_tori_that_cross() {
    assert_same(
        "camera { location <1, 3, -9> look_at 0 angle 50 }
        light_source { <-8, 9, -9>, 1 } light_source { <6, 1, -5>, 0.5 }
        #local R = seed(7);
        #for (I, 1, 60)
          difference {
            intersection { box { -1, 1 } sphere { 0, 1.35 } }
            cylinder { -2*x, 2*x, 0.6 } cylinder { -2*y, y, 0.6 } box { <0, 0, -1>, <1, 1, 2> } sphere { x + y, 0.5 }
            scale 0.4 #if (mod(I, 2)) rotate 360 * rand(R) #end
            translate <floor(12 * rand(R)), floor(12 * rand(R)), floor(12 * rand(R))> * 0.4 - 2.4 pigment { rgb 1 } finish { phong 1 }
          }
          torus { 0.5, 0.02 + 0.5 * rand(R) #if (mod(I, 3)) rotate 360 * rand(R) #end
            translate <rand(R), rand(R), rand(R)> * 5 - 2.5 pigment { rgb <1, 0.5, 0.2> } }
        #end",
    );
}

#[test]
fn large_meshes_turned_and_stretched() {
    assert_same(
        "camera { location <0, 3, -9> look_at 0 angle 55 }
        light_source { <-8, 9, -9>, 1 } light_source { <2, 0.5, -4>, 0.5 }
        #declare P = function(I, J) { 0.3 * sin(I) + 0.2 * cos(2 * J) }
        #macro Wavy(Word)
          mesh { #for (I, 0, 17) #for (J, 0, 17)
            #local A = <I - 9, P(I, J), J - 9> / 9; #local B = <I - 8, P(I + 1, J), J - 9> / 9;
            #local C = <I - 8, P(I + 1, J + 1), J - 8> / 9; #local D = <I - 9, P(I, J + 1), J - 8> / 9;
            triangle { A, B, C } smooth_triangle { A, y, C, y + 0.3 * x, D, y - 0.2 * z }
          #end #end }
        #end
        #declare One = Wavy(1)
        object { One scale 3 translate -2*y pigment { checker rgb 1 rgb <0.3, 0.5, 1> scale 0.3 } finish { phong 1 } }
        object { One scale <1, 4, 0.7> rotate <40, 30, 110> translate <-1, 0, 0> pigment { rgb <1, 0.5, 0.5> } }
        object { One rotate 70 * z translate <1.5, 0.4, 0.5> pigment { rgbt <1, 0.7, 0.2, 0.4> } no_shadow }
        object { One scale 0.6 rotate <20, -50, 0> translate <0.4, -0.6, -3> pigment { rgb 1 } no_image }
        sphere { <1, -1, -2>, 0.5 pigment { rgb 1 } finish { reflection 0.3 } } plane { y, -2.4 pigment { rgb 0.8 } }",
    );
}

#[test]
fn focal_blur_that_stops_early_and_late() {
    for (kind, samples) in [
        (
            "perspective",
            "blur_samples 19 confidence 0.9 variance 1/200",
        ),
        (
            "perspective",
            "blur_samples 4, 40 confidence 0.5 variance 1/50 bokeh { pigment { gradient x } }",
        ),
        ("orthographic", "blur_samples 5"),
        ("fisheye", "blur_samples 7"),
    ] {
        assert_same(&format!(
            "camera {{ {kind} location <0, 2, -9> look_at 0 angle 50 aperture 0.8 focal_point <0, 0, -1> {samples} }}
            light_source {{ <-8, 9, -9>, 1 }} light_source {{ <6, 4, -5>, 0.5 }}
            plane {{ y, -1 pigment {{ checker rgb 1 rgb 0.2 }} finish {{ reflection 0.2 }} }}
            sphere {{ <-1, 0, -1>, 1 pigment {{ rgbt <1, 0.9, 0.9, 0.8> }} interior {{ ior 1.4 }} }}
            box {{ -0.8, 0.8 rotate <20, 40, 0> translate <1.5, 0, 1> pigment {{ bozo scale 0.3 }} }}"
        ));
    }
}

#[test]
fn units_do_not_matter() {
    for k in ["pow(2, -60)", "pow(2, 60)", "pow(10, -25)", "pow(10, 25)"] {
        assert_same(&format!(
            "#local K = {k};
            camera {{ location <0, 1, -6> * K look_at 0 angle 50 }}
            light_source {{ <-8, 9, -9> * K, 1 }}
            #for (I, 0, 20)
              torus {{ 0.5, 0.2 scale K translate <mod(I, 5) - 2, 0.7 * int(I / 5) - 1, I / 7> * K pigment {{ rgb 1 }} }}
            #end"
        ));
    }
}

#[test]
fn camera_inside_and_far_away() {
    assert_same(
        "camera { location <0.2, 0, 0> look_at z angle 170 } light_source { <0, 0.5, 0>, 1 }
        sphere { 0, 2 pigment { rgb 1 } } #for (I, 0, 40) sphere { <sin(I), cos(3 * I), cos(I)>, 0.15 pigment { rgb 1 } } #end",
    );
    assert_same(
        "camera { location -1e9 * z look_at 0 angle 2.5e-7 } light_source { -1e8 * z, 1 }
        #for (I, 0, 40) sphere { <2 * sin(I), 1.5 * cos(3 * I), cos(I)>, 0.25 pigment { rgb 1 } } #end",
    );
}

/// Mirrors, glass and panes among each other, with extra settings.
fn mirrors_and_glass(settings: &str) -> String {
    format!(
        "global_settings {{ {settings} }}
        camera {{ location <0.3, 2, -8> look_at 0 angle 55 }} background {{ rgb <0.1, 0.2, 0.3> }}
        light_source {{ <-8, 9, -9>, 1 }}
        light_source {{ <4, 3, -5>, rgb <0.5, 0.4, 0.3> spotlight point_at 0 radius 20 falloff 40 }}
        light_source {{ <0, 6, 5>, 0.4 fade_distance 5 fade_power 2 }}
        #default {{ finish {{ ambient 0.05 diffuse 0.5 specular 0.4 }} }}
        plane {{ y, -1.5 pigment {{ checker rgb 0.9 rgb <0.2, 0.4, 0.1> }} finish {{ reflection 0.2 }} }}
        #local R = seed(11);
        #for (I, 1, 48)
          sphere {{ <rand(R), 0.6 * rand(R), rand(R)> * 6 - <3, 1.4, 3>, 0.2 + 0.35 * rand(R)
            #switch (mod(I, 8))
              #case (0) pigment {{ rgb <1, 0.8, 0.3> }} finish {{ reflection {{ 0.1, 0.7 falloff 2 metallic }} }} #break
              #case (1) pigment {{ rgbf <1, 1, 0.9, 0.8> }} interior {{ ior 1.5 fade_distance 1 fade_power 2 }} #break
              #case (2) pigment {{ rgbf 0.9 }} finish {{ reflection {{ 0, 1 fresnel }} conserve_energy }} interior {{ ior 1.4 }} #break
              #case (3) pigment {{ rgbt <0.9, 0.5, 0.5, 0.6> }} finish {{ reflection 0.1 conserve_energy }} #break
              #case (4) pigment {{ gradient y color_map {{ [0 rgb 1] [1 rgbf <1, 0, 0, 1>] }} scale 0.3 }} #break
              #case (5) pigment {{ rgb 0.1 }} finish {{ diffuse 0 reflection 0.9 }} no_image #break
              #case (6) pigment {{ rgb 1 }} normal {{ bumps 0.4 scale 0.1 }} finish {{ reflection 0.5 }} no_reflection #break
              #else pigment {{ rgb 0.3 }} finish {{ reflection 0.6 reflection_exponent 1.5 }}
            #end }}
        #end
        sphere {{ <0, 0, -4>, 0.9 pigment {{ rgbf <0.9, 1, 0.9, 0.9> }} finish {{ reflection 0.1 }} interior {{ ior 1.6 }} }}
        sphere {{ <0.2, 0.1, -4>, 0.4 pigment {{ rgbt 0.8 }} interior {{ ior 1 }} }}
        box {{ <-2, -1, -5>, <-1, 1, -4.9> pigment {{ rgbt <0.5, 0.9, 0.9, 0.7> }} }}"
    )
}

#[test]
fn rays_without_a_common_origin() {
    for camera in [
        "orthographic location <2, 3, -9> look_at 0 right 6*x up 5*y",
        "cylinder 1 location <2, 3, -9> look_at 0 angle 60",
        "cylinder 3 location <2, 3, -9> look_at 0 angle 60",
        "fisheye location <2, 3, -9> look_at 0 angle 90",
    ] {
        for settings in ["", "max_trace_level 0", "adc_bailout 0.5"] {
            let scene = mirrors_and_glass(settings);
            let own = "location <0.3, 2, -8> look_at 0 angle 55";
            assert_same(&scene.replace(own, camera));
        }
        assert_same(&format!(
            "camera {{ {camera} }} light_source {{ <-8, 9, -9>, 1 }}
            sphere {{ <2, 3, -9>, 4 pigment {{ rgbf 0.9 }} interior {{ ior 1.3 }} }}
            sphere {{ 0, 1.5 pigment {{ agate }} normal {{ bumps 0.5 }} finish {{ reflection 0.4 }} }}"
        ));
    }
}

#[test]
fn interreflection_and_transmission() {
    assert_same(&mirrors_and_glass(""));
    assert_same(
        &(mirrors_and_glass("max_trace_level 9") + "sky_sphere { pigment { gradient y } }"),
    );
}

#[test]
fn secondary_rays_end_at_the_trace_level_and_at_the_bailout() {
    for settings in [
        "max_trace_level 1",
        "max_trace_level 2",
        "max_trace_level 3",
        "adc_bailout 0.3 max_trace_level 12",
        "adc_bailout 0 max_trace_level 5",
    ] {
        assert_same(&mirrors_and_glass(settings));
    }
}

#[test]
fn secondary_rays_with_dispersion_or_crand() {
    assert_same(
        &(mirrors_and_glass("max_trace_level 4")
            + "sphere { <1, 0, -3>, 0.5 pigment { rgbf 1 } interior { ior 1.5 dispersion 1.1 } }"),
    );
    assert_same(
        &(mirrors_and_glass("max_trace_level 4")
            + "sphere { <1, 0, -3>, 0.5 pigment { rgb 1 } finish { crand 0.4 reflection 0.3 } }"),
    );
}

#[test]
fn more_panes_in_a_row_than_the_queue_holds() {
    assert_same_at(
        (BLOCK, BLOCK),
        "camera { location <0.3, 0.2, -8> look_at 0 angle 40 } light_source { <-8, 9, -9>, 1 }
        global_settings { adc_bailout 0 max_trace_level 6 }
        #for (I, 0, 60)
          box { <-2, -2, 0.1 * I>, <2, 2, 0.1 * I + 0.05>
            pigment { rgbt <1, 1, 1, 0.98> } finish { ambient 0.02 diffuse 0.3 } rotate I * z }
        #end
        plane { -z, -7 pigment { checker rgb 1 rgb 0.2 } }",
    );
}

#[test]
fn camera_inside_glass() {
    assert_same(
        "camera { location <0.1, 0, 0> look_at z angle 100 } light_source { <3, 5, -4>, 1 }
        sphere { 0, 2 pigment { rgbf 0.9 } finish { reflection { 0.1, 0.5 } } interior { ior 1.5 } }
        #for (I, 0, 20) sphere { 3 * <sin(I), cos(3 * I), cos(I)>, 0.4 pigment { rgb <1, 0.5, 0> } finish { reflection 0.3 } } #end",
    );
}

#[test]
fn csg_parts_with_bounds_of_their_own() {
    assert_same(
        "camera { location <0.3, 4, -14> look_at y angle 50 }
        light_source { <-8, 9, -9>, 1 } light_source { <6, 12, -5>, 0.5 }
        #declare Cone = quadric { <1, -1, 1>, 0, 0, 0 }
        #declare Foot = object { Cone clipped_by { plane { y, 0 } plane { -y, 1 } } scale <1.5, 0.5, 1.5> translate 0.5*y }
        #declare Bowl = intersection { plane { y, 1 } object { Cone } object { Cone scale <0.9, 1, 0.9> inverse } plane { -y, 0 } scale 1.5 }
        #macro Goblet(Kind)
          #switch (Kind) #case (0) merge { #break #case (1) union { #break #else difference { sphere { y, 3 } #end
            object { Foot } cylinder { 0, 2*y, 0.15 } object { Bowl translate 1.8*y }
            torus { 1.5, 0.1 clipped_by { plane { -y, 0 } } translate 3.3*y }
            union { sphere { y, 0.3 } intersection { box { -0.3, 0.3 } plane { x + y, 0.2 } rotate 30 translate 1.4*y } }
            triangle { <-1, 2, 0>, <1, 2, 0.3>, <0, 2.5, 1> }
            clipped_by { plane { x + 0.2*z, 1.4 } }
          }
        #end
        object { Goblet(0) rotate <20, 30, 10> pigment { rgb 1 } finish { phong 1 } translate -3.5*x }
        object { Goblet(1) rotate <-10, 70, 0> pigment { rgbf 0.8 } interior { ior 1.3 } }
        object { Goblet(2) rotate <60, 0, -30> pigment { rgb <1, 0.5, 0.2> } translate 3.5*x }
        plane { y, -2 pigment { checker rgb 1 rgb 0.4 } finish { reflection 0.3 } }",
    );
}

#[test]
fn unlit_surfaces_trace_no_shadow_rays() {
    let world = world(
        "camera { location -5*z look_at 0 angle 50 } light_source { <-8, 9, -9>, 1 }
        sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 diffuse 0 } } plane { -z, -9 finish { emission 1 diffuse 0 } }",
        3.7,
        false,
    );
    let mut scratch = BlockScratch::default();
    Tracer::new(&world, 9).block(&(0..16), &(0..16), (16, 16), &mut scratch, |_, _| {});
    let rays = scratch.take_rays();
    assert_eq!((rays.camera, rays.shadow), (256, 0));
}

#[test]
fn bumps_layers_films_and_fog_in_mirrors_and_glass() {
    assert_same(
        "global_settings { max_trace_level 9 }
        camera { location <1, 3, -9> look_at 0 angle 50 }
        light_source { <-8, 9, -9>, 1 } light_source { <6, 1, -5>, 0.5 }
        fog { distance 60 rgb <0.6, 0.7, 0.9> turbulence 0.3 }
        plane { y, -2 pigment { checker rgb 1 rgb 0.2 } normal { bumps 0.4 scale 0.2 }
          finish { reflection { 0.1, 0.6 fresnel exponent 0.7 } conserve_energy } interior { ior 1.4 } }
        #local R = seed(9);
        #for (I, 1, 40)
          sphere { <rand(R), rand(R), rand(R)> * 6 - 3, 0.2 + 0.4 * rand(R)
            texture { pigment { bozo color_map { [0 rgb 1] [1 rgbf <0.5, 0.8, 1, 0.9>] } }
              normal { dents 0.5 } finish { specular 0.8 reflection 0.4 irid { 0.3 thickness 0.4 } } }
            texture { pigment { granite color_map { [0 rgbt 1] [1 rgbt <1, 0.2, 0, 0.2>] } scale 0.3 }
              #if (mod(I, 3) = 0) finish { reflection 0.2 } #end }
            interior { ior 1 + 0.8 * mod(I, 2) fade_distance 1 fade_power 2 } }
          box { 0, <0.4, 0.6, 0.3> rotate 360 * rand(R) translate <rand(R), rand(R), rand(R)> * 6 - 3
            texture { checker texture { pigment { rgb 0.3 } finish { reflection 0.5 } }
              texture { pigment { rgbt <1, 1, 1, 0.7> } } scale 0.2 } }
        #end",
    );
}

#[test]
fn bumps_that_face_lights_far_behind_the_surface() {
    assert_same(
        "camera { location <1, 3, -9> look_at 0 angle 50 }
        light_source { <0, -30, 9>, <1, 0.6, 0.3> } light_source { <-8, 9, -9>, 1 }
        light_source { <4, 6, -6>, 1 spotlight point_at <0, -2, 0> radius 12 falloff 25 tightness 3 }
        light_source { <9, -1, 3>, 0.7 fade_distance 6 fade_power 2 }
        plane { y, -2 pigment { checker rgb 1 rgb 0.2 } normal { bumps 9 scale 0.3 } finish { brilliance 2 specular 0.6 } }
        sphere { <-2, 0, 0>, 1.5 pigment { slope <0.3, 1, 0> color_map { [0 rgb x] [1 rgb y] } }
          normal { wrinkles 4 scale 0.4 } finish { phong 0.7 phong_size 9 metallic } }
        sphere { <2, 0, 0>, 1.5 texture { pigment { rgbt <1, 0.5, 0.2, 0.6> } normal { granite 3 } finish { diffuse 0.3 } }
          texture { pigment { slope y color_map { [0 rgb x] [1 rgb z] } } finish { specular 0.4 } } }
        torus { 3.6, 0.3 pigment { rgb 1 } normal { bumps 6 scale 0.1 } finish { diffuse 0.5, 0.4 } }
        cylinder { <-4, -2, 3>, <-4, 2, 3>, 0.7 open pigment { rgb 0.8 } normal { bumps 5 } double_illuminate }",
    );
}

#[test]
fn layers_and_choices_of_textures_with_and_without_secondary_rays() {
    assert_same(
        "global_settings { max_trace_level 5 }
        camera { location <1, 3, -9> look_at 0 angle 50 }
        light_source { <-8, 9, -9>, 1 } light_source { <6, 1, -5>, 0.5 }
        background { rgb <0.3, 0.4, 0.6> }
        #declare Wood = texture { pigment { wood turbulence 0.1 color_map { [0 rgb <0.6, 0.3, 0.1>] [1 rgb 0.2] } scale 0.3 } }
        #declare Stain = texture { pigment { bozo color_map { [0 rgbf <1, 0.8, 0.6, 0.9>] [1 rgbt <0.5, 0.4, 0.3, 0.2>] } scale 0.2 } }
        plane { y, -2 texture { Wood } texture { Stain finish { reflection 0.3 conserve_energy } normal { bumps 0.3 } } }
        sphere { <-2.5, 0, 0>, 1 texture { Wood finish { reflection 0.2 } } texture { Stain finish { reflection 0.3 } } }
        sphere { 0, 1 texture { Wood finish { reflection { 0.1, 0.7 metallic 1 } } } texture { Stain finish { specular 1 } } }
        sphere { <2.5, 0, 0>, 1 texture { Stain } texture { Stain rotate 90*y } interior { ior 1.3 } }
        box { -1, 1 texture { gradient x texture_map { [0.2 Wood] [0.4 Wood normal { bumps 2 scale 0.2 }] [0.9 Stain] } }
          rotate 30*y translate <-2, 2.5, 2> }
        box { -1, 1 texture { average texture_map { [1 Wood] [2 pigment { rgb 1 } normal { dents 2 } finish { phong 1 }] } }
          rotate 50*y translate <1, 2.5, 2> }
        cylinder { -0.5*y, 0.5*y, 0.8 texture { checker texture { Wood } texture { pigment { rgb 0.3 } finish { reflection 0.5 } } scale 0.3 }
          interior_texture { Stain } translate <3.6, 2, 1> }
        sphere { 0, 0.9 texture { uv_mapping pigment { checker rgb 1 rgb x scale <0.1, 0.2, 1> } normal { bumps 2 scale 0.1 } }
          rotate 70 translate <-3.6, 2, 0> }",
    );
}
