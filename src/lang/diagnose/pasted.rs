//! Marks of web pages and of Markdown that were copied together with a scene.

use crate::lang::diagnose::remedy::Remedy;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Token};

/// Elements of HTML that stand around or in code.
const TAGS: &[&str] = &[
    "a",
    "b",
    "blockquote",
    "body",
    "br",
    "code",
    "div",
    "em",
    "font",
    "head",
    "hr",
    "html",
    "i",
    "li",
    "p",
    "pre",
    "span",
    "strong",
    "td",
    "title",
    "tr",
    "tt",
    "ul",
];

const PICTURE: &str = "This is a picture, not a scene.";
const PAGE: &str = "This is a page of HTML: save the scene itself, not the page that shows it.";
/// First bytes of files that are no scenes, and what they are.
const FORMATS: &[(&[u8], &str)] = &[
    (b"\xc2\x89PNG", PICTURE),
    (b"\xc3\xbf\xc3\x98\xc3\xbf", PICTURE),
    (b"GIF8", PICTURE),
    (b"\x1f\xc2\x8b", "This file is compressed: unpack it."),
    (b"PK\x03\x04", "This file is an archive: unpack it."),
    (
        b"{\\rtf",
        "This is a document of a word processor: save it as plain text.",
    ),
    (b"<!DOCTYPE", PAGE),
    (b"<!doctype", PAGE),
    (b"<html", PAGE),
    (b"<?xml", "This is a document in XML, not a scene."),
];

impl Reader<'_> {
    /// The rule that the file breaks as a whole: it is in another encoding, or no scene.
    pub(crate) fn foreign_format(&self) -> Option<&'static str> {
        let text = self.sources.text(self.here.tokens.file).as_bytes();
        let is_zero = |at: usize| text.get(at) == Some(&0);
        match [0, 1, 2, 3].map(is_zero) {
            [false, true, true, true] | [true, true, _, false] => {
                return Some("This file is in UTF-32: save it as UTF-8.");
            }
            [_, true, _, true] | [true, _, true, _] => {
                return Some("This file is in UTF-16: save it as UTF-8.");
            }
            _ => {}
        }
        let known = FORMATS.iter().find(|(start, _)| text.starts_with(start));
        known.map(|&(_, rule)| rule)
    }

    /// A tag of HTML, the rest of an entity, or a mark of Markdown at the next token.
    pub(super) fn pasted(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let mark = char::from_u32(token.value).filter(|_| token.kind == Kind::Mark);
        let is_word_wanted = wanted.contains("statement") || wanted.contains("`}`");
        match mark {
            None => self.entity_behind_ampersand(),
            Some('<') if is_word_wanted => self.tag(),
            Some('`') if self.rest_of_line(self.here.at).starts_with("```") => {
                let line = self.rest_of_line(self.here.at);
                let hint = "A line of ``` belongs to Markdown, not to the scene: remove it.";
                Some(self.removed_bytes(hint, line.len()))
            }
            _ => None,
        }
    }

    /// `<pre>` or `</a>`.
    fn tag(&self) -> Option<Remedy> {
        let line = self.rest_of_line(self.here.at);
        let end = line.find('>')? + 1;
        let tag = &line[..end];
        let name = tag.trim_start_matches(['<', '/']);
        let (name, rest) = name.split_at(name.find(|c: char| !c.is_ascii_alphanumeric())?);
        // Not a vector.
        let is_tag =
            matches!(rest, ">" | "/>" | " />") || rest.starts_with(' ') && rest.contains('=');
        (is_tag && TAGS.contains(&name.to_ascii_lowercase().as_str())).then(|| {
            let hint = format!("`{tag}` is HTML: remove it.");
            self.removed_bytes(hint, end)
        })
    }

    /// `&amp;`, of which the `&` was taken for an operator.
    fn entity_behind_ampersand(&self) -> Option<Remedy> {
        let before = self.here.at.checked_sub(1)?;
        let span = self.tokens_span(before..self.here.at + 2);
        let written = self.source_text(span);
        let meant = match written {
            "&amp;" => "&",
            "&lt;" => "<",
            "&gt;" => ">",
            "&quot;" => "\"",
            "&nbsp;" => " ",
            _ => return None,
        };
        let hint = format!("`{written}` is HTML: write `{meant}`.");
        Some(Remedy::fix(hint, span, meant))
    }
}

#[cfg(test)]
mod tests {
    use crate::base::options::ReadOptions;
    use crate::base::source::Sources;
    use crate::lang::evaluate;

    fn rules(text: &str) -> Vec<Vec<String>> {
        let mut sources = Sources::default();
        let file = sources.add_text("x.pov", text);
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        reading
            .findings
            .into_iter()
            .map(|error| error.hints)
            .collect()
    }

    #[test]
    fn a_file_of_another_format_has_one_error() {
        let scene = "#version 3.7;\nsphere { 0, 1 }\nbox { 0, 1 }\n";
        let little: String = scene.chars().flat_map(|letter| [letter, '\0']).collect();
        let big: String = scene.chars().flat_map(|letter| ['\0', letter]).collect();
        let rule = "This file is in UTF-16: save it as UTF-8.";
        assert_eq!(rules(&little), [[rule]]);
        assert_eq!(rules(&big), [[rule]]);
        let picture = "\u{89}PNG\r\n\u{1a}\n\0\0\0\rIHDR\n}";
        assert_eq!(rules(picture), [["This is a picture, not a scene."]]);
    }
}
