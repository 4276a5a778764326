//! The limits of reading: what no scene needs, and what keeps a faulty one from taking the machine.

use crate::scene::Object;

/// Blocks in blocks. Programs write differences of a hundred thousand, one in the other; hands nest about ten.
pub(super) const NESTING: usize = 120_000;
/// Directives, conditions, strings and macro arguments that are read while another is being read. Each takes two to
/// four KiB of stack.
pub(super) const READING: usize = 1_000;
/// Macro calls and includes inside each other.
pub(super) const CALLS: usize = 4_000;
/// Parentheses, vectors and calls inside each other in one expression.
pub(super) const EXPRESSION: usize = 1_000;
/// Files included inside each other; POV-Ray stops at 100.
pub(super) const INCLUDES: usize = 100;
/// Objects inside each other, by whatever names they got there.
pub(super) const HEIGHT: usize = 120_000;
/// The same without those that come to one with the object around them: a ray's time may grow with the square.
pub(super) const TURNS: usize = 2_000;
/// Who makes many objects works long: for each object that the scene has made, this share of the reader's patience may
/// be read again beyond it. 2,000 tokens, as patience commonly is.
pub(super) const PATIENCE_FOR_OBJECT: u64 = 75_000;
/// Tokens that may be read again for each byte that the scene has written to files: what makes meshes writes long.
pub(super) const TOKENS_FOR_BYTE: u64 = 8;
/// Items of one array.
pub(super) const ARRAY_ITEMS: usize = 50_000_000;
/// Bytes of one string.
pub(super) const STRING: usize = 10_000_000;
/// Errors after which reading gives up.
pub(super) const ERRORS: usize = 20;
/// Calls, loops and includes named in one message.
pub(super) const TRACE: usize = 6;
/// Values named in one step of that.
pub(super) const TOLD: usize = 4;
/// Characters of the scene quoted in one message.
pub(super) const QUOTED: usize = 60;
/// Shapes of one scene; what large unions share, and each copy of them, counts once.
pub(super) const LEAVES: u64 = 200_000_000;
/// Shapes of one scene, each counted as often as it is drawn: they are numbered.
pub(super) const SHOWN: u64 = 4_000_000_000;
/// Objects with fewer shapes are looked into by `trace`, `inside` and patterns without counting more closely.
pub(super) const PROBED: u32 = 1_000_000;
/// Files that a scene has open at once.
pub(super) const FILES: usize = 64;
/// Bytes that a scene writes to files in a run.
pub(super) const WRITTEN: u64 = 1 << 30;
/// Bytes that `#debug` and the like write in a run.
pub(super) const MESSAGES: usize = 16 << 20;
/// After so many bytes that may have been taken, memory is looked at, which takes as long as reading a hundred tokens.
pub(super) const MEMORY_STEP: u64 = 16 << 20;
/// Bytes that a shape takes in the compiled scene, measured: 405 for a plain sphere.
pub(super) const LEAF_BYTES: u64 = 500;
/// Bytes that an object takes while it is read, measured: 64 for a sphere of one colour, 620 for a moved one kept whole.
pub(super) const OBJECT_BYTES: u64 = 600;
/// Bytes that a round of a loop may leave behind: a few values.
pub(super) const ROUND_BYTES: u64 = 100;
/// Bytes that a stream of random numbers takes, with the room that a growing list keeps free.
pub(super) const STREAM_BYTES: u64 = 8;
/// Bytes of memory for each byte of a scene file, measured: text, tokens and numbers.
pub(super) const FILE_BYTES: u64 = 8;
/// Warnings kept of one run.
pub(super) const FINDINGS: usize = 1_000;

/// What an object has too much of, as a message.
pub(super) fn exceeded(object: &Object) -> Option<String> {
    let size = object.size();
    if size.height as usize > HEIGHT {
        Some(format!(
            "objects lie inside each other more than {HEIGHT} deep"
        ))
    } else if size.turns as usize > TURNS {
        Some(format!(
            "combinations that differ lie inside each other more than {TURNS} deep"
        ))
    } else if u64::from(size.leaves) > SHOWN {
        Some(format!("this object comes to more than {SHOWN} shapes"))
    } else {
        None
    }
}
