//! Trees compared with a linear search through all boxes.

use super::{Bundle, Bvh, LightBuffer, NewEnds, ParallelBundle};
use crate::base::math::conditioning::RescaledRay;
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::sampling::random::Random;
use crate::base::math::simd::SimdLevel;
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

struct Sphere {
    centre: DVec3,
    radius: f64,
}

impl Sphere {
    fn bounds(&self) -> Bounds {
        Bounds::new(self.centre - self.radius, self.centre + self.radius)
    }

    fn hit(&self, ray: &Ray) -> Option<f64> {
        let rescaled = RescaledRay::new(&Ray::new(ray.origin - self.centre, ray.dir), self.radius)?;
        let (enter, leave) = sphere_span(
            rescaled.ray.origin,
            rescaled.ray.dir,
            self.radius / rescaled.size,
        )?;
        [enter, leave]
            .map(|t| rescaled.t(t))
            .into_iter()
            .find(|t| *t > 0.0)
    }
}

fn spheres(count: usize, size: f64, at: DVec3) -> Vec<Sphere> {
    let mut rng = Random::new(17);
    let mut sphere = || Sphere {
        centre: at + rng.vector(size),
        radius: size * 0.3 * rng.uniform().powi(4),
    };
    (0..count).map(|_| sphere()).collect()
}

fn bounds_of(spheres: &[Sphere]) -> Vec<Bounds> {
    spheres.iter().map(Sphere::bounds).collect()
}

/// Trees over spheres, and the items in their order: of boxes, of boxes and spheres, and of spheres alone.
fn trees(spheres: &[Sphere], at: DVec3) -> [(Bvh, Vec<u32>); 3] {
    let bounds = bounds_of(spheres);
    let build = |is_sphere: fn(&Sphere, DVec3) -> bool| {
        Bvh::build_in_order(bounds.len(), |item| {
            (bounds[item], is_sphere(&spheres[item], at))
        })
    };
    let trees = [
        build(|_, _| false),
        build(|sphere, at| sphere.centre.x < at.x),
        build(|_, _| true),
    ];
    let sphere_leaves = trees.each_ref().map(|(tree, _)| tree.sphere_leaves.len());
    assert!(sphere_leaves[0] == 0 && 0 < sphere_leaves[1] && sphere_leaves[1] < sphere_leaves[2]);
    trees
}

/// The nearest hit; of several at the same depth the one first in the list.
fn nearest(bvh: &Bvh, order: &[u32], spheres: &[Sphere], ray: &Ray) -> Option<(u32, f64)> {
    let mut best: Option<(u32, f64)> = None;
    bvh.nearest(ray, 0.0, f64::INFINITY, |position, end| {
        let item = order[position as usize];
        let Some(t) = spheres[item as usize].hit(ray) else {
            return end;
        };
        if best.is_none_or(|(first, least)| t < least || (t == least && item < first)) {
            best = Some((item, t));
        }
        end.min(t)
    });
    best
}

fn nearest_of_all(spheres: &[Sphere], ray: &Ray) -> Option<(u32, f64)> {
    let hits = (0..)
        .zip(spheres)
        .filter_map(|(item, sphere)| Some((item, sphere.hit(ray)?)));
    hits.min_by(|a, b| a.1.total_cmp(&b.1))
}

#[test]
fn the_nearest_hit_is_that_of_a_linear_search() {
    for (size, at) in [
        (1.0, DVec3::ZERO),
        (1.0, DVec3::splat(1e8)),
        (1e-30, DVec3::ZERO),
        (1e30, DVec3::ZERO),
        (1e-150, DVec3::ZERO),
        (1e150, DVec3::ZERO),
        (1e-3, DVec3::new(0.0, 5e3, 0.0)),
    ] {
        let spheres = spheres(300, size, at);
        let trees = trees(&spheres, at);
        let region = Bounds::new(at - size, at + size);
        let mut rng = Random::new(18);
        let mut hits = 0;
        for _ in 0..500 {
            let ray = rng.ray_near(&region);
            for far in [0.0, -1e3, -1e9] {
                let ray = Ray::new(ray.at(far), ray.dir);
                let expected = nearest_of_all(&spheres, &ray);
                hits += usize::from(expected.is_some());
                for (tree, order) in &trees {
                    assert_eq!(nearest(tree, order, &spheres, &ray), expected, "{ray:?}");
                    let is_any = tree.any(&ray, 0.0, f64::INFINITY, |position| {
                        spheres[order[position as usize] as usize]
                            .hit(&ray)
                            .is_some()
                    });
                    assert_eq!(is_any, expected.is_some());
                    let mut entries = vec![f64::NAN; spheres.len()];
                    tree.each_entered(&ray, 0.0, f64::INFINITY, |position, entry| {
                        entries[order[position as usize] as usize] = entry;
                    });
                    for (sphere, entry) in spheres.iter().zip(entries) {
                        let Some(t) = sphere.hit(&ray) else {
                            continue;
                        };
                        assert!(entry <= t, "{entry} {t}");
                        // A sphere is not far behind the entry into its box.
                        let is_precise = far == 0.0 && at == DVec3::ZERO;
                        let depth = (4.0 * sphere.radius + 1e-4 * size) / ray.dir.length();
                        assert!(!is_precise || t - entry <= depth, "{entry} {t} {depth}");
                    }
                }
            }
        }
        assert!(hits > 300, "only {hits} hits at size {size}");
    }
}

/// True if an axis-parallel line hits a box; the test is exact.
fn is_hit_exactly(bounds: &Bounds, origin: DVec3, along: usize) -> bool {
    (0..3)
        .filter(|&axis| axis != along)
        .all(|axis| bounds.min[axis] <= origin[axis] && origin[axis] <= bounds.max[axis])
}

#[test]
fn rays_in_the_faces_and_edges_of_boxes_hit_them() {
    for unit in [1.0, 1e-30, 1e30, 0.1] {
        let cell = |i: i32| f64::from(i) * unit;
        let mut boxes = Vec::new();
        for (x, y) in (-4..4).flat_map(|x| (-4..4).map(move |y| (x, y))) {
            let low = DVec3::new(cell(x), cell(y), cell(x * y));
            boxes.push(Bounds::new(low, low + DVec3::splat(unit)));
        }
        let bvh = Bvh::build(&boxes);
        for (i, along) in (0..boxes.len()).flat_map(|i| [0, 1, 2].map(|along| (i, along))) {
            for sign in [1.0, -1.0] {
                let mut dir = DVec3::splat(-0.0);
                dir[along] = sign;
                let mut origin = boxes[i].min;
                origin[along] -= sign * 100.0 * unit;
                let mut seen = vec![false; boxes.len()];
                let ray = Ray::new(origin, dir);
                bvh.any(&ray, 0.0, f64::INFINITY, |item| {
                    seen[item as usize] = true;
                    false
                });
                for (other, is_seen) in seen.iter().enumerate() {
                    assert!(*is_seen || !is_hit_exactly(&boxes[other], origin, along));
                }
                assert!(seen.iter().filter(|seen| **seen).count() < boxes.len());
            }
        }
    }
}

#[test]
fn a_box_that_begins_where_the_search_ends_is_visited() {
    let boxes =
        [0.0, 0.0, 3.0].map(|z| Bounds::new(DVec3::new(-1.0, -1.0, z), DVec3::new(1.0, 1.0, z)));
    let bvh = Bvh::build(&boxes);
    let ray = Ray::new(DVec3::new(0.1, 0.2, -5.0), DVec3::Z);
    let mut visited = Vec::new();
    bvh.nearest(&ray, 0.0, f64::INFINITY, |item, end| {
        visited.push(item);
        end.min(if item < 2 { 5.0 } else { 8.0 })
    });
    visited.sort_unstable();
    assert_eq!(visited, [0, 1]);
}

#[test]
fn the_visits_go_from_front_to_back() {
    let boxes: Vec<Bounds> = (0..50)
        .map(|i| {
            Bounds::new(
                DVec3::splat(f64::from(i * 7 % 50)),
                DVec3::splat(f64::from(i * 7 % 50) + 0.5),
            )
        })
        .collect();
    let ray = Ray::new(DVec3::splat(-3.0), DVec3::ONE);
    let mut visited = Vec::new();
    Bvh::build(&boxes).nearest(&ray, 0.0, 1e3, |item, end| {
        visited.push(item * 7 % 50);
        end
    });
    assert!(visited.is_sorted() && visited.len() == 50);
}

#[test]
fn a_point_visits_every_box_that_contains_it() {
    let spheres = spheres(500, 2.0, DVec3::new(10.0, 0.0, 0.0));
    let boxes = bounds_of(&spheres);
    let trees = trees(&spheres, DVec3::new(10.0, 0.0, 0.0));
    let mut rng = Random::new(19);
    let mut hits = 0;
    for round in 0..2000 {
        let point = DVec3::new(10.0, 0.0, 0.0) + rng.vector(2.0);
        let mut seen = vec![false; boxes.len()];
        let (tree, order) = &trees[round % 3];
        tree.visit_containing(point, |position| {
            seen[order[position as usize] as usize] = true;
            false
        });
        for (bounds, is_seen) in boxes.iter().zip(seen) {
            let holds = point.cmpge(bounds.min).all() && point.cmple(bounds.max).all();
            assert!(is_seen || !holds);
            hits += usize::from(is_seen);
        }
    }
    assert!(hits > 1000 && hits < 200_000);
}

#[test]
fn empty_large_degenerate_and_infinite_inputs_build() {
    let ray = Ray::new(DVec3::new(0.2, 0.3, -9.0), DVec3::Z);
    let count = |boxes: &[Bounds]| {
        let mut count = 0;
        Bvh::build(boxes).any(&ray, 0.0, f64::INFINITY, |_| {
            count += 1;
            false
        });
        count
    };
    let cube = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);
    let point = Bounds::new(DVec3::new(0.2, 0.3, 0.0), DVec3::new(0.2, 0.3, 0.0));
    let huge = Bounds::new(DVec3::splat(-1e308), DVec3::splat(1e308));
    assert_eq!(count(&[]), 0);
    assert_eq!(count(&[cube]), 1);
    assert_eq!(count(&[point]), 1);
    assert_eq!(count(&[huge]), 1);
    assert_eq!(count(&[Bounds::EMPTY]), 0);
    assert_eq!(count(&[cube; 5000]), 5000);
    assert_eq!(count(&[point; 777]), 777);
    assert_eq!(
        count(&[cube, point, huge, Bounds::EMPTY, Bounds::EVERYTHING]),
        4
    );
    let growing: Vec<Bounds> = (-1000..1000)
        .map(|i| Bounds::new(DVec3::ZERO, DVec3::splat(2.0_f64.powi(i))))
        .collect();
    assert!(count(&growing) >= 1000);
}

#[test]
fn the_tree_is_the_same_for_any_number_of_threads() {
    let boxes = bounds_of(&spheres(20_000, 1.0, DVec3::ZERO));
    let build = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| format!("{:?}", Bvh::build(&boxes)))
    };
    assert!(build(1) == build(4));
}

#[test]
fn degenerate_rays_visit_at_most_all_items() {
    let bvh = Bvh::build(&bounds_of(&spheres(100, 1.0, DVec3::ZERO)));
    for dir in [DVec3::ZERO, DVec3::splat(f64::NAN), DVec3::splat(1e300)] {
        for origin in [DVec3::ZERO, DVec3::splat(f64::NAN), DVec3::splat(1e300)] {
            let mut count = 0;
            bvh.nearest(&Ray::new(origin, dir), 0.0, f64::INFINITY, |_, end| {
                count += 1;
                end
            });
            assert!(count <= 100);
        }
    }
}

#[test]
fn memory_stays_below_sixty_bytes_per_box_and_forty_per_sphere() {
    let spheres = spheres(20_000, 1.0, DVec3::ZERO);
    let [(per_box, _), _, (per_sphere, _)] = trees(&spheres, DVec3::ZERO);
    let (per_box, per_sphere) = (
        per_box.bytes() / spheres.len(),
        per_sphere.bytes() / spheres.len(),
    );
    assert!(
        per_box < 60 && per_sphere < 40,
        "{per_box} and {per_sphere} bytes an item"
    );
}

#[test]
fn sphere_leaves_give_the_same_bits_in_wide_and_narrow_lanes() {
    let spheres = spheres(2000, 1.0, DVec3::ZERO);
    let [_, _, (tree, _)] = trees(&spheres, DVec3::ZERO);
    let mut rng = Random::new(37);
    let mut hits = 0;
    for (round, leaf) in tree.sphere_leaves.iter().enumerate() {
        for _ in 0..20 {
            let ray = tree.frame.ray(&rng.ray_near(&bounds_of(&spheres)[round]));
            let (from, to) = [(0.0, f32::INFINITY), (f32::NEG_INFINITY, 1.0)][round % 2];
            let wide = leaf.intersect(SimdLevel::widest(), &ray, from, to);
            let narrow = leaf.intersect(SimdLevel::NARROW, &ray, from, to);
            assert_eq!(wide.1, narrow.1);
            assert_eq!(wide.0.map(f32::to_bits), narrow.0.map(f32::to_bits));
            hits += wide.1.count_ones();
        }
    }
    assert!(hits > 100, "{hits}");
}

#[test]
fn a_bundle_has_the_hits_of_its_single_rays() {
    for (size, at) in [
        (1.0, DVec3::ZERO),
        (1e-20, DVec3::splat(1e-19)),
        (1e12, DVec3::X * 3e12),
    ] {
        let spheres = spheres(350, size, at);
        for (mut tree, order) in trees(&spheres, at) {
            tree.set_bounding_spheres(order.len(), |position| {
                let item = order[position];
                let sphere = &spheres[item as usize];
                (!item.is_multiple_of(3)).then_some((sphere.centre, sphere.radius, item % 3 == 1))
            });
            let mut rng = Random::new(23);
            let (mut bundle, mut traversed, mut hits) = (Bundle::default(), 0, 0);
            for round in (0..60).filter(|round| round % 4 < 2) {
                let origin = at + rng.vector(if round % 2 == 0 { 4.0 } else { 1.0 }) * size;
                let middle = at + rng.vector(1.0) * size - origin;
                let count = 1 + round * 4;
                let rays: Vec<Ray> = (0..count)
                    .map(|_| {
                        Ray::new(
                            origin,
                            (middle + rng.vector(0.4) * middle.length()).normalize(),
                        )
                    })
                    .collect();
                let far = |i: usize| {
                    if i % 5 == 4 {
                        2.0 * size
                    } else {
                        f64::INFINITY
                    }
                };
                let packet4 = |number: usize| {
                    let ray_index = |lane: usize| (4 * number + lane).min(rays.len() - 1);
                    let axis =
                        |axis: usize| [0, 1, 2, 3].map(|lane| rays[ray_index(lane)].dir[axis]);
                    (
                        [axis(0), axis(1), axis(2)],
                        [0, 1, 2, 3].map(|lane| far(ray_index(lane))),
                    )
                };
                if !bundle.fill(&tree, origin, rays.len(), packet4) {
                    continue;
                }
                let mut best = vec![None; rays.len()];
                let is_done = tree.traverse_bundle(
                    SimdLevel::widest(),
                    &mut bundle,
                    |position, first, lanes, new_ends| {
                        for lane in (0..8).filter(|lane| lanes >> lane & 1 == 1) {
                            let ray = first + lane;
                            let Some(t) =
                                spheres[order[position as usize] as usize].hit(&rays[ray])
                            else {
                                continue;
                            };
                            let slot: &mut Option<f64> = &mut best[ray];
                            if t < far(ray) && slot.is_none_or(|least| t < least) {
                                new_ends.set(lane, *slot.insert(t));
                            }
                        }
                    },
                );
                if !is_done {
                    continue;
                }
                traversed += 1;
                for (i, (ray, best)) in rays.iter().zip(best).enumerate() {
                    let alone = nearest_of_all(&spheres, ray)
                        .map(|(_, t)| t)
                        .filter(|&t| t < far(i));
                    assert_eq!(best, alone);
                    hits += u32::from(best.is_some());
                }
            }
            assert!(traversed > 20 && hits > 500, "{traversed} {hits}");
        }
    }
}

#[test]
fn parallel_rays_of_extreme_origins_or_directions_are_no_bundle() {
    let bounds = bounds_of(&spheres(50, 1.0, DVec3::ZERO));
    let mut bundle = ParallelBundle::default();
    let mut is_filled = |tree: &Bvh, origin: DVec3, dir: DVec3| {
        let origins = origin.to_array().map(|at| [at; 4]);
        bundle.fill(SimdLevel::widest(), tree, (3, dir), |_| &origins)
    };
    let tree = Bvh::build(&bounds);
    assert!(is_filled(&tree, DVec3::new(0.3, -0.2, -1e5), DVec3::Z));
    for at in [1e300, f64::INFINITY, f64::NAN, 1e4] {
        assert!(!is_filled(&tree, DVec3::new(0.3, at, -5.0), DVec3::Z));
    }
    assert!(!is_filled(&tree, DVec3::new(0.3, 0.2, -1e12), DVec3::Z));
    for dir in [DVec3::ZERO, DVec3::Z * 1.006, DVec3::splat(f64::NAN)] {
        assert!(!is_filled(&tree, DVec3::ZERO, dir));
    }
    let empty = Bvh::build(&[]);
    if is_filled(&empty, DVec3::ZERO, DVec3::Z) {
        let no_item = |_, _, _, _: &mut NewEnds| panic!("there are no items");
        assert!(empty.traverse_parallel_bundle(SimdLevel::widest(), &mut bundle, no_item));
    }
}

#[test]
fn a_bundle_of_parallel_rays_has_the_hits_of_its_single_rays() {
    for (size, at) in [
        (1.0, DVec3::ZERO),
        (1e-20, DVec3::splat(1e-19)),
        (1e12, DVec3::X * 3e12),
    ] {
        let spheres = spheres(350, size, at);
        for (mut tree, order) in trees(&spheres, at) {
            tree.set_bounding_spheres(order.len(), |position| {
                let item = order[position];
                let sphere = &spheres[item as usize];
                (!item.is_multiple_of(3)).then_some((sphere.centre, sphere.radius, item % 3 == 1))
            });
            let mut rng = Random::new(29);
            let (mut bundle, mut traversed, mut hits) = (ParallelBundle::default(), 0, 0);
            for round in 0..60 {
                let mut dir = rng.vector(1.0).normalize();
                if round % 3 == 0 {
                    // Along an axis, as most cameras of diagrams.
                    dir = [DVec3::X, -DVec3::Y, DVec3::Z][round / 3 % 3];
                }
                let far_away = [1.0, 40.0, 0.0, 1e4][round % 4];
                let middle = at + (rng.vector(1.0) - far_away * dir) * size;
                let width = [0.02, 0.2, 1.0][round % 3] * size;
                let rays: Vec<Ray> = (0..1 + round * 4)
                    .map(|_| Ray::new(middle + rng.vector(width), dir))
                    .collect();
                let far = |i: usize| match i % 5 {
                    4 => (far_away + 0.5) * size,
                    _ => f64::INFINITY,
                };
                let packets: Vec<_> = (0..rays.len().div_ceil(4))
                    .map(|packet| {
                        let index = |lane: usize| (4 * packet + lane).min(rays.len() - 1);
                        let axis =
                            |axis: usize| [0, 1, 2, 3].map(|lane| rays[index(lane)].origin[axis]);
                        let origins = [axis(0), axis(1), axis(2)];
                        (origins, [0, 1, 2, 3].map(|lane| far(index(lane))))
                    })
                    .collect();
                let lanes = [SimdLevel::widest(), SimdLevel::NARROW][round % 2];
                assert!(bundle.fill(lanes, &tree, (rays.len(), dir), |at| &packets[at].0));
                bundle.end_all(|at| packets[at].1);
                let mut best = vec![None; rays.len()];
                let is_done = tree.traverse_parallel_bundle(
                    lanes,
                    &mut bundle,
                    |position, first, rays_hit, new_ends| {
                        for lane in (0..8).filter(|lane| rays_hit >> lane & 1 == 1) {
                            let ray = first + lane;
                            let sphere = &spheres[order[position as usize] as usize];
                            let Some(t) = sphere.hit(&rays[ray]) else {
                                continue;
                            };
                            let slot: &mut Option<f64> = &mut best[ray];
                            if t < far(ray) && slot.is_none_or(|least| t < least) {
                                new_ends.set(lane, *slot.insert(t));
                            }
                        }
                    },
                );
                if !is_done {
                    continue;
                }
                traversed += 1;
                for (i, (ray, best)) in rays.iter().zip(best).enumerate() {
                    let alone = nearest_of_all(&spheres, ray)
                        .map(|(_, t)| t)
                        .filter(|&t| t < far(i));
                    assert_eq!(best, alone);
                    hits += u32::from(best.is_some());
                }
            }
            assert!(traversed > 20 && hits > 500, "{traversed} {hits}");
        }
    }
}

/// The hits of eight rays with a common point on spheres, from lookups in a light buffer: with `ends` rays towards the
/// point, from these distances, else rays from the point.
fn light_buffer_hits(
    light_buffer: &LightBuffer,
    spheres: &[Sphere],
    order: &[u32],
    rays: &[Ray; 8],
    ends: Option<[f64; 8]>,
) -> [Option<f64>; 8] {
    let mut best = [None; 8];
    let dirs = |half: usize| {
        [0, 1, 2].map(|axis| [0, 1, 2, 3].map(|lane| rays[4 * half + lane].dir[axis]))
    };
    let far = |half: usize| {
        [0, 1, 2, 3].map(|lane| ends.map_or(f64::INFINITY, |ends| ends[4 * half + lane]))
    };
    let (dirs, far) = ([dirs(0), dirs(1)], [far(0), far(1)]);
    let halves = [(&dirs[0], &far[0]), (&dirs[1], &far[1])];
    let mut rays8 = match ends {
        None => light_buffer.load_from_point(halves, 0xff),
        Some(_) => light_buffer.load_to_point(halves, 0xff),
    };
    let beside =
        light_buffer.visit_packet(SimdLevel::widest(), &mut rays8, |position, lanes, rays8| {
            for lane in (0..8).filter(|lane| lanes >> lane & 1 == 1) {
                let Some(t) = spheres[order[position as usize] as usize].hit(&rays[lane]) else {
                    continue;
                };
                let slot: &mut Option<f64> = &mut best[lane];
                if t < ends.map_or(f64::INFINITY, |ends| ends[lane])
                    && slot.is_none_or(|least| t < least)
                {
                    *slot = Some(t);
                    if ends.is_none() {
                        rays8.shorten(lane, t);
                    }
                }
            }
        });
    assert!(ends.is_some() || beside == 0);
    best
}

#[test]
fn light_buffer_lookups_have_the_hits_of_single_rays() {
    for (size, at) in [
        (1.0, DVec3::ZERO),
        (1e-20, DVec3::splat(1e-19)),
        (1e12, DVec3::X * 3e12),
    ] {
        let spheres = spheres(700, size, at);
        for (mut tree, order) in trees(&spheres, at) {
            tree.set_bounding_spheres(order.len(), |position| {
                let item = order[position];
                let sphere = &spheres[item as usize];
                (!item.is_multiple_of(3)).then_some((sphere.centre, sphere.radius, item % 3 == 1))
            });
            // Some have a bounding cylinder as well.
            let cylinder = |position: u32| {
                let sphere = &spheres[order[position as usize] as usize];
                position.is_multiple_of(4).then_some((
                    sphere.centre + 9.0 * size * DVec3::ONE,
                    -DVec3::ONE,
                    sphere.radius,
                ))
            };
            let mut rng = Random::new(29);
            let (mut seen, mut blocked, mut free) = (0, 0, 0);
            for round in 0..70 {
                let mut from = at + rng.vector(1.0).normalize() * 6.0 * size;
                let along = (at - from).normalize();
                let (right, up) = along.any_orthonormal_pair();
                let axes = [right, up, along];
                let light_buffer =
                    LightBuffer::for_camera(&tree, from, (axes, [0.01, 0.005]), cylinder).unwrap();
                let rays = [(); 8].map(|()| {
                    let [x, y] = [(); 2].map(|()| rng.uniform() - 0.5);
                    Ray::new(from, (along + x * right + y * up).normalize())
                });
                let best = light_buffer_hits(&light_buffer, &spheres, &order, &rays, None);
                for (ray, best) in rays.iter().zip(best) {
                    assert_eq!(best, nearest_of_all(&spheres, ray).map(|(_, t)| t));
                    seen += u32::from(best.is_some());
                }
                // Like the sun.
                from = at - along * [6.0, 600.0, 6000.0][round % 3] * size;
                let light = LightBuffer::for_light(&tree, from, cylinder).unwrap();
                // Behind some sphere, or just beside it.
                let points = [(); 8].map(|()| {
                    let pick = usize::try_from(rng.bits() % 700).expect("small");
                    let sphere = &spheres[pick];
                    let aim = sphere.centre + 1.2 * rng.vector(sphere.radius);
                    aim + 6.0 * size * (aim - from).normalize()
                });
                let rays = points.map(|point| Ray::new(point, (from - point).normalize()));
                let ends = points.map(|point| point.distance(from));
                let best = light_buffer_hits(&light, &spheres, &order, &rays, Some(ends));
                for (ray, best) in rays.iter().zip(best) {
                    let alone = nearest_of_all(&spheres, ray).is_some();
                    assert_eq!(best.is_some(), alone);
                    let hits = |position: u32| {
                        spheres[order[position as usize] as usize]
                            .hit(ray)
                            .is_some()
                    };
                    assert_eq!(light.any_between(ray.origin, hits), alone);
                    blocked += u32::from(alone);
                    free += u32::from(!alone);
                }
            }
            assert!(
                seen > 50 && blocked > 100 && free > 2,
                "{seen} {blocked} {free}"
            );
        }
    }
}

#[test]
fn no_ray_hits_anything_where_a_view_is_empty() {
    let spheres = spheres(60, 1.0, DVec3::ZERO);
    let bounds = bounds_of(&spheres);
    let (mut tree, order) = Bvh::build_in_order(bounds.len(), |item| (bounds[item], false));
    tree.set_bounding_spheres(order.len(), |position| {
        let sphere = &spheres[order[position] as usize];
        Some((sphere.centre, sphere.radius, true))
    });
    let mut rng = Random::new(31);
    let (mut empty, mut full) = (0, 0);
    for _ in 0..60 {
        let from = rng.vector(1.0).normalize() * 6.0;
        let along = -from.normalize();
        let (right, up) = along.any_orthonormal_pair();
        let axes = [right, up, along];
        let light_buffer =
            LightBuffer::for_camera(&tree, from, (axes, [0.01, 0.005]), |_| None).unwrap();
        for _ in 0..60 {
            let low = [(); 2].map(|()| 0.95 * rng.uniform() - 0.5);
            let high = low.map(|low| low + 0.05 * rng.uniform());
            if !light_buffer.is_empty(low, high) {
                full += 1;
                continue;
            }
            empty += 1;
            for step in 0..=16 {
                let share = f64::from(step % 4) / 3.0;
                let x = low[0] + (high[0] - low[0]) * f64::from(step / 4) / 4.0;
                let y = low[1] + (high[1] - low[1]) * share;
                let ray = Ray::new(from, (along + x * right + y * up).normalize());
                assert!(nearest_of_all(&spheres, &ray).is_none());
            }
        }
        assert!(
            !light_buffer.is_empty([-0.6, 0.0], [-0.55, 0.1]),
            "beside the grid"
        );
        assert!(!light_buffer.is_empty([f64::NAN; 2], [f64::NAN; 2]));
    }
    assert!(empty > 300 && full > 300, "{empty} {full}");
}

#[test]
fn a_light_among_the_items_has_no_light_buffer() {
    let tree = Bvh::build(&bounds_of(&spheres(100, 1.0, DVec3::ZERO)));
    assert!(LightBuffer::for_light(&tree, DVec3::ZERO, |_| None).is_none());
    assert!(LightBuffer::for_light(&tree, DVec3::splat(f64::NAN), |_| None).is_none());
}

#[test]
fn an_item_around_a_light_is_visited_by_every_ray() {
    let mut spheres = spheres(100, 1.0, DVec3::ZERO);
    spheres.push(Sphere {
        centre: DVec3::ZERO,
        radius: 50.0,
    });
    let bounds = bounds_of(&spheres);
    let (mut tree, order) = Bvh::build_in_order(bounds.len(), |item| (bounds[item], false));
    tree.set_bounding_spheres(order.len(), |position| {
        let sphere = &spheres[order[position] as usize];
        Some((sphere.centre, sphere.radius, true))
    });
    let light = LightBuffer::for_light(&tree, 6.0 * DVec3::X, |_| None).unwrap();
    for point in [DVec3::ZERO, 40.0 * DVec3::X, 60.0 * DVec3::Y] {
        assert!(light.any_between(point, |position| order[position as usize] == 100));
    }
}
