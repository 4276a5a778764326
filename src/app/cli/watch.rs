//! `povr watch`: renders a scene again whenever it or a file that it read, or looked for, changes.
//!
//! A preview of a quarter of the side comes first, then the whole picture, which is written as in a normal rendering. A
//! change in the middle cancels the rendering and starts the next. Errors are printed as in a normal rendering, and the
//! last good picture stays. `--timeout`, `--max-memory` and `--sandbox` hold for each rendering, `--timeout` for
//! the preview and again for the picture.

mod files;
mod page;
mod painter;
mod shown;
mod terminal;

use crate::app::cli::options::command_line;
use std::net::TcpListener;
use std::process::ExitCode;
use std::sync::atomic::AtomicUsize;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use clap::Parser;

use self::files::{Known, Watched};
use self::painter::{Drawing, Painter};
use self::shown::Shown;
use super::Command;
use super::draw::report::say;
use super::draw::{Request, reporter, request_of};
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options;
use super::options::settings::Scene;

pub(super) const COMMAND: Command = Command {
    name: "watch",
    about: "draw again whenever the scene or its files change",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Draws a scene again whenever it, or a file that it read or looked for, changes.
#[derive(Debug, Parser)]
#[command(
    name = "povr watch",
    override_usage = "povr watch [OPTIONS] [+/-SWITCHES] [Key=Value] [FILE.ini[section]] SCENE",
    help_template = super::HELP_TEMPLATE,
    before_help = "\
Examples:
  povr watch scene.pov                     shows it in the terminal
  povr watch scene.pov --serve             on a page of this machine",
    after_help = "\
All options and switches of drawing count: `povr watch scene.pov +W640 +H480 +A0.3 -o picture.png`. The picture is shown \
where the terminal can draw (kitty, iTerm, sixel; elsewhere with half characters), and with --serve on a page that only \
this machine can see; no browser is opened. Ctrl-C ends it."
)]
struct CommandOptions {
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

/// Polling interval for file systems that report no changes.
const LOOK: Duration = Duration::from_millis(500);
/// An editor may write a file in several steps: it is read after this time without changes,
const CALM: Duration = Duration::from_millis(40);
/// but no later than this.
const IMPATIENCE: Duration = Duration::from_secs(1);

/// The options beside the render switches.
#[derive(Debug, Default)]
struct Wanted {
    is_served: bool,
    port: Option<u16>,
    is_silent: bool,
    times: Option<u32>,
}

/// Events that the loop waits for.
#[derive(Debug)]
enum WatchEvent {
    /// Something in a watched folder.
    Change,
    /// The rendering has ended.
    End,
}

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let (wanted, rest) = match read_arguments(arguments)? {
        Ok(read) => read,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let settings = match request_of("povr watch", &rest, environment)? {
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
            .with_hint("Watch one picture of it: `+K0.5` sets the clock."));
    }
    let shown = Arc::new(Shown::default());
    if wanted.is_served || wanted.port.is_some() {
        serve(&wanted, &shown, &file.display().to_string())?;
    }
    let (sender, receiver) = mpsc::channel();
    let painter = Painter {
        scene: file.clone(),
        reporter: reporter(&settings),
        settings,
        shown,
        is_silent: wanted.is_silent,
        worker: Mutex::default(),
        drawings: AtomicUsize::new(0),
    };
    let mut watch = Watch {
        painter,
        sender: sender.clone(),
        receiver,
        watched: Watched::new(move || drop(sender.send(WatchEvent::Change))),
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
            true => long_options::length::<CommandOptions>(rest),
            false => 0,
        };
        if length == 0 {
            others.push(first.clone());
            rest = behind;
            continue;
        }
        let (option, behind) = rest.split_at(length);
        match command_line::parse::<CommandOptions>(option) {
            Ok(options) => {
                wanted.is_served |= options.serve;
                wanted.port = options.port.or(wanted.port);
                wanted.is_silent |= options.no_terminal;
                wanted.times = options.times.or(wanted.times);
            }
            Err(error) => return command_line::printed::<CommandOptions>(&error).map(Err),
        }
        rest = behind;
    }
    Ok(Ok((wanted, others)))
}

/// Serves the page, on this machine only.
fn serve(wanted: &Wanted, shown: &Arc<Shown>, title: &str) -> Result<(), CliError> {
    let port = wanted.port.unwrap_or(0);
    let cannot = |error: std::io::Error| {
        CliError::new(format!("cannot serve on port {port}: {error}"))
            .with_hint("Leave `--port` out, and a free one is taken.")
    };
    let listener = TcpListener::bind(("127.0.0.1", port)).map_err(cannot)?;
    let address = listener.local_addr().map_err(cannot)?;
    say(format_args!("povr: http://{address}/"));
    page::serve(listener, shown, title).map_err(cannot)
}

/// A watched scene.
struct Watch {
    painter: Painter,
    sender: Sender<WatchEvent>,
    receiver: Receiver<WatchEvent>,
    watched: Watched,
    /// The files that the picture depends on.
    known: Known,
}

impl Watch {
    /// Renders again and again until nothing changes meanwhile.
    fn draw(&mut self) {
        while !self.render_once() {
            self.wait_until_stable();
        }
    }

    /// Waits for a change.
    fn wait(&mut self) {
        while self.known.changed().is_none() {
            // Whatever ends the wait, the files are checked.
            let _ = self.receiver.recv_timeout(LOOK);
        }
        self.wait_until_stable();
    }

    /// Waits until nothing changes any more, and reports the change.
    fn wait_until_stable(&mut self) {
        if let Some(file) = self
            .known
            .changed()
            .filter(|_| !self.painter.settings.verbosity.quiet)
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
        while self.receiver.try_recv().is_ok() {}
    }

    /// Renders once. `false` if files changed before it was done.
    fn render_once(&mut self) -> bool {
        let began = SystemTime::now();
        let drawing = Drawing::default();
        let mut is_changed = false;
        // Until the scene has been read, the previous dependencies count.
        let mut known = self.known.again();
        let (painter, sender, receiver) = (&self.painter, self.sender.clone(), &self.receiver);
        thread::scope(|scope| {
            let drawing = &drawing;
            scope.spawn(move || {
                painter.draw(drawing, began);
                // The loop runs as long as this thread.
                let _ = sender.send(WatchEvent::End);
            });
            loop {
                let happened = receiver.recv_timeout(LOOK);
                if let Some(now) = drawing.take_read() {
                    known = now;
                }
                is_changed |= known.changed().is_some();
                if is_changed {
                    drawing.cancel();
                }
                drawing.kill_overdue(painter.settings.timeout);
                if matches!(happened, Ok(WatchEvent::End)) {
                    break;
                }
            }
        });
        self.watched.watch(&known);
        self.known = known;
        // A last check: from now on the system reports changes.
        !is_changed && self.known.changed().is_none()
    }
}
