//! The reserved words, from `grammar/words.pest`.

use std::fmt;

include!(concat!(env!("OUT_DIR"), "/words.rs"));

/// Slots of [`BY_SPELLING`]: about eight times the number of words, so that collisions are rare.
const SLOTS: usize = 1 << 12;

/// A word of POV-Ray 3.7 that 3.8 does not reserve.
pub const FREE_SINCE_3_8: Word = Word::Steps;

/// Hash table with linear probing: the index of the word in each slot, or `u16::MAX` in a free one.
static BY_SPELLING: [u16; SLOTS] = by_spelling();

const fn by_spelling() -> [u16; SLOTS] {
    let mut table = [u16::MAX; SLOTS];
    let mut word = 0_u16;
    while (word as usize) < COUNT_3_7 {
        let mut at = hash_slot(WORDS[word as usize].1.as_bytes());
        while table[at] != u16::MAX {
            at = (at + 1) % SLOTS;
        }
        table[at] = word;
        word += 1;
    }
    table
}

#[inline]
const fn hash_slot(spelling: &[u8]) -> usize {
    let mut hash = 0_u32;
    let mut at = 0;
    while at < spelling.len() {
        hash = (hash.rotate_left(5) ^ spelling[at] as u32).wrapping_mul(0x9e37_79b9);
        at += 1;
    }
    (hash >> 20) as usize
}

impl Word {
    /// Number of reserved words.
    pub const COUNT: usize = WORDS.len();

    /// The words that POV-Ray 3.8 added, in the order of the grammar.
    pub fn since_3_8() -> impl Iterator<Item = Word> {
        WORDS[COUNT_3_7..].iter().map(|entry| entry.0)
    }

    /// The word of the same meaning under which elements are read: `gray` for `grey`.
    #[must_use]
    pub fn usual(self) -> Word {
        match self {
            Word::Grey => Word::Gray,
            Word::GreyThreshold => Word::GrayThreshold,
            Word::HfGrey16 => Word::HfGray16,
            word => word,
        }
    }

    /// The word of POV-Ray 3.7 with this spelling; all are lower case.
    #[must_use]
    pub fn from_spelling(spelling: &str) -> Option<Word> {
        let mut at = hash_slot(spelling.as_bytes());
        loop {
            let &(word, known, _) = WORDS.get(usize::from(BY_SPELLING[at]))?;
            if known == spelling {
                return Some(word);
            }
            at = (at + 1) % SLOTS;
        }
    }

    /// The word with this index in [`Word::all`].
    #[must_use]
    pub fn from_index(index: u32) -> Option<Word> {
        WORDS.get(index as usize).map(|entry| entry.0)
    }

    /// The spelling of the word in a scene.
    #[must_use]
    pub fn spelling(self) -> &'static str {
        WORDS[self as usize].1
    }

    /// The class of the word in the grammar.
    #[must_use]
    pub fn class(self) -> Class {
        WORDS[self as usize].2
    }

    /// Returns true if an expression may begin with this word.
    #[must_use]
    pub fn is_value(self) -> bool {
        matches!(self.class(), Class::Value | Class::Function)
    }

    /// Returns true if an expression that begins with this word begins with a float.
    #[must_use]
    pub fn gives_float(self) -> bool {
        use Word::{
            Chr, Concat, Datetime, Function, Internal, MaxExtent, MinExtent, Str, Strlwr, Strupr,
            Substr, T, Trace, U, V, VaxisRotate, Vcross, Vnormalize, Vrotate, Vstr, Vturbulence, X,
            Y, Z,
        };
        let is_vector = matches!(
            self,
            X | Y
                | Z
                | T
                | U
                | V
                | MaxExtent
                | MinExtent
                | Trace
                | VaxisRotate
                | Vcross
                | Vnormalize
                | Vrotate
                | Vturbulence
        );
        let is_string = matches!(
            self,
            Chr | Concat | Datetime | Str | Strlwr | Strupr | Substr | Vstr
        );
        self.is_value() && !is_vector && !is_string && !matches!(self, Function | Internal)
    }

    /// All words of POV-Ray 3.7 in the grammar's order, which is the order of `self as usize`.
    pub fn all() -> impl Iterator<Item = Word> {
        WORDS[..COUNT_3_7].iter().map(|entry| entry.0)
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.spelling())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_looked_up_by_its_spelling() {
        assert_eq!(Word::all().count(), 499);
        for word in Word::all() {
            assert_eq!(Word::from_spelling(word.spelling()), Some(word));
            assert_eq!(Word::from_index(word as u32), Some(word));
        }
        for word in Word::since_3_8() {
            assert_eq!(Word::from_spelling(word.spelling()), None);
        }
        assert_eq!(Word::from_index(499), Word::since_3_8().next());
        assert_eq!(Word::from_spelling("Sphere"), None);
    }

    /// A word outside the listed classes would have no entry in the table.
    #[test]
    fn every_word_of_the_grammar_has_a_class() {
        let grammar = include_str!("../../grammar/words.pest");
        let lines = grammar.lines().filter(|line| !line.starts_with("//"));
        let quoted: Vec<&str> = lines
            .flat_map(|line| line.split('"').skip(1).step_by(2))
            .collect();
        assert_eq!(quoted.len(), Word::COUNT);
        for (word, spelling) in Word::all().chain(Word::since_3_8()).zip(quoted) {
            assert_eq!(word.spelling(), spelling);
            let class = format!("{:?}", word.class()).to_lowercase();
            let rule = match Word::from_spelling(spelling) {
                Some(_) => format!("\n{class} = {{"),
                None => format!("\n{class}_since_3_8 = {{"),
            };
            let rule = grammar.find(&rule).unwrap();
            let body = &grammar[rule..];
            let end = body.find("}").unwrap();
            assert!(
                body[..end].contains(&format!("\"{spelling}\"")),
                "{spelling}: {class}"
            );
        }
    }
}
