//! Doubts about the view, from the first hits of rays of the camera.

use super::candidates::Candidates;
use super::{Located, doubt};
use crate::base::math::Ray;
use crate::base::math::conditioning::Normalization;
use crate::base::options::CancelToken;
use crate::base::source::{Code, Diagnostic};
use crate::scene::light::Beam;
use crate::scene::shape::Shape;
use crate::scene::{Kind, Object, Scene};
use crate::world::ProbeModel;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Rays of the camera across and down.
const GRID: (u32, u32) = (40, 30);
/// The same where the first find nothing: small objects fall between them.
const FINE_GRID: (u32, u32) = (160, 120);
/// Most shapes of a scene whose view is examined.
const MOST_SHAPES: usize = 500_000;
/// Surfaces nearer to each other than this share of their distance coincide.
const COINCIDENT: f64 = 1e-9;
/// Least share of rays that must hit coincident surfaces.
const COINCIDENT_RAYS: usize = 4;

/// Directions in which a light is blocked if an object encloses it; one in 20 degrees.
const DIRECTIONS: u32 = 500;

/// Distance, in distances of a light from the origin, at which bounded objects have ended.
const FAR: f64 = 1e6;

/// The nearest two objects on a ray, by their indices.
#[derive(Clone, Copy, Default)]
struct Nearest {
    first: Option<(f64, usize)>,
    second: Option<(f64, usize)>,
}

impl Nearest {
    /// Adds a hit; of objects at one distance the first in the scene comes first.
    fn add(&mut self, hit: (f64, usize)) {
        if self.first.is_none_or(|first| hit < first) {
            self.second = self.first.replace(hit);
        } else if self.second.is_none_or(|second| hit < second) {
            self.second = Some(hit);
        }
    }
}

/// True if a scene is small enough, as far as the number of its objects shows.
pub(super) fn is_examined(scene: &Scene) -> bool {
    scene.objects.len() <= MOST_SHAPES && !scene.camera.is_mesh()
}

/// The doubts about the view; none if it takes too long to examine, or when cancelled.
pub(super) fn doubts(
    scene: &Scene,
    located: impl Iterator<Item = Located>,
    stop: &CancelToken,
) -> Vec<Diagnostic> {
    let doubts = view_doubts(scene, located, stop);
    doubts.filter(|_| !stop.is_cancelled()).unwrap_or_default()
}

fn view_doubts(
    scene: &Scene,
    located: impl Iterator<Item = Located>,
    stop: &CancelToken,
) -> Option<Vec<Diagnostic>> {
    let (lights, mut visible): (Vec<Located>, Vec<Located>) =
        located.partition(|one| matches!(one.object.kind, Kind::Light { .. }));
    visible.retain(|one| !one.object.flags.no_image);
    let leaves = visible.iter().map(|one| one.object.size().leaves as usize);
    if visible.is_empty() || leaves.fold(0, usize::saturating_add) > MOST_SHAPES {
        return None;
    }
    let mut view = View {
        scene,
        lights: &lights,
        visible: &visible,
        candidates: Candidates::new(&visible),
        probe: ProbeModel::default(),
        stop,
    };
    let mut nearest = view.nearest(&view.rays(GRID))?;
    let hits_nothing = |nearest: &[Nearest]| nearest.iter().all(|one| one.first.is_none());
    if hits_nothing(&nearest) {
        nearest = view.nearest(&view.rays(FINE_GRID))?;
    }
    if hits_nothing(&nearest) {
        return Some(vec![doubt(
            Code::NothingInView,
            None,
            "no object is in view",
            "Point the camera at one: `look_at <0, 0, 0>`.",
        )]);
    }
    let mut doubts = Vec::new();
    doubts.extend(view.hidden(&nearest));
    doubts.extend(view.coincident(&nearest));
    doubts.extend(view.lights_inside()?);
    Some(doubts)
}

struct View<'a> {
    scene: &'a Scene,
    lights: &'a [Located],
    visible: &'a [Located],
    candidates: Candidates,
    probe: ProbeModel,
    stop: &'a CancelToken,
}

impl View<'_> {
    fn rays(&self, (width, height): (u32, u32)) -> Vec<Ray> {
        let camera = &self.scene.camera;
        let points =
            (0..height).flat_map(|y| (0..width).map(move |x| (f64::from(x), f64::from(y))));
        points
            .filter_map(|(x, y)| camera.primary_ray(x, y, width, height))
            .collect()
    }

    /// The nearest objects on rays, object by object, as the probe prepares one at a time; `None` if too many come into
    /// question, or when cancelled.
    fn nearest(&mut self, rays: &[Ray]) -> Option<Vec<Nearest>> {
        let mut nearest = vec![Nearest::default(); rays.len()];
        for (at, index) in self.candidates.on_rays(rays)? {
            if self.stop.is_cancelled() {
                return None;
            }
            let (ray, nearest) = (&rays[index], &mut nearest[index]);
            let least = self.candidates.distance(at, ray.origin);
            if nearest.second.is_some_and(|(known, _)| known < least) {
                continue;
            }
            let object = &self.visible[at].object;
            if let Some((point, _)) =
                self.probe
                    .trace(object, ray.origin, ray.dir, Normalization::default())
            {
                nearest.add(((point - ray.origin).dot(ray.dir), at));
            }
        }
        Some(nearest)
    }

    /// The object that alone is seen, though others lie behind it.
    fn hidden(&mut self, nearest: &[Nearest]) -> Option<Diagnostic> {
        let (_, only) = nearest.iter().find_map(|one| one.first)?;
        let is_alone = nearest
            .iter()
            .all(|one| one.first.is_some_and(|(_, at)| at == only));
        let hides = nearest.iter().any(|one| one.second.is_some());
        let Located { object, span, .. } = &self.visible[only];
        if !is_alone || !hides || !self.probe.is_opaque(object) {
            return None;
        }
        let is_plane =
            matches!(&object.kind, Kind::Shape(shape) if matches!(**shape, Shape::Plane(_)));
        let location = self.scene.camera.location();
        let is_inside = self.probe.is_inside(object, location);
        Some(match (is_plane, is_inside) {
            (true, _) => doubt(
                Code::HidesEverything,
                *span,
                "this plane hides everything else from the camera",
                "Move the camera to the other side of it, or the plane away.",
            ),
            (false, true) => doubt(
                Code::CameraInside,
                *span,
                "the camera is inside this object, and sees nothing else",
                "Move the camera out of it, or make the object larger than the others.",
            ),
            (false, false) => doubt(
                Code::HidesEverything,
                *span,
                "this object hides everything else from the camera",
                "Move the camera or the object.",
            ),
        })
    }

    /// Two objects with different textures whose surfaces coincide where the camera sees them.
    fn coincident(&mut self, nearest: &[Nearest]) -> Option<Diagnostic> {
        let pairs = nearest.iter().filter_map(|one| {
            let ((near, a), (far, b)) = (one.first?, one.second?);
            (far - near <= COINCIDENT * far).then_some((a.min(b), a.max(b)))
        });
        let pairs: Vec<(usize, usize)> = pairs.collect();
        let &(a, b) = pairs
            .iter()
            .find(|pair| pairs.iter().filter(|other| other == pair).count() >= COINCIDENT_RAYS)?;
        let (a, b) = (&self.visible[a], &self.visible[b]);
        if a.has_texture_of(b)
            || !self.probe.is_opaque(&a.object)
            || !self.probe.is_opaque(&b.object)
        {
            return None;
        }
        let doubt = doubt(
            Code::CoincidentSurfaces,
            b.span,
            "surfaces of two objects coincide where both are seen",
            "Move one of them a little, as by `translate 0.001*y`.",
        );
        Some(match a.span {
            Some(span) => doubt.with_label(span, "the other object"),
            None => doubt,
        })
    }

    /// Lights in opaque objects that the camera sees from outside; `None` if too many come into question, or when
    /// cancelled.
    fn lights_inside(&mut self) -> Option<Vec<Diagnostic>> {
        let lights = self.lights.iter().filter_map(|one| match &one.object.kind {
            Kind::Light {
                light,
                looks_like: None,
                ..
            } if one.object.steps.is_empty()
                && !light.is_parallel
                && light.beam != Beam::Shadowless =>
            {
                Some((one, light.centre))
            }
            _ => None,
        });
        let (lights, centres): (Vec<&Located>, Vec<DVec3>) = lights.unzip();
        let location = self.scene.camera.location();
        let mut around: Vec<Option<&Located>> = vec![None; lights.len()];
        for (at, light) in self.candidates.around(&centres)? {
            if self.stop.is_cancelled() {
                return None;
            }
            let one = &self.visible[at];
            let keeps_light = around[light].is_none()
                && !one.object.flags.no_shadow
                && self.probe.is_inside(&one.object, centres[light])
                && !self.probe.is_inside(&one.object, location)
                && self.probe.is_opaque(&one.object)
                && self.blocks_light(&one.object, centres[light]);
            if keeps_light {
                around[light] = Some(one);
            }
        }
        let enclosed = lights.into_iter().zip(around);
        let doubts = enclosed.filter_map(|(light, around)| Some(light_inside(light, around?)));
        Some(doubts.collect())
    }
}

impl View<'_> {
    /// True if an object around a light is unbounded, or is hit in all directions: an open cylinder is not.
    fn blocks_light(&mut self, object: &Arc<Object>, light: DVec3) -> bool {
        let far = FAR * light.length().max(1.0);
        let is_unbounded = DVec3::AXES
            .into_iter()
            .flat_map(|axis| [axis, -axis])
            .any(|axis| self.probe.is_inside(object, light + far * axis));
        let golden_angle = PI * (3.0 - 5f64.sqrt());
        let mut directions = (0..DIRECTIONS).map(|index| {
            let index = f64::from(index);
            let height = 1.0 - (2.0 * index + 1.0) / f64::from(DIRECTIONS);
            let radius = (1.0 - height * height).sqrt();
            let (sin, cos) = (golden_angle * index).sin_cos();
            DVec3::new(radius * cos, height, radius * sin)
        });
        is_unbounded
            || directions.all(|dir| {
                self.probe
                    .trace(object, light, dir, Normalization::default())
                    .is_some()
            })
    }
}

fn light_inside(light: &Located, around: &Located) -> Diagnostic {
    let doubt = doubt(
        Code::LightInside,
        light.span,
        "this light is inside an opaque object, which keeps its light",
        "Move it out, or write `no_shadow` in the object.",
    );
    match around.span {
        Some(span) => doubt.with_label(span, "this object"),
        None => doubt,
    }
}
