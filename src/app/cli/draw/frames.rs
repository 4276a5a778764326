//! Animations: frame numbers, clocks, and file names. Every rule here was measured with povray 3.7.0.10.

use std::path::{Path, PathBuf};

use crate::base::options::ReadOptions;

/// The animation options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    pub(crate) initial_frame: Option<i64>,
    pub(crate) final_frame: Option<i64>,
    pub(crate) initial_clock: f32,
    /// 1 unless set.
    pub(crate) final_clock: Option<f32>,
    pub(crate) is_cyclic: bool,
    /// A frame, or a share of the frames: see [`subset`].
    pub(crate) subset_start: Option<f32>,
    pub(crate) subset_end: Option<f32>,
    pub(crate) step: i64,
}

impl Default for Wanted {
    fn default() -> Self {
        Wanted {
            initial_frame: None,
            final_frame: None,
            initial_clock: 0.0,
            final_clock: None,
            is_cyclic: false,
            subset_start: None,
            subset_end: None,
            step: 1,
        }
    }
}

/// The frames of an animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// `initial_frame`.
    initial: u32,
    /// `final_frame`: one more than is rendered of a cyclic animation.
    last: u32,
    /// The first frame to render.
    start: u32,
    /// The last frame to render, if a step ends there.
    end: u32,
    step: u32,
    initial_clock: f32,
    final_clock: f32,
}

impl Frames {
    /// The requested frames; `None` for a still picture, which is the default unless a first or last frame is set.
    pub(crate) fn of(wanted: &Wanted) -> Option<Self> {
        let is_named = |frame: Option<i64>| frame.is_some_and(|frame| frame != 0);
        if !is_named(wanted.initial_frame) && !is_named(wanted.final_frame) {
            return None;
        }
        let number = |frame: Option<i64>| {
            let frame = frame.unwrap_or(1).clamp(0, i64::from(u32::MAX - 1));
            u32::try_from(frame).unwrap_or(u32::MAX - 1)
        };
        let initial = number(wanted.initial_frame);
        let drawn = number(wanted.final_frame).max(initial);
        let last = drawn + u32::from(wanted.is_cyclic);
        let within = |frame: Option<f32>| frame.map(|frame| subset(frame, last - initial));
        let start = within(wanted.subset_start).map_or(initial, |frame| frame.max(initial));
        let end = within(wanted.subset_end).map_or(drawn, |frame| frame.max(initial));
        Some(Frames {
            initial,
            last,
            start,
            end: end.max(start),
            step: u32::try_from(wanted.step.max(1)).unwrap_or(u32::MAX),
            initial_clock: wanted.initial_clock,
            final_clock: wanted.final_clock.unwrap_or(1.0),
        })
    }

    /// The numbers of the frames to render, in order.
    #[must_use]
    pub fn numbers(&self) -> Vec<u32> {
        let step = usize::try_from(self.step).unwrap_or(usize::MAX);
        (self.start..=self.end).step_by(step).collect()
    }

    /// The position of a frame from the first to the last to render, counted from 1, and that of the last. A step of
    /// two takes every other position.
    pub(crate) fn position(&self, frame: u32) -> (u32, u32) {
        let position = |frame: u32| frame - self.start + 1;
        (position(frame), position(self.end))
    }

    /// True if there is only one frame, so that the clock has no step.
    pub(crate) fn is_single(&self) -> bool {
        self.initial == self.last
    }

    /// The clock of a frame, in single precision and rounded at each step as in POV-Ray. A single frame has the initial
    /// clock; in POV-Ray it is NaN.
    #[must_use]
    pub fn clock(&self, frame: u32) -> f64 {
        if self.is_single() {
            return f64::from(self.initial_clock);
        }
        let span = self.final_clock - self.initial_clock;
        let clock = self.initial_clock
            + single(frame - self.initial) * span / single(self.last - self.initial);
        f64::from(clock)
    }

    /// Read options with the frame variables of the scene.
    #[must_use]
    pub fn read_options_for(&self, frame: u32, read: &ReadOptions) -> ReadOptions {
        let delta = if self.is_single() {
            0.0
        } else {
            (self.final_clock - self.initial_clock) / single(self.last - self.initial)
        };
        ReadOptions {
            clock: self.clock(frame),
            clock_on: true,
            clock_delta: six_digits(delta),
            frame_number: frame,
            initial_frame: self.initial,
            final_frame: self.last,
            initial_clock: six_digits(self.initial_clock),
            final_clock: six_digits(self.final_clock),
            ..read.clone()
        }
    }

    /// The file name of a frame: the number, with as many digits as the last frame's, goes before the ending.
    #[must_use]
    pub fn path(&self, frame: u32, path: &Path) -> PathBuf {
        let digits = self.last.to_string().len();
        let mut name = path.file_stem().unwrap_or_default().to_os_string();
        name.push(format!("{frame:0digits$}"));
        if let Some(ending) = path.extension() {
            name.push(".");
            name.push(ending);
        }
        path.with_file_name(name)
    }
}

/// The number of a frame; a value below 1 is a share of all frames, counted from 0 even where the first has another
/// number.
fn subset(frame: f32, steps: u32) -> u32 {
    let frame = if frame < 1.0 {
        frame * (single(steps) + 1.0)
    } else {
        frame
    };
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is beyond the range is its end, and the fraction is meant to go"
    )]
    (frame.min(4e9) as u32)
}

/// A number of frames in single precision, as in POV-Ray.
fn single(frames: u32) -> f32 {
    #[allow(clippy::cast_precision_loss, reason = "POV-Ray loses it too")]
    (frames as f32)
}

/// A value after conversion to six digits of text, as scenes receive it.
fn six_digits(value: f32) -> f64 {
    format!("{:.5e}", f64::from(value)).parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(change: impl FnOnce(&mut Wanted)) -> Frames {
        let mut wanted = Wanted::default();
        change(&mut wanted);
        Frames::of(&wanted).expect("an animation")
    }

    #[test]
    fn a_picture_without_a_first_or_last_frame_is_still() {
        let with = |initial_frame, final_frame| {
            Frames::of(&Wanted {
                initial_frame,
                final_frame,
                subset_start: Some(2.0),
                ..Wanted::default()
            })
        };
        assert_eq!(with(None, None), None);
        assert_eq!(with(None, Some(0)), None);
        assert_eq!(with(Some(0), None), None);
        assert!(with(Some(1), None).is_some() && with(None, Some(-3)).is_some());
    }

    /// `+KFIa +KFFb +SFc +EFd`, `+KC`.
    #[test]
    fn the_frames_of_a_part_are_those_of_povray() {
        let all = |initial, last, start, end, is_cyclic| {
            frames(|w| {
                (w.initial_frame, w.final_frame) = (Some(initial), Some(last));
                (w.subset_start, w.subset_end) = (start, end);
                w.is_cyclic = is_cyclic;
            })
            .numbers()
        };
        for (initial, last, start, end, is_cyclic, expected) in [
            (1, 10, Some(9.0), Some(12.0), false, vec![9, 10, 11, 12]),
            (1, 10, Some(0.3), Some(0.5), false, vec![3, 4, 5]),
            (1, 10, Some(0.25), Some(0.55), false, vec![2, 3, 4, 5]),
            (1, 10, Some(0.95), None, false, vec![9, 10]),
            (1, 100, Some(0.29), Some(0.29), false, vec![29]),
            (1, 100, Some(0.57), Some(0.58), false, vec![57, 58]),
            (1, 7, Some(0.5), Some(0.75), false, vec![3, 4, 5]),
            (0, 5, Some(0.5), None, false, vec![3, 4, 5]),
            (11, 20, Some(0.9), Some(12.0), false, vec![11, 12]),
            (11, 20, Some(0.7), Some(0.8), false, vec![11]),
            (11, 20, Some(2.0), Some(12.0), false, vec![11, 12]),
            (1, 10, Some(8.0), Some(5.0), false, vec![8]),
            (1, 10, Some(2.7), Some(4.9), false, vec![2, 3, 4]),
            (1, 10, Some(11.0), None, false, vec![11]),
            (1, 10, Some(-0.5), Some(2.0), false, vec![1, 2]),
            (1, 3, None, Some(0.0), false, vec![1]),
            (1, 4, None, Some(1.0), false, vec![1]),
            (1, 3, None, None, true, vec![1, 2, 3]),
            (1, 2, Some(3.0), None, true, vec![3]),
            (1, 9, Some(0.95), None, true, vec![9]),
            (1, 3, None, Some(0.9), true, vec![1, 2, 3]),
            (3, 2, None, None, false, vec![3]),
            (-2, 2, None, None, false, vec![0, 1, 2]),
        ] {
            let actual = all(initial, last, start, end, is_cyclic);
            assert_eq!(actual, expected, "{initial} {last} {start:?} {end:?}");
        }
        let by_twos = |start| {
            frames(|w| {
                (w.final_frame, w.subset_start, w.step) = (Some(6), start, 2);
            })
            .numbers()
        };
        assert_eq!(by_twos(None), [1, 3, 5]);
        assert_eq!(by_twos(Some(2.0)), [2, 4, 6]);
    }

    /// Values of `clock` by `str(clock, 0, 18)`.
    #[test]
    fn clocks_have_the_rounding_of_povray() {
        for (from, to, first, last, frame, expected) in [
            (0.1, 0.7, 1, 8, 3, 0.271_428_555_250_167_85),
            (0.1, 0.7, 1, 8, 4, 0.357_142_835_855_484),
            (0.0, 1.0, 1, 31, 15, 0.466_666_668_653_488_16),
            (0.0, 1.0, 1, 10, 12, 1.222_222_208_976_745_6),
            (0.0, 1.0, 1, 1000, 2, 0.001_001_000_986_434_519),
            (0.0, 1.0, 1, 100, 99, 0.989_898_979_663_848_9),
            (0.123_456_79, 1.987_654_3, 1, 3, 2, 1.055_555_582_046_508_8),
            (0.0, 1.0, 11, 20, 16, 0.555_555_582_046_508_8),
        ] {
            let frames = frames(|w| {
                (w.initial_clock, w.final_clock) = (from, Some(to));
                (w.initial_frame, w.final_frame) = (Some(first), Some(last));
            });
            assert!((frames.clock(frame) - expected).abs() < 1e-17, "{frame}");
        }
    }

    #[test]
    fn values_in_scenes_have_six_digits() {
        let values = |from, to, last, is_cyclic| {
            let frames = frames(|w| {
                (w.initial_clock, w.final_clock) = (from, Some(to));
                (w.final_frame, w.is_cyclic) = (Some(last), is_cyclic);
            });
            let read = frames.read_options_for(1, &ReadOptions::default());
            let frames = (read.initial_frame, read.final_frame);
            (
                frames,
                read.clock_delta,
                read.initial_clock,
                read.final_clock,
            )
        };
        assert_eq!(
            values(0.0, 1.0, 31, false),
            ((1, 31), 0.033_333_3, 0.0, 1.0)
        );
        assert_eq!(
            values(0.123_456_79, 1.987_654_3, 3, false),
            ((1, 3), 0.932_099, 0.123_457, 1.987_65)
        );
        assert_eq!(values(2.0, 5.0, 3, true), ((1, 4), 1.0, 2.0, 5.0));
        assert_eq!(values(3.0, 1.0, 1, false), ((1, 1), 0.0, 3.0, 1.0));
    }

    #[test]
    fn pictures_are_numbered_with_the_digits_of_the_last_frame() {
        for (last, is_cyclic, frame, path, expected) in [
            (3, false, 2, "s.png", "s2.png"),
            (10, false, 9, "s.png", "s09.png"),
            (9, true, 9, "s.png", "s09.png"),
            (99, true, 99, "s.png", "s099.png"),
            (10, false, 11, "o/x.png", "o/x11.png"),
            (1000, false, 2, "s.png", "s0002.png"),
            (3, false, 1, "name.tga.png", "name.tga1.png"),
            (3, false, 1, "name.png.tga", "name.png1.tga"),
            (3, false, 1, "a7.png", "a71.png"),
            (10, false, 120, "s.png", "s120.png"),
        ] {
            let frames = frames(|w| (w.final_frame, w.is_cyclic) = (Some(last), is_cyclic));
            assert_eq!(frames.path(frame, Path::new(path)), Path::new(expected));
        }
    }
}
