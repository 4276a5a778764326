//! Interned identifiers.
//!
//! The first symbols are those of the words that POV-Ray 3.8 added: identifiers in scenes of older versions, reserved
//! words where version 3.8 holds. So the same tokens serve both.

use super::Word;
use crate::base::word::FREE_SINCE_3_8;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// An identifier of the scene, interned: equal spellings have equal symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// The identifiers of all files of one run.
#[derive(Clone, Debug)]
pub struct Names {
    by_spelling: FxHashMap<Arc<str>, Symbol>,
    spellings: Vec<Arc<str>>,
    qualified: Vec<Qualified>,
}

/// An identifier of one scope: `local.Name` or `global.Name`.
#[derive(Clone, Copy, Debug)]
pub struct Qualified {
    /// The symbol of the whole.
    pub symbol: Symbol,
    /// The symbol of the name itself.
    pub name: Symbol,
    /// True for `local`, false for `global`.
    pub is_local: bool,
}

impl Default for Names {
    /// The identifiers that become reserved words in version 3.8, and the one that ceases to be one.
    fn default() -> Self {
        let mut names = Names {
            by_spelling: FxHashMap::default(),
            spellings: Vec::new(),
            qualified: Vec::new(),
        };
        for word in Word::since_3_8().chain([FREE_SINCE_3_8]) {
            names.intern(word.spelling());
        }
        names
    }
}

impl Names {
    /// No identifiers of a scene.
    #[must_use]
    pub fn new() -> Self {
        Names::default()
    }

    /// The symbol of a spelling; a new one if it has none yet. Case matters.
    pub fn intern(&mut self, spelling: &str) -> Symbol {
        if let Some(&symbol) = self.by_spelling.get(spelling) {
            return symbol;
        }
        let number = u32::try_from(self.spellings.len()).expect("texts are shorter than 4 GiB");
        let spelling: Arc<str> = spelling.into();
        self.spellings.push(Arc::clone(&spelling));
        self.by_spelling.insert(spelling, Symbol(number));
        Symbol(number)
    }

    /// The symbol of `local.Name` or `global.Name`.
    pub fn intern_qualified(&mut self, is_local: bool, name: Symbol) -> Symbol {
        let scope = if is_local { "local" } else { "global" };
        let spelling = format!("{scope}.{}", self.spelling(name));
        let known = self.spellings.len();
        let symbol = self.intern(&spelling);
        if self.spellings.len() > known {
            self.qualified.push(Qualified {
                symbol,
                name,
                is_local,
            });
        }
        symbol
    }

    /// The identifiers of one scope, in the order in which they occur.
    #[must_use]
    pub fn qualified(&self) -> &[Qualified] {
        &self.qualified
    }

    /// True for `local.Name` and `global.Name`.
    #[must_use]
    pub fn is_qualified(&self, symbol: Symbol) -> bool {
        self.spelling(symbol).contains('.')
    }

    /// The symbol of a spelling that occurs in some text of the run.
    #[must_use]
    pub fn symbol(&self, spelling: &str) -> Option<Symbol> {
        self.by_spelling.get(spelling).copied()
    }

    /// The identifier as the scene writes it.
    ///
    /// # Panics
    /// If the symbol is of another `Names`.
    #[must_use]
    pub fn spelling(&self, symbol: Symbol) -> &str {
        &self.spellings[symbol.0 as usize]
    }

    /// All spellings, in the order of their symbols, for "did you mean".
    pub fn spellings(&self) -> impl Iterator<Item = &str> {
        self.spellings.iter().map(AsRef::as_ref)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_spellings_are_one_symbol() {
        let mut names = Names::new();
        let leg = names.intern("Leg");
        let other = names.intern("leg");
        assert_ne!(leg, other);
        assert_eq!(names.intern("Leg"), leg);
        assert_eq!(names.spelling(leg), "Leg");
        assert_eq!(names.symbol("leg"), Some(other));
        assert_eq!(names.symbol("Arm"), None);
    }
}
