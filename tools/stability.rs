//! `stability FOLDER [--no-povray] [WORD...]`: the whole catalogue of `tests/stability/`, povr and POV-Ray side by
//! side, with a page of tables, pictures and plots.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]
#![allow(dead_code, reason = "the suite's test uses the rest")]

#[path = "../tests/stability/case.rs"]
mod case;
#[path = "../tests/stability/catalogue/mod.rs"]
mod catalogue;
#[path = "../tests/stability/certain.rs"]
mod certain;
#[path = "../tests/stability/draw.rs"]
mod draw;
#[path = "../tests/stability/model.rs"]
mod model;
#[path = "../tests/stability/oracle.rs"]
mod oracle;
#[path = "../tests/stability/rays/mod.rs"]
mod rays;
#[path = "../tests/stability/sheet.rs"]
mod sheet;
#[path = "../tests/stability/wide.rs"]
mod wide;

#[path = "report/curves.rs"]
mod curves;
#[path = "report/items.rs"]
mod items;
#[path = "report/montage.rs"]
mod montage;
#[path = "report/page.rs"]
mod page;

use case::{Asks, Case, Outcome};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A case and the results of both renderers.
pub(crate) struct Answered {
    pub(crate) case: Case,
    pub(crate) povr: Outcome,
    /// `None` where POV-Ray was not run.
    pub(crate) pov_ray: Option<Outcome>,
}

/// The command line.
struct Wishes {
    folder: PathBuf,
    asks_pov_ray: bool,
    words: Vec<String>,
}

fn main() -> ExitCode {
    let mut wishes = Wishes {
        folder: PathBuf::from("target/stability/report"),
        asks_pov_ray: true,
        words: Vec::new(),
    };
    let mut arguments = std::env::args().skip(1);
    if let Some(folder) = arguments.next() {
        wishes.folder = PathBuf::from(folder);
    }
    for argument in arguments {
        match argument.as_str() {
            "--no-povray" => wishes.asks_pov_ray = false,
            _ => wishes.words.push(argument),
        }
    }
    match run(&wishes) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("stability: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(wishes: &Wishes) -> std::io::Result<()> {
    let scratch = wishes.folder.join("scratch");
    std::fs::create_dir_all(&scratch)?;
    let scratch = scratch.canonicalize()?;
    let cases: Vec<Case> = catalogue::all()
        .into_iter()
        .filter(|case| {
            let name = format!("{:02} {}", case.item, case.name);
            wishes.words.is_empty() || wishes.words.iter().any(|word| name.contains(word))
        })
        .collect();
    let count = cases.len();
    let answered = in_order(cases, |number, case| {
        let answered = answer(case, wishes.asks_pov_ray.then_some(scratch.as_path()));
        let of = |outcome: &Outcome| format!("{}/{}", outcome.wrong, outcome.decided);
        let pov_ray = answered.pov_ray.as_ref().map_or_else(|| "-".to_owned(), of);
        println!(
            "{:3}/{count} {:02} {}: povr {}, POV-Ray {pov_ray}",
            number + 1,
            answered.case.item,
            answered.case.name,
            of(&answered.povr)
        );
        answered
    });
    let curves = if wishes.words.is_empty() {
        curves::all(wishes.asks_pov_ray.then_some(scratch.as_path()))
    } else {
        Vec::new()
    };
    page::write(&wishes.folder, &answered, &curves)?;
    std::fs::remove_dir_all(&scratch)?;
    println!("{}", wishes.folder.join("index.html").display());
    Ok(())
}

/// Applies `work` to each item on all processors; the results keep the order.
pub(crate) fn in_order<T: Send, R: Send>(
    all: Vec<T>,
    work: impl Fn(usize, T) -> R + Sync,
) -> Vec<R> {
    let slots: Vec<Mutex<Option<T>>> = all.into_iter().map(|one| Mutex::new(Some(one))).collect();
    let results: Vec<Mutex<Option<R>>> = slots.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(slot) = slots.get(number) else {
                        return;
                    };
                    let taken = slot.lock().ok().and_then(|mut slot| slot.take());
                    if let (Some(one), Ok(mut result)) = (taken, results[number].lock()) {
                        *result = Some(work(number, one));
                    }
                }
            });
        }
    });
    results
        .into_iter()
        .filter_map(|result| result.into_inner().ok().flatten())
        .collect()
}

fn answer(case: Case, scratch: Option<&Path>) -> Answered {
    let povr = case.outcome(&|text, size| draw::by_povr(text, size));
    let uses_pov_ray = case.no_pov_ray.is_none() && !matches!(case.asks, Asks::Rays(_));
    let pov_ray = scratch
        .filter(|_| uses_pov_ray)
        .map(|folder| case.outcome(&|text, size| draw::by_pov_ray(text, size, folder)));
    Answered {
        case,
        povr,
        pov_ray,
    }
}
