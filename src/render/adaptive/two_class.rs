//! Two classes of samples: the two sides of an edge.

use super::sample::AdaptiveSample;

/// Two classes are distinct if the gap between them is larger than the range of each, by this factor.
const APART: f32 = 1.0;

/// Classifies samples.
#[derive(Clone, Copy, Debug)]
pub(super) enum SampleClasses {
    /// By one channel.
    Colors {
        channel: usize,
        /// The ranges of both classes, the darker first.
        ranges: [(f32, f32); 2],
    },
    /// By the surface they hit; the first stands for the darker class.
    Surfaces([u32; 2]),
}

impl SampleClasses {
    /// Two classes of samples, if they are clearly distinct.
    pub(super) fn of<'a>(
        samples: impl Iterator<Item = &'a AdaptiveSample> + Clone,
        channels: usize,
    ) -> Option<SampleClasses> {
        let (mut least, mut most) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4]);
        for sample in samples.clone() {
            for (c, &value) in sample.channels.iter().enumerate() {
                let value = if value < 1.0 { value } else { 1.0 };
                least[c] = if value < least[c] { value } else { least[c] };
                most[c] = if value > most[c] { value } else { most[c] };
            }
        }
        let width = |&c: &usize| most[c] - least[c];
        let channel = (0..channels).max_by(|a, b| width(a).total_cmp(&width(b)))?;
        let (least, most) = (least[channel], most[channel]);
        // A gap wider than the range on either side contains the middle.
        let middle = (least + most) / 2.0;
        let (mut below, mut above) = (least, most);
        for sample in samples.clone() {
            let value = sample.channels[channel].min(1.0);
            if value <= middle {
                below = if value > below { value } else { below };
            } else {
                above = if value < above { value } else { above };
            }
        }
        if above - below > APART * (below - least).max(most - above) {
            let ranges = [(least, below), (above, most)];
            return Some(SampleClasses::Colors { channel, ranges });
        }
        SampleClasses::by_surfaces(samples)
    }

    fn by_surfaces<'a>(
        mut samples: impl Iterator<Item = &'a AdaptiveSample> + Clone,
    ) -> Option<SampleClasses> {
        let first = samples.clone().next()?.leaf;
        let second = samples.clone().find(|sample| sample.leaf != first)?.leaf;
        let are_two = samples.all(|sample| sample.leaf == first || sample.leaf == second);
        are_two.then_some(SampleClasses::Surfaces([first, second]))
    }

    /// True if a sample belongs to the brighter class; `None` if it belongs to neither.
    pub(super) fn is_bright(&self, sample: &AdaptiveSample) -> Option<bool> {
        let (channel, [(least, below), (above, most)]) = match *self {
            SampleClasses::Colors { channel, ranges } => (channel, ranges),
            SampleClasses::Surfaces([dark, bright]) => {
                let is_known = sample.leaf == dark || sample.leaf == bright;
                return is_known.then_some(sample.leaf == bright);
            }
        };
        let value = sample.channels[channel].min(1.0);
        let tolerance = (above - below) / 4.0;
        if value >= above - tolerance && value <= most + tolerance {
            Some(true)
        } else {
            (value <= below + tolerance && value >= least - tolerance).then_some(false)
        }
    }
}
