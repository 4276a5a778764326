//! The limits of reading: what no scene needs, and what keeps a faulty one from taking the machine.

/// Blocks in blocks, and parentheses in parentheses. The deepest real scenes nest about a thousand.
pub(super) const NESTING: usize = 10_000;
/// Macro calls and includes inside each other.
pub(super) const CALLS: usize = 4_000;
/// Parentheses, vectors and calls inside each other in one expression.
pub(super) const EXPRESSION: usize = 1_000;
/// Files included inside each other; POV-Ray stops at 100.
pub(super) const INCLUDES: usize = 100;
/// Rounds of all loops of a run. A scene that builds a million objects takes a few million.
pub(super) const ROUNDS: u64 = 100_000_000;
/// Items of one array.
pub(super) const ARRAY_ITEMS: usize = 50_000_000;
/// Bytes of one string.
pub(super) const STRING: usize = 10_000_000;
/// Errors after which reading gives up.
pub(super) const ERRORS: usize = 20;
/// Calls and includes named in one message.
pub(super) const TRACE: usize = 6;
/// Characters of the scene quoted in one message.
pub(super) const QUOTED: usize = 60;
/// Objects of one scene.
pub(super) const OBJECTS: usize = 200_000_000;
/// Warnings kept of one run.
pub(super) const FINDINGS: usize = 1_000;
