use super::*;
use crate::scene::shape::Crossing;
use crate::scene::shape::tests::check;

fn field(width: usize, rows: &[u16], water: f64, is_smooth: bool) -> HeightField {
    let heights = image::Heights {
        width,
        rows: rows.to_vec(),
    };
    HeightField {
        field: Arc::new(Field::new(heights, water * HEIGHT, is_smooth)),
        transform: Box::new(Transform::IDENTITY),
    }
}

/// Random hills of `width` by `width` pixels.
fn hills(width: usize, water: f64) -> HeightField {
    let mut rng = check::Random::new(7);
    let rows: Vec<u16> = (0..width * width)
        .map(|_| u16::try_from(rng.bits() % 60_000).unwrap())
        .collect();
    field(width, &rows, water, false)
}

/// Brute force: all roots of a ray over all triangles.
fn brute_force(shape: &HeightField, ray: &Ray) -> Vec<f64> {
    let field = &shape.field;
    let mut hits = Vec::new();
    let scale = field.scale();
    for face in 0..u32::try_from(2 * field.cells[0] * field.cells[1]).unwrap() {
        let (x, z, is_far) = field.cell(face);
        let corner = |dx: usize, dz: usize| {
            let height = field.height(x + dx, z + dz);
            DVec3::new((x + dx) as f64, height, (z + dz) as f64) / scale
        };
        let third = if is_far { corner(1, 1) } else { corner(0, 0) };
        let corners = [third, corner(1, 0), corner(0, 1)];
        let frame = crate::base::math::watertight::RayFrame::new(ray);
        hits.extend(frame.hit(&corners).map(|hit| hit.t));
    }
    hits.sort_by(f64::total_cmp);
    hits.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    hits
}

#[test]
fn traversal_agrees_with_brute_force() {
    for width in [2, 3, 17, 40] {
        let shape = hills(width, 0.0);
        let mut rng = check::Random::new(11);
        let mut hits = 0;
        for _ in 0..500 {
            let ray = rng.ray_near(&shape.bounds());
            let mut roots = Vec::new();
            shape.roots(&ray, &mut roots);
            let seen = roots.iter().filter(|root| root.is_visible);
            let mut hit_ts: Vec<f64> = seen.map(|root| root.t).collect();
            hit_ts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
            let expected = brute_force(&shape, &ray);
            assert_eq!(
                hit_ts.len(),
                expected.len(),
                "{ray:?} {hit_ts:?} {expected:?}"
            );
            for (a, b) in hit_ts.iter().zip(&expected) {
                assert!((a - b).abs() < 1e-9);
            }
            hits += hit_ts.len();
            for at in [0.0, 0.3, 1.0] {
                let nearest = shape.nearest(&ray, at, f64::INFINITY).map(|root| root.t);
                let next = hit_ts.iter().find(|t| **t > at).copied();
                assert!((nearest.unwrap_or(-1.0) - next.unwrap_or(-1.0)).abs() < 1e-9);
            }
        }
        assert!(hits > 100);
    }
}

#[test]
fn enter_and_leave_alternate_and_agree_with_contains() {
    for water in [0.0, 0.4] {
        let shape = hills(9, water);
        let mut rng = check::Random::new(13);
        for turn in 0..2000 {
            let mut ray = rng.ray_near(&shape.bounds());
            if turn % 7 == 0 {
                ray.dir = DVec3::Y * ray.dir.y;
            }
            let mut roots = Vec::new();
            let start = shape.roots(&ray, &mut roots);
            let mut is_inside = start == Start::Inside;
            assert!(roots.is_sorted_by(|a, b| a.t <= b.t));
            let mut last = -20.0;
            for root in &roots {
                if root.t - last > 1e-6 {
                    let middle = ray.at(0.5 * (root.t + last));
                    assert_eq!(shape.contains(middle), is_inside, "{ray:?} {roots:?}");
                }
                let expected = if is_inside {
                    Crossing::Leave
                } else {
                    Crossing::Enter
                };
                assert_eq!(root.crossing, expected, "{ray:?} {roots:?}");
                is_inside = !is_inside;
                last = root.t;
            }
        }
    }
}

#[test]
fn flat_fields_and_vertical_rays_are_hit() {
    let flat = field(3, &[10000; 9], 0.0, false);
    let down = flat.nearest(&Ray::new(DVec3::new(0.3, 5.0, 0.5), -DVec3::Y), 0.0, 100.0);
    assert!((down.unwrap().t - (5.0 - 10000.0 / 65536.0)).abs() < 1e-15);
    let slanted = Ray::new(DVec3::new(-1.0, 1.0, 0.5), DVec3::new(1.5, -1.0, 0.0));
    assert!(flat.nearest(&slanted, 0.0, 100.0).is_some());
    assert!(field(1, &[1, 2], 0.0, false).bounds().is_empty());
}

#[test]
fn everything_below_ground_or_water_is_inside() {
    // Measured with POV-Ray 3.7.
    let shape = field(2, &[20000; 4], 0.5, false);
    for (point, is_inside) in [
        (DVec3::new(0.5, 0.45, 0.5), true),
        (DVec3::new(0.5, -100.0, 0.5), true),
        (DVec3::new(0.5, 0.55, 0.5), false),
        (DVec3::new(1.0, 0.1, 0.5), false),
        (DVec3::new(0.0, 0.1, 0.0), true),
    ] {
        assert_eq!(shape.contains(point), is_inside, "{point}");
    }
    assert!(shape.bounds().is_empty());
}

#[test]
fn the_bottom_row_of_the_picture_lies_at_z_zero() {
    let shape = field(2, &[0, 65535, 30000, 65535], 0.0, false);
    let down = |x: f64, z: f64| {
        let ray = Ray::new(DVec3::new(x, 2.0, z), -DVec3::Y);
        let hit = shape.nearest(&ray, 0.0, 9.0).unwrap();
        (2.0 - hit.t) * 65536.0
    };
    assert!((down(1e-9, 1e-9) - 30000.0).abs() < 1e-3);
    assert!(down(1e-9, 1.0 - 1e-9).abs() < 1e-3);
}

#[test]
fn the_water_is_never_visible() {
    let shape = hills(9, 0.4);
    let mut rng = check::Random::new(17);
    for _ in 0..2000 {
        let ray = rng.ray_near(&shape.bounds());
        let mut roots = Vec::new();
        shape.roots(&ray, &mut roots);
        for root in roots.iter().filter(|root| root.is_visible) {
            let at = shape.point_to_field(ray.at(root.t));
            assert!(
                (at.y - shape.field.ground(at, root.face)).abs() < 1e-6,
                "{ray:?} {root:?}"
            );
            let (x, z, _) = shape.field.cell(root.face);
            let is_in_cell = (at.x - x as f64 - 0.5).abs() < 0.5 + 1e-9
                && (at.z - z as f64 - 0.5).abs() < 0.5 + 1e-9;
            assert!(is_in_cell, "{ray:?} {root:?}");
        }
    }
}

#[test]
fn ground_as_high_as_the_water_is_visible() {
    // A hill in one corner of a plain.
    let mut rows = [0; 25];
    rows[4] = 30_000;
    let shape = field(5, &rows, 0.0, false);
    for (x, z) in [(0.2, 0.3), (0.25, 0.25), (0.6, 0.1), (0.5, 0.25)] {
        for dir in [DVec3::NEG_Y, DVec3::new(0.1, -1.0, 0.05)] {
            let ray = Ray::new(DVec3::new(x, 2.0, z) - 2.0 * (dir - DVec3::NEG_Y), dir);
            let root = shape.nearest(&ray, 0.0, f64::INFINITY).unwrap();
            assert!((root.t - 2.0).abs() < 1e-9, "{ray:?}: {root:?}");
        }
    }
    let drowned = field(5, &rows, 0.1, false);
    let down = Ray::new(DVec3::new(0.2, 2.0, 0.3), DVec3::NEG_Y);
    assert_eq!(drowned.nearest(&down, 0.0, f64::INFINITY), None);
}

#[test]
fn cached_normals_equal_those_at_the_pixels() {
    for width in [2, 5, 9, 40] {
        let mut shape = hills(width, 0.0);
        let field = Arc::get_mut(&mut shape.field).unwrap();
        let heights = image::Heights {
            width,
            rows: field.heights.clone(),
        };
        *field = Field::new(heights, 0.0, true);
        for z in 0..field.cells[1] {
            for x in 0..field.cells[0] {
                for (dz, row) in field.corner_normals(x, z).iter().enumerate() {
                    for (dx, normal) in row.iter().enumerate() {
                        assert_eq!(*normal, field.pixel_normal(x + dx, z + dz));
                    }
                }
            }
        }
    }
}
