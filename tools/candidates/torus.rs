//! Alternative methods for the roots of a ray on a torus, for comparison with povr's: by the textbook (Ferrari 1545
//! through the resolvent cubic), with the ray's origin first moved to the point nearest to the torus, with Newton
//! steps, by the derivative chain (Yuksel 2022, HPG), by Sturm's chain in doubles, and by sphere tracing (Hart 1996).

use crate::rays::families::Question;
use glam::DVec3;

/// Fills in the roots of a ray, in any order.
pub(crate) type Solve = fn(&Question, &mut Vec<f64>);

pub(crate) const ALL: &[(&str, Solve)] = &[
    ("Ferrari at the origin", |q, out| {
        ferrari(&quartic(q, 0.0), 0.0, out)
    }),
    ("Ferrari, moved near", |q, out| {
        let near = nearest(q);
        ferrari(&quartic(q, near), near, out);
    }),
    ("Ferrari, moved near, polished", |q, out| {
        let near = nearest(q);
        ferrari(&quartic(q, near), near, out);
        polish(q, out);
    }),
    ("Sturm's chain, moved near", |q, out| sturm(q, out)),
    ("derivative chain, moved near", |q, out| chain(q, out)),
    ("derivative chain, polished", |q, out| {
        chain(q, out);
        polish(q, out);
    }),
    ("steps of the distance", march),
];

fn nearest(q: &Question) -> f64 {
    -q.ray.origin.dot(q.ray.dir) / q.ray.dir.length_squared()
}

/// The monic quartic about a point of the ray, by rising power.
fn quartic(q: &Question, at: f64) -> [f64; 5] {
    let (o, d) = (q.ray.at(at), q.ray.dir);
    let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared());
    let (major_sq, minor_sq) = (q.major * q.major, q.minor * q.minor);
    let k = c - major_sq - minor_sq;
    let quadruple = 4.0 * major_sq;
    let lead = a * a;
    [
        (k * k - quadruple * (minor_sq - o.y * o.y)) / lead,
        (4.0 * k * b + 2.0 * quadruple * o.y * d.y) / lead,
        (2.0 * k * a + 4.0 * b * b + quadruple * d.y * d.y) / lead,
        4.0 * b / a,
        1.0,
    ]
}

fn quadratic(b: f64, c: f64, out: &mut Vec<f64>, add: f64) {
    let half = 0.5 * b;
    let discriminant = half * half - c;
    if discriminant >= 0.0 {
        let root = discriminant.sqrt();
        out.push(add - half + root);
        out.push(add - half - root);
    }
}

fn ferrari(c: &[f64; 5], at: f64, out: &mut Vec<f64>) {
    let (b3, b2, b1, b0) = (c[3], c[2], c[1], c[0]);
    let shift = -0.25 * b3;
    let p = b2 - 0.375 * b3 * b3;
    let q = b1 - 0.5 * b2 * b3 + 0.125 * b3 * b3 * b3;
    let r = b0 - 0.25 * b3 * b1 + 0.0625 * b3 * b3 * b2 - 0.01171875 * b3 * b3 * b3 * b3;
    let add = at + shift;
    // The resolvent cubic y³ + 2p·y² + (p² − 4r)·y − q² has a root that is not negative.
    let y = largest_root(2.0 * p, p * p - 4.0 * r, -q * q);
    if y <= 0.0 {
        let mut squares = Vec::with_capacity(2);
        quadratic(p, r, &mut squares, 0.0);
        for square in squares.into_iter().filter(|square| *square >= 0.0) {
            out.push(add + square.sqrt());
            out.push(add - square.sqrt());
        }
        return;
    }
    let s = y.sqrt();
    quadratic(s, 0.5 * (p + y - q / s), out, add);
    quadratic(-s, 0.5 * (p + y + q / s), out, add);
}

/// The largest real root of a monic cubic.
fn largest_root(a: f64, b: f64, c: f64) -> f64 {
    let third = a / 3.0;
    let q = third * third - b / 3.0;
    let r = third * third * third - 0.5 * (third * b - c);
    let x = if r * r <= q * q * q {
        let angle = (r / (q * q * q).sqrt()).clamp(-1.0, 1.0).acos();
        let root = -2.0 * q.max(0.0).sqrt();
        (0..3)
            .map(|k| root * ((angle + std::f64::consts::TAU * f64::from(k)) / 3.0).cos() - third)
            .fold(f64::NEG_INFINITY, f64::max)
    } else {
        let big = -r.signum() * (r.abs() + (r * r - q * q * q).sqrt()).cbrt();
        let small = if big == 0.0 { 0.0 } else { q / big };
        big + small - third
    };
    // One Newton step.
    let value = ((x + a) * x + b) * x + c;
    let slope = (3.0 * x + 2.0 * a) * x + b;
    if slope == 0.0 { x } else { x - value / slope }
}

/// Two Newton steps on the distance from the tube (and the lemon).
fn polish(q: &Question, roots: &mut [f64]) {
    for t in roots {
        for _ in 0..2 {
            let p = q.ray.at(*t);
            let across = p.x.hypot(p.z);
            let (g, k) = (
                (across - q.major).powi(2) + p.y * p.y - q.minor * q.minor,
                (across + q.major).powi(2) + p.y * p.y - q.minor * q.minor,
            );
            let inward = if g.abs() < k.abs() { -q.major } else { q.major };
            let value = if g.abs() < k.abs() { g } else { k };
            let radial = (p.x * q.ray.dir.x + p.z * q.ray.dir.z) / across;
            let slope = 2.0 * ((across + inward) * radial + p.y * q.ray.dir.y);
            let step = value / slope;
            if step.is_finite() {
                *t -= step;
            }
        }
    }
}

fn at<const N: usize>(c: &[f64; N], t: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

/// The interval within the bounding sphere of the torus.
fn around(q: &Question) -> Option<(f64, f64)> {
    let near = nearest(q);
    let reach = 1.001 * (q.major + q.minor);
    let off = q.ray.at(near).length_squared();
    let half_sq = (reach * reach - off) / q.ray.dir.length_squared();
    (half_sq > 0.0).then(|| (near, half_sq.sqrt()))
}

/// The quartic about the middle of its interval, in units of half of it.
fn centred(q: &Question) -> Option<(f64, f64, [f64; 5])> {
    let (near, half) = around(q)?;
    let mut c = quartic(q, near);
    let mut power = 1.0;
    for c in &mut c {
        *c *= power;
        power *= half;
    }
    Some((near, half, c))
}

fn chain(q: &Question, out: &mut Vec<f64>) {
    let Some((near, half, c)) = centred(q) else {
        return;
    };
    let slope = [c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4]];
    let bend = [slope[1], 2.0 * slope[2], 3.0 * slope[3]];
    let mut ends = Vec::with_capacity(2);
    if bend[2] != 0.0 {
        quadratic(bend[1] / bend[2], bend[0] / bend[2], &mut ends, 0.0);
    }
    let extremes = between(&slope, &mut ends);
    let mut ends = extremes;
    for t in between(&c, &mut ends) {
        out.push(near + half * t);
    }
}

/// The sign changes of a polynomial from -1 to 1, given where its slope changes its sign.
fn between<const N: usize>(c: &[f64; N], inner: &mut Vec<f64>) -> Vec<f64> {
    inner.retain(|t| -1.0 < *t && *t < 1.0);
    inner.sort_by(f64::total_cmp);
    inner.insert(0, -1.0);
    inner.push(1.0);
    let mut changes = Vec::with_capacity(4);
    for pair in inner.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        let (from, to) = (at(c, low), at(c, high));
        if (from < 0.0) == (to < 0.0) {
            continue;
        }
        let mut t = 0.5 * (low + high);
        for _ in 0..60 {
            let value = at(c, t);
            if (value < 0.0) == (from < 0.0) {
                low = t;
            } else {
                high = t;
            }
            let mut slope = 0.0;
            for (power, c) in c.iter().enumerate().skip(1).rev() {
                slope = slope * t + c * f64::from(u32::try_from(power).unwrap_or(0));
            }
            let newton = t - value / slope;
            let next = if low < newton && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - t).abs() <= 1e-16 {
                break;
            }
            t = next;
        }
        changes.push(t);
    }
    changes
}

fn sturm(q: &Question, out: &mut Vec<f64>) {
    let Some((near, half, c)) = centred(q) else {
        return;
    };
    let mut chain = vec![c.to_vec(), vec![c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4]]];
    loop {
        let (a, b) = (&chain[chain.len() - 2], &chain[chain.len() - 1]);
        let mut rest = a.clone();
        while rest.len() >= b.len() {
            let factor = rest[rest.len() - 1] / b[b.len() - 1];
            let offset = rest.len() - b.len();
            for (i, c) in b.iter().enumerate() {
                rest[offset + i] -= factor * c;
            }
            rest.pop();
        }
        let size = rest.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
        while rest.last().is_some_and(|c| c.abs() <= 1e-15 * size) {
            rest.pop();
        }
        if rest.is_empty() {
            break;
        }
        chain.push(rest.iter().map(|c| -c).collect());
        if rest.len() == 1 {
            break;
        }
    }
    let changes = |t: f64| {
        let values = chain
            .iter()
            .map(|c| c.iter().rev().fold(0.0, |sum, c| sum * t + c));
        let (mut count, mut last) = (0, 0.0);
        for value in values.filter(|value| *value != 0.0) {
            if value * last < 0.0 {
                count += 1;
            }
            last = value;
        }
        count
    };
    let mut open = vec![(-1.0, 1.0, 0)];
    while let Some((low, high, depth)) = open.pop() {
        let count = changes(low) - changes(high);
        if count <= 0 {
            continue;
        }
        let middle = 0.5 * (low + high);
        if depth > 52 {
            out.push(near + half * middle);
        } else {
            open.push((low, middle, depth + 1));
            open.push((middle, high, depth + 1));
        }
    }
}

/// Sphere tracing by the distance from the tube; a grazing ray takes a thousand steps.
fn march(q: &Question, out: &mut Vec<f64>) {
    let Some((near, half)) = around(q) else {
        return;
    };
    let speed = q.ray.dir.length();
    let distance = |t: f64| {
        let p: DVec3 = q.ray.at(t);
        (p.x.hypot(p.z) - q.major).hypot(p.y) - q.minor
    };
    let (mut t, end) = (near - half, near + half);
    let least = 1e-12 * (q.major + q.minor);
    for _ in 0..2000 {
        if t > end || out.len() == 4 {
            return;
        }
        let off = distance(t);
        if off.abs() <= least {
            out.push(t);
            // Goes beyond the surface, in steps large enough to change `t`.
            let step = |t: f64| (4.0 * least / speed).max(4.0 * f64::EPSILON * t.abs());
            t += step(t);
            while t < end && distance(t).abs() <= least {
                t += step(t);
            }
        } else {
            t += off.abs() / speed;
        }
    }
}
