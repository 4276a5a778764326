//! `julia_fractal { <c> [quaternion | hypercomplex] [function] [max_iteration n] [precision p] [slice <n>, d] }`: a
//! slice of the set of four-dimensional numbers whose orbit stays bounded under repeated application of a function plus
//! `c`.
//!
//! The set has no closed form; a ray is marched in steps. Outside, the steps for quaternions are the distance estimate
//! of Hart, Sandin and Kauffman 1989 ("Ray tracing deterministic 3-D fractals", eq. 8), inside they are
//! `1 / precision`; where the inside state changes, the step is halved down to [`TOLERANCE`]. POV-Ray does the same,
//! and surfaces that its steps miss must be missed here: a finer search would draw hairs that POV-Ray does not. The
//! normal is the gradient of `|z|²` after the last iteration. Under many iterations hits that are seen, and those of rays
//! that leave the surface, are searched again to the last bit ([`ExactSearch`]).
//!
//! Error bound of quaternions and of the hypercomplex `sqr`, `cube` and `reciprocal`: within [`TOLERANCE`] of a reported
//! root the state changes (`tests/stability`); missed surfaces have no bound.
//!
//! Hypercomplex numbers are pairs of complex numbers, to each of which every function is applied separately. For most
//! of them POV-Ray 3.7 halves its steps with another inside test than that of its search, and takes the function for
//! its derivative ([`Function::factor`]), which makes its surfaces rough: the same is done here. In 3.8 both tests are one.
//!
//! In a CSG object that is transformed as a whole, POV-Ray 3.7 forgets that a `julia_fractal` is inverse or subtracted,
//! so that a difference shows what an intersection would; here it stays a difference.

mod complex;
mod exact;
mod exact_packet;
mod inside_test;
mod left_orbit;
mod packet;

use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::Normalization;
use crate::base::math::{Bounds, Complex, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Crossing, Geometry, Root, Rounded, Start, Steps, SurfaceSide, first_visible, read,
    uniform_scale,
};
use complex::Function;
pub(crate) use exact::ExactSearch;
use glam::{DVec3, DVec4};
use inside_test::{BATCH, Lookahead};
use left_orbit::{LeftOrbit, SearchStep};
use smallvec::SmallVec;
use std::f64::consts::SQRT_2;

/// Length at which the halving of a step ends, in object units; POV-Ray's value.
const TOLERANCE: f64 = 1e-7;
/// Nearer hits of a ray that leaves the surface are ignored, in scene units: POV-Ray's value, also for shadows once the
/// fractal has blocked the light.
const LEAST_DISTANCE: f64 = 1e-4;
/// Radius of the bounding sphere of a hypercomplex fractal.
const HYPERCOMPLEX_RADIUS: f64 = 4.0;
/// Largest radius of the bounding sphere of a quaternion fractal.
const QUATERNION_RADIUS: f64 = 2.0;
/// Longest step outside a hypercomplex fractal, in minimum steps.
const MAX_STEP_RATIO: f64 = 30.0;
/// Bits of the mantissa of a double.
const MANTISSA: u64 = (1 << (f64::MANTISSA_DIGITS - 1)) - 1;
/// Bound on the relative rounding error of the length of a unit vector.
const UNIT_LOSS: f64 = 4.0 * f64::EPSILON;
/// Limit of steps of one ray through the bounding sphere; a precision that needs more is refused.
const MAX_STEPS: f64 = 1e7;
/// The lowest precision; POV-Ray raises lower ones to this.
const MIN_PRECISION: f64 = 1.0;
/// Limit of iterations: rounding destroys all digits long before.
const MAX_ITERATIONS: f64 = 1e5;

/// A Julia fractal. In its object space, the bounding sphere is centred at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct JuliaFractal(Box<Fractal>);

#[derive(Clone, Debug, PartialEq)]
struct Fractal {
    c: DVec4,
    rule: Rule,
    max_iteration: u32,
    /// The minimum step.
    min_step: f64,
    /// The unit normal of the slice, and its distance from the origin.
    slice: DVec4,
    distance: f64,
    /// The fourth coordinate as an affine function of the others: its gradient, and its value at the origin.
    slope: DVec3,
    offset: f64,
    radius: f64,
    /// True if the inside test takes the second coordinate for the third, too.
    tests_y_as_z: bool,
    /// The unit of `LEAST_DISTANCE`.
    unit: f64,
    /// True if rays go through a transform other than a scale by a power of two.
    is_moved: bool,
    /// The rounding of unit vectors.
    normalization: Normalization,
}

/// The function of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rule {
    QuaternionSquare,
    QuaternionCube,
    Hypercomplex(Function),
}

impl JuliaFractal {
    /// Reads the number and the keywords of the fractal.
    ///
    /// # Errors
    /// Malformed or non-finite parameters; a slice along the fourth axis; a function that is not defined for
    /// quaternions; a useless precision or number of iterations. With one iteration or none everything is inside, and
    /// nothing is visible, as in POV-Ray.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let c = vector4(args)?;
        let mut is_hypercomplex = false;
        let mut function = (Word::Sqr, Function::Square);
        let mut at = args.last_span();
        let (mut max_iteration, mut precision) = (20.0, 20.0);
        let (mut normal, mut distance) = (DVec4::W, 0.0);
        loop {
            if args.accept(Word::Quaternion)? {
                is_hypercomplex = false;
            } else if args.accept(Word::Hypercomplex)? {
                is_hypercomplex = true;
            } else if let Some(named) = read_function(args)? {
                function = named;
                at = args.last_span();
            } else if args.accept(Word::MaxIteration)? {
                max_iteration = at_most(args, "`max_iteration`", MAX_ITERATIONS)?.max(0.0);
            } else if args.accept(Word::Precision)? {
                precision = at_most(args, "`precision`", MAX_STEPS / HYPERCOMPLEX_RADIUS)?
                    .max(MIN_PRECISION);
            } else if args.accept(Word::Slice)? {
                normal = read_slice(args)?;
                distance = read::number(args, "the distance of the slice")?;
            } else {
                break;
            }
        }
        let rule = match (is_hypercomplex, function) {
            (true, (_, function)) => Rule::Hypercomplex(function),
            (false, (Word::Sqr, _)) => Rule::QuaternionSquare,
            (false, (Word::Cube, _)) => Rule::QuaternionCube,
            (false, (word, _)) => {
                let message = format!("quaternions have only `sqr` and `cube`, not `{word}`");
                return Err(Box::new(
                    Diagnostic::error(at, message).with_hint("Write `hypercomplex` before it."),
                ));
            }
        };
        let radius = if is_hypercomplex {
            HYPERCOMPLEX_RADIUS
        } else {
            QUATERNION_RADIUS.min(1.0 + c.length() + TOLERANCE)
        };
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked to be a small number, and not negative"
        )]
        let max_iteration = max_iteration as u32;
        Ok(JuliaFractal(Box::new(Fractal {
            c,
            rule,
            max_iteration,
            min_step: 1.0 / precision,
            slice: normal,
            distance,
            slope: -normal.truncate() / normal.w,
            offset: distance / normal.w,
            radius,
            tests_y_as_z: matches!(rule, Rule::Hypercomplex(function) if function.tests_y_as_z())
                && !args.is_for_3_8(),
            unit: 1.0,
            is_moved: false,
            normalization: Normalization::of_version(args.is_for_3_8()),
        })))
    }
}

fn vector4(args: &mut dyn Args) -> Parse<DVec4> {
    args.comma()?;
    args.vector4().map(DVec4::from_array)
}

/// Reads a function, if one is next.
fn read_function(args: &mut dyn Args) -> Parse<Option<(Word, Function)>> {
    for (word, function) in Function::NAMED {
        if args.accept(*word)? {
            return Ok(Some((*word, *function)));
        }
    }
    if !args.accept(Word::Pwr)? {
        return Ok(None);
    }
    let open = |args: &mut dyn Args, mark| {
        if args.accept_mark(mark)? {
            return Ok(());
        }
        Err(args.expected("`pwr(real, imaginary)`"))
    };
    open(args, '(')?;
    let re = args.float()?;
    args.comma()?;
    let im = args.float()?;
    open(args, ')')?;
    Ok(Some((Word::Pwr, Function::Power(Complex::new(re, im)))))
}

/// Reads the unit normal of the slice.
fn read_slice(args: &mut dyn Args) -> Parse<DVec4> {
    let at = args.span();
    let normal = vector4(args)?;
    let unit = normal.try_normalize().filter(|unit| unit.w != 0.0);
    unit.ok_or_else(|| {
        let message = "the fourth component of the `slice` must not be zero";
        Box::new(Diagnostic::error(at.to(args.last_span()), message))
    })
}

fn at_most(args: &mut dyn Args, what: &str, most: f64) -> Parse<f64> {
    let at = args.span();
    let value = args.float()?;
    if value <= most {
        return Ok(value);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("{what} must be {most} at most, found {value}"),
    )))
}

fn square(z: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    2.0 * z.x * v + DVec4::X * (z.x * z.x - v.length_squared())
}

fn cube(z: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    let (x_sq, v_sq) = (z.x * z.x, v.length_squared());
    v * (3.0 * x_sq - v_sq) + DVec4::X * (z.x * (x_sq - 3.0 * v_sq))
}

/// The transpose of the derivative of [`square`] at `z`, applied to `g`.
fn square_adjoint(z: DVec4, g: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    2.0 * (z.x * g - g.x * v + DVec4::X * g.with_x(0.0).dot(v))
}

/// The transpose of the derivative of [`cube`] at `z`, applied to `g`.
fn cube_adjoint(z: DVec4, g: DVec4) -> DVec4 {
    let v = z.with_x(0.0);
    let (x_sq, v_sq) = (z.x * z.x, v.length_squared());
    let inner = g.with_x(0.0);
    let along = inner.dot(v);
    (3.0 * x_sq - v_sq) * inner - 2.0 * along * v - 6.0 * z.x * g.x * v
        + DVec4::X * (3.0 * (x_sq - v_sq) * g.x + 6.0 * z.x * along)
}

impl Fractal {
    fn start(&self, point: DVec3) -> DVec4 {
        point.extend(self.offset + self.slope.dot(point))
    }

    /// The gradient of `|z|²` after all iterations, for a surface that a search crossed in a step from `point` on.
    fn gradient(&self, point: DVec3, step: SearchStep) -> DVec3 {
        let start = self.start(point);
        let gradient = match self.rule {
            Rule::QuaternionSquare => self.quaternion_gradient(start, square, square_adjoint),
            Rule::QuaternionCube => self.quaternion_gradient(start, cube, cube_adjoint),
            Rule::Hypercomplex(function) => {
                return LeftOrbit::of_hit(self, function, point, step).gradient();
            }
        };
        // POV-Ray 3.7 omits the change of the fourth coordinate of a slanted slice.
        gradient.truncate()
    }

    fn quaternion_gradient(
        &self,
        mut z: DVec4,
        function: impl Fn(DVec4) -> DVec4,
        adjoint: impl Fn(DVec4, DVec4) -> DVec4,
    ) -> DVec4 {
        let mut orbit: SmallVec<[DVec4; 32]> = SmallVec::new();
        for _ in 0..self.max_iteration {
            orbit.push(z);
            z = function(z) + self.c;
        }
        orbit.iter().rev().fold(z, |g, z| adjoint(*z, g))
    }

    /// Marches a ray of unit direction from `from` through the bounding sphere and passes each change of the inside
    /// state to `emit`, until that returns false. Returns the inside state at the end.
    fn march(&self, ray: &Ray, from: f64, emit: &mut dyn FnMut(Root) -> bool) -> bool {
        let Some((enter, leave)) = self.chord(ray) else {
            return false;
        };
        let mut depth = enter.max(from);
        if depth >= leave {
            return false;
        }
        let mut lookahead = Lookahead::new(self, ray);
        let mut state = lookahead.state_at(depth);
        if state.is_inside {
            depth += 2.0 * TOLERANCE;
            state = lookahead.state_at(depth);
        }
        if state.is_inside && from < enter && !emit(root(enter, Crossing::Enter, 0)) {
            return true;
        }
        loop {
            let step = if state.is_inside {
                self.min_step
            } else {
                state.step
            };
            let next_depth = depth + step;
            if next_depth > leave || next_depth == depth {
                return state.is_inside;
            }
            let next_state = lookahead.state_at(next_depth);
            if next_state.is_inside != state.is_inside {
                let crossing = if next_state.is_inside {
                    Crossing::Enter
                } else {
                    Crossing::Leave
                };
                let t = self.bisect(ray, depth, step, state.is_inside);
                if !emit(root(t, crossing, SearchStep::face(self, step, crossing))) {
                    return next_state.is_inside;
                }
            }
            (depth, state) = (next_depth, next_state);
        }
    }

    /// Bisects the change of the inside state between `depth` and `depth + step`. Several halvings are done at once:
    /// all midpoints that they may need are evaluated in one batch.
    fn bisect(&self, ray: &Ray, mut depth: f64, mut step: f64, is_inside: bool) -> f64 {
        let batch_size = self.batch_size();
        while step > TOLERANCE {
            // Heap-ordered tree of subintervals: the lower end and the midpoint of each.
            let (mut lows, mut midpoints) = ([depth; BATCH], [depth; BATCH]);
            let mut half = step;
            for node in 1..batch_size.max(2) {
                if node.is_power_of_two() {
                    half *= 0.5;
                }
                if node > 1 {
                    let parent = node / 2;
                    lows[node] = [lows[parent], midpoints[parent]][node % 2];
                }
                midpoints[node] = lows[node] + half;
            }
            // A batch of one evaluates the first midpoint.
            midpoints.rotate_left(1);
            let states = self.states(ray, &midpoints);
            let mut node = 1;
            while node < batch_size.max(2) && step > TOLERANCE {
                step *= 0.5;
                let is_beyond = states.is_inside(node - 1) == is_inside;
                if is_beyond {
                    depth = midpoints[node - 1];
                }
                node = 2 * node + usize::from(is_beyond);
            }
        }
        // The end that is inside, since the normal comes from its iterations.
        if is_inside { depth } else { depth + step }
    }

    fn is_hypercomplex(&self) -> bool {
        matches!(self.rule, Rule::Hypercomplex(_))
    }

    /// Normalises the direction of a ray; also returns its length before.
    fn unit(&self, ray: &Ray) -> (Ray, f64) {
        let length = ray.dir.length();
        if !self.is_hypercomplex() {
            return (Ray::new(ray.origin, ray.dir / length), length);
        }
        self.exact_unit(ray)
    }

    /// The same, as POV-Ray rounds it: see `chord`.
    fn exact_unit(&self, ray: &Ray) -> (Ray, f64) {
        let length = ray.dir.length();
        // It does not normalise the rays of untransformed objects; then neither are
        // those normalised here whose length is a power of two but for rounding.
        let power = f64::from_bits((length * SQRT_2).to_bits() & !MANTISSA);
        let is_unit = !self.is_moved && (length / power - 1.0).abs() < UNIT_LOSS;
        let length = if is_unit { power } else { length };
        let dir = self.normalization.divided(ray.dir, length);
        (Ray::new(ray.origin, dir), length)
    }

    /// Interval of a ray of unit direction in the bounding sphere.
    fn chord(&self, ray: &Ray) -> Option<(f64, f64)> {
        if self.is_hypercomplex() {
            return self.exact_chord(ray);
        }
        let middle = -ray.origin.dot(ray.dir);
        let half_sq = self.radius * self.radius - ray.at(middle).length_squared();
        (half_sq > 0.0).then(|| (middle - half_sq.sqrt(), middle + half_sq.sqrt()))
    }

    /// The same, as POV-Ray rounds it: the search begins on the sphere, where the last bit decides if that is inside.
    fn exact_chord(&self, ray: &Ray) -> Option<(f64, f64)> {
        let middle = -ray.origin.dot(ray.dir);
        let radius_sq = self.radius * self.radius;
        let half_sq = radius_sq - ray.origin.length_squared() + middle * middle;
        (half_sq > 0.0).then(|| (middle - half_sq.sqrt(), middle + half_sq.sqrt()))
    }
}

fn root(t: f64, crossing: Crossing, face: u32) -> Root {
    Root {
        t,
        crossing,
        face,
        is_visible: true,
    }
}

impl Geometry for JuliaFractal {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let (ray, length) = self.0.unit(ray);
        let Some((enter, leave)) = self.0.chord(&ray) else {
            return Start::Outside;
        };
        let is_inside = self.0.march(&ray, f64::NEG_INFINITY, &mut |root| {
            // The bounding sphere is invisible where it cuts through the fractal.
            let (t, is_visible) = (root.t / length, root.t > enter);
            roots.push(Root {
                t,
                is_visible,
                ..root
            });
            true
        });
        if is_inside {
            let is_visible = false;
            roots.push(Root {
                is_visible,
                ..root(leave / length, Crossing::Leave, 0)
            });
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if from == f64::NEG_INFINITY {
            let mut roots = Vec::new();
            self.roots(ray, &mut roots);
            return first_visible(&roots, from, to);
        }
        let (ray, length) = self.0.unit(ray);
        let mut hit = None;
        let from = from * length;
        let enter = self.0.chord(&ray)?.0;
        self.0.march(&ray, from.max(TOLERANCE), &mut |root| {
            // The bounding sphere is invisible where it cuts through the fractal.
            if root.t <= enter {
                return true;
            }
            let t = root.t / length;
            hit = (t < to).then_some(Root { t, ..root });
            false
        });
        hit
    }

    /// The surface is where the steps of another ray hit it, and a ray that leaves it may hit it again. POV-Ray
    /// searches for one hit only, and ignores it if it is too near.
    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, _: u32) -> Option<Root> {
        let min_t = from.max(self.0.unit * LEAST_DISTANCE);
        if self.0.is_exact() {
            let (unit, length) = self.0.exact_unit(ray);
            let hit = self.0.exact_first(unit)?;
            let face = SearchStep::face(&self.0, hit.step, hit.crossing);
            let root = root(hit.depth / length, hit.crossing, face);
            return (min_t < root.t && root.t < to).then_some(root);
        }
        let (unit, length) = self.0.unit(ray);
        let mut hit = None;
        self.0.march(&unit, TOLERANCE, &mut |root| {
            let t = root.t / length;
            hit = (min_t < t && t < to).then_some(Root { t, ..root });
            false
        });
        hit
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        self.normal_along(point, DVec3::ZERO, face)
    }

    fn normal_along(&self, point: DVec3, dir: DVec3, face: u32) -> DVec3 {
        let gradient = self.0.gradient(point, SearchStep::of_face(face, dir));
        if gradient.is_finite() && gradient != DVec3::ZERO {
            gradient.normalize()
        } else {
            DVec3::X
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let fractal = &self.0;
        point.length_squared() <= fractal.radius * fractal.radius
            && fractal
                .states(&Ray::new(point, DVec3::X), &[0.0; BATCH])
                .is_inside(0)
    }

    fn surface_side(&self) -> SurfaceSide {
        SurfaceSide::Inside
    }

    fn keeps_its_box(&self) -> bool {
        true
    }

    fn keeps_normal_before_3_8(&self) -> bool {
        true
    }

    fn bounds(&self) -> Bounds {
        let radius = DVec3::splat(self.0.radius);
        Bounds {
            min: -radius,
            max: radius,
        }
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn scale_scene_lengths(&mut self, factor: f64) {
        self.0.unit *= factor;
    }

    fn note_steps(&mut self, steps: &[Step]) {
        let is_power = |x: f64| x.is_normal() && x.to_bits() & MANTISSA == 0;
        let only_scales = |step: &Step| matches!(step, Step::Scale(by) if uniform_scale(*by).is_some_and(is_power));
        self.0.is_moved = !steps.iter().all(only_scales);
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        let search = ExactSearch::new(self, steps.steps)?;
        Some(Rounded::of_search(search, steps))
    }

    fn is_searched(&self) -> bool {
        self.0.is_exact()
    }

    /// Makes callers use `nearest_beside` for rays that leave the surface, so that these do not march through the whole
    /// bounding sphere again.
    fn is_faceted(&self) -> bool {
        true
    }
}
