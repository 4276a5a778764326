//! `povr sheet`: renders a shape under all transforms, each as a scene and a picture, with a contact sheet as a picture
//! and as a page. Where POV-Ray is installed every picture is compared with POV-Ray's, unless that is 3.7 and lacks the
//! shape.
//!
//! Exit code 0: all pictures are there and agree; 1: some do not; 2: the command line is wrong.

mod contact;
mod judge;
mod scene;
mod shapes;
mod transforms;

use crate::app::cli::options::command_line;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use rayon::prelude::*;

use self::judge::{Comparer, Verdict};
use self::scene::Subject;
use self::shapes::{HEIGHTS, SHAPES};
use self::transforms::Move;
use super::Command;
use super::draw::report::say;
use super::draw::{self, Request};
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options::Size;

pub(super) const COMMAND: Command = Command {
    name: "sheet",
    about: "draw a shape under all transforms, with a contact sheet",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Draws a shape under all transforms and makes contact sheets.
#[derive(Debug, Parser)]
#[command(
    name = "povr sheet",
    help_template = super::HELP_TEMPLATE,
    before_help = "\
Examples:
  povr sheet torus                         writes sheet/torus/sheet.html
  povr sheet mine.pov --object Chair       an object of a file of your own",
    after_help = "\
In DIR a folder for each shape gets a scene and a picture for each transform, `overview.pov` with all of them, \
`sheet.png` and `sheet.html`. x is red, y is green, z is blue.
Exit code 0: all pictures agree with POV-Ray's, or it is not installed; 1: some do not; 2: the command line is at fault."
)]
struct CommandOptions {
    /// A primitive or combination by its word, `all`, or a file with an object or the declaration of one
    shape: String,
    /// Size of each picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "320x240")]
    size: Size,
    /// The folder to write to; it is made if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "sheet")]
    output: PathBuf,
    /// Object to draw when SHAPE is a file that declares several
    #[arg(long, value_name = "NAME")]
    object: Option<String>,
    /// Draw only the scene that holds all transforms
    #[arg(long)]
    overview: bool,
    /// Do not compare with POV-Ray
    #[arg(long)]
    alone: bool,
}

/// A picture of a sheet.
struct Entry {
    folder: PathBuf,
    of: Move,
    verdict: Verdict,
}

/// The scene of all transforms, and the factor by which it is larger than the others.
const OVERVIEW: (&str, u32) = ("overview", 2);
/// Pictures at once for each processor: POV-Ray spends most of the time of a small picture asleep.
const AT_ONCE: usize = 8;

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let name = std::iter::once("povr sheet".to_owned());
    let options = match CommandOptions::try_parse_from(name.chain(arguments.iter().cloned())) {
        Ok(options) => options,
        Err(error) => {
            say(command_line::printed::<CommandOptions>(&error)?.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let subjects = subjects(&options)?;
    let comparer = (!options.alone).then(Comparer::find).flatten();
    if comparer.is_none() && !options.alone {
        say("povr: POV-Ray is not installed, so nothing is compared");
    }
    let mut pictures = Vec::new();
    for subject in &subjects {
        pictures.extend(drawn(&options, subject, environment)?);
    }
    let entries = compared(pictures, comparer.as_ref())?;
    let mut sheets = Vec::new();
    let mut wrong = 0;
    for (subject, entries) in subjects
        .iter()
        .zip(entries.chunk_by(|a, b| a.folder == b.folder))
    {
        let folder = options.output.join(&subject.name);
        let differing: Vec<&Entry> = entries
            .iter()
            .filter(|one| one.verdict.is_wrong())
            .collect();
        for entry in &differing {
            say(format_args!(
                "{}: {}: {}",
                subject.name, entry.of.name, entry.verdict
            ));
        }
        wrong += differing.len();
        say(format_args!(
            "{}: {} pictures, {} differ from POV-Ray's",
            subject.name,
            entries.len(),
            differing.len()
        ));
        contact::write(&folder, &subject.name, entries, options.size.0)?;
        sheets.push((subject.name.clone(), differing.len()));
    }
    if sheets.len() > 1 {
        contact::write_index(&options.output, &sheets)?;
    }
    Ok(if wrong == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// The requested shapes.
fn subjects(options: &CommandOptions) -> Result<Vec<Subject>, CliError> {
    let known: Vec<Subject> = SHAPES
        .iter()
        .filter(|sample| options.shape == "all" || options.shape == sample.name)
        .map(|sample| Subject {
            name: sample.name.to_owned(),
            declaration: format!("#declare Shape = {}\n", sample.text),
            file: sample
                .text
                .contains(HEIGHTS.0)
                .then(|| (HEIGHTS.0.to_owned(), HEIGHTS.1.to_owned())),
        })
        .collect();
    if known.is_empty() {
        return Ok(vec![own(
            Path::new(&options.shape),
            options.object.as_deref(),
        )?]);
    }
    Ok(known)
}

/// The user's own object. The scenes get a copy of its file, so that their folder is complete.
fn own(path: &Path, object: Option<&str>) -> Result<Subject, CliError> {
    let stem = path.file_stem().filter(|_| path.is_file());
    let Some(stem) = stem.and_then(|stem| stem.to_str()) else {
        let names: Vec<&str> = SHAPES.iter().map(|sample| sample.name).collect();
        return Err(CliError::new(format!(
            "`{}` is neither a shape nor a file",
            path.display()
        ))
        .with_hint(format!("Shapes are {}, or `all`.", names.join(", "))));
    };
    let text = fs::read_to_string(path).map_err(|error| failed("read", path, &error))?;
    let (declaration, file) = match object {
        Some(name) => {
            let copy = format!("{stem}.inc");
            (
                format!("#include \"{copy}\"\n#declare Shape = object {{ {name} }}\n"),
                Some((copy, text)),
            )
        }
        None => (format!("#declare Shape = {text}\n"), None),
    };
    Ok(Subject {
        name: stem.to_owned(),
        declaration,
        file,
    })
}

/// A rendered picture of a shape.
struct Drawn {
    folder: PathBuf,
    of: Move,
    size: Size,
    needs_3_8: bool,
}

/// Writes and renders all pictures of one shape.
fn drawn(
    options: &CommandOptions,
    subject: &Subject,
    environment: &Environment,
) -> Result<Vec<Drawn>, CliError> {
    let folder = options.output.join(&subject.name);
    make_folder(&folder)?;
    if let Some((name, text)) = &subject.file {
        write(&folder.join(name), text)?;
    }
    let moves = transforms::all();
    let large = Size(options.size.0 * OVERVIEW.1, options.size.1 * OVERVIEW.1);
    let overview = Move {
        name: OVERVIEW.0.to_owned(),
        text: "all transforms".to_owned(),
    };
    let mut jobs = vec![(overview, subject.overview(&moves, large), large)];
    if !options.overview {
        jobs.extend(moves.into_iter().map(|one| {
            let text = subject.scene(&one, options.size);
            (one, text, options.size)
        }));
    }
    jobs.into_iter()
        .map(|(of, text, size)| {
            let scene = folder.join(format!("{}.pov", of.name));
            write(&scene, &text)?;
            draw(&scene, size, environment)?;
            Ok(Drawn {
                folder: folder.clone(),
                of,
                size,
                needs_3_8: subject.needs_3_8(),
            })
        })
        .collect()
}

/// Compares pictures with POV-Ray's.
fn compared(pictures: Vec<Drawn>, comparer: Option<&Comparer>) -> Result<Vec<Entry>, CliError> {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let at_once = comparer.map_or(1, |_| AT_ONCE * processors);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(at_once)
        .build()
        .map_err(|error| CliError::new(format!("no threads to compare with: {error}")))?;
    let entry = |drawn: Drawn| {
        let verdict = match comparer.filter(|one| one.is_3_8() || !drawn.needs_3_8) {
            Some(comparer) => comparer.compare(&drawn.folder, &drawn.of.name, drawn.size)?,
            None => Verdict::NotCompared,
        };
        Ok(Entry {
            folder: drawn.folder,
            of: drawn.of,
            verdict,
        })
    };
    pool.install(|| {
        pictures
            .into_par_iter()
            .with_max_len(1)
            .map(entry)
            .collect()
    })
}

/// Renders a scene to a file beside it.
fn draw(scene: &Path, size: Size, environment: &Environment) -> Result<(), CliError> {
    let arguments = [
        format!("+I{}", scene.display()),
        format!("+O{}", scene.with_extension("png").display()),
        format!("+W{}", size.0),
        format!("+H{}", size.1),
        "-A".to_owned(),
        "-D".to_owned(),
        "--quiet".to_owned(),
    ];
    if let Request::Draw(settings) = draw::request(&arguments, environment)?
        && draw::carry_out(&settings, &crate::draw)? != ExitCode::SUCCESS
    {
        return Err(CliError::new(format!("cannot draw `{}`", scene.display()))
            .with_hint("Your own file must be one object, or name one with `--object`."));
    }
    Ok(())
}

fn make_folder(folder: &Path) -> Result<(), CliError> {
    fs::create_dir_all(folder).map_err(|error| failed("make", folder, &error))
}

fn write(path: &Path, text: &str) -> Result<(), CliError> {
    fs::write(path, text).map_err(|error| failed("write", path, &error))
}

fn failed(what: &str, path: &Path, error: &dyn std::fmt::Display) -> CliError {
    CliError::new(format!("cannot {what} `{}`: {error}", path.display()))
}

#[cfg(test)]
mod tests;
