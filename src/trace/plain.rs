//! The short way to a colour: one opaque layer without a mirror image, lit by lamps of a point each, in clear air. Most
//! pixels of most pictures are that.
//!
//! It is the way of all others ([`Tracer::trace`]) without what cannot happen here: the sums are the same, in the same
//! order. Where light is on its way through something transparent, all turn to that.

use super::light::{Known, Shining, Viewed, is_nothing};
use super::surface::spot;
use super::{Quality, Sample, Tracer};
use crate::color::Rgb;
use crate::compile::{Hit, Scratch, Seen, Way, World};
use glam::DVec3;

/// Whether plain surfaces of a world may be coloured the short way.
pub(super) fn suits(world: &World, quality: Quality) -> bool {
    let globals = &world.globals;
    let is_simple = |number: u32| {
        let light = world.lights.get(number);
        let is_point = light.area.is_none() && !light.is_parallel;
        is_point && !light.is_shadowless() && !world.lights.is_projected(number)
    };
    let mut lights = (0u32..).take(world.lights.len());
    quality == Quality::FULL
        && globals.max_trace_level > 0
        && (0.0..=1.0).contains(&globals.adc_bailout)
        && world.fogs.is_empty()
        && world.rainbows.is_empty()
        && lights.all(is_simple)
}

impl Tracer<'_> {
    /// What a ray of the camera in this direction sees, if that is plain. It is known what it meets, and what can be known
    /// of the lights there.
    #[inline]
    pub(super) fn plain_view(
        &self,
        hit: Option<&Hit>,
        dir: DVec3,
        known: &[Known],
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        if !self.takes_plain || self.stop.is_asked() {
            return None;
        }
        match hit {
            Some(hit) => self.plain(hit, dir, known, scratch),
            None => Some(self.behind_everything(dir, Seen::Image)),
        }
    }

    /// What a ray in this direction sees at a hit, if that is plain. Of each light either what can be known is known, or
    /// nothing is.
    #[inline]
    pub(super) fn plain(
        &self,
        hit: &Hit,
        dir: DVec3,
        known: &[Known],
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let surface = &self.world.surfaces[hit.surface as usize];
        let is_filtered = |known: &Known| known.way == Some(Way::Filtered);
        if !self.takes_plain || !surface.is_plain() || known.iter().any(is_filtered) {
            return None;
        }
        let layer = surface.texture.layers().first()?;
        let color = layer.pigment.color(&spot(hit, dir));
        let (own, coat) = self.coat(layer, color);
        let at = Viewed::new(hit, dir);
        let mut sum = Rgb::BLACK;
        for &number in self.world.lights.of(surface.lights) {
            let found;
            let known = match known.get(number as usize) {
                Some(known) => known,
                None => {
                    found = self.find_out(number, hit, &at, scratch);
                    &found
                }
            };
            match known.way {
                Some(Way::Free) => {}
                Some(Way::Filtered) => return None,
                Some(Way::Blocked) | None => continue,
            }
            let Some(side) = coat.side(known.cosine, surface.flags.double_illuminate) else {
                continue;
            };
            let arriving = self.world.lights.get(number).color * known.share;
            if is_nothing(arriving) {
                continue;
            }
            let shining = Shining {
                to_light: known.arrival.to_light,
                side,
                arriving,
                has_highlights: side.is_in_front,
            };
            sum += self.shine(&shining, &at, &coat, scratch);
        }
        Some(Sample {
            rgb: Rgb::BLACK + (own + sum),
            transmit: 0.0,
        })
    }

    /// What can be known of a light at a point.
    fn find_out(&self, number: u32, hit: &Hit, at: &Viewed, scratch: &mut Scratch) -> Known {
        let mut known = self.light_at(number, hit, at.normal);
        if known.share != 0.0 {
            let query = known.shadow_query(self.world, hit);
            known.way = Some(self.world.way(&query, number, scratch));
        }
        known
    }
}
