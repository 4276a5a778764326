//! The reserved words of a scene.
//!
//! POV-Ray 3.8 reserves words that older scenes may declare, and frees one. Text becomes tokens before its version is
//! known, so the cursor reads such tokens by what is known of the scene.

use super::syntax::{Kind, Names, Symbol, Token};
use crate::base::args::Word;
use crate::base::source::FileId;
use crate::base::word::FREE_SINCE_3_8;
use rustc_hash::FxHashMap;
use std::cell::Cell;

/// The reserved words in force.
#[derive(Debug)]
pub(crate) struct Dialect {
    has_words: bool,
    /// The word that each of the first symbols is in version 3.8.
    words: Vec<Word>,
    /// The symbol of the word that 3.8 frees.
    freed: u32,
    /// The words read so far, a bit for each of `words`.
    used: Cell<u32>,
    /// The names that computed keys of scopes stand for, by the place of their `]`.
    keys: FxHashMap<(FileId, u32), Symbol>,
}

impl Dialect {
    /// The dialect of scenes for POV-Ray 3.8, or of older ones. `names` holds the symbols of the words that 3.8 added.
    pub(crate) fn new(is_for_3_8: bool, names: &Names) -> Dialect {
        Dialect {
            has_words: is_for_3_8,
            words: Word::since_3_8().map(Word::usual).collect(),
            freed: names
                .symbol(FREE_SINCE_3_8.spelling())
                .map_or(u32::MAX, |symbol| symbol.0),
            used: Cell::new(0),
            keys: FxHashMap::default(),
        }
    }

    /// Reserves the words of POV-Ray 3.8 for the rest of the scene; true if they were not.
    pub(crate) fn reserve_words_of_3_8(&mut self) -> bool {
        !std::mem::replace(&mut self.has_words, true)
    }

    /// True if the words of POV-Ray 3.8 are reserved.
    #[inline(always)]
    pub(crate) fn has_words_of_3_8(&self) -> bool {
        self.has_words
    }

    /// Makes the `]` of a computed key the name that it stands for.
    pub(crate) fn set_key(&mut self, close: (FileId, u32), name: Symbol) {
        self.keys.insert(close, name);
    }

    /// Makes the `]` of a computed key a mark again, as long as the key is computed.
    pub(crate) fn forget_key(&mut self, close: (FileId, u32)) {
        self.keys.remove(&close);
    }

    /// A token of a file where the words of 3.8 are reserved.
    pub(crate) fn token(&self, token: Token, file: FileId) -> Token {
        let (kind, value) = match token.kind {
            Kind::Name => match self.words.get(token.value as usize) {
                Some(&word) => {
                    self.used.set(self.used.get() | 1 << token.value);
                    (Kind::Word, word as u32)
                }
                None => return token,
            },
            Kind::Word if token.value == FREE_SINCE_3_8 as u32 => (Kind::Name, self.freed),
            Kind::Mark if token.value == u32::from(b']') && !self.keys.is_empty() => {
                match self.keys.get(&(file, token.start)) {
                    Some(name) => (Kind::Name, name.0),
                    None => return token,
                }
            }
            _ => return token,
        };
        Token {
            kind,
            value,
            ..token
        }
    }

    /// The words of POV-Ray 3.8 read so far.
    pub(crate) fn used(&self) -> impl Iterator<Item = Word> {
        let used = self.used.get();
        let words = Word::since_3_8().enumerate();
        words.filter_map(move |(bit, word)| (used >> bit & 1 == 1).then_some(word))
    }

    /// True if a name, which has no value here, means something where the words of 3.8 are reserved.
    pub(crate) fn is_of_3_8(&self, name: Symbol, names: &Names) -> bool {
        let is_word = (name.0 as usize) < self.words.len();
        !self.has_words && (is_word || names.is_qualified(name))
    }
}
