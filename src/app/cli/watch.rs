//! `povr watch`: draws a scene again whenever it or anything it read, or looked for, changes.
//!
//! A picture of a quarter of the side comes first, then the whole one, which is written as drawing writes it. A change in
//! the middle ends the drawing and begins the next. What is wrong is printed as drawing prints it, and the last good
//! picture stays where it is.

mod files;
mod page;
mod painter;
mod shown;
mod terminal;

use std::net::TcpListener;
use std::process::ExitCode;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use clap::Parser;

use self::files::{Known, Watched};
use self::painter::Painter;
use self::shown::Shown;
use super::Command;
use super::draw::report::say;
use super::draw::{Request, reporter, request_of};
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options;
use super::options::settings::Scene;
use crate::base::options::{CancelToken, Input};

pub(super) const COMMAND: Command = Command {
    name: "watch",
    about: "draw again whenever the scene or its files change",
    run,
    face: <Face as clap::CommandFactory>::command,
};

/// Draws a scene again whenever it, or a file that it read or looked for, changes.
#[derive(Debug, Parser)]
#[command(
    name = "povr watch",
    override_usage = "povr watch [OPTIONS] [+/-SWITCHES] [Key=Value] [FILE.ini[section]] SCENE",
    after_help = "\
All options and switches of drawing count: `povr watch scene.pov +W640 +H480 +A0.3 -o picture.png`. The picture is shown \
where the terminal can draw (kitty, iTerm, sixel; elsewhere with half characters), and with --serve on a page that only \
this machine can see; no browser is opened. Ctrl-C ends it."
)]
struct Face {
    /// Serve a live page on localhost and print its address
    #[arg(long)]
    serve: bool,
    /// Port of the page [default: a free one]
    #[arg(long, value_name = "PORT")]
    port: Option<u16>,
    /// Show nothing in the terminal
    #[arg(long)]
    no_terminal: bool,
    /// Exit after N renders
    #[arg(long, value_name = "N")]
    times: Option<u32>,
}

/// Where the system tells of no changes, files are looked at so often.
const LOOK: Duration = Duration::from_millis(500);
/// An editor may write a file in several steps: it is read when nothing has changed for so long,
const CALM: Duration = Duration::from_millis(40);
/// but no later than this.
const IMPATIENCE: Duration = Duration::from_secs(1);

/// What was asked for beside the switches of drawing.
#[derive(Debug, Default)]
struct Wanted {
    is_served: bool,
    port: Option<u16>,
    is_silent: bool,
    times: Option<u32>,
}

/// What the loop waits for.
#[derive(Debug)]
enum Happened {
    /// Something in a watched folder.
    Change,
    /// The drawing has come to its end.
    End,
}

fn run(arguments: &[String], around: &Environment) -> Result<ExitCode, CliError> {
    let (wanted, rest) = match read_arguments(arguments)? {
        Ok(read) => read,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let settings = match request_of("povr watch", &rest, around)? {
        Request::Print(text) => {
            say(text.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
        Request::Draw(settings) => *settings,
    };
    let Scene::File(file) = settings.scene.clone() else {
        return Err(CliError::new("a file is watched, not standard input"));
    };
    if settings.frames.is_some() {
        return Err(CliError::new("an animation is not watched")
            .with_hint("watch one picture of it: `+K0.5` sets the clock"));
    }
    let shown = Arc::new(Shown::default());
    if wanted.is_served || wanted.port.is_some() {
        serve(&wanted, &shown, &file.display().to_string())?;
    }
    let (tell, hear) = mpsc::channel();
    let painter = Painter {
        input: Input::File(file.clone()),
        reporter: reporter(&settings),
        settings,
        shown,
        is_silent: wanted.is_silent,
    };
    let mut watch = Watch {
        painter,
        tell: tell.clone(),
        hear,
        watched: Watched::new(move || drop(tell.send(Happened::Change))),
        known: Known::of([file], SystemTime::now()),
    };
    let mut left = wanted.times;
    loop {
        watch.draw();
        left = left.map(|left| left.saturating_sub(1));
        if left == Some(0) {
            return Ok(ExitCode::SUCCESS);
        }
        watch.wait();
    }
}

/// The options of this command, and all other arguments.
fn read_arguments(arguments: &[String]) -> Result<Result<(Wanted, Vec<String>), String>, CliError> {
    const OWN: [&str; 6] = [
        "--serve",
        "--port",
        "--no-terminal",
        "--times",
        "--help",
        "-h",
    ];
    let mut wanted = Wanted::default();
    let mut others = Vec::new();
    let mut rest = arguments;
    while let Some((first, behind)) = rest.split_first() {
        let name = first.split('=').next().unwrap_or_default();
        let length = match OWN.contains(&name) {
            true => long_options::length::<Face>(rest),
            false => 0,
        };
        if length == 0 {
            others.push(first.clone());
            rest = behind;
            continue;
        }
        let (option, behind) = rest.split_at(length);
        match long_options::parse::<Face>(option) {
            Ok(face) => {
                wanted.is_served |= face.serve;
                wanted.port = face.port.or(wanted.port);
                wanted.is_silent |= face.no_terminal;
                wanted.times = face.times.or(wanted.times);
            }
            Err(said) => return long_options::printed::<Face>(&said).map(Err),
        }
        rest = behind;
    }
    Ok(Ok((wanted, others)))
}

/// Opens the page, on this machine only.
fn serve(wanted: &Wanted, shown: &Arc<Shown>, title: &str) -> Result<(), CliError> {
    let port = wanted.port.unwrap_or(0);
    let cannot = |error: std::io::Error| {
        CliError::new(format!("cannot serve on port {port}: {error}"))
            .with_hint("leave `--port` out, and a free one is taken")
    };
    let listener = TcpListener::bind(("127.0.0.1", port)).map_err(cannot)?;
    let address = listener.local_addr().map_err(cannot)?;
    say(format_args!("povr: http://{address}/"));
    page::serve(listener, Arc::clone(shown), title.to_owned()).map_err(cannot)
}

/// A scene that is watched.
struct Watch {
    painter: Painter,
    tell: Sender<Happened>,
    hear: Receiver<Happened>,
    watched: Watched,
    /// The files that the picture depends on.
    known: Known,
}

impl Watch {
    /// Draws, again and again until nothing changes meanwhile.
    fn draw(&mut self) {
        while !self.drawn_in_peace() {
            self.calm_down();
        }
    }

    /// Waits for a change.
    fn wait(&mut self) {
        while self.known.changed().is_none() {
            // Whatever ends the waiting, the files are looked at.
            let _ = self.hear.recv_timeout(LOOK);
        }
        self.calm_down();
    }

    /// Waits until nothing changes any more, and says what has changed.
    fn calm_down(&mut self) {
        if let Some(file) = self
            .known
            .changed()
            .filter(|_| !self.painter.settings.talk.quiet)
        {
            say(format_args!("povr: `{}` has changed", file.display()));
        }
        let start = Instant::now();
        let mut before = self.known.again();
        while start.elapsed() < IMPATIENCE {
            thread::sleep(CALM);
            let now = self.known.again();
            if now == before {
                break;
            }
            before = now;
        }
        while self.hear.try_recv().is_ok() {}
    }

    /// Draws once. `false` if files changed before it was done.
    fn drawn_in_peace(&mut self) -> bool {
        let began = SystemTime::now();
        let stop = CancelToken::default();
        let read: Mutex<Option<Known>> = Mutex::new(None);
        let take = || read.lock().unwrap_or_else(PoisonError::into_inner).take();
        let mut is_changed = false;
        // Until the scene has been read, what counts is what counted before.
        let mut known = self.known.again();
        let (painter, tell, hear) = (&self.painter, self.tell.clone(), &self.hear);
        thread::scope(|scope| {
            let (stop, read) = (&stop, &read);
            scope.spawn(move || {
                painter.draw(stop, began, read);
                // The loop is there as long as this thread.
                let _ = tell.send(Happened::End);
            });
            loop {
                let happened = hear.recv_timeout(LOOK);
                if let Some(now) = take() {
                    known = now;
                }
                if !is_changed && known.changed().is_some() {
                    is_changed = true;
                    stop.ask();
                }
                if matches!(happened, Ok(Happened::End)) {
                    break;
                }
            }
        });
        self.watched.watch(&known);
        self.known = known;
        // The last look: from now on the system tells.
        !is_changed && self.known.changed().is_none()
    }
}
