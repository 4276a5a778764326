use super::*;
use crate::scene::shape::tests::check;
use glam::DVec2;
use outline::Outline;

/// A ring-shaped letter, round inside and out.
fn ring(at: DVec3) -> Letter {
    let p = DVec2::new;
    let circle = |size: f64| {
        let points = [p(-1.0, 0.0), p(0.0, 1.0), p(1.0, 0.0), p(0.0, -1.0)];
        let bends = [p(-1.0, 1.0), p(1.0, 1.0), p(1.0, -1.0), p(-1.0, -1.0)];
        let piece = move |i: usize| [points[i], bends[i], points[(i + 1) % 4]].map(|p| size * p);
        (0..4).map(piece)
    };
    let outline = Outline::new(circle(1.0).chain(circle(0.6)).collect());
    let (low, high) = outline.bounds();
    Letter {
        outline: Arc::new(outline),
        low,
        high,
        at,
    }
}

fn rings(positions: &[DVec3]) -> Text {
    Text(Arc::new(Line::new(
        positions.iter().map(|at| ring(*at)).collect(),
        0.7,
    )))
}

#[test]
fn letters_are_solids() {
    check::solid(&rings(&[DVec3::ZERO]));
    check::solid(&rings(&[DVec3::ZERO, 2.5 * DVec3::X]));
}

#[test]
fn overlapping_letters_are_one_solid() {
    check::solid(&rings(&[DVec3::ZERO, DVec3::X, DVec3::new(1.5, 0.3, 0.2)]));
}

#[test]
fn a_ray_straight_through_hits_both_faces() {
    let ring = rings(&[DVec3::ZERO]);
    let turn = ring.0.turn.transpose();
    let ray = Ray::new(turn * DVec3::new(0.8, 0.0, -2.0), turn * DVec3::Z);
    let mut roots = Vec::new();
    ring.roots(&ray, &mut roots);
    let faces: Vec<_> = roots.iter().map(|root| root.face).collect();
    assert_eq!(faces, [FRONT, BACK]);
    assert!((roots[0].t - 2.0).abs() < 1e-14 && (roots[1].t - 2.7).abs() < 1e-14);
}
