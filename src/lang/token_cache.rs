//! The names and tokens of a scene, cached between readings.

use crate::base::source::{FileId, Sources};
use crate::lang::syntax::{Names, Tokens, Whole};
use rustc_hash::FxHashMap;
use std::rc::Rc;
use std::sync::Arc;

/// Names and tokens of the texts of some [`Sources`]: readings with copies of these need not make them again.
#[derive(Clone, Debug, Default)]
pub struct TokenCache {
    pub(super) names: Names,
    tokens: FxHashMap<FileId, Arc<Whole>>,
}

impl TokenCache {
    /// The tokens of a text, if it has been read before.
    pub(super) fn tokens(&self, file: FileId) -> Option<Rc<Tokens>> {
        self.tokens.get(&file).map(|whole| Rc::new(whole.tokens()))
    }

    /// Adds the tokens of a reading; true if any are new. Texts written by the scene itself are not cached.
    pub(super) fn update(
        &mut self,
        names: Names,
        tokenized: &FxHashMap<FileId, Rc<Tokens>>,
        sources: &Sources,
        scene: FileId,
    ) -> bool {
        let lasts = |file: FileId| file == scene || sources.is_persistent(file);
        let new: Vec<(FileId, Arc<Whole>)> = tokenized
            .iter()
            .filter(|(file, _)| !self.tokens.contains_key(file) && lasts(**file))
            .filter_map(|(file, tokens)| Some((*file, Arc::new(Whole::of(tokens)?))))
            .collect();
        if new.is_empty() {
            return false;
        }
        self.names = names;
        self.tokens.extend(new);
        true
    }
}
