//! `#fopen`, `#fclose`, `#read` and `#write`: files that a scene reads values from and writes text to.
//!
//! Output goes to an unnamed file, which gets its name at `#fclose`, at the end of the scene, or as soon as the scene
//! accesses any file; a scene that fails before leaves the old file as it was. Only [`ReadOptions::writable`] folders
//! are written to. POV-Ray on Debian is configured the same, but 3.7.0.10 does not enforce it.
//!
//! [`ReadOptions::writable`]: crate::base::options::ReadOptions::writable

use super::data_file::DataFile;
use super::open_file::{OpenFile, Output};
use crate::base::args::{Args, Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::base::version::has_defaults_of_3_8;
use crate::lang::expr::strings::general;
use crate::lang::expr::value::{Number, Value};
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use std::rc::Rc;

impl Reader<'_> {
    /// `#fopen Name "file" read`, or `write`, or `append`.
    pub(crate) fn run_fopen(&mut self) -> Parse<()> {
        self.peek()?;
        let symbol = self.identifier("a name for the file after `#fopen`")?;
        if let Some(held) = self.scopes.get(symbol) {
            let hint = match held {
                Value::File(_) => "Close the file with `#fclose` first.",
                _ => "Take another name, or `#undef` this one.",
            };
            let message = format!("this name is taken: it is {}", held.kind());
            let error = Diagnostic::error(self.taken_span(), message);
            return Err(self.with_trace(error.with_hint(hint)));
        }
        let name = self.file_name()?;
        let span = self.taken_span();
        let mode = match self.peek()?.word() {
            Some(mode @ (Word::Read | Word::Write | Word::Append)) => mode,
            _ => return Err(self.expected_here("`read`, `write` or `append` after the file name")),
        };
        self.pass();
        if self.files.len() >= limits::FILES {
            let message = format!("a scene has at most {} files open at once", limits::FILES);
            let error = Diagnostic::error(span, message);
            return Err(self.with_trace(error.with_hint("Close files with `#fclose`.")));
        }
        self.publish_files(span)?;
        let file = if mode == Word::Read {
            OpenFile::Read(self.open_data(&name, span)?)
        } else {
            OpenFile::Write(Box::new(self.open_output(name, mode, span)?))
        };
        let handle = self.files.add(file);
        self.scopes.declare(symbol, Value::File(handle));
        Ok(())
    }

    /// The name of a file, in which `\` is no escape before version 3.8.
    pub(crate) fn file_name(&mut self) -> Parse<String> {
        let token = self.peek()?;
        if token.kind != Kind::String || has_defaults_of_3_8(self.draft.version) {
            return self.string();
        }
        self.pass();
        Ok(self.last.tokens.string_raw(token.value).into_owned())
    }

    fn open_data(&mut self, name: &str, span: Span) -> Parse<DataFile> {
        let found = self.sources.find_data(name, span.file);
        let file = found.map_err(|mut error| {
            error.span = Some(span);
            self.with_trace(*error)
        })?;
        Ok(DataFile::new(name.to_owned(), self.tokens_of(file)?))
    }

    /// Makes all output of the scene visible, before it accesses any file.
    pub(crate) fn publish_files(&mut self, span: Span) -> Parse<()> {
        for handle in self.files.handles() {
            if let Some(output) = self.publish(handle, span)? {
                let file = OpenFile::Write(Box::new(output));
                self.files.put(handle, file);
            }
        }
        Ok(())
    }

    fn publish(&mut self, handle: usize, span: Span) -> Parse<Option<Output>> {
        let output = match self.files.take(handle) {
            Some(OpenFile::Write(output)) => output,
            Some(file) => {
                self.files.put(handle, file);
                return Ok(None);
            }
            None => return Ok(None),
        };
        let name = output.name.clone();
        match output.publish(self.sources) {
            Ok(output) => Ok(Some(output)),
            Err(error) => {
                self.files.close(handle);
                Err(self.not_written(&name, &error, span))
            }
        }
    }

    /// At the end of a scene without errors: publishes the files still open for writing.
    pub(crate) fn close_files(&mut self) {
        let span = self.taken_span();
        if let Err(error) = self.publish_files(span) {
            self.record(*error);
        }
        self.files.clear();
    }

    /// `#fclose Name`.
    pub(crate) fn run_fclose(&mut self) -> Parse<()> {
        let token = self.peek()?;
        if matches!(token.kind, Kind::Number | Kind::Word) {
            self.pass();
            return self.closes_nothing();
        }
        let symbol = self.identifier("the name of an open file after `#fclose`")?;
        if self.begins_item(symbol) {
            self.item_path(symbol)?;
        }
        match self.scopes.get(symbol) {
            // POV-Ray says nothing: `#read` has closed it at its end.
            None => Ok(()),
            Some(&Value::File(handle)) => {
                let span = self.taken_span();
                self.scopes.undefine(symbol);
                self.close_file(handle, span)
            }
            Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
            Some(_) => self.closes_nothing(),
        }
    }

    /// Warns of `#fclose` before anything but a file, as POV-Ray accepts it.
    fn closes_nothing(&mut self) -> Parse<()> {
        let message = "this is not an open file; nothing is closed";
        self.warning(Diagnostic::warning(self.taken_span(), message).with_hint("Remove it."));
        Ok(())
    }

    /// Closes a file whose name is undefined.
    pub(crate) fn close_file(&mut self, handle: usize, span: Span) -> Parse<()> {
        self.publish(handle, span)?;
        self.files.close(handle);
        Ok(())
    }

    /// Reads the `(` and the file of `#read` and `#write`.
    fn file_in_parentheses(&mut self, word: Word) -> Parse<(Symbol, usize)> {
        self.expect_mark('(', &format!("`(` after `#{word}`"))?;
        let what = format!("the name of an open file in `#{word}`");
        self.peek()?;
        let symbol = self.identifier(&what)?;
        match self.scopes.get(symbol) {
            Some(&Value::File(handle)) => Ok((symbol, handle)),
            Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
            held => {
                let found = match held {
                    Some(held) => format!("expected an open file, found {}", held.kind()),
                    None => format!("`{}` is not an open file", self.names.spelling(symbol)),
                };
                let hint = "Open it with `#fopen`; at its end a file that is read is closed.";
                let error = Diagnostic::error(self.taken_span(), found);
                Err(self.with_trace(error.with_hint(hint)))
            }
        }
    }

    /// `#write(Name, value, ...)`: strings as they are, numbers and vectors as C's `%g`.
    pub(crate) fn run_write(&mut self) -> Parse<()> {
        let (_, handle) = self.file_in_parentheses(Word::Write)?;
        let span = self.taken_span();
        loop {
            self.take_mark(',')?;
            if self.take_mark(')')? {
                return Ok(());
            }
            let text = if self.at_string()? {
                self.string()?
            } else if self.begins_number()? {
                if self.is_at_color_name()? || self.raw().word() == Some(Word::T) {
                    let reason = "`#write` takes no colours and vectors of four";
                    let remedy = "Write its components: `A.red, \",\", A.green`.";
                    self.refused_by_povray(self.here_span(), reason, remedy);
                }
                written(&self.sum()?)
            } else {
                return Err(self.expected_here("a string, a number, a vector or `)` in `#write`"));
            };
            self.write_text(handle, &text, span)?;
        }
    }

    fn write_text(&mut self, handle: usize, text: &str, span: Span) -> Parse<()> {
        self.files.written += text.len() as u64;
        if self.files.written > limits::WRITTEN {
            self.is_over = true;
            let message = format!("a scene writes at most {} bytes", limits::WRITTEN);
            return Err(self.with_trace(Diagnostic::error(span, message)));
        }
        let open = self.files.get(handle);
        if matches!(open, Some(OpenFile::Write(output)) if output.is_in_memory()) {
            self.take_memory(text.len() as u64, span)?;
        }
        let result = match self.files.get(handle) {
            Some(OpenFile::Write(output)) => {
                let done = output.write(text);
                done.map_err(|error| format!("cannot write `{}`: {error}", output.name))
            }
            Some(OpenFile::Read(data)) => {
                Err(format!("`{}` is open for reading only", data.name()))
            }
            _ => Err("this file is closed".to_owned()),
        };
        result.map_err(|message| self.with_trace(Diagnostic::error(span, message)))
    }

    /// `#read(Name, A, B, ...)`. At the end of the file the remaining names keep their values, and the file is closed
    /// and its name undefined, which `defined` tests. If the file ends with a comma or is empty, the first of them is
    /// declared without a value where it was not declared.
    pub(crate) fn run_read(&mut self) -> Parse<()> {
        let (symbol, handle) = self.file_in_parentheses(Word::Read)?;
        let span = self.taken_span();
        let mut data = match self.files.take(handle) {
            Some(OpenFile::Read(data)) => data,
            other => {
                let message = match &other {
                    Some(OpenFile::Write(output)) => {
                        format!("`{}` is open for writing only", output.name)
                    }
                    _ => "this file is closed".to_owned(),
                };
                if let Some(file) = other {
                    self.files.put(handle, file);
                }
                return Err(self.with_trace(Diagnostic::error(span, message)));
            }
        };
        let result = self.read_values(&mut data);
        if data.is_at_end() {
            self.files.close(handle);
            self.scopes.undefine(symbol);
        } else {
            self.files.put(handle, OpenFile::Read(data));
        }
        result
    }

    fn read_values(&mut self, data: &mut DataFile) -> Parse<()> {
        loop {
            self.take_mark(',')?;
            if self.take_mark(')')? {
                return Ok(());
            }
            let symbol = self.identifier("a name to read into, or `)`")?;
            let path = match self.begins_item(symbol) {
                true => self.item_path(symbol)?,
                false => Vec::new(),
            };
            match self.scopes.get(symbol).and_then(|held| held.item(&path)) {
                None if !path.is_empty() => {
                    let message = "cannot read into an item of an array that has no value yet";
                    let error = Diagnostic::error(self.taken_span(), message);
                    let hint = "Give it one first: `#declare A[0] = 0;`.";
                    return Err(self.with_trace(error.with_hint(hint)));
                }
                None | Some(Value::Number(_) | Value::Text(_) | Value::Poison(_)) => {}
                Some(other) => {
                    let message = format!("cannot read into this name: it is {}", other.kind());
                    let error = Diagnostic::error(self.taken_span(), message);
                    return Err(self.with_trace(error.with_hint("Take a name of its own.")));
                }
            }
            let had_ended = data.is_at_end();
            match data.next(&mut |warning| self.warning(warning)) {
                Ok(Some(value)) if path.is_empty() => self.scopes.declare(symbol, value),
                Ok(Some(value)) => {
                    let array = self.scopes.get_mut(symbol);
                    if let Some(item) = array.and_then(|array| array.item_mut(&path)) {
                        *item = Some(value);
                    }
                }
                // Behind the last comma the name is declared and has no value: whatever reads it is an error.
                Ok(None) if !had_ended && self.scopes.get(symbol).is_none() => {
                    let end = self.error_taken("the file has ended before this value");
                    self.scopes
                        .declare(symbol, Value::Poison(Some(Rc::from(end))));
                }
                Ok(None) => {}
                Err(error) => return Err(self.with_trace(*error)),
            }
        }
    }
}

/// A number in the format of `#write`: a vector has a blank after it.
fn written(number: &Number) -> String {
    if number.len == 1 {
        return general(number.v[0]);
    }
    let parts: Vec<String> = number.v[..usize::from(number.len)]
        .iter()
        .map(|&part| general(part))
        .collect();
    format!("<{}> ", parts.join(","))
}
