//! Limits on reading: more than any scene needs, and low enough that a faulty one cannot exhaust the machine.

use crate::scene::Object;

/// Nested blocks. Programs write a hundred thousand nested differences; people about ten levels.
pub(super) const NESTING: usize = 120_000;
/// Nested directives, conditions, strings and macro arguments. Each takes two to four KiB of stack.
pub(super) const READING: usize = 1_000;
/// Nested macro calls and includes.
pub(super) const CALLS: usize = 4_000;
/// Nested parentheses, vectors and calls in one expression.
pub(super) const EXPRESSION: usize = 1_000;
/// Nested includes; POV-Ray stops at 100.
pub(super) const INCLUDES: usize = 100;
/// Depth of an object tree, including objects that were referenced by name.
pub(super) const HEIGHT: usize = 120_000;
/// Depth without the objects that merge with their parent: the time of a ray may grow with its square.
pub(super) const TURNS: usize = 2_000;
/// Scenes with many objects need long loops: each object adds the token limit divided by this, 2,000 tokens with the
/// usual limit.
pub(super) const PATIENCE_FOR_OBJECT: u64 = 1_500_000;
/// Tokens that may be read again for each byte written to files: scenes that generate meshes write much.
pub(super) const TOKENS_FOR_BYTE: u64 = 8;
/// Items of one array.
pub(super) const ARRAY_ITEMS: usize = 50_000_000;
/// Bytes of one string.
pub(super) const STRING: usize = 10_000_000;
/// Errors after which reading stops.
pub(super) const ERRORS: usize = 20;
/// Most errors, with consequences of earlier ones, after which no more of a scene is read.
pub(super) const ALL_ERRORS: usize = 500;
/// Calls, loops and includes named in one message.
pub(super) const TRACE: usize = 6;
/// Variables shown for each step of the trace.
pub(super) const TRACE_VALUES: usize = 4;
/// Characters of the scene quoted in one message.
pub(super) const QUOTED: usize = 60;
/// Primitives of one scene; the shared parts of large unions, and each copy, count once.
pub(super) const LEAVES: u64 = 200_000_000;
/// Primitives of one scene, each counted as often as it is drawn: they are numbered.
pub(super) const SHOWN: u64 = 4_000_000_000;
/// Objects with fewer primitives are compiled for `trace`, `inside` and patterns without a check of memory.
pub(super) const PROBED: u32 = 1_000_000;
/// Files that a scene has open at once.
pub(super) const FILES: usize = 64;
/// Bytes that a scene writes to files in a run.
pub(super) const WRITTEN: u64 = 1 << 30;
/// Bytes that `#debug` and the like write in a run.
pub(super) const MESSAGES: usize = 16 << 20;
/// Memory is measured after about this many bytes; a measurement takes as long as reading a hundred tokens.
pub(super) const MEMORY_STEP: u64 = 16 << 20;
/// Bytes of a primitive in the compiled scene, measured: 405 for a plain sphere.
pub(super) const LEAF_BYTES: u64 = 500;
/// Bytes of an object while it is read, measured: 64 for a sphere of one colour, 620 for a general object with a
/// transform.
pub(super) const OBJECT_BYTES: u64 = 600;
/// Bytes that a round of a loop may leave behind: a few values.
pub(super) const ROUND_BYTES: u64 = 100;
/// Bytes of a stream of random numbers, including the spare capacity of the growing list.
pub(super) const STREAM_BYTES: u64 = 8;
/// Bytes of memory for each byte of a scene file, measured: text, tokens and numbers.
pub(super) const FILE_BYTES: u64 = 8;
/// Warnings recorded of one run.
pub(super) const FINDINGS: usize = 1_000;

/// The message for an object that exceeds a limit.
pub(super) fn exceeded(object: &Object) -> Option<String> {
    let size = object.size();
    if size.height as usize > HEIGHT {
        Some(format!(
            "objects lie inside each other more than {HEIGHT} deep"
        ))
    } else if size.csg_depth as usize > TURNS {
        Some(format!(
            "different CSG objects are nested more than {TURNS} deep"
        ))
    } else if u64::from(size.leaves) > SHOWN {
        Some(format!("this object comes to more than {SHOWN} shapes"))
    } else {
        None
    }
}

/// Floats that differ by no more than this are equal in the language.
pub(crate) const EQUAL: f64 = 1e-10;

/// Bytes of a piece to tokenize: short where literals are interrupted, longer where they end.
pub(crate) const MIN_PIECE: usize = 1 << 10;
