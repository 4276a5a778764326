//! The part in which two texts differ.

use crate::base::file::{common_end, common_start};
use std::ops::Range;

/// The range in which two texts differ: what lies between their common beginning and their common end.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextChange {
    /// The bytes of the old text that others replace.
    pub old: Range<usize>,
    /// The byte behind those others in the new text; they start where the old ones do.
    pub new_end: usize,
}

impl TextChange {
    /// The difference of two texts.
    #[must_use]
    pub fn between(old: &[u8], new: &[u8]) -> Self {
        let start = common_start(old, new);
        let most = old.len().min(new.len()) - start;
        let end = common_end(&old[old.len() - most..], &new[new.len() - most..]);
        TextChange {
            old: start..old.len() - end,
            new_end: new.len() - end,
        }
    }

    /// This change and then another one, of the new text.
    #[must_use]
    pub fn then(&self, next: &TextChange) -> Self {
        // Where nothing changes is of no account.
        match (self.is_empty(), next.is_empty()) {
            (true, _) => return next.clone(),
            (_, true) => return self.clone(),
            _ => {}
        }
        // In the text between the two.
        let end = self.new_end.max(next.old.end);
        TextChange {
            old: self.old.start.min(next.old.start)..end - self.new_end + self.old.end,
            new_end: end - next.old.end + next.new_end,
        }
    }

    fn is_empty(&self) -> bool {
        self.old.is_empty() && self.new_end == self.old.start
    }

    /// The range in the new text of an unchanged range of the old one.
    pub(crate) fn moved(&self, range: &Range<usize>) -> Option<Range<usize>> {
        if range.end <= self.old.start {
            return Some(range.clone());
        }
        let moved = |at: usize| at - self.old.end + self.new_end;
        (range.start >= self.old.end).then(|| moved(range.start)..moved(range.end))
    }

    /// The position in the old text of an unchanged one in the new text.
    pub(crate) fn old_position(&self, at: usize) -> Option<usize> {
        if at < self.old.start {
            return Some(at);
        }
        (at >= self.new_end).then(|| at - self.new_end + self.old.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_one_after_the_other_are_one() {
        let texts = [
            "abcdefghij",
            "abXdefghij",
            "abXdefYYghij",
            "bXdghij",
            "bXdghijk",
        ];
        for first in 0..texts.len() {
            let mut change = TextChange::between(texts[first].as_bytes(), texts[first].as_bytes());
            for (before, after) in texts[first..].iter().zip(&texts[first + 1..]) {
                let next = TextChange::between(before.as_bytes(), after.as_bytes());
                change = change.then(&next);
                assert_eq!(change, TextChange::default().then(&change));
                let TextChange { old, new_end } = change.clone();
                let new = [
                    &texts[first][..old.start],
                    &after[old.start..new_end],
                    &texts[first][old.end..],
                ];
                assert_eq!(new.concat(), *after, "{change:?}");
                for at in 0..after.len() {
                    if let Some(old) = change.old_position(at) {
                        assert_eq!(texts[first][old..=old], after[at..=at]);
                        assert_eq!(change.moved(&(old..old + 1)), Some(at..at + 1));
                    }
                }
            }
        }
    }
}
