//! Area lights: what is decided for all of a light at once holds for each of its shadow rays, and samples that are looked
//! ahead to are those that are traced one after the other.

use super::*;
use crate::base::math::Ray;
use crate::base::math::sampling::random::Random;
use crate::base::math::simd::SimdLevel;
use crate::render::shade::BlockScratch;
use crate::world::{HitPacket4, LightArea, Occlusion, Query, QueryScratch, RayKind};

/// Convex and other solids on a plane, some of them transparent.
const SOLIDS: &str = "plane { y, -1.5 pigment { checker rgb 1 rgb 0.4 } }
    #local R = seed(3);
    #for (I, 1, 25)
      #local P = <rand(R), rand(R), rand(R)> * 5 - 2.5;
      #local Q = <rand(R), rand(R), rand(R)> * 5 - 2.5;
      sphere { P, 0.2 + 0.5 * rand(R) pigment { rgb <1, 0.5, 0.2> } finish { phong 1 } }
      cylinder { Q, Q + <rand(R), rand(R), rand(R)>, 0.3 #if (mod(I, 3) = 0) open #end pigment { rgb 0.7 } }
      box { P, P + 0.7 #if (mod(I, 2)) rotate 70 * rand(R) #end pigment { rgbt <0.2, 1, 0.5, 0.5 * mod(I, 2)> } }
    #end
    #for (I, 1, 8)
      #local P = <rand(R), rand(R), rand(R)> * 12 - 6;
      #local Q = <rand(R), rand(R), rand(R)> * 12 - 6;
      cylinder { P, Q, 0.04 pigment { rgb 0.3 } #if (mod(I, 2)) rotate 30 * x scale 1.1 #end }
    #end
    difference { sphere { <2, 0, 2>, 1 } box { <1, 0, 0>, 3 } pigment { rgb 1 } normal { bumps 0.5 scale 0.2 } }
    torus { 0.8, 0.2 translate <-1, 1, -2> pigment { rgb 1 } finish { reflection 0.3 } }";
const PERSPECTIVE: &str = "camera { location <0, 4, -9> look_at 0 angle 50 }";
const ORTHOGRAPHIC: &str =
    "camera { orthographic location <0, 4, -9> right <7, 0, 0> up <0, 6, 0> look_at 0 }";

/// An area light with these settings.
fn area_light(settings: &str) -> String {
    format!(
        "light_source {{ <4, 9, -5>, 1 area_light <1.5, 0, 0>, <0, 0.5, 1.5>, 4, 4 {settings} }}"
    )
}

#[test]
fn what_holds_for_all_of_a_light_holds_for_its_rays() {
    const SIZE: u32 = 70;
    let world = world(&(area_light("") + PERSPECTIVE + SOLIDS), 3.7, false);
    let light = world.lights.get(0);
    let area = light.area.as_ref().expect("an area light");
    let extent = LightArea::of(light, area, &area.axes);
    let (mut scratch, mut rng) = (QueryScratch::default(), Random::new(5));
    let (mut dark, mut clear) = (0, 0);
    for at in 0..SIZE * SIZE {
        let (x, y) = (f64::from(at % SIZE), f64::from(at / SIZE));
        let ray = world.camera.primary_ray(x, y, SIZE, SIZE).expect("a ray");
        let seen = Query {
            ray,
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: RayKind::Camera,
        };
        let Some(hit) = world.nearest(&seen, &mut scratch) else {
            continue;
        };
        let hits = HitPacket4::all_at(hit.point, &hit.spawn_surface);
        let is_dark = world.is_in_umbra(&hits, &extent, 0, &scratch);
        let lanes = SimdLevel::widest();
        let unblocked = world.lanes_without_blockers(lanes, &[hits], 1, &extent, &mut scratch);
        let is_clear = unblocked == 1;
        for _ in 0..8 {
            let [across, up] = extent
                .half_edges
                .map(|edge| edge * (2.0 * rng.uniform() - 1.0));
            let end = extent.centre + across + up;
            let distance = end.distance(hit.point);
            let shadow_ray = Query {
                ray: Ray::new(hit.point, (end - hit.point) / distance),
                origin_surface: Some(hit.spawn_surface),
                t_max: world.shadow_t_max(end, distance),
                kind: RayKind::Shadow,
            };
            let occlusion = world.occlusion(&shadow_ray, 0, &mut scratch);
            assert!(!is_dark || occlusion == Occlusion::Opaque, "{x}, {y}");
            assert!(!is_clear || occlusion == Occlusion::Clear, "{x}, {y}");
        }
        dark += u32::from(is_dark);
        clear += u32::from(is_clear);
    }
    assert!(dark > 100 && clear > 1000, "{dark} dark, {clear} clear");
}

#[test]
fn samples_looked_ahead_to_are_those_traced_in_order() {
    const SIZE: (u32, u32) = (44, 33);
    let fill = "light_source { <-5, 3, -5>, 0.3 }";
    for (camera, more) in [
        (PERSPECTIVE, ""),
        (ORTHOGRAPHIC, ""),
        (PERSPECTIVE, fill),
        (ORTHOGRAPHIC, fill),
    ] {
        for settings in ["jitter adaptive 1", "jitter circular adaptive 0", "jitter"] {
            let text = area_light(settings) + more + camera + SOLIDS;
            let options = RenderOptions {
                width: SIZE.0,
                height: SIZE.1,
                ..RenderOptions::default()
            };
            let world = world_for(&text, 3.7, &options);
            assert!(world.has_povray_distances(), "POV-Ray's order");
            let tracer = Tracer::new(&world, 9);
            let row = |y| (0..SIZE.0).map(move |x| (f64::from(x), f64::from(y)));
            let positions: Vec<_> = (0..SIZE.1).flat_map(row).collect();
            let (mut block, mut single) = (BlockScratch::default(), Scratch::default());
            block.single().begin_order(&world);
            single.begin_order(&world);
            tracer.sample_in_order(&positions, SIZE, &mut block, |number, sample| {
                let (x, y) = positions[number];
                let alone = tracer.pixel(x, y, SIZE.0, SIZE.1, &mut single);
                assert_eq!(sample, alone, "{settings} {more}: {x}, {y}");
            });
            let [found, expected] = [block.take_rays(), single.query.rays];
            assert_eq!(found.camera, expected.camera);
            assert_eq!(found.shadow, expected.shadow);
        }
    }
}
