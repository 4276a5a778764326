//! Values of options: numbers, flags, names, file types.

use std::path::PathBuf;
use std::time::Duration;

use super::error::CliError;
use super::raw_args::RawArgs;
use crate::base::color::Gamma;
use crate::output::{self, Format};

/// The longest side of a picture. A film of that width and one row is 16 MiB.
const LONGEST_SIDE: f64 = 1_048_576.0;

/// A value without the quotes around it.
pub(crate) fn unquoted(value: &str) -> &str {
    let value = value.trim();
    ['"', '\'']
        .iter()
        .find_map(|&quote| value.strip_prefix(quote)?.strip_suffix(quote))
        .unwrap_or(value)
}

/// A number in decimal notation.
pub(crate) fn number(value: &str, word: &str) -> Result<f64, CliError> {
    let parsed = value.parse().ok();
    parsed
        .filter(|v: &f64| v.is_finite())
        .ok_or_else(|| no_number(value, word))
}

/// The error of a value that is no number.
pub(crate) fn no_number(value: &str, word: &str) -> CliError {
    let shown_value = match value {
        "" => "nothing".to_owned(),
        text => format!("`{text}`"),
    };
    CliError::new(format!("`{word}` needs a number, found {shown_value}"))
}

/// A number truncated to an integer, as in POV-Ray. Not negative.
pub(crate) fn whole(value: &str, word: &str) -> Result<u32, CliError> {
    let v = number(value, word)?;
    if !(0.0..=f64::from(u32::MAX)).contains(&v) {
        return Err(CliError::new(format!(
            "`{word}` needs a number from 0 to {}",
            u32::MAX
        )));
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "in range, and the fraction is meant to go"
    )]
    Ok(v as u32)
}

/// An error in steps of 1/255.
pub(crate) fn error(value: &str, word: &str) -> Result<f64, CliError> {
    match number(value, word)? {
        error if error > 0.0 => Ok(error),
        other => Err(
            CliError::new(format!("`{word}`: an error is above 0, found {other}"))
                .with_hint("Write the error of a pixel in steps of 1/255, like `--error 0.5`."),
        ),
    }
}

/// A number of bytes: `500M`, `4G`, `1T`.
pub(crate) fn bytes(value: &str, word: &str) -> Result<u64, CliError> {
    let (text, unit) = [
        ('K', 1_u64 << 10),
        ('M', 1 << 20),
        ('G', 1 << 30),
        ('T', 1 << 40),
    ]
    .iter()
    .find_map(|&(end, unit)| Some((value.strip_suffix([end, end.to_ascii_lowercase()])?, unit)))
    .unwrap_or((value, 1));
    whole(text, word).map(|number| u64::from(number) * unit)
}

/// A length of time: `10s`, `500ms`, `2m`, `1h`, or a number of seconds.
pub(crate) fn duration(value: &str, word: &str) -> Result<Duration, CliError> {
    let (text, unit) = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("h", 3600.0)]
        .iter()
        .find_map(|&(end, unit)| Some((value.strip_suffix(end)?, unit)))
        .unwrap_or((value, 1.0));
    number(text.trim(), word)
        .ok()
        .filter(|&n| n >= 0.0)
        .and_then(|n| Duration::try_from_secs_f64(n * unit).ok())
        .ok_or_else(|| {
            CliError::new(format!("`{word}` needs a length of time, found `{value}`"))
                .with_hint("Write it like 10s, 500ms, 2m or 1h.")
        })
}

/// A side of the picture in pixels.
pub(crate) fn size(value: &str, word: &str) -> Result<u32, CliError> {
    let v = number(value, word)?;
    if !(1.0..=LONGEST_SIDE).contains(&v) {
        return Err(CliError::new(format!(
            "`{word}` needs a size from 1 to {LONGEST_SIDE} pixels"
        )));
    }
    whole(value, word)
}

/// On or off. POV-Ray treats unknown words as off; so does this program, with a warning.
pub(crate) fn flag(raw_args: &mut RawArgs, value: &str, word: &str) -> bool {
    match value.to_ascii_lowercase().as_str() {
        "on" | "yes" | "true" | "1" => true,
        "off" | "no" | "false" | "0" => false,
        other => {
            raw_args.doubts.push(format!(
                "`{word}` is taken for off: `{other}` is neither on nor off"
            ));
            false
        }
    }
}

/// A name that is not empty.
pub(crate) fn name(value: &str, word: &str) -> Result<String, CliError> {
    if value.is_empty() {
        return Err(CliError::new(format!("`{word}` names no file")));
    }
    Ok(value.to_owned())
}

/// The path of a name that is not empty.
pub(crate) fn path(value: &str, word: &str) -> Result<PathBuf, CliError> {
    name(value, word).map(PathBuf::from)
}

/// A letter of `+F`, as for `Output_File_Type`. POV-Ray ignores all but the first.
pub(crate) fn file_type(raw_args: &mut RawArgs, value: &str, word: &str) -> Result<(), CliError> {
    let letter = value.chars().next().unwrap_or(' ');
    raw_args.format = Some(format_of(letter).ok_or_else(|| no_type(word))?);
    Ok(())
}

/// The value of `+F`: a letter, bits a channel, `g` for grey.
pub(crate) fn file_type_switch(
    raw_args: &mut RawArgs,
    text: &str,
    word: &str,
) -> Result<(), CliError> {
    let mut rest = text.chars();
    let format = rest
        .next()
        .and_then(format_of)
        .ok_or_else(|| no_type(word))?;
    let rest = rest.as_str().to_ascii_lowercase();
    // POV-Ray 3.7 reads no number beside the `g`, 3.8 one behind it.
    let without = rest.strip_prefix('g').or_else(|| rest.strip_suffix('g'));
    let is_grey = without.is_some();
    let digits = without.unwrap_or(&rest);
    let bits = match digits {
        "" => None,
        digits => Some(digits.parse::<u8>().map_err(|_| no_type(word))?),
    };
    let is_refused = raw_args.is_povray && bits.is_some() && is_grey;
    if (is_grey && !format.has_grey) || is_refused {
        return Err(no_type(word));
    }
    let given = &mut raw_args.given;
    given.push(("Output_File_Type", format.letter.to_string()));
    given.extend(bits.map(|bits| ("Bits_Per_Color", bits.to_string())));
    if is_grey {
        given.push(("Grayscale_Output", "on".to_owned()));
    }
    raw_args.format = Some(format);
    raw_args.bits = bits;
    raw_args.grayscale = is_grey;
    Ok(())
}

/// The file type for an ending.
pub(crate) fn format_of_ending(ending: &str) -> Option<Format> {
    let ending = ending.to_ascii_lowercase();
    output::formats().find(|format| format.extensions.contains(&ending.as_str()))
}

/// `sRGB`, `BT709`, `BT2020` or the exponent of a power law.
pub(crate) fn file_gamma(value: &str, word: &str) -> Result<Gamma, CliError> {
    match value.to_ascii_lowercase().as_str() {
        "srgb" => return Ok(Gamma::Srgb),
        "bt709" => return Ok(Gamma::Bt709),
        "bt2020" => return Ok(Gamma::Bt2020),
        _ => {}
    }
    value
        .parse()
        .ok()
        .filter(|g| (0.01..=100.0).contains(g))
        .map(Gamma::power)
        .ok_or_else(|| {
            CliError::new(format!(
                "`{word}` needs `sRGB`, `BT709`, `BT2020` or a number greater than 0, found `{value}`"
            ))
        })
}

fn format_of(letter: char) -> Option<Format> {
    output::formats().find(|format| format.letter == letter.to_ascii_uppercase())
}

fn no_type(word: &str) -> CliError {
    let types: Vec<String> = output::formats()
        .map(|format| format!("{} is {}", format.letter, format.name))
        .collect();
    let types = types.join(", ");
    CliError::new(format!("`{word}` names no file type"))
        .with_hint(format!("{types}; N16 has 16 bits, Ng is grey."))
}
