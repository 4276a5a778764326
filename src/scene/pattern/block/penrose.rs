//! The `tiling` patterns that are not periodic: pentagons with stars, boats and diamonds (25), kites and darts (26),
//! and rhombs (27), all by Penrose.
//!
//! A point is folded into a tenth of the plane, then shrunk until it lies in a prototile, and inflated again step by
//! step: each step finds the tile of the next finer tiling that holds it. The value is that of [`super::tiling`], but
//! for the scale of its fall.

use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::{DVec2, DVec3};

/// Cosine and sine of an angle.
type Angle = DVec2;

const SIN_18: f64 = 0.309_016_994_374_947_45;
const SIN_36: f64 = 0.587_785_252_292_473_1;
const SIN_54: f64 = 0.809_016_994_374_947_5;
const SIN_72: f64 = 0.951_056_516_295_153_5;
const TAN_18: f64 = 0.324_919_696_232_906_3;
const TAN_36: f64 = 0.726_542_528_005_360_9;
const TAN_54: f64 = 1.376_381_920_471_173_5;
const TAN_72: f64 = 3.077_683_537_175_253_4;
const DEGREES_36: Angle = Angle::new(SIN_54, SIN_36);
const DEGREES_72: Angle = Angle::new(SIN_18, SIN_72);
const DEGREES_108: Angle = Angle::new(-SIN_18, SIN_72);
const DEGREES_144: Angle = Angle::new(-SIN_54, SIN_36);

/// The golden ratio, and the factors of one and two deflations.
const PHI: f64 = 1.618_033_988_749_895;
const PHI_SQ: f64 = 2.618_033_988_749_895;
const DEFLATION: f64 = 0.618_033_988_749_894_8;
const DEFLATION_SQ: f64 = 0.381_966_011_250_105_15;

/// Gap between the ranges of values of different tiles.
const GAP: f64 = 1e-6;
/// Distance from the origin within which the value is 1.
const CENTRE: f64 = 1e-10;

/// Inradius and circumradius of a pentagon of side 1.
const INRADIUS: f64 = 0.5 / TAN_36;
const CIRCUMRADIUS: f64 = 0.5 / SIN_36;

/// Scale of the fall of the value from a side, for rhombs and for kites.
const RHOMB_FALL: f64 = 5.55;
const KITE_FALL: f64 = 4.46;

/// A tiling of the plane by Penrose's tiles.
#[derive(Clone, Copy, Debug)]
pub(super) enum Penrose {
    /// Pentagons, stars, boats and diamonds.
    Pentagons,
    KitesAndDarts,
    Rhombs,
}

/// A prototile of kites and darts: half of one, or the rhombs that stand for it.
#[derive(Clone, Copy)]
enum Half {
    Kite,
    Dart,
}

/// A tile of the tiling with pentagons; the flag tells two orientations apart.
#[derive(Clone, Copy)]
enum Tile {
    Pentagon,
    /// A pentagon beside diamonds.
    Between(bool),
    /// A pentagon beside boats.
    Among(bool),
    Star,
    Boat(bool),
    Diamond(bool),
}

/// Turns a point clockwise.
#[inline]
fn turned(p: DVec2, by: Angle) -> DVec2 {
    DVec2::new(p.x * by.x + p.y * by.y, p.y * by.x - p.x * by.y)
}

/// Turns a point anticlockwise.
#[inline]
fn turned_back(p: DVec2, by: Angle) -> DVec2 {
    DVec2::new(p.x * by.x - p.y * by.y, p.y * by.x + p.x * by.y)
}

/// Reflects a point into the upper half-plane.
#[inline]
fn raised(p: DVec2) -> DVec2 {
    DVec2::new(p.x, p.y.abs())
}

/// Folds the plane into the tenth above the x axis.
#[inline]
fn folded(p: DVec2) -> DVec2 {
    let r = (p.x * p.x + p.y * p.y).sqrt();
    if p.x >= r * DEGREES_36.x {
        return raised(p);
    }
    let angle = match p.x < r * DEGREES_108.x {
        true => DEGREES_144,
        false => DEGREES_72,
    };
    raised(turned(raised(p), angle))
}

/// The number of times by which a distance exceeds 1, in powers of `base`.
#[allow(
    clippy::cast_possible_truncation,
    reason = "at most the number of powers in the range of doubles"
)]
fn deflations(distance: f64, base: f64) -> i32 {
    (distance.ln() / base.ln()).ceil().max(0.0) as i32
}

impl Penrose {
    fn at(self, p: DVec2) -> f64 {
        let r = (p.x * p.x + p.y * p.y).sqrt();
        if r <= CENTRE || !r.is_finite() {
            return 1.0;
        }
        let p = folded(p);
        match self {
            Penrose::Pentagons => pentagons(p),
            Penrose::KitesAndDarts => halves(p, kite_or_dart),
            Penrose::Rhombs => halves(p * DEFLATION, rhomb),
        }
    }
}

/// The value of a tiling by kites and darts, or by what they are replaced with, at a folded point.
fn halves(p: DVec2, value: fn(Half, DVec2) -> f64) -> f64 {
    let distance = (DEGREES_108.y * p.x - DEGREES_108.x * p.y).abs() / SIN_72;
    let count = deflations(distance, PHI_SQ);
    let mut p = p * DEFLATION_SQ.powf(f64::from(count));
    if count % 2 == 1 {
        p = raised(turned(p, DEGREES_36));
    }
    let mut half = Half::Kite;
    for _ in 0..2 * count {
        p = raised(p);
        (half, p) = match half {
            Half::Kite if p.y < (p.x - DEFLATION) * -TAN_36 => (Half::Dart, p),
            Half::Kite => (Half::Kite, turned_back(p - DEGREES_36, DEGREES_108)),
            Half::Dart if p.y < (p.x - DEFLATION) * -TAN_72 => (Half::Kite, turned(p, DEGREES_36)),
            Half::Dart => (Half::Dart, turned(p - DVec2::X, DEGREES_144)),
        };
        p *= PHI;
    }
    value(half, raised(p))
}

/// Distance of a point from the line through `start` on the x axis.
#[inline]
fn distance_from(p: DVec2, angle: Angle, start: f64) -> f64 {
    (angle.y * (p.x - start) - angle.x * p.y).abs()
}

/// The value in a tile of the lower half of the range, at these scaled distances from two sides.
fn lower(a: f64, b: f64) -> f64 {
    (0.5 - a / 2.0).max(0.5 - b / 2.0).clamp(0.0, 0.5 - GAP)
}

/// The value in a tile of the upper half of the range.
fn upper(a: f64, b: f64) -> f64 {
    (1.0 - a / 2.0).max(1.0 - b / 2.0).max(0.5 + GAP)
}

fn kite_or_dart(half: Half, p: DVec2) -> f64 {
    let from = |angle, start| distance_from(p, angle, start) * KITE_FALL;
    match half {
        Half::Kite => lower(from(DEGREES_36, 0.0), from(DEGREES_108, 1.0)),
        Half::Dart => upper(p.y.abs() * KITE_FALL, from(DEGREES_144, 1.0)),
    }
}

fn rhomb(half: Half, p: DVec2) -> f64 {
    let from = |angle, start| distance_from(p, angle, start) * RHOMB_FALL;
    match half {
        Half::Kite if p.y < (p.x - DEFLATION) * TAN_72 => {
            upper(from(DEGREES_72, DEFLATION), from(DEGREES_108, 1.0))
        }
        Half::Kite => lower(p.y.abs() * RHOMB_FALL, from(DEGREES_72, DEFLATION)),
        Half::Dart => lower(from(DEGREES_36, 0.0), from(DEGREES_144, 1.0)),
    }
}

/// The value of the tiling with pentagons at a folded point.
fn pentagons(p: DVec2) -> f64 {
    let count = deflations(p.x * 2.0 * TAN_36, PHI_SQ * PHI_SQ);
    let mut p = p * (DEFLATION_SQ * DEFLATION_SQ).powf(f64::from(count));
    let mut tile = Tile::Pentagon;
    for _ in 0..4 * count {
        (tile, p) = tile.inflated(tile.entered(p));
        p *= PHI;
    }
    tile.value(tile.entered(p))
}

impl Tile {
    /// The point by the symmetry of the tile.
    fn entered(self, p: DVec2) -> DVec2 {
        match self {
            Tile::Pentagon => folded(p),
            _ => raised(p),
        }
    }

    /// The tile of the next finer tiling that holds a point, and the point in its coordinates, before inflation.
    fn inflated(self, p: DVec2) -> (Tile, DVec2) {
        let shift = |x: f64| DVec2::new(p.x + x, p.y);
        let mirrored = DVec2::new(-p.x, p.y);
        // The mirror image of a turned point, a vertex of a pentagon further on.
        let image = |turned: DVec2| {
            DVec2::new(
                -turned.x - SIN_18 * 0.5 / SIN_36,
                turned.y - SIN_72 * 0.5 / SIN_36,
            )
        };
        match self {
            Tile::Pentagon if p.y < (p.x - INRADIUS) * TAN_54 + 0.5 => (
                Tile::Between(false),
                DVec2::new(p.x - INRADIUS - DEFLATION * 0.5 * SIN_18 / SIN_36, p.y),
            ),
            Tile::Pentagon => (Tile::Star, turned(p, DEGREES_36)),
            Tile::Between(true) if p.y < (p.x - DEFLATION_SQ * 0.5 / SIN_36) * TAN_54 => {
                (Tile::Pentagon, shift(-CIRCUMRADIUS))
            }
            Tile::Between(true) if p.y < (p.x - DEFLATION_SQ * 0.5 / SIN_36) * -TAN_18 => {
                (Tile::Diamond(true), mirrored)
            }
            Tile::Between(true) => {
                let back = turned_back(p, DEGREES_108);
                let next = DVec2::new(back.x + DEFLATION * 0.5 / SIN_36, back.y);
                (Tile::Between(true), next)
            }
            Tile::Between(false) if p.y < (p.x + CIRCUMRADIUS) * TAN_18 => {
                let next = DVec2::new(p.x + CIRCUMRADIUS - DEFLATION_SQ * 0.5 / SIN_36, p.y);
                (Tile::Diamond(false), next)
            }
            Tile::Between(false) => (Tile::Among(false), image(turned(p, DEGREES_36))),
            Tile::Among(true) if p.x > DEFLATION_SQ * 0.5 * SIN_18 / SIN_36 => {
                let x = -(p.x - DEFLATION_SQ * 0.5 * SIN_18 / SIN_36 - DEFLATION * 0.5 / TAN_36);
                (Tile::Between(true), DVec2::new(x, p.y))
            }
            Tile::Among(true) => (Tile::Boat(true), p),
            Tile::Among(false) if p.x < 0.5 * -SIN_18 / SIN_36 => {
                let next = turned(p, DEGREES_144);
                (
                    Tile::Between(false),
                    DVec2::new(next.x - CIRCUMRADIUS, next.y),
                )
            }
            Tile::Among(false) if p.y > (p.x - DEFLATION_SQ * 0.5 / SIN_36) * -TAN_54 => {
                (Tile::Among(false), image(turned_back(p, DEGREES_36)))
            }
            Tile::Among(false) => (Tile::Boat(false), p),
            Tile::Star if p.x < DEFLATION * 0.5 / TAN_36 => (Tile::Pentagon, p),
            Tile::Star => (
                Tile::Among(true),
                DVec2::new(-(p.x - DEFLATION / TAN_36), p.y),
            ),
            Tile::Boat(true) if p.x > PHI * 0.5 * -SIN_18 / SIN_36 => (Tile::Pentagon, mirrored),
            Tile::Boat(true) => (Tile::Among(true), shift(CIRCUMRADIUS)),
            Tile::Boat(false) => {
                let back = turned_back(p, DEGREES_72);
                (Tile::Among(true), DVec2::new(back.x + CIRCUMRADIUS, back.y))
            }
            Tile::Diamond(true) => (Tile::Pentagon, p),
            Tile::Diamond(false) => (Tile::Among(true), p),
        }
    }

    /// The place of the tile's range of values, in sixths.
    fn rank(self) -> f64 {
        match self {
            Tile::Pentagon => 0.0,
            Tile::Between(_) => 1.0,
            Tile::Among(_) => 2.0,
            Tile::Star => 3.0,
            Tile::Boat(_) => 4.0,
            Tile::Diamond(_) => 5.0,
        }
    }

    /// The value at a point in the coordinates of the tile.
    fn value(self, p: DVec2) -> f64 {
        let fall = |distance: f64| distance * RHOMB_FALL * DEFLATION;
        let of_star = |p: DVec2| {
            let along = -SIN_72 * p.y;
            fall((SIN_18 * (p.x - PHI * 0.5 / SIN_36) - along).abs())
        };
        let rank = self.rank();
        let (low, high) = (rank / 6.0, (rank + 1.0) / 6.0);
        let low = if rank == 0.0 { low } else { low + GAP };
        let at = |distance: f64| high - distance / 6.0;
        let value = match self {
            Tile::Pentagon => at(fall((p.x - INRADIUS).abs())),
            Tile::Between(_) | Tile::Among(_) => at(fall((folded(p).x - INRADIUS).abs())),
            Tile::Star => at(of_star(p)),
            Tile::Boat(_) => {
                let straight = at(fall((p.x - DEFLATION * 0.5 * SIN_18 / SIN_36).abs()));
                straight.max(at(of_star(folded(DVec2::new(-p.x, p.y)))))
            }
            Tile::Diamond(_) => {
                let side = SIN_18 * (p.x + DEFLATION * 0.5 / SIN_36) - SIN_72 * p.y;
                at(fall(side.abs()))
            }
        };
        value.max(low).min(high - GAP)
    }
}

impl Pattern for Penrose {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }
}

impl PatternEval for Penrose {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        self.at(DVec2::new(point.x, point.z))
    }
}
