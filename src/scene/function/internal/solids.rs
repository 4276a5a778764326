//! Solids as approximate signed distances: zero on the surface, negative inside, growing about as fast as the distance.

use super::Internal;
use std::f64::consts::PI;

/// The functions of this group.
pub(super) static LIST: &[Internal] = &[
    Internal::new(9, "f_comma", 1, comma),
    Internal::new(17, "f_ellipsoid", 3, |p| {
        hypot3(p[0] * p[3], p[1] * p[4], p[2] * p[5])
    }),
    Internal::new(24, "f_helical_torus", 10, helical_torus),
    Internal::new(25, "f_helix1", 7, helix1),
    Internal::new(26, "f_helix2", 7, helix2),
    Internal::new(27, "f_hex_x", 1, hex_x),
    Internal::new(28, "f_hex_y", 1, hex_y),
    Internal::new(40, "f_mesh1", 5, mesh1),
    Internal::new(47, "f_ph", 0, |p| (p[1] / hypot3(p[0], p[1], p[2])).acos()),
    Internal::new(51, "f_poly4", 5, poly4),
    Internal::new(52, "f_polytubes", 6, polytubes),
    Internal::new(57, "f_r", 0, |p| hypot3(p[0], p[1], p[2])),
    Internal::new(60, "f_rounded_box", 4, rounded_box),
    Internal::new(61, "f_sphere", 1, |p| hypot3(p[0], p[1], p[2]) - p[3]),
    Internal::new(64, "f_spiral", 6, spiral),
    Internal::new(68, "f_superellipsoid", 2, superellipsoid),
    Internal::new(69, "f_th", 0, |p| p[0].atan2(p[2])),
    Internal::new(70, "f_torus", 2, |p| {
        let out = hypot2(p[0], p[2]) - p[3];
        hypot2(out, p[1]) - p[4]
    }),
];

fn hypot2(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

fn hypot3(a: f64, b: f64, c: f64) -> f64 {
    (a * a + b * b + c * c).sqrt()
}

/// The norm of a point for a cross section of this kind: 0 is a square, 1 a circle, 2 a square on its tip; values in
/// between give superellipses.
fn section(a: f64, b: f64, kind: f64) -> f64 {
    let (a, b) = (a.abs(), b.abs());
    if kind == 0.0 {
        return a.max(b);
    }
    if kind == 1.0 {
        return hypot2(a, b);
    }
    let power = 2.0 / kind;
    (a.powf(power) + b.powf(power)).powf(1.0 / power)
}

/// A sphere with a tail that tapers to a point along half a circle.
fn comma(p: &[f64]) -> f64 {
    /// POV-Ray moves points on the y axis, which have no angle, to this x.
    const AXIS_OFFSET: f64 = 1e-4;
    let [x, y, z, size] = *p else { return 0.0 };
    let x = if x == 0.0 && z == 0.0 { AXIS_OFFSET } else { x };
    let head = hypot3(x - size / 2.0, y, z) - size / 2.0;
    let out = hypot2(x + size / 4.0, z) - 0.75 * size;
    let tail = hypot2(out, y) - size / 2.0 * (z.atan2(x) / 2.0).cos();
    head.min(tail.max(-z))
}

/// A grooved thread wound around a torus.
fn helical_torus(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0], p[1], p[2]);
    let [
        major,
        loops,
        twist,
        fatness,
        threshold,
        minor,
        spread,
        period,
        depth,
        phase,
    ] = p[3..13]
    else {
        return 0.0;
    };
    let radius = hypot2(x, z);
    let out = radius - major;
    let around = x.atan2(z);
    let wound = (loops * around + twist * out.atan2(y)).rem_euclid(2.0 * PI) - PI;
    let from_axis = hypot2(out, y);
    let high = from_axis - minor;
    let column = radius + major - minor;
    let thread = (high * high + spread * wound * wound).sqrt();
    let groove = period * (depth * wound).atan2(high) + phase * around;
    // If the thread is NaN, the column alone counts.
    let body = thread.min(from_axis + minor) - fatness * groove.cos();
    if thread.is_nan() {
        return column - threshold;
    }
    body.min(column) - threshold
}

/// Helices about the y axis; their cross section lies in a plane through the axis.
fn helix1(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0], p[1], p[2]);
    let [count, period, minor, major, shape, kind, turn] = p[3..10] else {
        return 0.0;
    };
    let radius = hypot2(x, z);
    let angle = (count * (z.atan2(x) + period * y)).rem_euclid(2.0 * PI);
    let (mut out, mut up) = (radius - major, (angle - PI) / (period * count) / shape);
    if turn != 0.0 {
        let (sin, cos) = turn.to_radians().sin_cos();
        (out, up) = (out * cos - up * sin, out * sin + up * cos);
    }
    (section(out, up, kind) - minor).min(radius + major - minor)
}

/// A helix about the y axis; its cross section lies in a plane perpendicular to the axis and turns with the helix.
fn helix2(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0], p[1], p[2]);
    let (sin, cos) = (p[4] * y).sin_cos();
    let (out, side) = (x * cos + z * sin - p[6], z * cos - x * sin);
    section(out, side, p[8]) - p[5]
}

/// The height of an equilateral triangle of side 1.
const HALF_ROOT_3: f64 = 0.866_025_403_784_438_6;

/// The hexagonal distance from the centre of the nearest cell of a honeycomb.
fn hex_x(p: &[f64]) -> f64 {
    let (x, y) = (p[0], p[1]);
    let width = 2.0 * HALF_ROOT_3;
    let mut nearest = f64::INFINITY;
    let row = (y / 1.5).floor();
    for row in [row, row + 1.0] {
        let down = y - 1.5 * row;
        let shift = row / 2.0;
        let column = (x / width - shift).round();
        for column in [column - 1.0, column, column + 1.0] {
            let across = x - width * (column + shift);
            let (half, tilted) = (across / 2.0, down * HALF_ROOT_3);
            let size = across
                .abs()
                .max((half + tilted).abs())
                .max((half - tilted).abs());
            nearest = nearest.min(size);
        }
    }
    nearest
}

/// The distance to the nearest line of three families of parallel lines.
fn hex_y(p: &[f64]) -> f64 {
    let (half, tilted) = (p[1] / 2.0, p[0] * HALF_ROOT_3);
    let distance = |at: f64| (at - 1.5 * (at / 1.5).round()).abs();
    let nearest = distance(half + tilted).min(distance(half - tilted));
    nearest.min(distance(p[1]))
}

/// Threads along x and z that weave over and under each other.
fn mesh1(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0], p[1], p[2]);
    let [apart_x, apart_z, thick, weave, thick_y] = p[3..8] else {
        return 0.0;
    };
    let thread = |across: f64, apart: f64, height: f64| {
        let first = (across / apart).floor();
        let distance = |count: f64| {
            let up = if count.rem_euclid(2.0) == 0.0 {
                height
            } else {
                -height
            };
            hypot2(thick_y * (y - up), thick * (across - count * apart))
        };
        distance(first).min(distance(first + 1.0))
    };
    let along_z = thread(x, apart_x, -weave * (PI * z / apart_z).cos());
    along_z.min(thread(z, apart_z, weave * (PI * x / apart_x).cos()))
}

fn polynomial(coefficients: &[f64], y: f64) -> f64 {
    let mut sum = 0.0;
    let mut power = 1.0;
    for coefficient in coefficients {
        sum += coefficient * power;
        power *= y;
    }
    sum
}

/// A solid of revolution about the y axis; its radius is a polynomial in y.
fn poly4(p: &[f64]) -> f64 {
    /// POV-Ray's lower bound of the radius.
    const LEAST: f64 = -5.0;
    hypot2(p[0], p[2]) - polynomial(&p[3..8], p[1]).max(LEAST)
}

/// Tubes around the y axis, at a distance from it that is a polynomial in y.
fn polytubes(p: &[f64]) -> f64 {
    /// POV-Ray's value without tubes.
    const FAR: f64 = 10_000.0;
    /// Limit on tubes, more than any picture can show.
    const MAX_TUBES: f64 = 10_000.0;
    let radius = polynomial(&p[4..9], p[1]);
    let mut nearest = FAR;
    let mut tube = 0.0;
    while tube < p[3].trunc().min(MAX_TUBES) {
        let (sin, cos) = (2.0 * PI * tube / p[3]).sin_cos();
        nearest = nearest.min(hypot2(p[0] - radius * sin, p[2] - radius * cos));
        tube += 1.0;
    }
    nearest
}

fn rounded_box(p: &[f64]) -> f64 {
    /// POV-Ray subtracts this, so that the solid has an inside even without a radius.
    const OFFSET: f64 = 1e-6;
    let beyond = |axis: usize| (p[axis].abs() - (p[4 + axis] - p[3])).max(0.0);
    hypot3(beyond(0), beyond(1), beyond(2)) - p[3] - OFFSET
}

/// A spiral thread from the origin outwards in the xz plane, clipped by a sphere.
fn spiral(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0], p[1], p[2]);
    let [apart, thick, limit, _, _, kind] = p[3..9] else {
        return 0.0;
    };
    let turns = hypot2(x, z) / apart - (PI - z.atan2(x)) / (2.0 * PI);
    let beside = (turns - turns.round().max(0.0)) * apart;
    let size = hypot3(x, y, z);
    (section(y, beside, kind).min(size) - thick).max(size - limit)
}

fn superellipsoid(p: &[f64]) -> f64 {
    let (x, y, z) = (p[0].abs(), p[1].abs(), p[2].abs());
    let (east, north) = (p[3], p[4]);
    let flat = (x.powf(2.0 / east) + y.powf(2.0 / east)).powf(east / north);
    1.0 - (flat + z.powf(2.0 / north)).powf(north / 2.0)
}
