//! Doubts about the view, from the first hits of rays of the camera.

use super::{Located, doubt};
use crate::base::math::Ray;
use crate::base::source::{Code, Diagnostic};
use crate::scene::light::Beam;
use crate::scene::shape::Shape;
use crate::scene::{Kind, Scene};
use crate::world::ProbeModel;

/// Rays of the camera across and down.
const GRID: (u32, u32) = (40, 30);
/// The same where the first find nothing: small objects fall between them.
const FINE_GRID: (u32, u32) = (160, 120);
/// Most objects, and most shapes in all of them, of a scene whose view is examined.
const MOST_OBJECTS: usize = 400;
const MOST_SHAPES: u64 = 100_000;
/// Surfaces nearer to each other than this share of their distance coincide.
const COINCIDENT: f64 = 1e-9;
/// Least share of rays that must hit coincident surfaces.
const COINCIDENT_RAYS: usize = 4;

/// The nearest two objects on a ray, by their indices.
#[derive(Clone, Copy, Default)]
struct Nearest {
    first: Option<(f64, usize)>,
    second: Option<(f64, usize)>,
}

impl Nearest {
    fn add(&mut self, hit: (f64, usize)) {
        if self.first.is_none_or(|(distance, _)| hit.0 < distance) {
            self.second = self.first.replace(hit);
        } else if self.second.is_none_or(|(distance, _)| hit.0 < distance) {
            self.second = Some(hit);
        }
    }
}

pub(super) fn doubts(scene: &Scene, located: &[Located]) -> Vec<Diagnostic> {
    let shapes: u64 = located
        .iter()
        .map(|one| u64::from(one.object.size().leaves))
        .sum();
    if located.len() > MOST_OBJECTS || shapes > MOST_SHAPES || scene.camera.is_mesh() {
        return Vec::new();
    }
    let visible: Vec<usize> = (0..located.len())
        .filter(|&at| {
            let object = &located[at].object;
            !matches!(object.kind, Kind::Light { .. }) && !object.flags.no_image
        })
        .collect();
    if visible.is_empty() {
        return Vec::new();
    }
    let mut view = View {
        scene,
        located,
        probe: ProbeModel::default(),
    };
    let rays = view.rays(GRID);
    let mut nearest = view.nearest(&visible, &rays);
    let hits_nothing = |nearest: &[Nearest]| nearest.iter().all(|one| one.first.is_none());
    if hits_nothing(&nearest) {
        nearest = view.nearest(&visible, &view.rays(FINE_GRID));
    }
    if hits_nothing(&nearest) {
        return vec![doubt(
            Code::NothingInView,
            None,
            "no object is in view",
            "Point the camera at one: `look_at <0, 0, 0>`.",
        )];
    }
    let mut doubts = Vec::new();
    doubts.extend(view.hidden(&nearest));
    doubts.extend(view.coincident(&nearest));
    doubts.extend(view.lights_inside(&visible));
    doubts
}

struct View<'a> {
    scene: &'a Scene,
    located: &'a [Located],
    probe: ProbeModel,
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

    /// The nearest objects on rays, object by object, as the probe prepares one at a time.
    fn nearest(&mut self, visible: &[usize], rays: &[Ray]) -> Vec<Nearest> {
        let mut nearest = vec![Nearest::default(); rays.len()];
        for &at in visible {
            let object = &self.located[at].object;
            for (ray, nearest) in rays.iter().zip(&mut nearest) {
                if let Some((point, _)) = self.probe.trace(object, ray.origin, ray.dir) {
                    nearest.add(((point - ray.origin).dot(ray.dir), at));
                }
            }
        }
        nearest
    }

    /// The object that alone is seen, though others lie behind it.
    fn hidden(&mut self, nearest: &[Nearest]) -> Option<Diagnostic> {
        let (_, only) = nearest.iter().find_map(|one| one.first)?;
        let is_alone = nearest
            .iter()
            .all(|one| one.first.is_some_and(|(_, at)| at == only));
        let hides = nearest.iter().any(|one| one.second.is_some());
        let Located { object, span, .. } = &self.located[only];
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
        let (a, b) = (&self.located[a], &self.located[b]);
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

    /// Lights in opaque objects that the camera sees from outside.
    fn lights_inside(&mut self, visible: &[usize]) -> Vec<Diagnostic> {
        let lights = self
            .located
            .iter()
            .filter_map(|one| match &one.object.kind {
                Kind::Light {
                    light,
                    looks_like: None,
                    ..
                } if one.object.steps.is_empty() => Some((one, light)),
                _ => None,
            });
        let location = self.scene.camera.location();
        let mut doubts = Vec::new();
        for (one, light) in lights {
            if light.is_parallel || light.beam == Beam::Shadowless {
                continue;
            }
            let around = visible.iter().map(|&at| &self.located[at]).find(|around| {
                !around.object.flags.no_shadow
                    && self.probe.is_inside(&around.object, light.centre)
                    && !self.probe.is_inside(&around.object, location)
                    && self.probe.is_opaque(&around.object)
            });
            if let Some(around) = around {
                let doubt = doubt(
                    Code::LightInside,
                    one.span,
                    "this light is inside an opaque object, which keeps its light",
                    "Move it out, or write `no_shadow` in the object.",
                );
                doubts.push(match around.span {
                    Some(span) => doubt.with_label(span, "this object"),
                    None => doubt,
                });
            }
        }
        doubts
    }
}
