//! Properties of every shape, tested on a few thousand random rays.

pub(crate) use crate::base::math::sampling::random::Random;
use crate::base::math::{Bounds, Ray, Step, Transform};
use crate::scene::shape::{Crossing, Geometry, Root, Start};
use glam::DVec3;

fn roots_of(shape: &dyn Geometry, ray: &Ray) -> (Start, Vec<Root>) {
    let mut roots = Vec::new();
    let start = shape.roots(ray, &mut roots);
    (start, roots)
}

/// Roots are sorted, enter and leave alternate from the start, and `nearest` returns the same roots.
fn alternates(shape: &dyn Geometry, ray: &Ray) -> Vec<Root> {
    let (start, roots) = roots_of(shape, ray);
    let mut is_inside = start == Start::Inside;
    for root in &roots {
        assert!(root.t.is_finite());
        if root.crossing == Crossing::Touch {
            assert!(is_inside, "{ray:?}: {roots:?}");
            continue;
        }
        let expected = if is_inside {
            Crossing::Leave
        } else {
            Crossing::Enter
        };
        assert_eq!(root.crossing, expected, "{ray:?}: {roots:?}");
        is_inside = !is_inside;
    }
    assert!(roots.is_sorted_by(|a, b| a.t <= b.t), "{ray:?}: {roots:?}");
    nearest_agrees(shape, ray, &roots);
    roots
}

fn nearest_agrees(shape: &dyn Geometry, ray: &Ray, roots: &[Root]) {
    let mut from = f64::NEG_INFINITY;
    let mut seen: Vec<&Root> = roots.iter().filter(|root| root.is_visible).collect();
    seen.dedup_by_key(|root| root.t);
    for root in seen {
        let nearest = shape.nearest(ray, from, f64::INFINITY);
        assert_eq!(nearest.as_ref(), Some(root), "{ray:?}: {roots:?}");
        assert_eq!(shape.nearest(ray, from, root.t), None);
        from = root.t;
    }
    assert_eq!(shape.nearest(ray, from, f64::INFINITY), None);
}

/// The normal at a hit points out, and a neighbouring ray hits the same face at a point in the tangent plane.
fn surface(shape: &dyn Geometry, ray: &Ray, root: &Root, size: f64) {
    let point = ray.at(root.t);
    let normal = shape.normal(point, root.face).normalize();
    assert!(normal.is_finite());
    let slope = normal.dot(ray.dir.normalize());
    match root.crossing {
        Crossing::Enter => assert!(slope < 1e-6, "{ray:?} {root:?} {slope}"),
        Crossing::Leave => assert!(slope > -1e-6, "{ray:?} {root:?} {slope}"),
        Crossing::Touch => {}
    }
    // Grazing hits and edges prove nothing at this distance.
    if slope.abs() < 0.1 {
        return;
    }
    let step = 1e-6 * size;
    for aside in [DVec3::X, DVec3::Y, DVec3::Z] {
        let neighbour = Ray::new(ray.origin + step * aside, ray.dir);
        let (_, roots) = roots_of(shape, &neighbour);
        let reach = 100.0 * step / ray.dir.length();
        let same = roots
            .iter()
            .find(|other| other.face == root.face && (other.t - root.t).abs() < reach);
        if let Some(other) = same {
            let along = neighbour.at(other.t) - point;
            assert!(
                along.dot(normal).abs() < 1e-3 * step.max(along.length()),
                "{ray:?} {root:?}: {normal} is not across {along}"
            );
        }
    }
}

/// The inside test at points of a ray agrees with the roots around them, at least where it is moved away from the surface by
/// more than POV-Ray's tolerance of 1e-10, which is one of squares at cones.
fn parity(shape: &dyn Geometry, ray: &Ray, start: Start, roots: &[Root], size: f64) {
    let far = roots
        .iter()
        .fold(0.0_f64, |far, root| far.max(root.t.abs()));
    let gap = 1e-9 * size / ray.dir.length() + 1e-11 * far;
    let mut ends = vec![(-10.0 * size / ray.dir.length(), DVec3::ZERO)];
    let crossings = roots.iter().filter(|root| root.crossing != Crossing::Touch);
    ends.extend(crossings.map(|root| {
        let normal = shape.normal(ray.at(root.t), root.face);
        (root.t, normal.normalize_or_zero())
    }));
    let last = ends[ends.len() - 1].0.max(0.0) + 10.0 * size / ray.dir.length();
    ends.push((last, DVec3::ZERO));
    let mut is_inside = start == Start::Inside;
    for pair in ends.windows(2) {
        let [(from, first), (to, second)] = [pair[0], pair[1]];
        if to - from > 2.0 * gap {
            let away = 1e-8 * size * (first + second) * if is_inside { -1.0 } else { 1.0 };
            for share in [0.0, 0.3, 1.0] {
                let point = ray.at(from + gap + share * (to - from - 2.0 * gap));
                let agrees = |point| shape.contains(point) == is_inside;
                assert!(
                    agrees(point) || agrees(point + away),
                    "{ray:?} at {point}: {roots:?}"
                );
            }
        }
        is_inside = !is_inside;
    }
}

fn within(bounds: &Bounds, ray: &Ray, root: &Root) {
    let point = ray.at(root.t);
    let slack = 1e-14 * (ray.origin.length() + point.length());
    let grown = Bounds::new(bounds.min - slack, bounds.max + slack);
    let is_in = point.cmpge(grown.min).all() && point.cmple(grown.max).all();
    assert!(is_in, "{point} is not in {bounds:?}");
}

/// Properties of every bounded solid.
pub(crate) fn solid(shape: &dyn Geometry) {
    creased(shape);
    let bounds = shape.bounds();
    let size = (bounds.max - bounds.min).length();
    let mut rng = Random::new(1);
    for _ in 0..4000 {
        let ray = rng.ray_near(&bounds);
        for root in roots_of(shape, &ray).1 {
            surface(shape, &ray, &root, size);
        }
    }
}

/// Properties of a bounded solid with creases within a face, across which normals are not continuous.
pub(crate) fn creased(shape: &dyn Geometry) {
    let bounds = shape.bounds();
    let size = (bounds.max - bounds.min).length();
    let mut rng = Random::new(1);
    let mut hits = 0;
    for _ in 0..4000 {
        let ray = rng.ray_near(&bounds);
        let roots = alternates(shape, &ray);
        assert_eq!(roots.len() % 2, 0);
        hits += roots.len();
        for root in &roots {
            within(&bounds, &ray, root);
        }
        parity(shape, &ray, Start::Outside, &roots, size);
    }
    assert!(hits > 500, "only {hits} hits");
}

/// Properties of every half-space.
pub(crate) fn half_space(shape: &dyn Geometry) {
    let bounds = Bounds::new(DVec3::splat(-4.0), DVec3::splat(4.0));
    let mut rng = Random::new(2);
    for _ in 0..4000 {
        let ray = rng.ray_near(&bounds);
        let roots = alternates(shape, &ray);
        for root in &roots {
            surface(shape, &ray, root, 4.0);
            if root.is_visible {
                within(&shape.bounds(), &ray, root);
            }
        }
        let (start, _) = roots_of(shape, &ray);
        parity(shape, &ray, start, &roots, 4.0);
    }
}

/// Properties of every patch.
pub(crate) fn patch(shape: &dyn Geometry) {
    let bounds = shape.bounds();
    let size = (bounds.max - bounds.min).length();
    let mut rng = Random::new(3);
    let mut hits = 0;
    for _ in 0..4000 {
        let ray = rng.ray_near(&bounds);
        let (start, roots) = roots_of(shape, &ray);
        assert_eq!(start, Start::Outside);
        nearest_agrees(shape, &ray, &roots);
        hits += roots.len();
        for root in &roots {
            assert_eq!(root.crossing, Crossing::Touch);
            surface(shape, &ray, root, size);
            within(&bounds, &ray, root);
            assert!(!shape.contains(ray.at(root.t)));
        }
    }
    assert!(hits > 200, "only {hits} hits");
}

/// Scaling by 2^k gives the same roots to the bit.
pub(crate) fn scales_exactly<S: Geometry>(shape: &S, scaled: impl Fn(f64) -> S) {
    let region = shape.bounds();
    let region = if region.is_finite() {
        region
    } else {
        Bounds::new(DVec3::splat(-4.0), DVec3::splat(4.0))
    };
    let mut rng = Random::new(4);
    for k in -40..=40 {
        let unit = 2.0_f64.powi(k);
        let other = scaled(unit);
        for _ in 0..40 {
            let ray = rng.ray_near(&region);
            let (_, roots) = roots_of(shape, &ray);
            let (_, others) = roots_of(&other, &Ray::new(ray.origin * unit, ray.dir));
            let expected: Vec<Root> = roots
                .iter()
                .map(|root| Root {
                    t: root.t * unit,
                    ..*root
                })
                .collect();
            assert_eq!(others, expected, "k = {k}");
        }
    }
}

/// A shape that was turned and moved absorbs a scale by 2^k with the same roots to the bit.
pub(crate) fn absorbs_scales_exactly<S: Geometry + Clone>(shape: &S) {
    let absorbed = |shape: &S, step: Step| {
        let mut moved = shape.clone();
        assert!(moved.absorb(&step));
        moved
    };
    let mut rng = Random::new(8);
    for _ in 0..10 {
        let turned = absorbed(shape, Step::Rotate(rng.vector(180.0)));
        let moved = absorbed(&turned, Step::Translate(rng.vector(3.0)));
        scales_exactly(&moved, |k| absorbed(&moved, Step::Scale(DVec3::splat(k))));
    }
}

/// A point is inside the moved shape where it was inside the original.
pub(crate) fn same_inside(original: &dyn Geometry, moved: &dyn Geometry, transform: &Transform) {
    let mut rng = Random::new(6);
    let mut inside = 0;
    for _ in 0..4000 {
        let point = rng.vector(6.0);
        let is_inside = original.contains(point);
        inside += usize::from(is_inside);
        let moved_point = transform.world_from_object.transform_point3(point);
        assert_eq!(moved.contains(moved_point), is_inside, "{point}");
    }
    assert!(inside > 10, "only {inside} points inside");
}
