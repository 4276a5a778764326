//! From text to flat tokens by the pest grammar of `grammar/`, and the table of reserved words made from the same folder.

mod word;

pub use word::{Class, Word};
