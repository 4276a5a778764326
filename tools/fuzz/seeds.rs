//! Writes the seed corpus: `seeds SCENES FOLDER` makes `FOLDER/TARGET/` for each target, of the scenes and pictures below
//! the folder SCENES and of files that this program writes.

// It has the functions that instrumented code calls.
use libfuzzer_sys as _;
use povr::base::film::Film;
use povr::base::options::{Input, ReadOptions, RenderOptions};
use povr::output::{self, EncodeOptions};
use povr_fuzz::{PHOTONS, PICTURES, USES, VIEW, state_options, state_scene};
use serde_json::json;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Larger files teach a fuzzer little.
const LARGEST: usize = 20_000;

fn main() -> io::Result<()> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [scenes, to] = arguments.as_slice() else {
        return Err(io::Error::other("usage: seeds SCENES FOLDER"));
    };
    let mut seeds = Seeds {
        to: to.clone(),
        count: 0,
    };
    let mut files = Vec::new();
    for folder in [scenes.as_path(), Path::new("/usr/share/fonts")] {
        // Without fonts of the system there is none to begin with.
        let _ = all_files(folder, &mut files);
    }
    for file in files {
        let bytes = fs::read(&file)?;
        let ending = file
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if ending == "ttf" && bytes.len() < 3 * LARGEST {
            seeds.put("font", &bytes)?;
        }
        if bytes.len() > LARGEST {
            continue;
        }
        match ending.as_str() {
            "pov" | "inc" => {
                for target in ["tokens", "language", "scene"] {
                    seeds.put(target, &bytes)?;
                }
            }
            "df3" => seeds.put("density", &bytes)?,
            "ini" => seeds.put("options", &[b"\n", bytes.as_slice()].concat())?,
            "jpg" => seeds.picture("jpeg", &bytes)?,
            "tif" => seeds.picture("tiff", &bytes)?,
            ending => seeds.picture(ending, &bytes)?,
        }
    }
    let film = drawn(VIEW, &RenderOptions::of_size(8, 6))?;
    for format in output::formats() {
        for bits in [8, 16, 32] {
            let options = EncodeOptions {
                bits,
                alpha: bits == 16,
                ..EncodeOptions::new(format)
            };
            if let Ok(bytes) = output::encode(&film, &options) {
                seeds.picture(
                    &format.name.to_ascii_lowercase().replace("compressed ", ""),
                    &bytes,
                )?;
            }
        }
    }
    seeds.put(
        "density",
        &[
            &[0, 2, 0, 2, 0, 2],
            [0, 50, 100, 150, 200, 250, 20, 10].as_slice(),
        ]
        .concat(),
    )?;
    let temporary = tempfile::tempdir()?;
    let map = temporary.path().join("map");
    let save = format!("save_file {:?}", map.display().to_string());
    drawn(
        &PHOTONS.replace("FILE", &save),
        &RenderOptions::of_size(8, 6),
    )?;
    seeds.put("photons", &fs::read(&map)?)?;
    let state = temporary.path().join("state");
    drawn(&state_scene(), &state_options(state.clone()))?;
    seeds.put("state", &fs::read(&state)?)?;
    seeds.put("journal", b"\n{\"output\":\"a.png\",\"key\":\"0\",\"made\":\"1\",\"files\":[[\"/a.pov\",\"2\"]],\"missing\":[\"/b\"]}\n")?;
    seeds.put("replies", &replies()?)?;
    for words in [
        "+Ia.pov\n+W320\n+H240\n+A0.3\n+AM2\n+R3\n-D\n+FN8\n+Oa.png",
        "a.pov\n--error\n1\n--timeout\n3s\n--sandbox\n--allow-read\n/tmp",
        "+K0.5\n+KFI1\n+KFF9\n+SF2\n+EF3\n+KC\n+SR0.1\n+ER0.5\n+SC2\n+EC5",
        "a.ini[b]\n+L/tmp\nDeclare=A=3\n+UA\n+GFdebug.txt\n-GA\n+Q9\n+MV3.1",
        "\nInput_File_Name=a.pov\nWidth=32\n[part]\nDisplay=off ; comment\nFinal_Frame=3\n",
    ] {
        seeds.put("options", words.as_bytes())?;
    }
    Ok(())
}

/// Replies about a picture of three bytes.
fn replies() -> io::Result<Vec<u8>> {
    let span =
        json!({ "file": "a.pov", "line": 1, "column": 2, "end": { "line": 1, "column": 3 } });
    let mut note = span.clone();
    note["text"] = "a note".into();
    let mut finding = span;
    for (key, value) in [
        ("severity", json!("error")),
        ("code", json!("limit")),
        ("message", json!("a message")),
        ("labels", json!([note])),
        ("trace", json!([note])),
        ("hints", json!(["a hint"])),
        ("fix", note.clone()),
    ] {
        finding[key] = value;
    }
    let dependency = json!({ "path": "/a.inc", "is_there": false });
    let mut bytes = Vec::new();
    for reply in [
        json!({ "Report": { "Weaker": "no Landlock" } }),
        json!({ "Output": "text" }),
        json!({ "Finding": [finding, ["a line", "an excerpt", "in colour"]] }),
        json!({ "Read": { "dependencies": [dependency], "wrote_files": true } }),
        json!({ "Drawn": 9 }),
        json!({ "Limit": "Time" }),
        json!({ "Done": [3] }),
    ] {
        let reply = rmp_serde::to_vec_named(&reply).map_err(io::Error::other)?;
        let length = u32::try_from(reply.len()).map_err(io::Error::other)?;
        bytes.extend(length.to_le_bytes());
        bytes.extend(reply);
    }
    bytes.extend(b"abc");
    Ok(bytes)
}

struct Seeds {
    to: PathBuf,
    count: usize,
}

impl Seeds {
    fn put(&mut self, target: &str, bytes: &[u8]) -> io::Result<()> {
        let folder = self.to.join(target);
        fs::create_dir_all(&folder)?;
        self.count += 1;
        fs::write(folder.join(format!("seed-{}", self.count)), bytes)
    }

    /// A picture in each use.
    fn picture(&mut self, kind: &str, bytes: &[u8]) -> io::Result<()> {
        let Some(kind) = PICTURES.iter().position(|known| *known == kind) else {
            return Ok(());
        };
        for usage in 0..USES.len() {
            let [kind, usage] = [kind, usage].map(|number| u8::try_from(number).unwrap_or(0));
            self.put("picture", &[&[kind, usage], bytes].concat())?;
        }
        Ok(())
    }
}

fn all_files(folder: &Path, to: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        match path.is_dir() {
            true => all_files(&path, to)?,
            false => to.push(path),
        }
    }
    Ok(())
}

fn drawn(scene: &str, render: &RenderOptions) -> io::Result<Film> {
    let read = ReadOptions {
        writable: povr::base::file::Folders::All,
        width: render.width,
        height: render.height,
        ..ReadOptions::default()
    };
    let input = Input::Text {
        name: "seed".to_owned(),
        text: scene.as_bytes().to_vec(),
    };
    let drawn = povr::draw(&input, &read, render, &|_| {});
    drawn.map(|picture| picture.film).map_err(io::Error::other)
}
