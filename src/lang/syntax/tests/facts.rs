//! Single facts about the tokens, each as POV-Ray 3.7 has it.

use super::super::{END_OF_FILE, Kind, Names, Word, tokenize};
use super::{lex, spellings};
use crate::base::source::Sources;
use crate::base::source::print::{Styling, annotated};

#[test]
fn a_token_takes_twelve_bytes() {
    assert_eq!(size_of::<super::super::Token>(), 12);
}

#[test]
fn marks_and_comparisons_are_distinguished() {
    let text = "<1,2>=3 <= 4!=5 a<-b ~ \\ @ ° {}()[],;:?&|+-*/.=!";
    let expected = [
        "<", "1", ",", "2", ">=", "3", "<=", "4", "!=", "5", "a", "<", "-", "b", "~", "\\", "@",
        "°", "{", "}", "(", ")", "[", "]", ",", ";", ":", "?", "&", "|", "+", "-", "*", "/", ".",
        "=", "!",
    ];
    assert_eq!(spellings(text), expected);
}

#[test]
fn words_and_names_differ() {
    let (tokens, names) = lex("sphere Sphere spheres x x1 sphere").unwrap();
    let kinds: Vec<Kind> = tokens.tokens.iter().map(|token| token.kind).collect();
    let (w, n) = (Kind::Word, Kind::Name);
    assert_eq!(kinds, [w, n, n, w, n, w, Kind::End]);
    assert_eq!(tokens.tokens[0].word(), Some(Word::Sphere));
    assert_eq!(names.spelling(tokens.tokens[1].symbol().unwrap()), "Sphere");
    assert_eq!(tokens.tokens[6].start, 33);
    assert_eq!(tokens.span(6).start, tokens.span(6).end);
}

#[test]
fn points_belong_to_numbers_only_beside_digits() {
    assert_eq!(
        spellings("v.x 5.x .5 2pi 1e-3-4"),
        ["v", ".", "x", "5.", "x", ".5", "2", "pi", "1e-3", "-", "4"]
    );
}

#[test]
fn every_bad_number_is_reported() {
    let faults = lex("1.2.3 4 5..6\n7.8.9e1").unwrap_err();
    let messages: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
    assert_eq!(
        messages,
        [
            "`1.2.3` has two decimal points",
            "`5..6` has two decimal points",
            "`7.8.9e1` has two decimal points"
        ]
    );
    assert_eq!(faults[1].hints, ["Write `5.6`."]);
}

#[test]
fn comments_nest() {
    assert_eq!(
        spellings("a/* b /* c */ d */e // f /*\r g /*/ */h /***/"),
        ["a", "e", "g", "h"]
    );
}

#[test]
fn a_comment_that_stays_open_is_reported_with_the_inner_one() {
    let faults = lex("a /* b /* c */ d").unwrap_err();
    assert_eq!(faults[0].message, "no `*/` for this comment");
    assert_eq!(faults[0].span.unwrap().start, 2);
    assert_eq!(faults[0].labels[0].span.start, 7);
    let faults = lex("a /* b\n/* c */ d").unwrap_err();
    assert!(faults[0].labels.is_empty());
    let faults = lex("a /* b /* c /* */ d").unwrap_err();
    assert_eq!(faults[0].labels[0].span.start, 7);
}

#[test]
fn a_missing_quote_is_attributed_to_the_first_string_that_spans_lines() {
    let text = "#include \"a.inc\"\n#include \"b.inc\n#include \"c.inc\"\n";
    let faults = lex(text).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].message, "this string is not closed in its line");
    let starts: Vec<u32> = faults[0]
        .labels
        .iter()
        .map(|label| label.span.start)
        .collect();
    assert_eq!(starts, [42, 48]);
    assert_eq!(faults[0].span.unwrap().start, 26);
}

#[test]
fn strings_have_a_written_and_a_meant_form() {
    let text = r#""C:\new\"x\"" "a\tb\\\u0041\u00e9\ud800\0\'" "\" "\q\u12" "#;
    let (tokens, _) = lex(r#""C:\new\"x\"" "a\tb\\\u0041\u00e9\ud800\0\'" "a\qb\u12""#).unwrap();
    assert!(lex(text).is_err(), "the fourth string is not closed");
    assert_eq!(tokens.string_raw(0), "C:\\new\"x\"");
    assert_eq!(tokens.string(1), "a\tb\\A\u{e9}\u{fffd}\0'");
    assert_eq!(tokens.bad_escape(1), None);
    assert_eq!(tokens.string(2), "a\\qb\\u12");
    let bad = tokens.bad_escape(2).unwrap();
    assert_eq!(&tokens.text()[bad.start as usize..bad.end as usize], "\\q");
}

#[test]
fn a_directive_takes_trivia_before_its_word() {
    let text = "# declare #/* /* c */ */ if #//x\nend #default ##local # 5 #sphere #once #foo #";
    let (tokens, _) = lex(text).unwrap();
    let words: Vec<Option<Word>> = tokens.directives.iter().map(|each| each.word).collect();
    let some = [
        Word::Declare,
        Word::If,
        Word::End,
        Word::Default,
        Word::Local,
    ]
    .map(Some);
    assert_eq!(words[..5], some);
    assert_eq!(words[5..], [None, None]);
    let rest: Vec<String> = spellings(text).into_iter().skip(5).collect();
    assert_eq!(rest, ["#", "5", "sphere", "once", "#", "foo"]);
    assert_eq!(spellings(text)[1], "#/* /* c */ */ if");
}

#[test]
fn directives_without_the_sign_are_words() {
    let (tokens, _) = lex("declare A = 1; include \"x\" default").unwrap();
    assert!(tokens.directives.is_empty());
    assert_eq!(tokens.tokens[0].word(), Some(Word::Declare));
}

/// `next` and `end` of each directive, as indices into the list of directives.
fn links(text: &str) -> Vec<(String, Option<usize>, Option<usize>)> {
    let (tokens, _) = lex(text).unwrap();
    let position =
        |index: u32| (index != END_OF_FILE).then(|| tokens.tokens[index as usize].value as usize);
    let directives = tokens.directives.iter();
    directives
        .map(|each| {
            (
                each.word.unwrap().to_string(),
                position(each.next),
                position(each.end),
            )
        })
        .collect()
}

#[test]
fn groups_are_linked() {
    let text = "#if(1) a #elseif(2) #while(3) b #break #end #else c #end";
    let link = |word: &str, next, end| (word.to_owned(), next, end);
    assert_eq!(
        links(text),
        [
            link("if", Some(1), Some(6)),
            link("elseif", Some(5), Some(6)),
            link("while", Some(4), Some(4)),
            link("break", None, None),
            link("end", None, Some(4)),
            link("else", Some(6), Some(6)),
            link("end", None, Some(6)),
        ]
    );
    assert_eq!(
        links("#switch(1) #case(2) #break #range(3,4) #else #end"),
        [
            link("switch", Some(1), Some(5)),
            link("case", Some(3), Some(5)),
            link("break", None, None),
            link("range", Some(4), Some(5)),
            link("else", Some(5), Some(5)),
            link("end", None, Some(5)),
        ]
    );
}

#[test]
fn groups_may_be_open_at_both_ends_of_a_file() {
    let link = |word: &str, next, end| (word.to_owned(), next, end);
    assert_eq!(
        links("#end #else #macro M() #if(1) #else #declare A=1;"),
        [
            link("end", None, None),
            link("else", None, None),
            link("macro", None, None),
            link("if", Some(4), None),
            link("else", None, None),
            link("declare", None, None),
        ]
    );
}

#[test]
fn long_lists_of_a_mesh_are_read_as_any_other_text() {
    let mut text = String::from("mesh2 { vertex_vectors { 9000, ");
    for i in 0..300_000 {
        text.push_str(&format!("<{i}.5,-.25e-1,{i}>,"));
        if i == 200_000 {
            text.push_str("<A,1>=2 // note\n /* x */ 5.");
        }
    }
    text.push_str("} face_indices { 1 <1,2,3> } }");
    super::corpus::assert_same_tokens(&text, "mesh");
}

#[test]
fn lexical_faults_are_shown_in_the_scene() {
    let mut sources = Sources::new(Vec::new());
    let file = sources.add_text(
        "x.pov",
        "#include \"a.inc\nsphere { 1.5.2 }\n#debug \"done\"\n",
    );
    let faults = tokenize(file, sources.text(file), &mut Names::new()).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(
        annotated(&faults[0], &sources, Styling::Plain),
        "\
error: this string is not closed in its line
 --> x.pov:1:10
  |
1 | #include \"a.inc
  |          ^^^^^^
2 | sphere { 1.5.2 }
3 | #debug \"done\"
  |        -    - so that this one has no end
  |        |
  |        it ends only here
  |
  = help: Write `\"` at the end of the string."
    );
}
