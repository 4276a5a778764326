//! The fuzz targets. A panic, an abort, a hang and too much memory are faults; messages are not.

use povr::RenderSession;
use povr::app::batch::{self, Batch};
use povr::app::cli::{Environment, request};
use povr::base::file::Folders;
use povr::base::options::{
    CancelToken, CheckpointOptions, Event, Input, ReadOptions, RenderOptions, Writes,
};
use povr::base::source::{FileId, Message, Sources};
use povr::lang::evaluate;
use povr::lang::syntax::{Names, tokenize};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, LazyLock};
use std::thread;
use std::time::Duration;

/// Token limit of loops and macros; the loops of the seeds end before.
const PATIENCE: u64 = 100_000;
/// Time after which a drawing is cancelled, as `--timeout` does.
const TIMEOUT: Duration = Duration::from_secs(3);
/// Memory limit of reading in bytes.
const MEMORY: u64 = 512 << 20;
/// Findings of each scene that are formatted as messages.
const MESSAGES: usize = 3;

/// The folder of the files that scenes read, which is among the library folders.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let memory = Path::new("/dev/shm");
    let parent = match memory.is_dir() {
        true => memory.to_owned(),
        false => std::env::temp_dir(),
    };
    // One for each process, which libFuzzer ends without dropping anything.
    let folder = parent.join(format!("povr-fuzz-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("temporary folders can be made");
    folder
});

static POOL: LazyLock<Arc<rayon::ThreadPool>> = LazyLock::new(|| {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    Arc::new(
        pool.stack_size(1 << 24)
            .build()
            .expect("threads can be started"),
    )
});

/// The uses of a picture; `P` is the picture with its type.
pub const USES: [&str; 7] = [
    "pigment { image_map { P interpolate 2 filter all 0.5 } }",
    "pigment { image_map { P map_type 1 once interpolate 4 } }",
    "normal { bump_map { P bump_size 2 use_index } }",
    "texture { material_map { P texture { pigment { rgb 1 } } texture { pigment { rgb x } } } }",
    "pigment { image_pattern { P use_alpha } color_map { [0 rgb 0] [1 rgb 1] } }",
    "pigment { function { pigment { image_map { P } }.red } }",
    "",
];

/// The types of pictures, as scenes name them.
pub const PICTURES: [&str; 10] = [
    "png", "gif", "jpeg", "tga", "ppm", "pgm", "tiff", "bmp", "exr", "hdr",
];

pub const VIEW: &str = "camera { location -3*z look_at 0 } light_source { <-4, 6, -8>, rgb 1 }\n";

/// A scene whose light comes from the photon map `input`.
pub const PHOTONS: &str = "global_settings { photons { spacing 0.2 FILE media 20 } }
camera { location <0, 2, -3> look_at 0 } light_source { <-4, 6, -8>, rgb 1 photons { refraction on } }
sphere { 0, 1 pigment { rgbt 1 } interior { ior 1.5 } photons { target refraction on } } plane { y, -1 pigment { rgb 1 } }\n";

/// Tokenizes a text.
pub fn tokens(input: &[u8]) {
    let text = Arc::new(String::from_utf8_lossy(input).into_owned());
    let _ = tokenize(FileId(0), &text, &mut Names::new());
}

/// Reads a scene.
pub fn language(input: &[u8]) {
    // The stack on which `povr` reads.
    let reader = thread::Builder::new().stack_size(1 << 30);
    let text = input.to_vec();
    let reading = reader.spawn(move || {
        let mut sources = Sources::new(vec![FOLDER.clone()]);
        sources.limit_reads(Folders::Only(vec![FOLDER.clone()]));
        let file = sources.add_text("fuzz.pov", &text);
        let reading = evaluate(file, &mut sources, &read_options());
        for finding in reading.findings.iter().take(MESSAGES) {
            assert!(!Message::new(finding, &sources).excerpt.is_empty());
        }
    });
    reading
        .expect("threads can be started")
        .join()
        .expect("panics abort");
}

/// Draws a scene at 8 by 6 pixels.
pub fn scene(input: &[u8]) {
    draw(input, &RenderOptions::of_size(8, 6));
}

/// Draws a picture, whose type and use the first two bytes choose.
pub fn picture(input: &[u8]) {
    let [kind, usage, bytes @ ..] = input else {
        return;
    };
    let kind = PICTURES[usize::from(*kind) % PICTURES.len()];
    let usage = USES[usize::from(*usage) % USES.len()];
    put("picture", bytes);
    let named = format!("{kind} \"picture\"");
    let object = match usage {
        "" => format!("height_field {{ {named} smooth translate -0.5 }}"),
        usage => format!("box {{ -1, 1 {} }}", usage.replace('P', &named)),
    };
    scene(format!("{VIEW}{object}").as_bytes());
}

/// Draws text in a font.
pub fn font(input: &[u8]) {
    put("font.ttf", input);
    let text = "text { ttf \"font.ttf\" \"Ag fi\\u00e9\\u4e00\" 0.2, 0.1*x translate -x }";
    scene(format!("{VIEW}{text}").as_bytes());
}

/// Draws a density file with each interpolation.
pub fn density(input: &[u8]) {
    put("density.df3", input);
    let object = |number| {
        format!(
            "box {{ 0, 1 pigment {{ density_file df3 \"density.df3\" interpolate {number} }} translate {number}*x-1 }}"
        )
    };
    let objects: String = (0..3).map(object).collect();
    scene(format!("{VIEW}{objects}").as_bytes());
}

/// Draws with a photon map.
pub fn photons(input: &[u8]) {
    put("map", input);
    scene(PHOTONS.replace("FILE", "load_file \"map\"").as_bytes());
}

/// Draws a picture of which a part is done.
pub fn state(input: &[u8]) {
    put("state", input);
    draw(
        state_scene().as_bytes(),
        &state_options(FOLDER.join("state")),
    );
}

pub fn state_scene() -> String {
    format!("{VIEW}sphere {{ 0, 1 pigment {{ rgb 1 }} }}")
}

/// Options of drawing that store what is done in a file.
pub fn state_options(file: PathBuf) -> RenderOptions {
    RenderOptions {
        checkpoint: Some(CheckpointOptions {
            file,
            resume: true,
            build: String::new(),
        }),
        ..RenderOptions::of_size(40, 40)
    }
}

/// Opens the log of a batch and compacts it.
pub fn journal(input: &[u8]) {
    fs::create_dir_all(FOLDER.join(".povr-batch/all")).expect("folders can be made");
    put(".povr-batch/all/log", input);
    let batch = Batch {
        out: FOLDER.clone(),
        threads: Some(1),
        ..Batch::default()
    };
    let _ = batch::run(&[], &batch, &|_| {});
}

/// Reads what a worker replies to a command.
pub fn replies(input: &[u8]) {
    let _ = povr::app::read_replies(input);
}

/// Reads a command line, a word a line, or if the first line is empty an ini file.
pub fn options(input: &[u8]) {
    let text = String::from_utf8_lossy(input);
    let arguments: Vec<String> = match text.strip_prefix('\n') {
        Some(ini) => {
            put("fuzz.ini", ini.as_bytes());
            vec![FOLDER.join("fuzz.ini").display().to_string()]
        }
        None => text.lines().map(str::to_owned).collect(),
    };
    let _ = request(&arguments, &Environment::default());
}

fn put(name: &str, bytes: &[u8]) {
    fs::write(FOLDER.join(name), bytes).expect("files can be written");
}

fn read_options() -> ReadOptions {
    ReadOptions {
        library_paths: vec![FOLDER.clone()],
        readable: Folders::Only(vec![FOLDER.clone()]),
        writes: Writes::InMemory,
        max_repeated_tokens: PATIENCE,
        memory: Some(MEMORY),
        ..ReadOptions::default()
    }
}

/// Draws a scene as the program does.
fn draw(scene: &[u8], render: &RenderOptions) {
    let stop = CancelToken::default();
    let read = ReadOptions {
        width: render.width,
        height: render.height,
        stop: stop.clone(),
        ..read_options()
    };
    let render = RenderOptions {
        stop: stop.clone(),
        ..render.clone()
    };
    let input = Input::Text {
        name: "fuzz.pov".to_owned(),
        text: scene.to_vec(),
    };
    let (ended, watch) = channel::<()>();
    let watching = thread::spawn(move || {
        if watch.recv_timeout(TIMEOUT) == Err(RecvTimeoutError::Timeout) {
            stop.cancel();
        }
    });
    let session = RenderSession::of_one(Some(Arc::clone(&POOL)));
    let listen = |event: Event<'_>| {
        if let Event::Finding(message) = event {
            assert!(!message.excerpt.is_empty());
        }
    };
    let _ = session.draw(&input, &read, &render, &listen);
    drop(ended);
    let _ = watching.join();
}
