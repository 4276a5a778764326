//! Strings of a scene. One that grows, as in `#declare S = concat(S, "x")`, takes time in proportion to its final length.

use std::cell::{Ref, RefCell};
use std::rc::Rc;

/// A string. Copies share the letters: each has those up to its own length, and the longest can be extended in place.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    letters: Rc<RefCell<String>>,
    length: usize,
}

impl Text {
    /// The length in bytes.
    pub(crate) fn len(&self) -> usize {
        self.length
    }

    /// The letters, as long as the text is not extended.
    pub(crate) fn letters(&self) -> Ref<'_, str> {
        Ref::map(self.letters.borrow(), |letters| &letters[..self.length])
    }

    /// The same, owned.
    pub(crate) fn into_letters(self) -> String {
        match Rc::try_unwrap(self.letters) {
            Ok(letters) => {
                let mut letters = letters.into_inner();
                letters.truncate(self.length);
                letters
            }
            Err(letters) => letters.borrow()[..self.length].to_owned(),
        }
    }

    /// The number of bytes that [`Text::push`] of another text takes.
    pub(crate) fn bytes_to_push(&self, more: &Text) -> usize {
        match self.can_grow_by(more) {
            true => more.length,
            false => self.length + more.length,
        }
    }

    /// Appends a text.
    pub(crate) fn push(&mut self, more: &Text) {
        if !self.can_grow_by(more) {
            let copy = self.letters().to_owned();
            *self = copy.into();
        }
        self.letters.borrow_mut().push_str(&more.letters());
        self.length += more.length;
    }

    /// True if no other text has letters behind this one.
    fn can_grow_by(&self, more: &Text) -> bool {
        let is_longest = self.letters.borrow().len() == self.length;
        is_longest && !Rc::ptr_eq(&self.letters, &more.letters)
    }
}

impl From<String> for Text {
    fn from(letters: String) -> Self {
        Text {
            length: letters.len(),
            letters: Rc::new(RefCell::new(letters)),
        }
    }
}

impl From<&str> for Text {
    fn from(letters: &str) -> Self {
        letters.to_owned().into()
    }
}

#[cfg(test)]
mod tests {
    use super::Text;
    use std::rc::Rc;

    #[test]
    fn the_longest_text_alone_grows_where_it_is() {
        let begin = Text::from("ab");
        let mut long = begin.clone();
        assert_eq!(long.bytes_to_push(&Text::from("c")), 1);
        assert_eq!(long.bytes_to_push(&begin), 4);
        long.push(&Text::from("c"));
        assert!(Rc::ptr_eq(&begin.letters, &long.letters));
        let mut other = begin.clone();
        assert_eq!(other.bytes_to_push(&Text::from("d")), 3);
        other.push(&Text::from("d"));
        long.push(&long.clone());
        assert_eq!([begin.len(), long.len(), other.len()], [2, 6, 3]);
        let all = [begin, long, other].map(|text| {
            let letters = text.letters().to_owned();
            (letters, text.into_letters())
        });
        assert_eq!(
            all.each_ref().map(|(shared, _)| shared.as_str()),
            ["ab", "abcabc", "abd"]
        );
        assert!(all.iter().all(|(shared, owned)| shared == owned));
    }
}
