//! The text of a live scene: the numbers that a page may change, and the statements written back to the file.

use crate::app::worker::Splice;
use crate::base::file::{FileLimits, Named, difference};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

/// The prefix of the numbers that a scene may use to answer to the cursor.
pub(super) const CURSOR: &str = "live_cursor";
/// The character that may begin a text file.
const BYTE_ORDER_MARK: char = '\u{feff}';
/// The mark of a comment that makes a slider of the number before it: `#declare Height = 1.2; // live: 0..3`.
const MARK: &str = "live:";
/// Longest text of a number in bytes.
const LONGEST: usize = 40;

/// The text of a scene's file.
#[derive(Clone, Debug, Default)]
pub(super) struct SceneText {
    /// Different for each.
    pub(super) number: u64,
    /// The text, without a byte-order mark; `None` if it is not UTF-8.
    pub(super) text: Option<String>,
    /// True if a byte-order mark begins the file.
    has_mark: bool,
    pub(super) controls: Vec<Control>,
    /// True if comments of the text may give sliders.
    has_controls: bool,
    /// True if the scene may answer to the cursor.
    pub(super) has_cursor: bool,
}

impl SceneText {
    /// The text of the bytes of a file; `None` for a file that cannot be read.
    pub(super) fn new(number: u64, bytes: Option<Vec<u8>>) -> Self {
        let whole = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
        let has_mark = whole
            .as_ref()
            .is_some_and(|whole| whole.starts_with(BYTE_ORDER_MARK));
        let text = whole.map(|whole| match has_mark {
            true => whole[BYTE_ORDER_MARK.len_utf8()..].to_owned(),
            false => whole,
        });
        let written = text.as_deref().unwrap_or_default();
        let has_controls = holds(written, MARK);
        SceneText {
            number,
            has_mark,
            controls: match has_controls {
                true => controls(written),
                false => Vec::new(),
            },
            has_controls,
            has_cursor: holds(written, CURSOR),
            text,
        }
    }

    /// The part of the text that differs in a file now; an empty one if none does. `None` if the file cannot be read so, and
    /// has to be read as a whole.
    pub(super) fn change_to(&self, file: &Path) -> Option<Splice> {
        let text = self.text.as_ref().filter(|_| !self.has_mark)?;
        let limits = FileLimits::default();
        let (range, new) = difference(file, Named::ByScene, &limits, text.as_bytes()).ok()??;
        let mut with = new;
        let (mut start, mut end) = (range.start, range.end);
        // Characters are whole.
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        with.splice(0..0, text.as_bytes()[start..range.start].iter().copied());
        while !text.is_char_boundary(end) {
            with.push(text.as_bytes()[end]);
            end += 1;
        }
        let is_change = start < end || !with.is_empty();
        // There may be a byte-order mark.
        if is_change && start == 0 {
            return None;
        }
        Some(Splice {
            range: start..end,
            with: String::from_utf8(with).ok()?,
        })
    }

    /// This text with a change of one of its parts.
    pub(super) fn changed(mut self, change: &Splice) -> Self {
        let Some(text) = &mut self.text else {
            return self;
        };
        if !change.apply(text) {
            return self;
        }
        self.number += 1;
        let text = &*text;
        // If the old text has no such words, the new one has them near the change only.
        let start = change.range.start;
        let start = (0..=start.saturating_sub(CURSOR.len().max(MARK.len())))
            .rfind(|&at| text.is_char_boundary(at))
            .unwrap_or_default();
        let end = change.range.start + change.with.len() + CURSOR.len().max(MARK.len());
        let end = (end..text.len()).find(|&at| text.is_char_boundary(at));
        let near = &text[start..end.unwrap_or(text.len())];
        let holds_now = |word: &str, held: bool| match held {
            true => holds(text, word),
            false => holds(near, word),
        };
        self.has_cursor = holds_now(CURSOR, self.has_cursor);
        self.has_controls = holds_now(MARK, self.has_controls);
        self.controls = match self.has_controls {
            true => controls(text),
            false => Vec::new(),
        };
        self
    }

    /// The bytes of the file with this text or a changed one.
    pub(super) fn file(&self, text: &str) -> Vec<u8> {
        let mark = self.has_mark.then_some(BYTE_ORDER_MARK);
        let file: String = mark.into_iter().chain(text.chars()).collect();
        file.into_bytes()
    }
}

/// A number with a slider.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Control {
    /// The name that is declared.
    pub(super) name: String,
    /// The first byte of the number in the text.
    pub(super) start: usize,
    /// The byte behind it.
    pub(super) end: usize,
    /// The number as it is written.
    pub(super) value: String,
    /// The ends of the slider.
    pub(super) low: f64,
    /// The larger end.
    pub(super) high: f64,
}

/// The numbers of a text that its comments give sliders, in order.
fn controls(text: &str) -> Vec<Control> {
    let mut start = 0;
    let mut controls = Vec::new();
    for line in text.split_inclusive('\n') {
        if line.contains(MARK) {
            controls.extend(control(line, start));
        }
        start += line.len();
    }
    controls
}

/// True if a text, which may be long, holds another one.
fn holds(text: &str, part: &str) -> bool {
    memchr::memmem::find(text.as_bytes(), part.as_bytes()).is_some()
}

/// The slider of a line that starts at a byte of the text.
fn control(line: &str, start: usize) -> Option<Control> {
    let (statement, comment) = line.split_once("//")?;
    let (low, high) = comment.trim().strip_prefix(MARK)?.split_once("..")?;
    let (low, high) = (low.trim().parse().ok()?, high.trim().parse().ok()?);
    let rest = statement.trim_start().strip_prefix('#')?.trim_start();
    let rest = ["declare ", "local "]
        .iter()
        .find_map(|word| rest.strip_prefix(word))?;
    let (name, value) = rest.split_once('=')?;
    let value = value.trim().trim_end_matches(';').trim_end();
    let at = line.find('=')? + 1;
    let at = at + line[at..].find(value)?;
    let is_range = f64::is_finite(low) && f64::is_finite(high) && low < high;
    (is_number(value) && is_range).then(|| Control {
        name: name.trim().to_owned(),
        start: start + at,
        end: start + at + value.len(),
        value: value.to_owned(),
        low,
        high,
    })
}

/// True for a number as the scene language writes it, with or without a sign.
pub(super) fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let begins = digits.strip_prefix('.').unwrap_or(digits);
    text.len() <= LONGEST
        && begins.starts_with(|c: char| c.is_ascii_digit())
        && text.parse().is_ok_and(f64::is_finite)
}

/// Texts in place of ranges of another text, by their first byte.
pub(super) type Edits = BTreeMap<usize, Edit>;

/// A text in place of a range that starts at a known byte.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Edit {
    /// The byte behind the range.
    pub(super) end: usize,
    pub(super) text: String,
}

/// True if a range of the text is a number of its own.
pub(super) fn holds_number(text: &str, range: &Range<usize>) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.');
    let (Some(before), Some(number), Some(after)) = (
        text.get(..range.start),
        text.get(range.clone()),
        text.get(range.end..),
    ) else {
        return false;
    };
    is_number(number) && !before.ends_with(is_part) && !after.starts_with(is_part)
}

/// The text with its edits; `None` if their ranges are none of it, or overlap.
pub(super) fn edited(text: &str, edits: &Edits) -> Option<String> {
    let mut new = String::with_capacity(text.len());
    let mut done = 0;
    for (&start, Edit { end, text: number }) in edits {
        new += text.get(done..start)?;
        new += number;
        done = *end;
        text.get(start..done)?;
    }
    new += text.get(done..)?;
    Some(new)
}

/// The range of a text that a range of the edited text comes from; `None` if it begins or ends within an edit.
pub(super) fn unedited(range: &Range<usize>, edits: &Edits) -> Option<Range<usize>> {
    let position = |position: usize| {
        // The ends of the last edit in both texts.
        let (mut old, mut new) = (0, 0);
        for (&start, edit) in edits {
            let start = new + start.checked_sub(old)?;
            if position <= start {
                break;
            }
            (old, new) = (edit.end, start + edit.text.len());
            if position < new {
                return None;
            }
        }
        Some(old + (position - new))
    };
    Some(position(range.start)?..position(range.end)?)
}

/// The position in the edited text of a position outside of all edits.
pub(super) fn moved(position: usize, edits: &Edits) -> usize {
    let before = edits.iter().filter(|(_, edit)| edit.end <= position);
    before.fold(position, |position, (start, edit)| {
        position + edit.text.len() - (edit.end - start)
    })
}

/// The edits of a text as those of the text with others written. Those that are written, or lie within others, are gone.
pub(super) fn rebased(edits: &Edits, written: &Edits) -> Edits {
    let rebase = |(&start, edit): (&usize, &Edit)| {
        let mut others = written.iter();
        let length = match others.find(|(from, other)| **from < edit.end && start < other.end) {
            None => edit.end - start,
            Some((from, other)) => {
                let is_other_value =
                    (*from, other.end) == (start, edit.end) && other.text != edit.text;
                is_other_value.then_some(other.text.len())?
            }
        };
        let start = moved(start, written);
        let (end, text) = (start + length, edit.text.clone());
        Some((start, Edit { end, text }))
    };
    edits.iter().filter_map(rebase).collect()
}

/// The edit that replaces the camera of a text, whose statement has this range, or adds one at the end. `None` if the range
/// holds no statement.
pub(super) fn camera_edit(
    text: &str,
    range: Option<Range<usize>>,
    statement: &str,
) -> Option<(usize, Edit)> {
    match range {
        Some(range) => {
            let old = text.get(range.clone())?;
            let text = statement.to_owned();
            let is_camera = old.starts_with("camera") && old.ends_with('}');
            is_camera.then_some((
                range.start,
                Edit {
                    end: range.end,
                    text,
                },
            ))
        }
        None => {
            let line_break = if text.ends_with('\n') { "" } else { "\n" };
            let text_of_camera = format!("{line_break}{statement}\n");
            let end = text.len();
            Some((
                end,
                Edit {
                    end,
                    text: text_of_camera,
                },
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_make_sliders() {
        let text = "// live: 0..1\n  #declare Height = 1.2; // live: 0..3\n#local N=-5 // live: -9 .. 2.5 \n\
                    #declare A = B; // live: 0..3\n#declare C = 2; // live: 3..0\n#declare D = 2; // live 0..3\n";
        let all = controls(text);
        let [height, n] = all.as_slice() else {
            panic!("{all:?}");
        };
        assert_eq!(
            (height.name.as_str(), &text[height.start..height.end]),
            ("Height", "1.2")
        );
        assert_eq!((height.low, height.high), (0.0, 3.0));
        assert_eq!(
            (n.name.as_str(), &text[n.start..n.end], n.low),
            ("N", "-5", -9.0)
        );
    }

    #[test]
    fn only_whole_numbers_are_edited() {
        let text = "sphere { <-1.5, 2>, r2 } 1e3";
        for (range, is_whole) in [
            (10..14, true),
            (11..14, true),
            (10..13, false),
            (16..17, true),
            (21..22, false),
            (25..28, true),
            (25..26, false),
            (0..6, false),
            (25..99, false),
        ] {
            assert_eq!(holds_number(text, &range), is_whole, "{range:?}");
        }
        for text in ["", "inf", "NaN", "-", ".", "1e999", "0x1", "1 2"] {
            assert!(!is_number(text), "{text}");
        }
    }

    #[test]
    fn edits_leave_all_else_alone() {
        let text = "a 1 b 22 c\r\n";
        let edit = |end, text: &str| Edit {
            end,
            text: text.to_owned(),
        };
        let edits = Edits::from([(6, edit(8, "3")), (2, edit(3, "-0.25"))]);
        assert_eq!(edited(text, &edits).as_deref(), Some("a -0.25 b 3 c\r\n"));
        assert_eq!(
            edited(text, &Edits::from([(2, edit(8, "3")), (6, edit(8, "4"))])),
            None
        );
        assert_eq!(edited("ü", &Edits::from([(1, edit(2, "3"))])), None);
    }

    #[test]
    fn positions_are_mapped_through_edits() {
        let text = "a 1 b 22 c 3 d";
        let edit = |end, text: &str| Edit {
            end,
            text: text.to_owned(),
        };
        let edits = Edits::from([(2, edit(3, "-0.25")), (6, edit(8, "4"))]);
        let new = edited(text, &edits).unwrap();
        assert_eq!(new, "a -0.25 b 4 c 3 d");
        for (old, part) in [
            (4..5, "b"),
            (2..3, "-0.25"),
            (2..10, "-0.25 b 4 c"),
            (9..10, "c"),
        ] {
            let start = new.find(part).unwrap();
            assert_eq!(unedited(&(start..start + part.len()), &edits), Some(old));
        }
        assert_eq!(unedited(&(3..5), &edits), None);
        // Other values of the new text, at the same numbers.
        let wanted = Edits::from([
            (2, edit(3, "-0.25")),
            (6, edit(8, "5")),
            (11, edit(12, "6")),
        ]);
        let left = rebased(&wanted, &edits);
        assert_eq!(edited(&new, &left), edited(text, &wanted));
        assert_eq!(left.len(), 2);
        // A statement takes the numbers within it along.
        let statement = Edits::from([(4, edit(10, "camera"))]);
        let left = rebased(&wanted, &statement);
        let new = edited(text, &statement).unwrap();
        assert_eq!(edited(&new, &left).as_deref(), Some("a -0.25 camera 6 d"));
    }

    #[test]
    fn a_changed_file_gives_the_text_that_reading_it_gives() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.pov");
        let texts = [
            "#version 3.7; // grün\n#declare A = 1;\nsphere { 0, A }\n",
            "#version 3.7; // grün\n#declare A = 2;\nsphere { 0, A }\n",
            "#version 3.7; // grön\n#declare A = 2; // live: 0..4\nsphere { 0, A }\n",
            "#version 3.7; // gr\n#declare B = 2; // live: 0..4\n#declare A = B; sphere { 0, A }\n",
            "#version 3.7; // gr\n#declare B = 2; // liv: 0..4\n#declare A = B; sphere { 0, A }\n",
            "#version 3.7; // gr\n#declare B = 2; // live: 0..4\n#declare A = B; sphere { live_cursor_x, A }\n",
            "#version 3.7; // gr\n#declare B = 2; // live: 0..4\n#declare A = B; sphere { live_curso_x, A }\n",
            "#version 3.7; // gr\n",
            "#version 3.7; // gr\n",
        ];
        let mut now = SceneText::new(1, Some(texts[0].into()));
        for text in texts {
            std::fs::write(&path, text).unwrap();
            let change = now.change_to(&path);
            if change.is_none() && cfg!(not(unix)) {
                return;
            }
            let change = change.unwrap();
            let is_same = now.text.as_deref() == Some(text);
            assert_eq!(change.is_empty(), is_same);
            if !is_same {
                let number = now.number;
                now = now.changed(&change);
                assert_eq!(now.number, number + 1);
            }
            let read = SceneText::new(now.number, Some(text.into()));
            assert_eq!(format!("{now:?}"), format!("{read:?}"));
        }
        for other in [
            &b"\xef\xbb\xbf#version 3.7; // gr\n"[..],
            b"#version 3.7; // g\xfc\n",
            b"",
        ] {
            std::fs::write(&path, other).unwrap();
            assert_eq!(now.change_to(&path), None, "{other:?}");
        }
    }

    #[test]
    fn a_byte_order_mark_stays_in_the_file() {
        let text = SceneText::new(0, Some("\u{feff}#version 3.7;".into()));
        assert_eq!(text.text.as_deref(), Some("#version 3.7;"));
        assert_eq!(text.file("a"), "\u{feff}a".as_bytes());
        assert_eq!(SceneText::new(0, Some("a".into())).file("b"), b"b");
        assert_eq!(SceneText::new(0, Some(vec![0xff])).text, None);
    }

    #[test]
    fn a_camera_replaces_its_own_statement_or_is_added() {
        let text = "camera { location x }\nsphere { 0, 1 }";
        let (start, edit) = camera_edit(text, Some(0..21), "camera { }").unwrap();
        let new = edited(text, &Edits::from([(start, edit)]));
        assert_eq!(new.as_deref(), Some("camera { }\nsphere { 0, 1 }"));
        assert_eq!(camera_edit(text, Some(1..21), "camera { }"), None);
        let (start, edit) = camera_edit("plane { y, 0 }", None, "camera { }").unwrap();
        let new = edited("plane { y, 0 }", &Edits::from([(start, edit)]));
        assert_eq!(new.as_deref(), Some("plane { y, 0 }\ncamera { }\n"));
    }
}
