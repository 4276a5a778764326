//! Spans of source texts.

/// Identifies a source text of a run by its index in reading order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FileId(pub u32);

/// A half-open range of bytes in one source text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// The source text.
    pub file: FileId,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

impl Span {
    /// A span of `file`.
    #[must_use]
    pub fn new(file: FileId, start: u32, end: u32) -> Self {
        Span { file, start, end }
    }

    /// The span from the start of this one to the end of `last`; only this one if `last` lies in another file.
    #[must_use]
    pub fn to(self, last: Span) -> Span {
        if last.file == self.file && last.end >= self.start {
            Span {
                end: last.end,
                ..self
            }
        } else {
            self
        }
    }
}
