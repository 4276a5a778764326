//! Interned identifiers.

use rustc_hash::FxHashMap;
use std::sync::Arc;

/// An identifier of the scene, interned: equal spellings have equal symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// The identifiers of all files of one run.
#[derive(Clone, Debug, Default)]
pub struct Names {
    by_spelling: FxHashMap<Arc<str>, Symbol>,
    spellings: Vec<Arc<str>>,
}

impl Names {
    /// No identifiers.
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
