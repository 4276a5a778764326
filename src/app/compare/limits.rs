//! Limits for the difference of two pictures, and their syntax in scenes.

use super::Comparison;
use std::fmt;

/// Limits for the difference of two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// No channel of any pixel may be off by more steps than this.
    pub channel: u16,
    /// At most this many pixels may differ at all, in percent.
    pub pixels: f64,
}

/// A comparison measured against limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Within both limits.
    Within,
    /// A channel is off by more steps than allowed.
    ChannelOff,
    /// More pixels differ than allowed.
    TooManyPixels,
}

/// Errors in a `compare:` comment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LimitError {
    /// A part is missing or malformed; holds the expected text and the actual one.
    Expected(&'static str, String),
    /// The reason is empty.
    NoReason,
}

impl Limits {
    /// The word after `//` that begins a scene's own limits.
    pub const COMMENT: &str = "compare:";

    /// The default for scenes without limits: one pixel in a thousand may be one step off.
    pub const DEFAULT: Limits = Limits {
        channel: 1,
        pixels: 0.1,
    };

    /// Reads what follows `compare:` in a comment: `channel<=2 pixels<=0.5% because "the reason"`.
    ///
    /// # Errors
    /// When the text has any other form, a number is out of range, or the reason is empty.
    pub fn from_comment(text: &str) -> Result<(Limits, String), LimitError> {
        let text = text.trim();
        let (channel, rest) = after(text, "channel<=")?;
        let channel = channel
            .parse()
            .map_err(|_| expected("a whole number after `channel<=`", channel))?;
        let (pixels, rest) = after(rest, "pixels<=")?;
        let percent = pixels
            .strip_suffix('%')
            .and_then(|number| number.parse().ok())
            .filter(|percent| (0.0..=100.0).contains(percent))
            .ok_or_else(|| expected("0 to 100 and `%` after `pixels<=`", pixels))?;
        let reason = rest
            .strip_prefix("because ")
            .and_then(|quoted| quoted.trim().strip_prefix('"')?.strip_suffix('"'))
            .ok_or_else(|| expected("`because \"the reason\"`", rest))?;
        if reason.trim().is_empty() {
            return Err(LimitError::NoReason);
        }
        let limits = Limits {
            channel,
            pixels: percent,
        };
        Ok((limits, reason.to_owned()))
    }

    /// Checks a comparison against the limits; the first broken one counts.
    #[must_use]
    pub fn verdict(&self, comparison: &Comparison) -> Verdict {
        if comparison.max() > f64::from(self.channel) {
            Verdict::ChannelOff
        } else if comparison.differing_percent() > self.pixels {
            Verdict::TooManyPixels
        } else {
            Verdict::Within
        }
    }
}

/// The word after `name` at the beginning of `text`, and the rest of the text.
fn after<'a>(text: &'a str, name: &'static str) -> Result<(&'a str, &'a str), LimitError> {
    let rest = text
        .strip_prefix(name)
        .ok_or_else(|| expected(name, text))?;
    let (word, rest) = rest.split_once(' ').unwrap_or((rest, ""));
    Ok((word, rest.trim_start()))
}

fn expected(what: &'static str, actual: &str) -> LimitError {
    LimitError::Expected(what, actual.to_owned())
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "channel<={} pixels<={}%", self.channel, self.pixels)
    }
}

impl fmt::Display for LimitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LimitError::Expected(what, actual) => {
                let comment = Limits::COMMENT;
                write!(f, "expected {what} in `{comment}`, found `{actual}`")
            }
            LimitError::NoReason => {
                let comment = Limits::COMMENT;
                write!(f, "`{comment}` needs a reason between the quotes")
            }
        }
    }
}

impl std::error::Error for LimitError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::compare::compare;
    use image::{Rgb, RgbImage};

    #[test]
    fn a_comment_gives_limits_and_reason() {
        let read =
            Limits::from_comment(" channel<=2 pixels<=0.5% because \"noise tables differ\" ");
        let limits = Limits {
            channel: 2,
            pixels: 0.5,
        };
        assert_eq!(read, Ok((limits, "noise tables differ".to_owned())));
    }

    #[test]
    fn malformed_comments_are_refused() {
        for text in [
            "",
            "channel<=2",
            "channel<=2 pixels<=0.5%",
            "channel<=2 pixels<=0.5 because \"no percent\"",
            "channel<=2 pixels<=101% because \"too much\"",
            "channel<=2 pixels<=NaN% because \"no number\"",
            "channel<=-1 pixels<=1% because \"negative\"",
            "channel <= 2 pixels <= 1% because \"blanks\"",
            "pixels<=1% channel<=2 because \"order\"",
            "channel<=2 pixels<=1% because \"open",
            "channel<=2 pixels<=1% because no quotes",
            "channel<=2 pixels<=1% because \"more\" after",
        ] {
            assert!(
                matches!(Limits::from_comment(text), Err(LimitError::Expected(_, _))),
                "{text}"
            );
        }
        assert_eq!(
            Limits::from_comment("channel<=2 pixels<=1% because \" \""),
            Err(LimitError::NoReason)
        );
    }

    #[test]
    fn each_limit_includes_its_last_value() {
        let expected = RgbImage::new(100, 10);
        let mut actual = expected.clone();
        actual.put_pixel(3, 3, Rgb([1, 0, 0]));
        let one = compare(&expected.clone().into(), &actual.clone().into()).unwrap();
        assert_eq!(Limits::DEFAULT.verdict(&one), Verdict::Within);
        actual.put_pixel(4, 3, Rgb([0, 1, 0]));
        let two = compare(&expected.clone().into(), &actual.clone().into()).unwrap();
        assert_eq!(Limits::DEFAULT.verdict(&two), Verdict::TooManyPixels);
        actual.put_pixel(4, 3, Rgb([0, 2, 0]));
        let far = compare(&expected.into(), &actual.into()).unwrap();
        assert_eq!(Limits::DEFAULT.verdict(&far), Verdict::ChannelOff);
    }
}
