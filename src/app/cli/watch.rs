//! `povr watch`: renders a scene again whenever it or a file that it read, or looked for, changes.
//!
//! A coarse preview comes first, then the whole picture, which is written as in a normal rendering. A change in the middle
//! cancels the rendering and starts the next. Errors are printed as in a normal rendering, and the last good picture
//! stays. `--timeout`, `--max-memory` and `--sandbox` hold for each rendering, `--timeout` for the preview and again for
//! the picture. On the page of `--serve`, and of `povr live`, viewers move the camera and change numbers of the scene.

mod files;
mod page;
mod painter;
mod povray;
mod scenes;
mod shown;
mod source;
mod terminal;
mod wishes;

use crate::app::cli::options::command_line;
use crate::app::server;
use crate::app::worker::Splice;
use crate::base::file::{FileLimits, Folders, Named, read_limited};
use std::ffi::OsString;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::AtomicU32;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use clap::Parser;

use self::files::{Known, Watched};
use self::painter::{Drawing, Order, Painter};
use self::scenes::{SceneFile, Scenes};
use self::shown::Shown;
use self::wishes::{SceneWish, Wishes};
use super::Command;
use super::draw::report::say;
use super::draw::{Request, reporter, request_of};
use super::options::environment::Environment;
use super::options::error::{CliError, Stage};
use super::options::long_options;
use super::options::settings::{Scene, Settings};
use crate::base::sync::lock;

pub(super) const COMMAND: Command = Command {
    name: "watch",
    about: "draw again whenever the scene or its files change",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

pub(super) const LIVE: Command = Command {
    name: "live",
    about: "show a scene on a page that answers to mouse and keys",
    run: run_live,
    options: live_options,
};

fn live_options() -> clap::Command {
    <CommandOptions as clap::CommandFactory>::command()
        .mut_arg("serve", |serve| serve.hide(true))
        .mut_arg("no_terminal", |no_terminal| no_terminal.hide(true))
        .name("povr live")
        .about("Shows a scene on a page that moves its camera and changes its numbers")
        .override_usage("povr live [OPTIONS] [+/-SWITCHES] [Key=Value] [FILE.ini[section]] SCENE")
        .before_help(
            "Examples:
  povr live scene.pov                      prints the address of its page
  povr live scenes                         of a list of the scenes of a folder",
        )
        .after_help(
            "All options and switches of drawing count: `povr live scene.pov +W640 +H480 +A0.3`. A folder instead of a \
             scene shows a list of its scenes, and neither of them those that povr brings along. No browser is opened: \
             open the address that is printed. With `-o picture.png` each picture is stored. Ctrl-C ends it.",
        )
}

/// Runs `povr watch` with its page, nothing in the terminal, and no picture written unless it is asked for.
fn run_live(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    let wanted = Wanted {
        is_live: true,
        is_served: true,
        is_silent: true,
        ..Wanted::default()
    };
    run_as(wanted, arguments, environment)
}

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
    /// Secret part of the address, 16 characters or more, so that a page outlives a restart [default: random]
    #[arg(long, value_name = "TEXT", value_parser = secret)]
    token: Option<String>,
    /// Show nothing in the terminal
    #[arg(long)]
    no_terminal: bool,
    /// Exit after N renders
    #[arg(long, value_name = "N")]
    times: Option<u32>,
}

/// Least length of a token in bytes.
const SECRET: usize = 16;

/// A token of an address.
fn secret(text: &str) -> Result<String, &'static str> {
    let is_plain = text.bytes().all(|byte| byte.is_ascii_alphanumeric());
    match is_plain && text.len() >= SECRET {
        true => Ok(text.to_owned()),
        false => Err("it has 16 letters and digits or more"),
    }
}

/// Longest time for which the preview in progress goes on after a change of a file, so that one is seen however often a
/// file changes.
const PREVIEW_PATIENCE: Duration = Duration::from_millis(300);
/// Polling interval for file systems that report no changes.
const LOOK: Duration = Duration::from_millis(500);
/// An editor may write a file in several steps. Where the system does not tell that it is done, the file is read after this
/// time without changes,
const CALM: Duration = Duration::from_millis(10);
/// but no later than this.
const IMPATIENCE: Duration = Duration::from_secs(1);

/// The options beside the render switches.
#[derive(Debug, Default)]
struct Wanted {
    /// True for `povr live`.
    is_live: bool,
    is_served: bool,
    port: Option<u16>,
    token: Option<String>,
    is_silent: bool,
    times: Option<u32>,
}

/// Events that the loop waits for.
#[derive(Debug)]
enum WatchEvent {
    /// Something in a watched folder; the name of a file that has been written completely.
    Change(Option<OsString>),
    /// The wishes of the viewers have changed.
    Wish,
    /// The rendering has ended.
    End,
}

fn run(arguments: &[String], environment: &Environment) -> Result<ExitCode, CliError> {
    run_as(Wanted::default(), arguments, environment)
}

fn run_as(
    wanted: Wanted,
    arguments: &[String],
    environment: &Environment,
) -> Result<ExitCode, CliError> {
    let (wanted, rest) = match read_arguments(wanted, arguments)? {
        Ok(read) => read,
        Err(help) => {
            say(help.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
    };
    let command = if wanted.is_live {
        "povr live"
    } else {
        "povr watch"
    };
    let (folder, rest) = match wanted.is_live {
        true => split_folder(rest),
        false => (None, rest),
    };
    let requested = request_of(command, &rest, environment);
    let is_gallery = match &requested {
        Err(error) => wanted.is_live && error.stage == Stage::NoScene,
        Ok(_) => false,
    };
    let settings = match requested {
        Ok(Request::Print(text)) => {
            say(text.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
        Ok(Request::Draw(settings)) => Some(*settings),
        Err(_) if is_gallery => None,
        Err(error) => return Err(error),
    };
    let file = match settings.as_ref().map(|settings| &settings.scene) {
        Some(Scene::Stdin) => {
            return Err(CliError::new("a file is watched, not standard input"));
        }
        Some(Scene::File(file)) => Some(file.clone()),
        None => None,
    };
    let beside = |file: &PathBuf| file.parent().map(Path::to_owned);
    let scenes = Scenes::of(folder.or_else(|| beside(file.as_ref()?)));
    let settings_of = |scene: &SceneFile| opened(command, &rest, scene, environment);
    let (scene, mut settings) = match (file, settings) {
        (Some(path), Some(settings)) => {
            let built_in = None;
            (SceneFile { path, built_in }, settings)
        }
        _ => {
            let first = scenes.all().into_iter().next();
            let first = first.ok_or_else(|| CliError::new("there are no scenes in this folder"))?;
            let settings = settings_of(&first)?;
            (first, settings)
        }
    };
    if settings.frames.is_some() && !wanted.is_live {
        return Err(CliError::new("an animation is not watched")
            .with_hint("Watch one picture of it: `+K0.5` sets the clock."));
    }
    if wanted.is_live && (!settings.names_output || settings.frames.is_some()) {
        settings.output = None;
    }
    let clocks = still(&mut settings);
    let (sender, receiver) = mpsc::channel();
    let writes_nothing = Folders::Only(Vec::new());
    let may_write = !settings.is_sandboxed && settings.read.writable != writes_nothing;
    let povray = which::which("povray").ok();
    // It has limits of its own.
    let povray = povray.filter(|_| may_write);
    let wishes = Wishes::new(scenes, may_write, povray, sender.clone());
    let wishes = Arc::new(wishes);
    let shown = Arc::new(Shown::new(Arc::clone(&wishes)));
    if !is_gallery {
        wishes.open(scene.clone());
        shown.open(scene.name(), settings.read.clock, clocks);
    }
    let is_served = wanted.is_served || wanted.port.is_some();
    if is_served {
        serve(&wanted, &shown, &wishes)?;
    }
    let file = scene.path.clone();
    let painter = Painter {
        scene,
        reporter: reporter(&settings),
        settings,
        shown: Arc::clone(&shown),
        is_silent: wanted.is_silent,
        worker: Mutex::default(),
        wishes: Arc::clone(&wishes),
        preview_side: AtomicU32::new(painter::PREVIEW),
        drawn: Mutex::default(),
        delivered: Mutex::default(),
        picked: Mutex::default(),
        warnings: Mutex::default(),
        overlaid: Mutex::default(),
    };
    let mut watch = Watch {
        painter,
        settings_of: &settings_of,
        sender: sender.clone(),
        receiver,
        watched: Watched::new(move |written| drop(sender.send(WatchEvent::Change(written)))),
        known: Known::of([file.clone()], SystemTime::now()),
        text_known: Known::of([file], SystemTime::now()),
        scene: None,
        versions: 0,
        text: None,
        written: None,
        drawn: 0,
    };
    thread::scope(|scope| {
        if is_served {
            scope.spawn(|| {
                let settings_of = |scene: &SceneFile| settings_of(scene).ok();
                wishes.scenes.draw_thumbnails(settings_of, &shown);
            });
        }
        if is_gallery {
            watch.wait_for_wish();
        }
        let mut left = wanted.times;
        loop {
            watch.draw();
            left = left.map(|left| left.saturating_sub(1));
            if left == Some(0) {
                wishes.scenes.end();
                return Ok(ExitCode::SUCCESS);
            }
            watch.wait();
        }
    })
}

/// The last argument that is a folder, and all others.
fn split_folder(arguments: Vec<String>) -> (Option<PathBuf>, Vec<String>) {
    let is_folder = |argument: &String| {
        let is_switch = argument.starts_with(['-', '+']) || argument.contains('=');
        !is_switch && Path::new(argument).is_dir()
    };
    let folder = arguments.iter().rfind(|argument| is_folder(argument));
    let folder = folder.map(PathBuf::from);
    let others = arguments.into_iter().filter(|argument| {
        let is_taken = folder.as_deref() == Some(Path::new(argument));
        !is_taken
    });
    (folder.clone(), others.collect())
}

/// Takes the first picture of an animation; returns the first clock and the last one.
fn still(settings: &mut Settings) -> [f64; 2] {
    let clock = settings.read.clock;
    let Some(frames) = settings.frames.take() else {
        return [clock.min(0.0), clock.max(1.0)];
    };
    let numbers = frames.numbers();
    let ends = [numbers.first(), numbers.last()];
    let ends = ends.map(|frame| frame.map_or(clock, |&frame| frames.clock(frame)));
    settings.read.clock = ends[0];
    settings.read.clock_on = true;
    ends
}

/// The settings of a scene that a page opens: those of the command line, without the picture that it stores.
fn opened(
    command: &str,
    arguments: &[String],
    scene: &SceneFile,
    environment: &Environment,
) -> Result<Settings, CliError> {
    let mut arguments = arguments.to_vec();
    match scene.built_in {
        Some(_) => arguments.push("-".to_owned()),
        None => {
            let path = std::path::absolute(&scene.path).unwrap_or_else(|_| scene.path.clone());
            let folder = path.parent().unwrap_or(&path);
            arguments.push(format!("+L{}", folder.display()));
            arguments.push(path.display().to_string());
        }
    }
    match request_of(command, &arguments, environment)? {
        Request::Draw(settings) => Ok(Settings {
            output: None,
            ..*settings
        }),
        Request::Print(_) => Err(CliError::new("no scene is named")),
    }
}

/// The options of this command, and all other arguments.
fn read_arguments(
    mut wanted: Wanted,
    arguments: &[String],
) -> Result<Result<(Wanted, Vec<String>), String>, CliError> {
    const OWN: [&str; 7] = [
        "--serve",
        "--port",
        "--token",
        "--no-terminal",
        "--times",
        "--help",
        "-h",
    ];
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
                wanted.token = options.token.or(wanted.token);
                wanted.is_silent |= options.no_terminal;
                wanted.times = options.times.or(wanted.times);
            }
            Err(error) => {
                let help = command_line::printed::<CommandOptions>(&error)?;
                return Ok(Err(match wanted.is_live {
                    true => live_options().render_help().to_string(),
                    false => help,
                }));
            }
        }
        rest = behind;
    }
    Ok(Ok((wanted, others)))
}

/// Serves the page, on this machine only.
fn serve(wanted: &Wanted, shown: &Arc<Shown>, wishes: &Arc<Wishes>) -> Result<(), CliError> {
    let port = wanted.port.unwrap_or(0);
    let cannot = |error: std::io::Error| {
        CliError::new(format!("cannot serve on port {port}: {error}"))
            .with_hint("Leave `--port` out, and a free one is taken.")
    };
    let listener = TcpListener::bind(("127.0.0.1", port)).map_err(cannot)?;
    let address = listener.local_addr().map_err(cannot)?;
    let token = match &wanted.token {
        Some(token) => token.clone(),
        None => server::token().map_err(cannot)?,
    };
    page::serve(listener, &token, (shown, wishes)).map_err(cannot)?;
    say(format_args!("povr: http://{address}/{token}/"));
    Ok(())
}

/// A watched scene.
struct Watch<'a> {
    painter: Painter,
    /// The settings of a scene that is opened.
    settings_of: &'a dyn Fn(&SceneFile) -> Result<Settings, CliError>,
    sender: Sender<WatchEvent>,
    receiver: Receiver<WatchEvent>,
    watched: Watched,
    /// The files that the picture depends on.
    known: Known,
    /// The file of the scene before its text was read.
    text_known: Known,
    /// The number of the text, and the wishes, with which the scene was read in its last version; `None` once files have
    /// changed.
    scene: Option<(u64, SceneWish)>,
    /// The number of that version; the scene is read once for each.
    versions: u64,
    /// That number and the number of the text, if the version has the text as it is.
    text: Option<(u64, u64)>,
    /// The name of the file that has been written completely, if that is the last event.
    written: Option<OsString>,
    /// The number of the wishes that were drawn last.
    drawn: u64,
}

impl Watch<'_> {
    /// Waits until a page opens a scene.
    fn wait_for_wish(&self) {
        while self.drawn == self.painter.wishes.number() {
            let _ = self.receiver.recv();
        }
    }

    /// Opens a scene in place of the current one.
    fn open(&mut self, scene: SceneFile) {
        let painter = &mut self.painter;
        let mut settings = match (self.settings_of)(&scene) {
            Ok(settings) => settings,
            Err(error) => return painter.shown.fail(error.to_string()),
        };
        painter.wishes.open(scene.clone());
        let clocks = still(&mut settings);
        painter
            .shown
            .open(scene.name(), settings.read.clock, clocks);
        painter.reporter = reporter(&settings);
        painter.settings = settings;
        if painter.settings.is_sandboxed {
            // A worker in a sandbox draws one scene.
            *lock(&painter.worker) = None;
        }
        let path = scene.path.clone();
        painter.scene = scene;
        for known in [&mut self.known, &mut self.text_known] {
            *known = Known::of([path.clone()], SystemTime::now());
        }
        self.scene = None;
    }

    /// Renders again and again until nothing changes meanwhile.
    fn draw(&mut self) {
        loop {
            if !self.render_once() {
                self.wait_until_stable();
            } else if self.drawn == self.painter.wishes.number() {
                return;
            }
        }
    }

    /// Waits for a change.
    fn wait(&mut self) {
        loop {
            if self.changed().is_some() {
                return self.wait_until_stable();
            }
            if self.drawn != self.painter.wishes.number() {
                return;
            }
            // Whatever ends the wait, the files and wishes are checked.
            if let Ok(WatchEvent::Change(name)) = self.receiver.recv_timeout(LOOK) {
                self.written = name;
            }
        }
    }

    /// Waits until nothing changes any more, and reports the change.
    fn wait_until_stable(&mut self) {
        let changed = self.changed();
        if let Some(file) = changed
            .as_ref()
            .filter(|_| !self.painter.settings.verbosity.quiet)
        {
            say(format_args!("povr: `{}` has changed", file.display()));
        }
        let start = Instant::now();
        let mut before = self.known.again();
        let mut written = self.written.take();
        while start.elapsed() < IMPATIENCE {
            // The system tells when the writer is done.
            let name = changed.as_ref().and_then(|file| file.file_name());
            if name.is_some() && name == written.as_deref() {
                break;
            }
            match self.receiver.recv_timeout(CALM) {
                Ok(WatchEvent::Change(name)) => written = name,
                Ok(WatchEvent::Wish | WatchEvent::End) => {}
                Err(_) => {
                    let now = self.known.again();
                    if now == before {
                        break;
                    }
                    before = now;
                }
            }
        }
        while self.receiver.try_recv().is_ok() {}
        self.scene = None;
    }

    /// The next picture to draw. The text is read again if files have changed since the last one.
    fn order(&mut self) -> Order {
        if let Some(scene) = self.painter.wishes.take_next() {
            self.open(scene);
        }
        let painter = &self.painter;
        let SceneFile { path, built_in } = &painter.scene;
        // The change of the text since that of a number.
        let mut since = None;
        if self.scene.is_none() {
            // Before its text is read, so that no change of it is missed.
            self.text_known = Known::of([path.clone()], SystemTime::now());
            let limits = FileLimits::default();
            // Of a long text most stays.
            let source = painter.wishes.current().source;
            let number = source.number;
            let change = source.change_to(path).filter(|_| built_in.is_none());
            drop(source);
            let is_taken = change
                .as_ref()
                .is_some_and(|change| painter.wishes.take_change(number, change));
            if is_taken {
                since = change.map(|change| (number, change));
            } else {
                let bytes = match built_in {
                    Some(text) => Some(text.as_bytes().to_vec()),
                    None => read_limited(path, Named::ByScene, &limits).ok().flatten(),
                };
                painter.wishes.take_file(bytes);
            }
            painter.shown.refresh();
        }
        let wished = painter.wishes.current();
        let read = (wished.source.number, wished.wish.scene.clone());
        let edits = &wished.wish.scene.edits;
        let number = wished.source.number;
        let mut change = None;
        if self.scene.as_ref() != Some(&read) {
            self.versions += 1;
            self.scene = Some(read);
            let is_plain = edits.is_empty() && built_in.is_none();
            let last =
                std::mem::replace(&mut self.text, is_plain.then_some((self.versions, number)));
            let since = since.filter(|(of, change)| {
                // Pages may have written it meanwhile.
                *of + u64::from(!change.is_empty()) == number
            });
            change = last
                .filter(|_| is_plain)
                .and_then(|(version, text)| match since {
                    _ if text == number => Some((version, Splice::default())),
                    Some((of, change)) if of == text => Some((version, change)),
                    _ => None,
                });
        }
        let text = wished.source.text.as_deref();
        let text = text.filter(|_| !edits.is_empty() || built_in.is_some());
        Order {
            number: self.versions,
            text: text.and_then(|text| source::edited(text, edits)),
            change,
            is_wished: wished.number != self.drawn,
            wished,
        }
    }

    /// Renders once. `false` if files changed before it was done.
    fn render_once(&mut self) -> bool {
        let began = SystemTime::now();
        // A text that is drawn again may have changed since files were last looked at.
        if self.scene.is_some() && self.changed().is_some() {
            return false;
        }
        let drawing = Drawing::default();
        let order = &self.order();
        self.painter.shown.set_drawing(true);
        self.drawn = order.wished.number;
        let mut is_changed = false;
        let mut changed_at = None;
        let mut written = None;
        // Until the scene has been read, the previous dependencies count.
        let mut known = self.known.again();
        let (painter, sender, receiver) = (&self.painter, self.sender.clone(), &self.receiver);
        thread::scope(|scope| {
            let drawing = &drawing;
            scope.spawn(move || {
                painter.draw(drawing, began, order);
                // The loop runs as long as this thread.
                let _ = sender.send(WatchEvent::End);
            });
            loop {
                let is_late = changed_at.is_some();
                let happened = receiver.recv_timeout(if is_late { PREVIEW_PATIENCE } else { LOOK });
                if let Some(now) = drawing.take_read() {
                    known = now;
                }
                is_changed |= known.changed().or(self.text_known.changed()).is_some();
                if is_changed {
                    let since = *changed_at.get_or_insert_with(Instant::now);
                    match since.elapsed() < PREVIEW_PATIENCE {
                        true => drawing.supersede(),
                        false => drawing.cancel(),
                    }
                } else if painter.wishes.number() != order.wished.number {
                    drawing.supersede();
                }
                match happened {
                    Ok(WatchEvent::End) => break,
                    Ok(WatchEvent::Change(name)) => written = name,
                    _ => {}
                }
            }
        });
        self.painter.shown.set_drawing(false);
        self.watched.watch(&known);
        self.known = known;
        self.written = written;
        // A last check: from now on the system reports changes.
        !is_changed && self.changed().is_none()
    }

    /// A file that has changed since it was read.
    fn changed(&self) -> Option<PathBuf> {
        self.known.changed().or_else(|| self.text_known.changed())
    }
}
