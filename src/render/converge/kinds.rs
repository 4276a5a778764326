//! Samples of two kinds: what lies on either side of an edge.

use super::look::Look;

/// Two colours are told apart if they are further from each other than those of one kind are, by this factor.
const APART: f32 = 1.0;

/// How samples are told apart.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kinds {
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

impl Kinds {
    /// Two kinds of samples, if they are clearly two. `values` is a buffer.
    pub(super) fn of<'a>(
        looks: impl Iterator<Item = &'a Look> + Clone,
        channels: usize,
        values: &mut Vec<f32>,
    ) -> Option<Kinds> {
        let reach = |channel: usize| {
            let of_channel = looks.clone().map(|look| look.channels[channel].min(1.0));
            of_channel.fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), c| {
                (least.min(c), most.max(c))
            })
        };
        let width = |channel: &usize| {
            let (least, most) = reach(*channel);
            most - least
        };
        let channel = (0..channels).max_by(|a, b| width(a).total_cmp(&width(b)))?;
        values.clear();
        values.extend(looks.clone().map(|look| look.channels[channel].min(1.0)));
        values.sort_unstable_by(f32::total_cmp);
        let (&least, &most) = (values.first()?, values.last()?);
        let gap = values
            .windows(2)
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        let (below, above) = (gap[0], gap[1]);
        if above - below > APART * (below - least).max(most - above) {
            let ranges = [(least, below), (above, most)];
            return Some(Kinds::Colors { channel, ranges });
        }
        Kinds::by_surfaces(looks)
    }

    fn by_surfaces<'a>(mut looks: impl Iterator<Item = &'a Look> + Clone) -> Option<Kinds> {
        let first = looks.clone().next()?.leaf;
        let second = looks.clone().find(|look| look.leaf != first)?.leaf;
        let are_two = looks.all(|look| look.leaf == first || look.leaf == second);
        are_two.then_some(Kinds::Surfaces([first, second]))
    }

    /// Whether a sample is of the brighter kind; `None` if it is of neither.
    pub(super) fn is_bright(&self, look: &Look) -> Option<bool> {
        let (channel, [(least, below), (above, most)]) = match *self {
            Kinds::Colors { channel, ranges } => (channel, ranges),
            Kinds::Surfaces([dark, bright]) => {
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
