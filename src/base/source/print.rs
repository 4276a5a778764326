//! Diagnostics as text, for people and programs. Nothing here writes to a stream.

use super::diagnostic::{lint_suffix, sentence};
use super::files::char_start;
use super::{Diagnostic, FileId, Fix, Label, Severity, Sources, Span};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Patch, Renderer, Snippet};
use std::iter;
use std::ops::Range;

/// Use of the escape codes of a colour terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Styling {
    /// Characters only.
    Plain,
    /// With ANSI codes for colour and weight.
    Colored,
}

/// Labels of the same file further from the primary span than this number of lines get a snippet of their own, so that
/// the excerpt stays small in a text of any size.
const NEAR_LINES: usize = 200;

/// Most bytes of lines that are shown as changed.
const MAX_CHANGED: usize = 1000;

/// Steps of the trace shown from each end; a recursive macro has thousands.
const TRACE_ENDS: usize = 4;

/// The diagnostic in POV-Ray's form, as one line without a line end: `File 'x.pov' line 4: Parse Error: message`.
/// POV-Ray breaks such lines at 80 columns, which programs that search for them have to undo.
#[must_use]
pub fn pov_line(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let location = diagnostic.span.map_or(String::new(), |span| {
        let (line, _) = sources.line_column(span);
        format!("File '{}' line {line}: ", sources.name(span.file))
    });
    let kind = match diagnostic.severity {
        Severity::Error => "Parse Error",
        Severity::Warning => "Parse Warning",
    };
    let lint = lint_suffix(diagnostic.code);
    clean(&format!("{location}{kind}: {}{lint}", diagnostic.message))
}

/// The diagnostic with an excerpt of the scene: file, line and column, the span underlined, labels, hints as `help`,
/// the trace as notes. Several lines, without the end of the last.
#[must_use]
pub fn annotated(diagnostic: &Diagnostic, sources: &Sources, styling: Styling) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = format!("{}{}", diagnostic.message, lint_suffix(diagnostic.code));
    let mut group = level
        .primary_title(clean(&title))
        .elements(snippets(diagnostic, sources));
    let mut hints = diagnostic.hints.as_slice();
    let mut changed = None;
    if let (Some(fix), Some((last, others))) = (&diagnostic.fix, hints.split_last()) {
        changed = change(last, fix, sources);
        hints = if changed.is_some() { others } else { hints };
    }
    for hint in hints {
        group = group.element(Level::HELP.message(clean(&sentence(hint))));
    }
    let mut groups = vec![group];
    groups.extend(changed);
    groups.extend(trace(&diagnostic.trace, sources));
    let renderer = match styling {
        Styling::Plain => Renderer::plain(),
        Styling::Colored => Renderer::styled(),
    };
    renderer.render(&groups)
}

/// A span to underline, and its label.
struct Mark<'a> {
    span: Span,
    text: Option<&'a str>,
    kind: AnnotationKind,
}

/// The lines with the primary span and those with labels, in as few snippets as possible.
fn snippets<'a>(diagnostic: &Diagnostic, sources: &'a Sources) -> Vec<Snippet<'a, Annotation<'a>>> {
    let primary = diagnostic.span.map(|span| Mark {
        span,
        text: None,
        kind: AnnotationKind::Primary,
    });
    let labels = diagnostic.labels.iter().map(|label| Mark {
        span: label.span,
        text: Some(&label.text),
        kind: AnnotationKind::Context,
    });
    let mut clusters: Vec<Vec<Mark>> = Vec::new();
    for mark in primary.into_iter().chain(labels) {
        match clusters
            .iter_mut()
            .find(|cluster| is_near(&cluster[0], &mark, sources))
        {
            Some(cluster) => cluster.push(mark),
            None => clusters.push(vec![mark]),
        }
    }
    let snippets = clusters.iter().map(|cluster| snippet(cluster, sources));
    snippets.collect()
}

fn is_near(first: &Mark, other: &Mark, sources: &Sources) -> bool {
    let line = |mark: &Mark| sources.line_of(mark.span.file, mark.span.start as usize).0;
    first.span.file == other.span.file && line(first).abs_diff(line(other)) <= NEAR_LINES
}

/// The lines of a fix as a difference, with the hint that describes it; `None` for very long lines, which the renderer
/// would show in full.
fn change(hint: &str, fix: &Fix, sources: &Sources) -> Option<Group<'static>> {
    let range = visible(fix.span, sources);
    let (first_line, start, lines) = lines(fix.span.file, iter::once(range.clone()), sources);
    let text: Vec<String> = fix.text.lines().map(clean).collect();
    let patch = Patch::new(range.start - start..range.end - start, text.join("\n"));
    let title = Level::HELP.secondary_title(clean(&sentence(hint)));
    let is_short = lines.len() <= MAX_CHANGED;
    is_short.then(|| title.element(Snippet::source(lines).line_start(first_line).patch(patch)))
}

/// A snippet with all marks, which are near each other in one file.
fn snippet<'a>(marks: &[Mark], sources: &'a Sources) -> Snippet<'a, Annotation<'a>> {
    let file = marks[0].span.file;
    let ranges = marks.iter().map(|mark| visible(mark.span, sources));
    let (first_line, start, lines) = lines(file, ranges.clone(), sources);
    let annotations = marks.iter().zip(ranges).map(|(mark, range)| {
        let annotation = mark.kind.span(range.start - start..range.end - start);
        annotation.label(mark.text.map(clean))
    });
    Snippet::source(lines)
        .line_start(first_line)
        .path(sources.name(file))
        .annotations(annotations)
}

/// The lines that hold byte ranges of a file: the number of the first, its first byte, and the text.
fn lines(
    file: FileId,
    ranges: impl Iterator<Item = Range<usize>> + Clone,
    sources: &Sources,
) -> (usize, usize, String) {
    let start = ranges.clone().map(|range| range.start).min().unwrap_or(0);
    let end = ranges.map(|range| range.end).max().unwrap_or(start);
    let (first_line, start) = sources.line_of(file, start);
    let end = sources.line_start(file, sources.line_of(file, end).0 + 1);
    // The renderer only recognises line feeds. The replacements keep the length, so offsets stay valid.
    let lines = sources.text(file)[start..end]
        .replace("\r\n", " \n")
        .replace('\r', "\n");
    (first_line, start, lines)
}

/// The byte range of a span, cut off after [`NEAR_LINES`] lines.
fn visible(span: Span, sources: &Sources) -> Range<usize> {
    let text = sources.text(span.file);
    let start = char_start(text, span.start as usize);
    let (line, _) = sources.line_of(span.file, start);
    let limit = sources.line_start(span.file, line + NEAR_LINES);
    let end = char_start(text, (span.end as usize).min(limit));
    start..end.max(start)
}

/// A note for each call and include, innermost first.
fn trace<'a>(trace: &[Label], sources: &'a Sources) -> Vec<Group<'a>> {
    let omitted = trace.len().saturating_sub(2 * TRACE_ENDS);
    let mut groups = Vec::new();
    for (index, label) in trace.iter().enumerate() {
        if omitted > 0 && index == TRACE_ENDS {
            let title = format!("and {omitted} more on the way");
            groups.push(Group::with_title(Level::NOTE.secondary_title(title)));
        }
        if omitted > 0 && (TRACE_ENDS..TRACE_ENDS + omitted).contains(&index) {
            continue;
        }
        let mark = Mark {
            span: label.span,
            text: None,
            kind: AnnotationKind::Primary,
        };
        let title = Level::NOTE.secondary_title(clean(&label.text));
        groups.push(title.element(snippet(&[mark], sources)));
    }
    groups
}

/// Replaces control characters, which a terminal would interpret.
fn clean(text: &str) -> String {
    text.replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str =
        "#include \"leg.inc\"\nunion {\n  sphere {\n    0, 1\n  pigmnt { Red }\n}\n";

    /// Sources with the scene as `x.pov`, and a function that returns the span of a part of it.
    fn scene() -> (Sources, impl Fn(&str) -> Span) {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("x.pov", SCENE);
        let span = move |part: &str| {
            let start = u32::try_from(SCENE.find(part).unwrap()).unwrap();
            Span::new(file, start, start + u32::try_from(part.len()).unwrap())
        };
        (sources, span)
    }

    fn unknown_word(span: impl Fn(&str) -> Span) -> Diagnostic {
        let mut error = Diagnostic::error(span("pigmnt"), "unknown word `pigmnt` in `sphere`")
            .with_label(span("sphere {"), "in this `sphere`")
            .with_hint("did you mean `pigment`?");
        error.trace.push(Label {
            span: span("#include \"leg.inc\""),
            text: "included here".to_owned(),
        });
        error
    }

    #[test]
    fn the_line_of_pov_ray_is_never_broken() {
        let (sources, span) = scene();
        let error = unknown_word(&span);
        assert_eq!(
            pov_line(&error, &sources),
            "File 'x.pov' line 5: Parse Error: unknown word `pigmnt` in `sphere`"
        );
        let warning = Diagnostic::warning(None, "no\nobjects");
        assert_eq!(pov_line(&warning, &sources), "Parse Warning: no objects");
    }

    #[test]
    fn the_scene_is_shown_with_labels_help_and_trace() {
        let (sources, span) = scene();
        let text = annotated(&unknown_word(span), &sources, Styling::Plain);
        assert_eq!(
            text,
            "\
error: unknown word `pigmnt` in `sphere`
 --> x.pov:5:3
  |
3 |   sphere {
  |   -------- in this `sphere`
4 |     0, 1
5 |   pigmnt { Red }
  |   ^^^^^^
  |
  = help: Did you mean `pigment`?
note: included here
 --> x.pov:1:1
  |
1 | #include \"leg.inc\"
  | ^^^^^^^^^^^^^^^^^^"
        );
    }

    #[test]
    fn colour_is_only_there_when_asked_for() {
        let (sources, span) = scene();
        let error = unknown_word(span);
        assert!(!annotated(&error, &sources, Styling::Plain).contains('\x1b'));
        assert!(annotated(&error, &sources, Styling::Colored).contains('\x1b'));
    }

    #[test]
    fn lone_carriage_returns_end_lines_in_the_snippet_too() {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("mac.pov", "a\rb\r\n\u{e9} bad\rd");
        let bad = Span::new(file, 8, 11);
        assert_eq!(sources.line_column(bad), (3, 3));
        let text = annotated(
            &Diagnostic::error(bad, "bad word"),
            &sources,
            Styling::Plain,
        );
        assert_eq!(
            text,
            "\
error: bad word
 --> mac.pov:3:3
  |
3 | é bad
  |   ^^^"
        );
    }

    #[test]
    fn distant_spans_are_shown_without_the_lines_between() {
        let mut sources = Sources::new(Vec::new());
        let text = format!("first{}last", "\n".repeat(100_000));
        let end = u32::try_from(text.len()).unwrap();
        let file = sources.add_text("long.pov", text);
        let error = Diagnostic::error(Span::new(file, end - 4, end), "one")
            .with_label(Span::new(file, 0, 5), "two")
            .with_label(Span::new(file, 0, end), "three");
        let text = annotated(&error, &sources, Styling::Plain);
        assert!(
            text.contains("long.pov:100001:1") && text.contains("long.pov:1:1"),
            "{text}"
        );
        assert!(text.lines().count() < 30, "{text}");
    }

    #[test]
    fn a_span_at_the_end_or_outside_the_text_does_not_panic() {
        let mut sources = Sources::new(Vec::new());
        for text in ["", "\n", "é", "é\n", "\r"] {
            let file = sources.add_text("x.pov", text);
            for (start, end) in [(0, 0), (1, 1), (0, 1), (1, 2), (2, 2), (9, 99), (9, 0)] {
                let error = Diagnostic::error(Span::new(file, start, end), "x");
                assert!(annotated(&error, &sources, Styling::Plain).contains("x.pov"));
                assert!(pov_line(&error, &sources).starts_with("File 'x.pov' line "));
            }
        }
    }

    #[test]
    fn a_scene_in_one_endless_line_is_shown_in_part() {
        let mut sources = Sources::new(Vec::new());
        let text = format!(
            "{}bad {}",
            "sphere { 0, 1 } ".repeat(200_000),
            "x ".repeat(1_000_000)
        );
        let at = u32::try_from(text.find("bad").unwrap()).unwrap();
        let file = sources.add_text("line.pov", text);
        let error = Diagnostic::error(Span::new(file, at, at + 3), "bad word");
        let text = annotated(&error, &sources, Styling::Plain);
        assert!(
            text.contains("line.pov:1:3200001") && text.contains("bad"),
            "{text:.300}"
        );
        assert!(text.len() < 1000, "{}", text.len());
    }

    #[test]
    fn a_fix_is_shown_as_a_change_unless_its_line_is_endless() {
        for (blanks, is_shown) in [(1, true), (100_000, false)] {
            let mut sources = Sources::new(Vec::new());
            let file =
                sources.add_text("x.pov", format!("{}Sphere {{ 0, 1 }}", " ".repeat(blanks)));
            let at = u32::try_from(blanks).unwrap();
            let span = Span::new(file, at, at + 6);
            let fix = Fix {
                span,
                text: "sphere".to_owned(),
            };
            let error = Diagnostic::error(span, "bad word").with_fix("write `sphere`", fix);
            let text = annotated(&error, &sources, Styling::Plain);
            assert!(text.contains("help: Write `sphere`."), "{text:.300}");
            assert_eq!(text.contains("+  sphere { 0, 1 }"), is_shown, "{text:.300}");
            assert!(text.len() < 1000, "{}", text.len());
        }
    }

    #[test]
    fn a_long_trace_is_cut_in_the_middle() {
        let (sources, span) = scene();
        let mut error = Diagnostic::error(span("0, 1"), "too deep");
        for depth in 0..1000 {
            error.trace.push(Label {
                span: span("Red"),
                text: format!("in call {depth}"),
            });
        }
        let text = annotated(&error, &sources, Styling::Plain);
        assert!(
            text.contains("in call 3\n") && text.contains("in call 996\n"),
            "{text}"
        );
        assert!(text.contains("note: and 992 more on the way") && !text.contains("call 500"));
    }
}
