//! Subsurface light transport: multiple scattering by a dipole, single scattering along the refracted view ray, and
//! light that crosses the body unscattered.
//!
//! POV-Ray's estimators, with the same samples in the same order. They look for surfaces of the same body, which are
//! those that share an interior.

mod medium;
mod streams;

use super::bsdf::{NEGLIGIBLE, ViewPoint, is_negligible};
use super::indirect::radiosity::IrradiancePoint;
use super::shading_point::{LightSamples, ShadingPoint};
use super::surface::single;
use super::transmission::interior_stack::refracted;
use super::{InteriorStack, Path, Scratch, Tracer};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::world::{Hit, InteriorId, Query, RayKind, SpawnSurface, World};
use glam::DVec3;
pub(super) use medium::AlbedoTables;
use medium::Medium;
use std::f64::consts::PI;
use streams::DepthStreams;
pub(super) use streams::SubsurfaceStreams;

/// The least cosine between a sample and the surface that it hits.
const MIN_COSINE: f64 = 0.01;

/// The number of nested hits with subsurface light; deeper ones have none.
const MAX_DEPTH: usize = 2;

/// The subsurface light transport of a scene that uses it.
#[derive(Debug)]
pub(super) struct SubsurfaceTransport {
    /// The number of samples of multiple and of single scattering at camera rays' hits; nested ones take one.
    samples: [u32; 2],
    /// True if the dipole collects irradiance from radiosity, which then lights no layer directly.
    pub(super) has_radiosity: bool,
    /// True if rays of irradiance samples see subsurface light.
    in_irradiance: bool,
    /// Millimetres in a unit of world space.
    scale: f64,
    /// The length that counts as 1e-10 units.
    least: f64,
    albedos: AlbedoTables,
}

/// A hit whose layer scatters light below the surface.
struct ExitPoint<'p> {
    lit: &'p ShadingPoint<'p>,
    hit: &'p Hit,
    transport: &'p SubsurfaceTransport,
    medium: Medium,
    body: InteriorId,
    /// The unit normal on the viewer's side, without bump mapping.
    normal: DVec3,
    /// The cosine between the normal and the direction to the viewer.
    cosine: f64,
}

/// The refracted view ray within a body.
struct ViewSegment {
    dir: DVec3,
    /// Its length in millimetres; infinite if it hits nothing.
    length: f64,
}

/// Light from a source where it enters a body.
struct EnteringLight {
    /// The cosine between its direction and the normal on its side.
    cosine: f64,
    /// The irradiance of each channel.
    light: Rgb,
}

impl SubsurfaceTransport {
    /// The transport of a world; `None` if no surface uses it.
    pub(super) fn new(world: &World) -> Option<SubsurfaceTransport> {
        let settings = world.subsurface.as_ref()?;
        let radiosity = world.radiosity.as_ref();
        Some(SubsurfaceTransport {
            samples: settings.samples,
            has_radiosity: settings.has_radiosity && radiosity.is_some(),
            in_irradiance: radiosity.is_some_and(|radiosity| radiosity.has_subsurface),
            scale: world.globals.mm_per_unit,
            least: NEGLIGIBLE * world.globals.unit,
            albedos: AlbedoTables::new(world),
        })
    }
}

impl ExitPoint<'_> {
    /// The random streams of its depth.
    fn streams<'s>(&self, scratch: &'s mut Scratch) -> &'s mut DepthStreams {
        scratch.random.subsurface.at(self.lit.path.subsurface_depth)
    }
}

impl Tracer<'_> {
    /// The subsurface light of a layer of this reflectance (pigment times `diffuse`). `normal` is that on the viewer's
    /// side, without bump mapping.
    pub(super) fn subsurface_light(
        &self,
        transport: &SubsurfaceTransport,
        lit: &ShadingPoint,
        hit: &Hit,
        normal: DVec3,
        [translucency, reflectance]: [Rgb; 2],
        scratch: &mut Scratch,
    ) -> Rgb {
        let path = lit.path;
        let depth = path.subsurface_depth;
        if usize::from(depth) >= MAX_DEPTH || path.irradiance_depth > 0 && !transport.in_irradiance
        {
            return Rgb::BLACK;
        }
        let body = self.world.surfaces[hit.surface as usize].interior;
        let eta = self.relative_ior(&path.inside, body);
        let ior = self.world.interiors.get(body).ior;
        let exit = ExitPoint {
            lit,
            hit,
            transport,
            medium: Medium::new(translucency, transport.albedos.of(ior, reflectance), eta),
            body,
            normal,
            cosine: -normal.dot(path.ray.dir),
        };
        let [multiple, once] = if depth == 0 {
            transport.samples
        } else {
            [1, 1]
        };
        let mut sum = self.multiple_scattering(&exit, multiple, scratch);
        let Some(inward) = refracted(path.ray.dir, normal, 1.0 / eta) else {
            return sum;
        };
        let far = self.body_search(
            hit.point,
            inward,
            Some(hit.spawn_surface),
            f64::INFINITY,
            scratch,
        );
        let length = far.map_or(f64::INFINITY, |far| {
            hit.point.distance(far.point) * transport.scale
        });
        let view = ViewSegment {
            dir: inward,
            length,
        };
        self.single_scattering(&exit, &view, once, &mut sum, scratch);
        if let Some(far) = far.filter(|far| self.is_body(far, body)) {
            sum += self.unscattered(&exit, &view, &far, scratch);
        }
        sum
    }

    /// The light of the dipole: samples of the irradiance around a base point below the surface.
    fn multiple_scattering(&self, exit: &ExitPoint, count: u32, scratch: &mut Scratch) -> Rgb {
        let base = self.base_point(exit, scratch);
        let mut sum = Rgb::BLACK;
        let mut counted = 0;
        for _ in 0..count {
            if self.stop.is_cancelled() {
                break;
            }
            let dir = exit.streams(scratch).direction();
            let Some(entry) = self.body_search(base, dir, None, f64::INFINITY, scratch) else {
                continue;
            };
            let offset = entry.point - base;
            let length = offset.length();
            let cosine = (offset / length)
                .dot(entry.shading_normal)
                .abs()
                .max(MIN_COSINE);
            let area = 4.0 * PI * (length * exit.transport.scale).powi(2) / cosine;
            if area == 0.0 {
                continue;
            }
            counted += 1;
            if self.is_body(&entry, exit.body) {
                self.add_dipole(exit, &entry, area, &mut sum, scratch);
            }
        }
        if counted == 0 {
            return Rgb::BLACK;
        }
        let mean = |sum: f32| single(f64::from(sum) / f64::from(counted));
        sum.map(mean)
    }

    /// The point from which the samples of multiple scattering start.
    fn base_point(&self, exit: &ExitPoint, scratch: &mut Scratch) -> DVec3 {
        let (point, inward) = (exit.hit.point, -exit.normal);
        let free_path = exit.medium.mean_free_path() / exit.transport.scale;
        let spawn = Some(exit.hit.spawn_surface);
        let depth = match self.body_search(point, inward, spawn, 2.0 * free_path, scratch) {
            None => free_path,
            Some(far) if self.is_body(&far, exit.body) => far.t / 2.0,
            Some(far) => free_path.min(far.t - exit.transport.least),
        };
        point + inward * depth
    }

    /// Adds the light that enters at a point and leaves at the exit point by the dipole.
    fn add_dipole(
        &self,
        exit: &ExitPoint,
        entry: &Hit,
        area: f64,
        sum: &mut Rgb,
        scratch: &mut Scratch,
    ) {
        let separation = exit.transport.scale * entry.point.distance(exit.hit.point);
        let leaving = exit.medium.transmittance(exit.cosine.clamp(-1.0, 1.0));
        let dipole = exit.medium.dipole(separation * separation);
        let factors = |cosine: f64| {
            let entering = exit.medium.transmittance(cosine.min(1.0));
            dipole.map(|dipole| entering * leaving * dipole * area)
        };
        let lit = Self::entry_point(exit, entry);
        if exit.transport.has_radiosity
            && let Some(radiosity) = &self.radiosity
        {
            let point = IrradiancePoint::new(radiosity, &lit, entry.shading_normal, 1.0);
            let light = self.irradiance_below(&point, area, scratch);
            *sum += scaled(light, factors(1.0));
        }
        for &number in exit.lit.lights {
            if let Some(entering) = self.entering_light(number, &lit, scratch) {
                *sum += scaled(entering.light, factors(entering.cosine));
            }
        }
    }

    /// Adds single scattering: samples on the refracted view ray, each channel by its own.
    fn single_scattering(
        &self,
        exit: &ExitPoint,
        view: &ViewSegment,
        count: u32,
        sum: &mut Rgb,
        scratch: &mut Scratch,
    ) {
        for _ in 0..count {
            if self.stop.is_cancelled() {
                break;
            }
            let mut sample = |channel| self.scattered_once(exit, view, channel, scratch);
            let scattered = Rgb::new(sample(0), sample(1), sample(2));
            *sum += scattered.map(|light| light / single(f64::from(count)));
        }
    }

    /// One sample of single scattering in one channel.
    fn scattered_once(
        &self,
        exit: &ExitPoint,
        view: &ViewSegment,
        channel: usize,
        scratch: &mut Scratch,
    ) -> f32 {
        let ExitPoint {
            medium, transport, ..
        } = exit;
        let extinction = medium.extinction[channel];
        let depth = exit.streams(scratch).number().ln().abs() / extinction;
        let mut sum = 0.0;
        if depth.is_nan() || depth >= view.length {
            return sum;
        }
        let point = exit.hit.point + view.dir * (depth / transport.scale);
        let leaving = medium.transmittance(exit.cosine);
        for &number in exit.lit.lights {
            let to_light = self.world.lights.get(number).arrival(point).to_light;
            let entry = self.body_search(point, to_light, None, f64::INFINITY, scratch);
            let Some(entry) = entry.filter(|entry| self.is_body(entry, exit.body)) else {
                continue;
            };
            let lit = Self::entry_point(exit, &entry);
            let Some(entering) = self.entering_light(number, &lit, scratch) else {
                continue;
            };
            let inside = medium.refracted_cosine(entering.cosine);
            if inside.is_nan() || inside <= NEGLIGIBLE {
                continue;
            }
            let length = transport.scale * point.distance(entry.point);
            let refracted = length * entering.cosine / inside;
            let fresnel = medium.transmittance(entering.cosine) * leaving;
            let geometry = (medium.refracted_cosine(exit.cosine) / inside).abs();
            let combined = extinction + geometry * extinction;
            let phase = medium.scattering[channel] * fresnel * 0.25 / combined;
            let factor = phase * ((-refracted * extinction).exp() * (-depth * extinction).exp());
            sum += single(entering.light.channels()[channel] * finite(factor));
        }
        sum
    }

    /// The light from behind the body that crosses it along the refracted view ray, and leaves it at `far`.
    fn unscattered(
        &self,
        exit: &ExitPoint,
        view: &ViewSegment,
        far: &Hit,
        scratch: &mut Scratch,
    ) -> Rgb {
        let path = exit.lit.path;
        let attenuation = exit
            .medium
            .extinction
            .map(|extinction| (-extinction * view.length).exp().max(0.0));
        let weight = attenuation.iter().copied().fold(0.0, f64::max);
        if weight <= self.world.globals.adc_bailout {
            return Rgb::BLACK;
        }
        let Some(dir) = refracted(view.dir, far.shading_normal, exit.medium.eta) else {
            return Rgb::BLACK;
        };
        let behind = Path {
            ray: Ray::new(far.point, dir),
            from: Some(far.spawn_surface),
            kind: RayKind::Camera,
            level: path.level + 1,
            weight,
            irradiance_depth: path.irradiance_depth,
            subsurface_depth: path.subsurface_depth + 1,
            inside: InteriorStack::new(),
            wavelength: path.wavelength,
        };
        scaled(self.trace(behind, None, scratch).rgb, attenuation)
    }

    /// The closest hit of a ray in or around a body, which sees all objects.
    fn body_search(
        &self,
        from: DVec3,
        dir: DVec3,
        spawn_surface: Option<SpawnSurface>,
        t_max: f64,
        scratch: &mut Scratch,
    ) -> Option<Hit> {
        let query = Query {
            ray: Ray::new(from, dir),
            origin_surface: spawn_surface,
            t_max,
            kind: RayKind::Subsurface,
        };
        self.world.nearest(&query, &mut scratch.query)
    }

    /// Returns true if a hit lies on the body with this interior.
    fn is_body(&self, hit: &Hit, body: InteriorId) -> bool {
        self.world.surfaces[hit.surface as usize].interior == body
    }

    /// The shading point where light enters a body.
    fn entry_point<'p>(exit: &ExitPoint<'p>, entry: &'p Hit) -> ShadingPoint<'p> {
        ShadingPoint {
            at: ViewPoint {
                point: entry.point,
                normal: entry.shading_normal,
                view: exit.lit.at.view,
            },
            spawn_surface: Some(&entry.spawn_surface),
            path: exit.lit.path,
            known: LightSamples::NONE,
            shadow_cache: None,
            is_double_illuminated: false,
            lights: exit.lit.lights,
            collects: false,
        }
    }

    /// The light from a source that enters a body, from either side of its surface; `None` for none.
    fn entering_light(
        &self,
        number: u32,
        lit: &ShadingPoint,
        scratch: &mut Scratch,
    ) -> Option<EnteringLight> {
        let light = self.world.lights.get(number);
        let arrival = light.arrival(lit.at.point);
        let arriving = light.color * light.attenuation(lit.at.point, &arrival);
        let cosine = lit.at.normal.dot(arrival.to_light).abs();
        if is_negligible(arriving) || cosine < NEGLIGIBLE {
            return None;
        }
        let light = self.shadowed_light(arriving, number, lit, &arrival, scratch);
        (!is_negligible(light)).then(|| EnteringLight {
            cosine,
            light: light * cosine,
        })
    }
}

/// A colour with each channel multiplied by a factor of its own; none where that is not finite.
fn scaled(color: Rgb, [r, g, b]: [f64; 3]) -> Rgb {
    let scaled = |channel: f32, factor: f64| single(f64::from(channel) * finite(factor));
    Rgb::new(scaled(color.r, r), scaled(color.g, g), scaled(color.b, b))
}

/// The value, or 0 for infinite ones and NaN: those of channels in which the medium absorbs all light.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}
