//! The options by their ini names: one list with the effect of each, and those without effect here.
//!
//! Switches are other names of these (see `switches`). The list is that of the POV-Ray 3.7 reference, checked against
//! the options that the program of 3.7.0.10 accepts, and the options that 3.8 added.

use super::as_povray;
use super::error::CliError;
use super::raw_args::{Output, RawArgs, Shellout, Unbuilt};
use super::values::{
    duration, error, file_gamma, file_type, flag, name, number, path, size, whole,
};
use crate::app::cli::options::output_kinds::Stream;
use crate::base::nearest::nearest;
use crate::base::options::Method;
use crate::output::DitherMethod;

/// The effect of an option with its value. The third text is the word as typed, for messages.
pub(crate) type Set = fn(&mut RawArgs, &str, &str) -> Result<(), CliError>;

/// Sets an option by its ini name.
pub(crate) fn set(
    raw_args: &mut RawArgs,
    key: &str,
    value: &str,
    word: &str,
) -> Result<(), CliError> {
    match KEYS.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)) {
        Some((name, set)) => {
            let value = match raw_args.is_povray {
                true => as_povray::value(name, value, word)?,
                false => value.to_owned(),
            };
            set(raw_args, &value, word)?;
            raw_args.given.push((name, value));
            Ok(())
        }
        None => {
            let refusal = CliError::new(format!("unknown option `{key}`"));
            Err(match nearest(key, KEYS.iter().map(|(name, _)| *name)) {
                Some(near) => refusal.with_hint(format!("Did you mean `{near}`?")),
                None => refusal.with_hint("`povr --help` tells which options there are."),
            })
        }
    }
}

/// Known, without effect on this program; reported in verbose mode.
const IDLE: Set = |raw_args, _, word| {
    raw_args.idle.push(word.to_owned());
    Ok(())
};

/// Options for a display or a keyboard, which this program does not have.
const SCREEN: Set = |_, _, _| Ok(());

/// A program that POV-Ray would run once, if it were allowed to: see `conf`. Of the others it says nothing.
const SCENE_SHELLOUT: Set = |raw_args, value, word| shellout(raw_args, value, word, false);

/// The same for each frame.
const FRAME_SHELLOUT: Set = |raw_args, value, word| shellout(raw_args, value, word, true);

#[rustfmt::skip]
const KEYS: &[(&str, Set)] = &[
    ("All_Console", |t, v, s| { t.has_console = true; t.quiet = !flag(t, v, s); Ok(()) }),
    ("All_File", |t, v, _| { t.stream(Stream::All, v); Ok(()) }),
    ("Antialias", |t, v, s| { t.is_antialiased = flag(t, v, s); Ok(()) }),
    ("Antialias_Confidence", |t, v, s| { t.antialias.confidence = number(v, s)?.clamp(0.0, 1.0); Ok(()) }),
    ("Antialias_Depth", |t, v, s| { t.antialias.depth = u32::from(up_to(MAX_DEPTH, v, s)?.max(1)); Ok(()) }),
    ("Antialias_Error", |t, v, s| { t.error = Some(error(v, s)?); t.converge(); Ok(()) }),
    ("Antialias_Gamma", |t, v, s| { t.antialias.gamma = above_zero(v, s)?; Ok(()) }),
    ("Antialias_Threshold", |t, v, s| { t.antialias.threshold = number(v, s)?.clamp(0.0, 1.0); Ok(()) }),
    ("Antialias_Time", |t, v, s| { t.time = Some(duration(v, s)?); t.converge(); Ok(()) }),
    ("Append_File", IDLE),
    ("Bits_Per_Color", |t, v, s| { t.bits = Some(bits(v, s)?); Ok(()) }),
    ("Bits_Per_Colour", |t, v, s| { t.bits = Some(bits(v, s)?); Ok(()) }),
    ("Bounding", IDLE),
    ("Bounding_Method", IDLE),
    ("Bounding_Threshold", IDLE),
    ("BSP_BaseAccessCost", IDLE),
    ("BSP_ChildAccessCost", IDLE),
    ("BSP_ISectCost", IDLE),
    ("BSP_MaxDepth", IDLE),
    ("BSP_MissChance", IDLE),
    ("Clean_Cuts", |t, v, s| { t.has_clean_cuts = flag(t, v, s); Ok(()) }),
    ("Clock", |t, v, s| { t.clock = Some(f64::from(single(v, s)?)); Ok(()) }),
    ("Clockless_Animation", |t, v, s| { let on = flag(t, v, s); t.request(Unbuilt::Clockless, on, s); Ok(()) }),
    ("Compression", |t, v, s| { t.compression = Some(up_to(100, v, s)?); Ok(()) }),
    ("Continue_Trace", |t, v, s| { t.continues = flag(t, v, s); Ok(()) }),
    ("Create_Continue_Trace_Log", IDLE),
    ("Create_Ini", |t, v, s| { t.create_ini = Some(path(v, s)?); Ok(()) }),
    ("Cyclic_Animation", |t, v, s| { t.frames.is_cyclic = flag(t, v, s); Ok(()) }),
    ("Debug_Console", |t, v, s| { t.has_console = true; t.debugs = flag(t, v, s); Ok(()) }),
    ("Debug_File", |t, v, _| { t.stream(Stream::Debug, v); Ok(()) }),
    ("Declare", declare),
    ("Display", SCREEN),
    ("Display_Gamma", |_, v, s| file_gamma(v, s).map(drop)),
    ("Dither", |t, v, s| { t.is_dithered = flag(t, v, s); Ok(()) }),
    ("Dither_Method", dither_method),
    ("Draw_Vistas", IDLE),
    ("End_Column", |t, v, s| { t.end_column = Some(single(v, s)?); Ok(()) }),
    ("End_Row", |t, v, s| { t.end_row = Some(single(v, s)?); Ok(()) }),
    ("Fatal_Console", |t, v, s| { t.has_console = true; t.errors = flag(t, v, s); Ok(()) }),
    ("Fatal_Error_Command", IDLE),
    ("Fatal_Error_Return", IDLE),
    ("Fatal_File", |t, v, _| { t.stream(Stream::Fatal, v); Ok(()) }),
    ("Field_Render", |t, v, s| { let on = flag(t, v, s); t.request(Unbuilt::Fields, on, s); Ok(()) }),
    ("File_Gamma", |t, v, s| { t.file_gamma = Some(file_gamma(v, s)?); Ok(()) }),
    ("Final_Clock", |t, v, s| { t.frames.final_clock = Some(single(v, s)?); Ok(()) }),
    ("Final_Frame", |t, v, s| { t.frames.final_frame = Some(frame(v, s)?); Ok(()) }),
    ("Frame_Step", |t, v, s| { t.frames.step = frame(v, s)?; Ok(()) }),
    ("Grayscale_Output", |t, v, s| { t.grayscale = flag(t, v, s); Ok(()) }),
    ("Greyscale_Output", |t, v, s| { t.grayscale = flag(t, v, s); Ok(()) }),
    ("Height", |t, v, s| { t.height = size(v, s)?; Ok(()) }),
    ("High_Reproducibility", IDLE),
    ("Include_Header", |t, v, s| { t.include_header = Some(path(v, s)?); t.is_header_by_user = t.is_command_line; Ok(()) }),
    ("Initial_Clock", |t, v, s| { t.frames.initial_clock = single(v, s)?; Ok(()) }),
    ("Initial_Frame", |t, v, s| { t.frames.initial_frame = Some(frame(v, s)?); Ok(()) }),
    ("Input_File_Name", |t, v, s| { t.scene = Some(name(v, s)?); Ok(()) }),
    ("Jitter", |t, v, s| { t.is_jittered = flag(t, v, s); Ok(()) }),
    ("Jitter_Amount", |t, v, s| { t.antialias.jitter = number(v, s)?.clamp(0.0, 1.0); Ok(()) }),
    ("Library_Path", |t, v, s| { t.library_paths.push(path(v, s)?); Ok(()) }),
    ("Library_Path_38", |t, v, s| { t.library_paths_of_3_8.push(path(v, s)?); Ok(()) }),
    ("Light_Buffer", IDLE),
    ("Max_Image_Buffer_Memory", IDLE),
    ("Odd_Field", |t, v, s| { let on = flag(t, v, s); t.request(Unbuilt::OddField, on, s); Ok(()) }),
    ("Output_Alpha", |t, v, s| { t.alpha = flag(t, v, s); Ok(()) }),
    ("Output_File_Name", |t, v, s| { t.output = Output::Povray(name(v, s)?); Ok(()) }),
    ("Output_File_Type", |t, v, s| file_type(t, v, s)),
    ("Output_To_File", |t, v, s| { t.to_file = flag(t, v, s); Ok(()) }),
    ("Palette", SCREEN),
    ("Pause_When_Done", SCREEN),
    ("Post_Frame_Command", FRAME_SHELLOUT),
    ("Post_Frame_Return", IDLE),
    ("Post_Scene_Command", IDLE),
    ("Post_Scene_Return", IDLE),
    ("Pre_Frame_Command", FRAME_SHELLOUT),
    ("Pre_Frame_Return", IDLE),
    ("Pre_Scene_Command", SCENE_SHELLOUT),
    ("Pre_Scene_Return", IDLE),
    ("Preview_End_Size", SCREEN),
    ("Preview_Start_Size", SCREEN),
    ("Quality", |t, v, s| { t.quality = up_to(11, v, s)?; Ok(()) }),
    ("Radiosity_File_Name", IDLE),
    ("Radiosity_From_File", |t, v, s| { let on = flag(t, v, s); t.request(Unbuilt::SavedRadiosity, on, s); Ok(()) }),
    ("Radiosity_To_File", |t, v, s| { let on = flag(t, v, s); t.request(Unbuilt::SavedRadiosity, on, s); Ok(()) }),
    ("Radiosity_Vain_Pretrace", IDLE),
    ("Real_Time_Raytracing", IDLE),
    ("Remove_Bounds", IDLE),
    ("Render_Block_Size", IDLE),
    ("Render_Block_Step", IDLE),
    ("Render_Console", |t, v, s| { t.has_console = true; t.renders = flag(t, v, s); Ok(()) }),
    ("Render_File", |t, v, _| { t.stream(Stream::Render, v); Ok(()) }),
    ("Render_Pattern", IDLE),
    ("Sampling_Method", method),
    ("Split_Unions", IDLE),
    ("Start_Column", |t, v, s| { t.start_column = Some(single(v, s)?); Ok(()) }),
    ("Start_Row", |t, v, s| { t.start_row = Some(single(v, s)?); Ok(()) }),
    ("Statistic_Console", |t, v, s| { t.has_console = true; t.statistics = flag(t, v, s); Ok(()) }),
    ("Statistic_File", |t, v, _| { t.stream(Stream::Statistics, v); Ok(()) }),
    ("Stochastic_Seed", IDLE),
    ("Subset_End_Frame", |t, v, s| { t.frames.subset_end = Some(single(v, s)?); Ok(()) }),
    ("Subset_Start_Frame", |t, v, s| { t.frames.subset_start = Some(single(v, s)?); Ok(()) }),
    ("Test_Abort", SCREEN),
    ("Test_Abort_Count", SCREEN),
    ("User_Abort_Command", IDLE),
    ("User_Abort_Return", IDLE),
    ("Verbose", |t, v, s| { t.verbose = Some(flag(t, v, s)); Ok(()) }),
    ("Version", |t, v, s| { t.version = Some(number(v, s)?); Ok(()) }),
    ("Video_Mode", SCREEN),
    ("Vista_Buffer", IDLE),
    ("Warning_Console", |t, v, s| { t.has_console = true; t.warnings = flag(t, v, s); Ok(()) }),
    ("Warning_File", |t, v, _| { t.stream(Stream::Warning, v); Ok(()) }),
    ("Warning_Level", |t, v, s| { t.warnings = number(v, s)? > 0.0; Ok(()) }),
    ("Width", |t, v, s| { t.width = size(v, s)?; Ok(()) }),
    ("Work_Threads", |t, v, s| { t.threads = Some(whole(v, s)? as usize).filter(|&n| n > 0); Ok(()) }),
];

/// POV-Ray's largest `+R`; larger values count as this.
const MAX_DEPTH: u8 = 9;

fn shellout(
    raw_args: &mut RawArgs,
    command: &str,
    word: &str,
    is_of_frames: bool,
) -> Result<(), CliError> {
    let program = command.split_whitespace().next();
    raw_args.shellouts.extend(program.map(|program| Shellout {
        program: program.to_owned(),
        is_of_frames,
    }));
    IDLE(raw_args, command, word)
}

fn above_zero(value: &str, word: &str) -> Result<f64, CliError> {
    match number(value, word)? {
        gamma if gamma > 0.0 && gamma.is_finite() => Ok(gamma),
        other => Err(CliError::new(format!(
            "`{word}`: a gamma is above 0, found {other}"
        ))),
    }
}

/// Method 4 exists only in this program and turns antialiasing on.
fn method(raw_args: &mut RawArgs, value: &str, word: &str) -> Result<(), CliError> {
    raw_args.converges = false;
    match whole(value, word)? {
        1 => raw_args.antialias.method = Method::One,
        2 => raw_args.antialias.method = Method::Two,
        3 => raw_args.antialias.method = Method::Three,
        4 => raw_args.converge(),
        other => {
            return Err(CliError::new(format!(
                "`{word}`: there is no sampling method {other}; there are 1 to 4"
            ))
            .with_hint("4 samples until the error is small, see `--error`."));
        }
    }
    Ok(())
}

/// A value of a small scale; as in POV-Ray, values beyond it are clamped.
fn up_to(most: u8, value: &str, word: &str) -> Result<u8, CliError> {
    let value = number(value, word)?.clamp(0.0, f64::from(most));
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=most"
    )]
    Ok(value as u8)
}

fn bits(value: &str, word: &str) -> Result<u8, CliError> {
    up_to(32, value, word)
}

/// A number in single precision, as in POV-Ray: a clock, a pixel, or a share of the picture.
fn single(value: &str, word: &str) -> Result<f32, CliError> {
    #[allow(clippy::cast_possible_truncation, reason = "POV-Ray rounds so")]
    let single = number(value, word)? as f32;
    if single.is_finite() {
        Ok(single)
    } else {
        Err(CliError::new(format!("`{word}`: this number is too large")))
    }
}

/// A frame number without its fraction; negative values count as 0 where it matters.
fn frame(value: &str, word: &str) -> Result<i64, CliError> {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "beyond the range is its end"
    )]
    number(value, word).map(|frame| frame as i64)
}

fn dither_method(raw_args: &mut RawArgs, value: &str, word: &str) -> Result<(), CliError> {
    let is_known = |method: DitherMethod| !raw_args.is_povray || method.is_of_3_7();
    let methods = || {
        DitherMethod::ALL
            .iter()
            .filter(|(_, method)| is_known(*method))
    };
    if let Some((_, method)) = methods().find(|(name, _)| name.eq_ignore_ascii_case(value)) {
        raw_args.dither = Some(*method);
        return Ok(());
    }
    let names: Vec<&str> = methods().map(|(name, _)| *name).collect();
    let methods = names.join(", ");
    Err(CliError::new(format!(
        "`{word}`: there is no method `{value}` of dithering; there are {methods}"
    )))
}

fn declare(raw_args: &mut RawArgs, value: &str, word: &str) -> Result<(), CliError> {
    let done = declare_number(raw_args, value, word);
    match done {
        // A text in quotes is an error in POV-Ray too.
        Err(_) if raw_args.is_povray && !value.contains('"') => {
            declare_as_povray(raw_args, value, word);
            Ok(())
        }
        done => done,
    }
}

/// Declares what POV-Ray declares for a text that is no number: its beginning, as C's `strtod` reads it, or 0. Without
/// a name or a value there is nothing to declare.
fn declare_as_povray(raw_args: &mut RawArgs, text: &str, word: &str) {
    let (name, value) = text.split_once('=').unwrap_or((text, ""));
    let doubt = if value.is_empty() || !is_identifier(name) {
        format!("`{word}` declares nothing")
    } else {
        let value = as_povray::leading_number(value).unwrap_or(0.0);
        raw_args.declares.retain(|(declared, _)| declared != name);
        raw_args.declares.push((name.to_owned(), value));
        format!("`{word}` is no number: it declares {value}")
    };
    raw_args.doubts.push(doubt);
}

fn is_identifier(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn declare_number(raw_args: &mut RawArgs, value: &str, word: &str) -> Result<(), CliError> {
    let example = || {
        CliError::new(format!("`{word}` declares no number"))
            .with_hint("Write `Declare=Name=2.5`, without spaces around the name.")
    };
    let (name, value) = value.split_once('=').ok_or_else(example)?;
    let name = name.trim();
    let value: f64 = value.trim().parse().map_err(|_| example())?;
    if !is_identifier(name) || !value.is_finite() {
        return Err(example());
    }
    raw_args.declares.retain(|(declared, _)| declared != name);
    raw_args.declares.push((name.to_owned(), value));
    Ok(())
}

/// The names of all options in alphabetical order, and true for options with an effect on this program.
pub(crate) fn names() -> impl Iterator<Item = (&'static str, bool)> {
    KEYS.iter().map(|&(name, set)| (name, acts(set)))
}

/// True if an option ever changes the settings, or is refused.
fn acts(set: Set) -> bool {
    ["on", "off", "0", "1", "2", "0.5", "A=1", "FS", "x"]
        .iter()
        .any(|value| {
            let mut raw_args = RawArgs::default();
            let done = set(&mut raw_args, value, "");
            raw_args.idle.clear();
            raw_args.shellouts.clear();
            raw_args.has_console = false;
            done.is_err() || raw_args != RawArgs::default()
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_is_sorted_and_without_doubles() {
        let names: Vec<String> = KEYS.iter().map(|(n, _)| n.to_ascii_lowercase()).collect();
        assert!(names.windows(2).all(|pair| pair[0] < pair[1]), "{names:?}");
    }

    #[test]
    fn a_misspelt_option_names_its_neighbour() {
        let refused = set(&mut RawArgs::default(), "Widht", "3", "Widht=3").unwrap_err();
        assert_eq!(
            refused.to_string(),
            "unknown option `Widht`\n  hint: Did you mean `Width`?"
        );
        let refused = set(&mut RawArgs::default(), "Foo", "3", "Foo=3").unwrap_err();
        assert_eq!(
            refused.to_string(),
            "unknown option `Foo`\n  hint: `povr --help` tells which options there are."
        );
    }

    #[test]
    fn a_declared_name_keeps_its_last_value() {
        let mut raw_args = RawArgs::default();
        for text in ["A=1", "b_2= -1.5e3", "A=2"] {
            set(&mut raw_args, "Declare", text, text).unwrap();
        }
        assert_eq!(
            raw_args.declares,
            [("b_2".to_owned(), -1500.0), ("A".to_owned(), 2.0)]
        );
        for text in ["A", "A=x", "2=3", "=4", "A=", "A=\"x\"", "A=inf"] {
            let refused = set(&mut raw_args, "Declare", text, &format!("Declare={text}"));
            assert_eq!(
                refused.unwrap_err().to_string(),
                format!(
                    "`Declare={text}` declares no number\n  hint: Write `Declare=Name=2.5`, without spaces around the name."
                )
            );
        }
    }

    #[test]
    fn values_beyond_a_scale_are_clamped() {
        let mut raw_args = RawArgs::default();
        set(&mut raw_args, "Quality", "12", "+Q12").unwrap();
        assert_eq!(raw_args.quality, 11);
        set(&mut raw_args, "quality", "-1", "+Q-1").unwrap();
        assert_eq!(raw_args.quality, 0);
    }

    #[test]
    fn under_the_name_of_povray_a_text_declares_its_leading_number() {
        // Measured with povray 3.7.0.10.
        for (text, expected) in [
            ("A=text", Some(0.0)),
            ("A=1,2", Some(1.0)),
            ("A=0x10", Some(16.0)),
            ("A=-1.5e1xyz", Some(-15.0)),
            ("A=true", Some(0.0)),
            ("A=", None),
            ("A", None),
            ("1a=2", None),
        ] {
            let mut raw_args = RawArgs {
                is_povray: true,
                ..RawArgs::default()
            };
            set(&mut raw_args, "Declare", text, text).unwrap();
            let value = raw_args.declares.first().map(|(_, value)| *value);
            assert_eq!(value, expected, "{text}");
            assert_eq!(raw_args.doubts.len(), 1, "{text}");
        }
    }
}
