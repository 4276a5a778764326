//! Samples of two kinds: what lies on either side of an edge.

use super::sample::AdaptiveSample;

/// Two colours are told apart if they are further from each other than those of one kind are, by this factor.
const APART: f32 = 1.0;

/// How samples are told apart.
#[derive(Clone, Copy, Debug)]
pub(super) enum SampleClasses {
    /// By one channel.
    Colors {
        /// Which it is.
        channel: usize,
        /// The ranges of both kinds, the darker first.
        ranges: [(f32, f32); 2],
    },
    /// By the surfaces that they met; the first takes the place of the darker.
    Surfaces([u32; 2]),
}

impl SampleClasses {
    /// Two kinds of samples, if they are clearly two.
    pub(super) fn of<'a>(
        looks: impl Iterator<Item = &'a AdaptiveSample> + Clone,
        channels: usize,
    ) -> Option<SampleClasses> {
        let (mut least, mut most) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4]);
        for look in looks.clone() {
            for (c, &value) in look.channels.iter().enumerate() {
                let value = if value < 1.0 { value } else { 1.0 };
                least[c] = if value < least[c] { value } else { least[c] };
                most[c] = if value > most[c] { value } else { most[c] };
            }
        }
        let width = |&c: &usize| most[c] - least[c];
        let channel = (0..channels).max_by(|a, b| width(a).total_cmp(&width(b)))?;
        let (least, most) = (least[channel], most[channel]);
        // A gap that is wider than what lies on each side of it holds the middle.
        let middle = (least + most) / 2.0;
        let (mut below, mut above) = (least, most);
        for look in looks.clone() {
            let value = look.channels[channel].min(1.0);
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
        SampleClasses::by_surfaces(looks)
    }

    fn by_surfaces<'a>(
        mut looks: impl Iterator<Item = &'a AdaptiveSample> + Clone,
    ) -> Option<SampleClasses> {
        let first = looks.clone().next()?.leaf;
        let second = looks.clone().find(|look| look.leaf != first)?.leaf;
        let are_two = looks.all(|look| look.leaf == first || look.leaf == second);
        are_two.then_some(SampleClasses::Surfaces([first, second]))
    }

    /// Whether a sample is of the brighter kind; `None` if it is of neither.
    pub(super) fn is_bright(&self, look: &AdaptiveSample) -> Option<bool> {
        let (channel, [(least, below), (above, most)]) = match *self {
            SampleClasses::Colors { channel, ranges } => (channel, ranges),
            SampleClasses::Surfaces([dark, bright]) => {
                let is_known = look.leaf == dark || look.leaf == bright;
                return is_known.then_some(look.leaf == bright);
            }
        };
        let value = look.channels[channel].min(1.0);
        let room = (above - below) / 4.0;
        if value >= above - room && value <= most + room {
            Some(true)
        } else {
            (value <= below + room && value >= least - room).then_some(false)
        }
    }
}
