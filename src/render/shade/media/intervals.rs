//! The division of a ray segment in media into intervals, by the light beams on it and by the sampling.

use crate::scene::interior::{PreparedMedia, Sampling};

/// The interval of a ray within the beam of a light.
pub(in crate::render::shade) struct LightBeam {
    pub(super) number: u32,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// An interval of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::render::shade) struct MediaInterval {
    pub(in crate::render::shade) from: f64,
    pub(in crate::render::shade) to: f64,
    pub(super) is_lit: bool,
}

/// The common sampling of several media: that with the most intervals, at the smallest threshold.
pub(in crate::render::shade) fn common_sampling(media: &[&PreparedMedia]) -> Option<Sampling> {
    let mut common = media.first()?.sampling;
    for media in media {
        let own = media.sampling;
        let threshold = common.aa_threshold.min(own.aa_threshold);
        if own.intervals > common.intervals {
            common = own;
        }
        common.aa_threshold = threshold;
    }
    Some(common)
}

/// The intervals inside and outside of beams, in order.
pub(in crate::render::shade) fn parts_of(beams: &[LightBeam], length: f64) -> Vec<MediaInterval> {
    let mut lit: Vec<(f64, f64)> = beams.iter().map(|beam| (beam.from, beam.to)).collect();
    lit.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts: Vec<MediaInterval> = Vec::new();
    let mut end = 0.0;
    for (from, to) in lit {
        if from > end {
            parts.push(MediaInterval {
                from: end,
                to: from,
                is_lit: false,
            });
        }
        match parts.last_mut() {
            Some(last) if last.is_lit && from <= last.to => last.to = last.to.max(to),
            _ => parts.push(MediaInterval {
                from,
                to,
                is_lit: true,
            }),
        }
        end = end.max(to);
    }
    if end < length {
        parts.push(MediaInterval {
            from: end,
            to: length,
            is_lit: false,
        });
    }
    parts
}

/// Divides parts into intervals: lit parts get their share of them. Where rounding leaves all intervals together short
/// of the end, the rest is one more, as in POV-Ray: it draws random numbers like any other.
pub(in crate::render::shade) fn subdivided(
    parts: &[MediaInterval],
    sampling: &Sampling,
) -> Vec<MediaInterval> {
    let wanted = sampling.intervals as usize;
    let all = wanted.max(parts.len());
    let weight = |part: &MediaInterval| {
        if part.is_lit {
            sampling.ratio
        } else {
            1.0 - sampling.ratio
        }
    };
    let total: f64 = parts.iter().map(weight).sum();
    let mut remaining = all;
    let mut intervals = Vec::with_capacity(all);
    for (number, part) in parts.iter().enumerate() {
        let count = if parts.len() == 1 {
            wanted
        } else {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the cast saturates"
            )]
            let share = (weight(part) / total * all as f64) as usize + 1;
            share
                .min((remaining + number + 1).saturating_sub(parts.len()))
                .max(1)
        };
        remaining = remaining.saturating_sub(count);
        let length = (part.to - part.from) / count as f64;
        intervals.extend((0..count).map(|index| MediaInterval {
            from: part.from + index as f64 * length,
            to: part.from + (index + 1) as f64 * length,
            is_lit: part.is_lit,
        }));
    }
    if let (Some(end), Some(last)) = (parts.last().map(|part| part.to), intervals.last())
        && last.to < end
    {
        let from = last.to;
        intervals.push(MediaInterval {
            from,
            to: end,
            is_lit: false,
        });
    }
    intervals
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beam(from: f64, to: f64) -> LightBeam {
        LightBeam {
            number: 0,
            from,
            to,
        }
    }

    fn part(from: f64, to: f64, is_lit: bool) -> MediaInterval {
        MediaInterval { from, to, is_lit }
    }

    #[test]
    fn beams_that_overlap_are_one_lit_part() {
        let beams = [beam(5.0, 7.0), beam(1.0, 3.0), beam(2.0, 4.0)];
        let expected = [
            part(0.0, 1.0, false),
            part(1.0, 4.0, true),
            part(4.0, 5.0, false),
            part(5.0, 7.0, true),
            part(7.0, 10.0, false),
        ];
        assert_eq!(parts_of(&beams, 10.0), expected);
        assert_eq!(parts_of(&[], 2.0), [part(0.0, 2.0, false)]);
    }

    fn sampling_of_seven() -> Sampling {
        Sampling {
            method: 3,
            intervals: 7,
            samples: [1, 1],
            confidence: 0.9,
            variance: 0.01,
            ratio: 0.9,
            jitter: 0.0,
            aa_level: 3,
            aa_threshold: 0.1,
        }
    }

    #[test]
    fn intervals_fill_the_segment_without_gaps() {
        let sampling = sampling_of_seven();
        let parts = parts_of(&[beam(1.0, 3.0), beam(6.0, 7.0)], 9.0);
        let intervals = subdivided(&parts, &sampling);
        assert!(
            intervals
                .windows(2)
                .all(|pair| (pair[0].to - pair[1].from).abs() < 1e-12)
        );
        assert_eq!(
            (intervals[0].from, intervals[intervals.len() - 1].to),
            (0.0, 9.0)
        );
        let lit = intervals.iter().filter(|interval| interval.is_lit).count();
        assert!(2 * lit > intervals.len(), "{lit} of {}", intervals.len());
    }

    #[test]
    fn rounding_may_leave_one_more_interval() {
        let sampling = Sampling {
            intervals: 3,
            ..sampling_of_seven()
        };
        // The lengths are among those measured with POV-Ray.
        for (length, count) in [(1.728_715, 4), (0.920_754, 4), (1.0, 3), (1.5, 3)] {
            assert_eq!(subdivided(&parts_of(&[], length), &sampling).len(), count);
        }
    }
}
