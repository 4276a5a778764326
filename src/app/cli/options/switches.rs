//! POV-Ray's switches, and the option that each sets.
//!
//! Case is ignored; the longest matching name wins (`+KFF3` is not `+K`). `+` and `-` differ only where a switch turns
//! something on or off.

use super::as_povray;
use super::error::CliError;
use super::keys;
use super::raw_args::RawArgs;
use super::values::{file_type_switch, unquoted};

/// The syntax of a switch and its option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// `+X` or `-X`, without a value.
    Flag(&'static str),
    /// With a value.
    Value(&'static str),
    /// `+X` or `-X` for the first option, with or without a value for the second.
    Both(&'static str, &'static str),
    /// `+F`.
    FileType,
    /// Known, without effect, with any value.
    Idle,
}

use Form::{Both, FileType, Flag, Idle, Value};

const SWITCHES: &[(&str, Form)] = &[
    ("A", Both("Antialias", "Antialias_Threshold")),
    ("AC", Value("Antialias_Confidence")),
    ("AG", Value("Antialias_Gamma")),
    ("AM", Value("Sampling_Method")),
    ("B", Flag("Bounding")),
    ("BM", Value("Bounding_Method")),
    ("BS", Value("Render_Block_Size")),
    ("C", Flag("Continue_Trace")),
    ("CC", Flag("Create_Continue_Trace_Log")),
    ("D", Both("Display", "Palette")),
    ("EC", Value("End_Column")),
    ("EF", Value("Subset_End_Frame")),
    ("EP", Value("Preview_End_Size")),
    ("ER", Value("End_Row")),
    ("F", FileType),
    ("GA", Both("All_Console", "All_File")),
    ("GD", Both("Debug_Console", "Debug_File")),
    ("GF", Both("Fatal_Console", "Fatal_File")),
    ("GI", Value("Create_Ini")),
    ("GP", Idle),
    ("GR", Both("Render_Console", "Render_File")),
    ("GS", Both("Statistic_Console", "Statistic_File")),
    ("GW", Both("Warning_Console", "Warning_File")),
    ("H", Value("Height")),
    ("HI", Value("Include_Header")),
    ("HR", Flag("High_Reproducibility")),
    ("I", Value("Input_File_Name")),
    ("J", Both("Jitter", "Jitter_Amount")),
    ("K", Value("Clock")),
    ("KC", Flag("Cyclic_Animation")),
    ("KF", Value("Final_Clock")),
    ("KFF", Value("Final_Frame")),
    ("KFI", Value("Initial_Frame")),
    ("KI", Value("Initial_Clock")),
    ("L", Value("Library_Path")),
    ("MB", Both("Bounding", "Bounding_Threshold")),
    ("MI", Value("Max_Image_Buffer_Memory")),
    ("MV", Value("Version")),
    ("O", Value("Output_File_Name")),
    ("P", Flag("Pause_When_Done")),
    ("Q", Value("Quality")),
    ("R", Value("Antialias_Depth")),
    ("RF", Value("Radiosity_File_Name")),
    ("RFI", Flag("Radiosity_From_File")),
    ("RFO", Flag("Radiosity_To_File")),
    ("RP", Value("Render_Pattern")),
    ("RS", Value("Render_Block_Step")),
    ("RTR", Flag("Real_Time_Raytracing")),
    ("RVP", Flag("Radiosity_Vain_Pretrace")),
    ("SC", Value("Start_Column")),
    ("SF", Value("Subset_Start_Frame")),
    ("SP", Value("Preview_Start_Size")),
    ("SR", Value("Start_Row")),
    ("SS", Value("Stochastic_Seed")),
    ("SU", Flag("Split_Unions")),
    ("TH", Both("Dither", "Dither_Method")),
    ("UA", Flag("Output_Alpha")),
    ("UD", Flag("Draw_Vistas")),
    ("UF", Flag("Field_Render")),
    ("UL", Flag("Light_Buffer")),
    ("UO", Flag("Odd_Field")),
    ("UR", Flag("Remove_Bounds")),
    ("UV", Flag("Vista_Buffer")),
    ("V", Flag("Verbose")),
    ("W", Value("Width")),
    ("WL", Value("Warning_Level")),
    ("WT", Value("Work_Threads")),
    ("X", Both("Test_Abort", "Test_Abort_Count")),
];

/// The syntax of a switch, and the options that it sets: for help and completions.
pub(crate) struct Described {
    /// `+W`.
    pub(crate) name: String,
    /// The value: nothing, `<value>`, or `[value]`.
    pub(crate) value: &'static str,
    /// `Width`.
    pub(crate) sets: String,
}

/// All switches in alphabetical order.
pub(crate) fn described() -> impl Iterator<Item = Described> {
    SWITCHES.iter().map(|&(name, form)| {
        let (value, sets) = match form {
            Flag(key) => ("", format!("{key}: on with +, off with -")),
            Value(key) => ("<value>", key.to_owned()),
            Both(flag, value) => (
                "[value]",
                format!("{flag}: on with +, off with -; the value is {value}"),
            ),
            FileType => (
                "[type]",
                "Output_File_Type; -F: Output_To_File=off".to_owned(),
            ),
            Idle => ("[value]", "known, without effect".to_owned()),
        };
        Described {
            name: format!("+{name}"),
            value,
            sets,
        }
    })
}

/// The switch that sets an option: `+V`, `+W<value>`.
pub(crate) fn of_key(key: &str) -> Option<String> {
    SWITCHES.iter().find_map(|&(name, form)| match form {
        Flag(sets) | Both(sets, _) if sets == key => Some(format!("+{name}")),
        Value(sets) | Both(_, sets) if sets == key => Some(format!("+{name}<value>")),
        _ => None,
    })
}

/// The option that receives the value of a switch; empty for a switch without a value, `None` if this is not a switch.
pub(crate) fn key_of(word: &str) -> Option<&'static str> {
    let (form, _) = meaning(word.strip_prefix(['+', '-'])?)?;
    Some(match form {
        Value(key) | Both(_, key) => key,
        Flag(_) | FileType | Idle => "",
    })
}

/// Sets the option of a switch. `None` if this is not a switch.
pub(crate) fn set(raw_args: &mut RawArgs, word: &str) -> Option<Result<(), CliError>> {
    let body = word.strip_prefix(['+', '-'])?;
    let state = if word.starts_with('+') { "on" } else { "off" };
    let (form, text) = meaning(body)?;
    Some(match form {
        Flag(key) => keys::set(raw_args, key, state, word),
        Value(_) if text.is_empty() => Err(CliError::new(format!("`{word}` needs a value"))
            .with_hint("Write it after the switch without a space, like `+W320`.")),
        Value(key) => keys::set(raw_args, key, text, word),
        Both(flag, value) => keys::set(raw_args, flag, state, word).and_then(|()| match text {
            "" => Ok(()),
            text if value == "Antialias_Threshold" && raw_args.is_povray => {
                as_povray::check_threshold(text, word)?;
                keys::set(raw_args, value, text, word)
            }
            text => keys::set(raw_args, value, text, word),
        }),
        FileType => {
            raw_args.to_file = state == "on";
            raw_args.given.push(("Output_To_File", state.to_owned()));
            match text {
                "" => Ok(()),
                text => file_type_switch(raw_args, text, word),
            }
        }
        Idle => {
            raw_args.idle.push(word.to_owned());
            Ok(())
        }
    })
}

/// The switch at the beginning of a text, and its value. A flag has no value, a display has three letters.
fn meaning(body: &str) -> Option<(Form, &str)> {
    SWITCHES
        .iter()
        .filter_map(|&(name, form)| {
            let head = body.get(..name.len())?;
            let text = unquoted(&body[name.len()..]);
            let fits = head.eq_ignore_ascii_case(name)
                && match form {
                    Flag(_) => text.is_empty(),
                    Both("Display", _) => text.len() <= 3,
                    _ => true,
                };
            fits.then_some((name.len(), form, text))
        })
        .max_by_key(|&(length, ..)| length)
        .map(|(_, form, text)| (form, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_name_is_meant() {
        for (text, expected) in [
            ("KFF3", (Value("Final_Frame"), "3")),
            ("kf0.5", (Value("Final_Clock"), "0.5")),
            ("K0.5", (Value("Clock"), "0.5")),
            ("HIx.inc", (Value("Include_Header"), "x.inc")),
            ("h90", (Value("Height"), "90")),
            ("RFI", (Flag("Radiosity_From_File"), "")),
            ("RFI1.rca", (Value("Radiosity_File_Name"), "I1.rca")),
            ("Iv.pov", (Value("Input_File_Name"), "v.pov")),
            ("O\"a b.png\"", (Value("Output_File_Name"), "a b.png")),
        ] {
            assert_eq!(meaning(text), Some(expected), "{text}");
        }
        for text in ["Zz", "UA1", "V1", "nosuch", "display", "", "é"] {
            assert_eq!(meaning(text), None, "{text}");
        }
    }

    #[test]
    fn every_switch_sets_an_option_that_exists() {
        for (name, form) in SWITCHES {
            let named = match *form {
                Flag(key) | Value(key) => vec![key],
                Both(first, second) => vec![first, second],
                FileType | Idle => vec![],
            };
            for key in named {
                let value = if key == "Dither_Method" { "FS" } else { "1" };
                let refused = keys::set(&mut RawArgs::default(), key, value, name).err();
                assert!(refused.is_none(), "{name}: {refused:?}");
            }
        }
    }
}
