//! Files that a scene has opened.

use super::data_file::DataFile;
use crate::base::args::Word;
use crate::base::file::{
    Folders, PendingFile, check_appendable, check_replaceable, only_regular, open_appending,
};
use crate::base::source::{HeldFile, Sources};
use std::fs::File;
use std::io;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

/// The files of a run, by the handles that identifiers hold.
#[derive(Debug, Default)]
pub(crate) struct Files {
    /// Those that are open, in the order of opening. There are few, even where a scene opens very many in turn.
    open: Vec<Slot>,
    /// The number of files opened so far, which is the next handle.
    opened: usize,
    /// Bytes written in the whole run.
    pub(crate) written: u64,
}

impl Files {
    /// Stores an open file and returns its handle, which no file had before.
    pub(crate) fn add(&mut self, file: OpenFile) -> usize {
        let handle = self.opened;
        self.opened += 1;
        self.open.push(Slot {
            handle,
            file: Some(file),
        });
        handle
    }

    /// The number of open files.
    pub(crate) fn len(&self) -> usize {
        self.open.len()
    }

    /// The handles of all open files.
    pub(crate) fn handles(&self) -> Vec<usize> {
        self.open.iter().map(|slot| slot.handle).collect()
    }

    /// An open file.
    pub(crate) fn get(&mut self, handle: usize) -> Option<&mut OpenFile> {
        let mut slots = self.open.iter_mut();
        slots.find(|slot| slot.handle == handle)?.file.as_mut()
    }

    /// Takes an open file out of its slot, until [`Files::put`] or [`Files::close`].
    pub(crate) fn take(&mut self, handle: usize) -> Option<OpenFile> {
        let mut slots = self.open.iter_mut();
        slots.find(|slot| slot.handle == handle)?.file.take()
    }

    /// Puts a file back that was taken.
    pub(crate) fn put(&mut self, handle: usize, file: OpenFile) {
        let mut slots = self.open.iter_mut();
        if let Some(slot) = slots.find(|slot| slot.handle == handle) {
            slot.file = Some(file);
        }
    }

    /// Forgets a file.
    pub(crate) fn close(&mut self, handle: usize) {
        self.open.retain(|slot| slot.handle != handle);
    }

    /// Forgets all files.
    pub(crate) fn clear(&mut self) {
        self.open.clear();
    }

    /// Bytes written in the whole run.
    pub(crate) fn written(&self) -> u64 {
        self.written
    }
}

/// An open file, which is absent while it is read.
#[derive(Debug)]
struct Slot {
    handle: usize,
    file: Option<OpenFile>,
}

#[derive(Debug)]
pub(crate) enum OpenFile {
    Read(DataFile),
    Write(Box<Output>),
}

/// An output file.
#[derive(Debug)]
pub(crate) struct Output {
    pub(crate) name: String,
    pub(crate) path: PathBuf,
    pub(crate) to: To,
}

/// The destination of the bytes: a file without its final name, one that has it, or memory.
#[derive(Debug)]
pub(crate) enum To {
    Pending(BufWriter<PendingFile>),
    Named(BufWriter<File>),
    Memory(HeldFile),
}

impl Output {
    pub(in crate::lang) fn new(name: String, mode: Word, folders: &Folders) -> io::Result<Self> {
        let path = PathBuf::from(&name);
        let to = if mode == Word::Append {
            To::Named(BufWriter::new(open_appending(&path, folders)?))
        } else {
            only_regular(&path)?;
            To::Pending(BufWriter::new(PendingFile::new(&path, folders)?))
        };
        Ok(Output { name, path, to })
    }

    /// The same without any change on disk.
    pub(in crate::lang) fn in_memory(
        name: String,
        mode: Word,
        sources: &mut Sources,
    ) -> io::Result<Self> {
        let path = PathBuf::from(&name);
        let held = if mode == Word::Append {
            check_appendable(&path)?;
            sources.held_to_append(&path)
        } else {
            check_replaceable(&path)?;
            HeldFile::default()
        };
        let to = To::Memory(held);
        Ok(Output { name, path, to })
    }

    /// True if the output is held in memory.
    pub(crate) fn is_in_memory(&self) -> bool {
        matches!(self.to, To::Memory(_))
    }

    pub(crate) fn write(&mut self, text: &str) -> io::Result<()> {
        match &mut self.to {
            To::Pending(file) => file.write_all(text.as_bytes()),
            To::Named(file) => file.write_all(text.as_bytes()),
            To::Memory(held) => {
                held.write(text);
                Ok(())
            }
        }
    }

    /// Makes everything written so far visible under the file's name.
    pub(crate) fn publish(self, sources: &mut Sources) -> io::Result<Self> {
        let to = match self.to {
            To::Pending(file) => {
                let pending = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                To::Named(BufWriter::new(pending.persist()?))
            }
            To::Named(mut file) => {
                file.flush()?;
                To::Named(file)
            }
            To::Memory(held) => {
                sources.hold_in_memory(&self.path, &held);
                To::Memory(held)
            }
        };
        sources.record_write(&self.path);
        Ok(Output { to, ..self })
    }
}
