//! Values as POV-Ray 3.7 reads them, under its name.
//!
//! A value begins with a number, as C's `strtol` or `strtod` reads it; what follows the number is ignored, a value
//! without one is refused. Measured with povray 3.7.0.10 by what `Create_Ini` writes.

use super::error::CliError;
use super::values::{no_number, number};

/// The options with whole numbers.
const WHOLE: [&str; 23] = [
    "Antialias_Depth",
    "BSP_MaxDepth",
    "Bits_Per_Color",
    "Bits_Per_Colour",
    "Bounding_Method",
    "Bounding_Threshold",
    "Compression",
    "Final_Frame",
    "Frame_Step",
    "Height",
    "Initial_Frame",
    "Max_Image_Buffer_Memory",
    "Preview_End_Size",
    "Preview_Start_Size",
    "Quality",
    "Render_Block_Size",
    "Render_Block_Step",
    "Render_Pattern",
    "Sampling_Method",
    "Test_Abort_Count",
    "Warning_Level",
    "Width",
    "Work_Threads",
];

/// The options with numbers that may have a fraction.
const REAL: [&str; 17] = [
    "Antialias_Gamma",
    "Antialias_Threshold",
    "BSP_BaseAccessCost",
    "BSP_ChildAccessCost",
    "BSP_ISectCost",
    "BSP_MissChance",
    "Clock",
    "End_Column",
    "End_Row",
    "Final_Clock",
    "Initial_Clock",
    "Jitter_Amount",
    "Start_Column",
    "Start_Row",
    "Subset_End_Frame",
    "Subset_Start_Frame",
    "Version",
];

/// POV-Ray's smallest block; it refuses smaller ones.
const SMALLEST_BLOCK: f64 = 4.0;

/// The part of an option's value that counts.
///
/// # Errors
/// When the option needs a number, and the value does not begin with one.
pub(crate) fn value(key: &str, value: &str, word: &str) -> Result<String, CliError> {
    let read = if WHOLE.contains(&key) {
        leading_digits(value).map(str::to_owned)
    } else if REAL.contains(&key) {
        leading_number(value).map(|number| number.to_string())
    } else {
        return Ok(value.to_owned());
    };
    let read = read.ok_or_else(|| no_number(value, word))?;
    if key == "Render_Block_Size" && number(&read, word)? < SMALLEST_BLOCK {
        return Err(CliError::new(format!(
            "`{word}`: a block has at least {SMALLEST_BLOCK} pixels on a side"
        )));
    }
    Ok(read)
}

/// Refuses what POV-Ray refuses as a threshold after `+A`: all but `0.` and a digit.
pub(crate) fn check_threshold(text: &str, word: &str) -> Result<(), CliError> {
    let fraction = text.trim_start_matches('0').strip_prefix('.');
    let is_below_one = text.starts_with('0')
        && fraction.is_some_and(|digits| digits.starts_with(|c: char| c.is_ascii_digit()));
    match is_below_one {
        true => Ok(()),
        false => Err(CliError::new(format!(
            "`{word}` needs a threshold below 1, like `+A0.3`"
        ))),
    }
}

/// The sign and digits at the beginning of a text.
fn leading_digits(text: &str) -> Option<&str> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let length = digits.find(|c: char| !c.is_ascii_digit());
    let length = length.unwrap_or(digits.len());
    (length > 0).then(|| &text[..text.len() - digits.len() + length])
}

/// The finite number at the beginning of a text.
pub(crate) fn leading_number(text: &str) -> Option<f64> {
    let text = text.trim_start();
    let lower = text.to_ascii_lowercase();
    if let Some(digits) = lower.strip_prefix("0x") {
        let end = digits.find(|c: char| !c.is_ascii_hexdigit());
        let digits = &digits[..end.unwrap_or(digits.len())];
        return Some(u32::from_str_radix(digits, 16).map_or(0.0, f64::from));
    }
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    let end = text.find(|c| !is_number(c)).unwrap_or(text.len());
    let beginnings = (1..=end).rev().map(|end| text[..end].parse());
    beginnings.flatten().find(|number: &f64| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_at_the_beginning_counts() {
        for (key, text, expected) in [
            ("Width", "12abc", Some("12")),
            ("Width", "1e1", Some("1")),
            ("Width", "+3,4", Some("+3")),
            ("Width", "-1", Some("-1")),
            ("Width", ".3", None),
            ("Width", "", None),
            ("Clock", "2,3", Some("2")),
            ("Clock", ".3", Some("0.3")),
            ("Clock", "1e1", Some("10")),
            ("Clock", "0x10", Some("16")),
            ("Clock", "x", None),
            ("Render_Block_Size", "4", Some("4")),
            ("Render_Block_Size", "3", None),
            ("Output_File_Type", "N8", Some("N8")),
        ] {
            let value = value(key, text, "word").ok();
            assert_eq!(value.as_deref(), expected, "{key}={text}");
        }
    }

    #[test]
    fn a_threshold_after_its_switch_is_below_one() {
        for (text, is_right) in [
            ("0.3", true),
            ("0.3,2", true),
            ("0.3abc", true),
            ("00.3", true),
            (".3", false),
            ("0", false),
            ("0.", false),
            ("1.5", false),
            ("-0.3", false),
        ] {
            assert_eq!(check_threshold(text, "+A").is_ok(), is_right, "{text}");
        }
    }
}
