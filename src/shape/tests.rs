use super::*;
use crate::args::text::TextArgs;
use crate::syntax::Class;

fn read(word: Word, text: &str) -> (Shape, TextArgs) {
    let mut args = TextArgs::new(text);
    let shape = Shape::read(word, &mut args).unwrap().unwrap();
    (shape, args)
}

#[test]
fn every_word_of_the_list_is_a_shape_of_the_grammar() {
    for word in Shape::WORDS {
        assert_eq!(word.class(), Class::Shape);
    }
}

#[test]
fn a_shape_reads_its_parameters_and_stops() {
    for (word, text) in [
        (Word::Sphere, "<1,2,3>, 4"),
        (Word::Sphere, "1 4"),
        (Word::Box, "-1, 1"),
        (Word::Cylinder, "<0,0,0>, <0,1,0>, 1"),
        (Word::Cylinder, "<0,0,0> <0,1,0> 1 open"),
        (Word::Cone, "<0,0,0>, 1, <0,1,0>, 0"),
        (Word::Cone, "<0,0,0> 1 <0,1,0> 0 open"),
        (Word::Torus, "1, .3"),
        (Word::Torus, "1 .3 sturm"),
        (Word::Plane, "<0,1,0>, -1"),
        (Word::Disc, "<0,0,0>, <0,1,0>, 1"),
        (Word::Disc, "<0,0,0> <0,1,0> 1 .5"),
        (Word::Triangle, "<0,0,0>, <0,1,0>, <1,0,0>"),
        (Word::Quadric, "<1,1,1>, <0,0,0>, <0,0,0>, -1"),
        (Word::Blob, "threshold .5 sphere { <0,0,0>, 1, 1 }"),
        (Word::Superellipsoid, "<.5, .5>"),
        (Word::Prism, "-1, 1, 4, <0,0>, <1,0>, <0,1>, <0,0>"),
        (
            Word::Prism,
            "conic_sweep 0 1 4 <0,0> <1,0> <0,1> <0,0> open",
        ),
        (Word::Lathe, "2, <.5,-1>, <1,0>"),
        (Word::Sor, "4, <1,-2>, <1,-1>, <1,1>, <1,2>"),
        (Word::Sor, "4 <1,-2> <1,-1> <1,1> <1,2> open"),
        (Word::Polygon, "4, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,0>"),
        (Word::Poly, "2, <1,0,0,0,1,0,0,1,0,-1>"),
        (Word::Ovus, "1, .5"),
        (
            Word::SmoothTriangle,
            "<0,0,0>, <0,0,1>, <0,1,0>, <0,0,1>, <1,0,0>, <0,0,1>",
        ),
    ] {
        let (shape, args) = read(word, text);
        assert_eq!(shape.word(), word);
        assert!(args.is_done(), "{text}");
        assert!(args.warnings().is_empty());
        assert!(!shape.bounds().is_empty());
        let (_, mut args) = read(word, &format!("{text} rotate"));
        assert!(args.accept(Word::Rotate).unwrap());
    }
}

#[test]
fn a_word_that_begins_no_shape_reads_nothing() {
    assert!(Shape::read(Word::Union, &mut TextArgs::new("")).is_none());
}

#[test]
fn a_missing_parameter_is_an_error() {
    for word in Shape::WORDS {
        let result = Shape::read(*word, &mut TextArgs::new("<0,0,0>, <0,1,0>")).unwrap();
        let takes_vectors_only =
            matches!(word, Word::Box | Word::Superellipsoid | Word::JuliaFractal);
        assert_eq!(result.is_ok(), takes_vectors_only, "{word:?}");
    }
}
