//! Messages between a command and a worker: MessagePack, each behind its length in four bytes.
//!
//! Both ends know the maximum lengths: a message that is longer is an error for the end that wants to send it, and
//! nobody reads one.

use crate::base::options::{Event, ReadOptions, RenderOptions};
use crate::base::source::{Dependency, Location, Message, TextChange};
use crate::output::EncodeOptions;
use crate::scene::camera::View;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Maximum length of a request in bytes. It may contain the text of a scene.
const LONGEST_REQUEST: usize = 1 << 28;
/// Maximum length of a reply in bytes, pictures excluded: a worker that a scene has taken over cannot exhaust the memory
/// of the command. The longest string of a scene has 10 MB.
const LONGEST_REPLY: usize = 16 << 20;
/// Maximum length of the file of a picture in progress in bytes.
pub(crate) const LONGEST_PARTIAL: u64 = 32 << 20;

/// A request to a worker.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Request {
    /// Draw a picture.
    Draw(Box<Draw>),
    /// Cancel the current picture.
    Stop,
    /// Use this number of threads for the current picture, if it is more than before.
    Threads(usize),
}

/// A picture for a worker to draw.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Draw {
    /// The scene.
    pub(crate) scene: PathBuf,
    /// Successive pictures with the same number are of one scene, whose tokens the worker caches.
    pub(crate) series: Option<usize>,
    /// Options for reading the scene.
    pub(crate) read: ReadOptions,
    /// Options for rendering.
    pub(crate) render: RenderOptions,
    /// The number of threads to begin with; the others wait for [`Request::Threads`]. `None` begins with all.
    pub(crate) threads: Option<usize>,
    /// The files to encode of the picture.
    pub(crate) files: Vec<EncodeOptions>,
    /// True if the worker sends the scene's `#debug` output.
    pub(crate) tells_output: bool,
    /// Time limit for the picture.
    pub(crate) timeout: Option<Duration>,
    /// Memory limit for the process, in bytes.
    pub(crate) max_memory: Option<u64>,
    /// True if the worker enters a sandbox first. It draws no other scene then.
    pub(crate) is_sandboxed: bool,
    /// True if the worker gives way to other processes from its first picture on, where the system can do that.
    pub(crate) is_background: bool,
    /// For a scene that stays compiled from one picture to the next.
    pub(crate) live: Option<Live>,
}

/// A picture of a scene that stays compiled.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Live {
    /// The number of the scene's text with the options for reading it: the scene is read and compiled when it changes.
    pub(crate) number: u64,
    /// The text.
    pub(crate) text: LiveText,
    /// True if there is no file: the scene is one that povr brings along.
    pub(crate) is_built_in: bool,
    /// The statement of the camera, if it is not the scene's own.
    pub(crate) camera: Option<String>,
    pub(crate) task: LiveTask,
}

/// The text of a live scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum LiveText {
    /// That of the file, which the worker reads.
    File,
    /// The last one that was sent, which had the same number.
    Sent,
    /// The last one that was sent, with another part.
    Changed(Splice),
    /// This one.
    Whole(String),
}

/// A part of a text in place of another one.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Splice {
    /// The bytes that are replaced.
    pub(crate) range: Range<usize>,
    pub(crate) with: String,
}

impl Splice {
    /// Applies it to a text; false if it has no such part.
    pub(crate) fn apply(&self, text: &mut String) -> bool {
        let is_there = text.get(self.range.clone()).is_some();
        if is_there {
            text.replace_range(self.range.clone(), &self.with);
        }
        is_there
    }

    /// True if it changes nothing.
    pub(crate) fn is_empty(&self) -> bool {
        self.range.is_empty() && self.with.is_empty()
    }

    /// The range that changes.
    pub(crate) fn change(&self) -> TextChange {
        TextChange {
            old: self.range.clone(),
            new_end: self.range.start + self.with.len(),
        }
    }
}

/// The product of a live scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum LiveTask {
    /// A coarse picture, over which the next whole one is drawn.
    Coarse,
    /// A whole picture; it is also sent in progress.
    Whole,
    /// A report on the pixel of this column and row, instead of a picture.
    Pixel(u32, u32),
    /// A map of the picture.
    Map(MapKind),
}

/// A map of the pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum MapKind {
    /// Rays traced without antialiasing.
    Rays,
    /// Microseconds to trace them.
    Time,
    /// Estimated error of the picture, in steps of 1/255 of the working space.
    Error,
}

/// The scale of a map: logarithmic, from zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct MapReport {
    /// The value of the brightest colour.
    pub(crate) brightest: f64,
    pub(crate) largest: f64,
    pub(crate) mean: f64,
}

/// A report of a worker that is no event of the scene.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Report {
    /// The kernel does not enforce a part of the sandbox.
    Weaker(String),
    /// A live scene has been compiled.
    Camera(Box<CameraReport>),
    /// The time to draw a picture of a live scene, without that to read and to encode.
    Traced(Duration),
    /// The pixel that was asked for.
    Picked(Box<Picked>),
    /// The map that was asked for.
    Map(MapReport),
    /// The statistics of a live scene and its whole picture, as JSON.
    Statistics(String),
    /// The part of the whole picture in which it differs from an earlier one; its files follow.
    Patch(Box<Patch>),
    /// The file of a picture in progress, which comes behind a [`Reply::Partial`].
    #[serde(skip)]
    Partial(Vec<u8>),
}

/// A whole picture by the number and the camera of its scene ([`Live`]).
pub(crate) type PictureKey = (u64, Option<String>);

/// The part of a whole picture in which it differs from an earlier one.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Patch {
    /// The earlier picture.
    pub(crate) over: PictureKey,
    /// The position of its upper left pixel in the whole picture.
    pub(crate) column: u32,
    pub(crate) row: u32,
    /// A PNG file in base64, as a page takes it.
    pub(crate) png: String,
}

/// A pixel and the surface that the camera sees in its centre.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Picked {
    pub(crate) column: u32,
    pub(crate) row: u32,
    /// The surface; `None` for the background.
    pub(crate) surface: Option<PickedSurface>,
    /// The rays traced for the pixel, by kind.
    pub(crate) rays: BTreeMap<String, u64>,
    /// The time to trace them in seconds.
    pub(crate) seconds: f64,
}

/// A point of a surface, in the coordinates of the scene's text.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct PickedSurface {
    pub(crate) point: [f64; 3],
    /// The unit normal towards the camera, before any `normal` pattern.
    pub(crate) normal: [f64; 3],
    pub(crate) distance: f64,
    /// The start of the object's statement, if it was found.
    pub(crate) object: Option<Location>,
}

/// The camera of a scene, for those who move it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct CameraReport {
    /// The camera of the scene; `None` if it cannot be moved.
    pub(crate) view: Option<View>,
    /// The same without the point in its centre, which depends on the objects: equal for equal cameras.
    pub(crate) aimless: Option<View>,
    /// The bytes of its statement in the decoded text of the scene, if it stands there.
    pub(crate) statement: Option<Range<usize>>,
}

/// A reply of a worker.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Reply {
    /// Anything that is no event of the scene.
    Report(Report),
    /// As [`Event::SceneOutput`].
    Output(String),
    /// As [`Event::Finding`], with the texts that a serialised message does not have.
    Finding(Box<Message>, [String; 3]),
    /// As [`Event::Read`].
    Read {
        dependencies: Vec<Dependency>,
        wrote_files: bool,
    },
    /// As [`Event::Drawn`].
    Drawn(u64),
    /// The file of the picture in progress follows, with this length in bytes.
    Partial(u64),
    /// A limit is reached. The worker cancels the picture, and ends soon.
    Limit(Limit),
    /// The picture is finished; its files follow, with these lengths in bytes.
    Done(Vec<u64>),
    /// There is no picture; the reason, unless the findings give it.
    Failed(Option<String>),
}

/// A limit of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Limit {
    Time,
    Memory,
}

impl Limit {
    /// The excess as a message without its subject, for these limits.
    pub(crate) fn excess(self, timeout: Option<Duration>, max_memory: Option<u64>) -> String {
        match self {
            Limit::Time => format!(
                "took longer than {:?}, which `--timeout` allows",
                timeout.unwrap_or_default()
            ),
            Limit::Memory => format!(
                "took more memory than the {} MB that `--max-memory` allows",
                max_memory.unwrap_or_default() >> 20
            ),
        }
    }
}

impl Reply {
    /// The reply that stands for an event; `None` for events that a worker's pictures do not have.
    pub(crate) fn of(event: Event<'_>) -> Option<Self> {
        Some(match event {
            Event::SceneOutput(text) => Reply::Output(text.to_owned()),
            Event::Finding(message) => {
                let texts = [&message.pov_line, &message.excerpt, &message.colored];
                Reply::Finding(Box::new(message.clone()), texts.map(String::clone))
            }
            Event::Read {
                dependencies,
                wrote_files,
            } => Reply::Read {
                dependencies: dependencies.to_vec(),
                wrote_files,
            },
            Event::Drawn(pixels) => Reply::Drawn(pixels),
            _ => return None,
        })
    }
}

impl Live {
    /// The picture that is asked for, among whole ones.
    pub(crate) fn picture(&self) -> PictureKey {
        (self.number, self.camera.clone())
    }
}

impl Request {
    /// The bytes of the message.
    ///
    /// # Errors
    /// It is too long, or contains a path that is not UTF-8.
    pub(crate) fn encoded(&self) -> io::Result<Vec<u8>> {
        encoded(self, LONGEST_REQUEST)
    }

    /// Reads a request.
    ///
    /// # Errors
    /// The command has ended, or this is no request.
    pub(crate) fn read(from: &mut impl Read) -> io::Result<Self> {
        read_message(from, LONGEST_REQUEST)
    }
}

impl Reply {
    /// The bytes of the message.
    ///
    /// # Errors
    /// As for [`Request::encoded`].
    pub(crate) fn encoded(&self) -> io::Result<Vec<u8>> {
        encoded(self, LONGEST_REPLY)
    }

    /// Reads a reply.
    ///
    /// # Errors
    /// The worker has ended, or writes anything else.
    pub(super) fn read(from: &mut impl Read) -> io::Result<Self> {
        read_message(from, LONGEST_REPLY)
    }
}

fn encoded(message: &impl Serialize, longest: usize) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; size_of::<u32>()];
    rmp_serde::encode::write_named(&mut bytes, message).map_err(io::Error::other)?;
    let length = bytes.len() - size_of::<u32>();
    match u32::try_from(length) {
        Ok(header) if length <= longest => {
            bytes[..size_of::<u32>()].copy_from_slice(&header.to_le_bytes());
            Ok(bytes)
        }
        _ => Err(io::Error::other(format!(
            "it takes {} MB, and {} MB are the limit",
            length.div_ceil(1 << 20),
            longest >> 20
        ))),
    }
}

fn read_message<M: DeserializeOwned>(from: &mut impl Read, longest: usize) -> io::Result<M> {
    let mut length = [0; size_of::<u32>()];
    from.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if length as usize > longest {
        return Err(io::ErrorKind::InvalidData.into());
    }
    rmp_serde::from_slice(&read_bytes(from, length.into())?).map_err(io::Error::other)
}

/// Reads this number of bytes; no more memory is taken than bytes come.
pub(super) fn read_bytes(from: &mut impl Read, length: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(length).read_to_end(&mut bytes)?;
    match bytes.len() as u64 == length {
        true => Ok(bytes),
        false => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reply_that_is_too_long_is_neither_sent_nor_read() {
        let reply = |length| Reply::Output("a".repeat(length));
        let longest = reply(LONGEST_REPLY - 20).encoded().unwrap();
        assert!(Reply::read(&mut longest.as_slice()).is_ok());
        let refused = reply(LONGEST_REPLY).encoded().unwrap_err().to_string();
        assert_eq!(refused, "it takes 17 MB, and 16 MB are the limit");
        let request = encoded(&reply(LONGEST_REPLY), LONGEST_REQUEST).unwrap();
        let read = Reply::read(&mut request.as_slice()).unwrap_err();
        assert_eq!(read.kind(), io::ErrorKind::InvalidData);
    }

    #[test]
    fn a_length_without_its_bytes_takes_no_memory() {
        let claimed = u32::try_from(LONGEST_REPLY).unwrap().to_le_bytes();
        let read = Reply::read(&mut claimed.as_slice()).unwrap_err();
        assert_eq!(read.kind(), io::ErrorKind::UnexpectedEof);
    }
}
