//! The part in which a file, or a text, differs from another text.

#[cfg(feature = "cli")]
mod of_file;

#[cfg(feature = "cli")]
pub(crate) use of_file::difference;

/// Texts are compared in blocks of this many bytes.
const BLOCK: usize = 1 << 12;

/// The length of the common beginning of two texts.
pub(crate) fn common_start(a: &[u8], b: &[u8]) -> usize {
    let blocks = a.chunks_exact(BLOCK).zip(b.chunks_exact(BLOCK));
    let blocks = BLOCK * blocks.take_while(|(a, b)| a == b).count();
    let bytes = a[blocks..].iter().zip(&b[blocks..]);
    blocks + bytes.take_while(|(a, b)| a == b).count()
}

/// The length of the common end of two texts of the same length.
pub(crate) fn common_end(a: &[u8], b: &[u8]) -> usize {
    let blocks = a.rchunks_exact(BLOCK).zip(b.rchunks_exact(BLOCK));
    let blocks = BLOCK * blocks.take_while(|(a, b)| a == b).count();
    let rest = |text: &[u8]| text.len() - blocks;
    let bytes = a[..rest(a)].iter().rev().zip(b[..rest(b)].iter().rev());
    blocks + bytes.take_while(|(a, b)| a == b).count()
}
