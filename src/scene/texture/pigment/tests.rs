use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::pattern::{Settings, SurfacePoint};
use crate::scene::texture::PreparedPigment;
use glam::DVec3;

fn read(text: &str) -> Parse<Pigment> {
    Pigment::read(&mut TextArgs::new(text), &Pigment::default())
}

fn error(text: &str) -> String {
    read(text).expect_err("the text is faulty").message
}

fn list(pigment: &Pigment) -> Vec<Color> {
    match &pigment.kind {
        PigmentKind::Colors(mapped) => {
            let entries = mapped.map.entries().iter();
            entries.map(|entry| entry.1).collect()
        }
        _ => panic!("the pigment has a pattern of colours"),
    }
}

#[test]
fn a_colour_makes_a_plain_pigment() {
    let pigment = read("{ rgbf <1, 0.5, 0, 0.25> }").unwrap();
    let expected = Color::from_components([1.0, 0.5, 0.0, 0.25, 0.0]);
    assert!(matches!(pigment.kind, PigmentKind::Plain(color) if color == expected));
}

#[test]
fn a_list_shorter_than_the_pattern_ends_in_default_colours() {
    // POV-Ray 3.7 draws the second colour of `checker rgb 1` as rgb <0, 1, 0>.
    let pigment = read("{ checker rgb 1 }").unwrap();
    let green = Color::opaque(Rgb::new(0.0, 1.0, 0.0));
    assert_eq!(list(&pigment), [Color::opaque(Rgb::WHITE), green]);
}

#[test]
fn a_list_may_hold_bare_vectors() {
    let pigment = read("{ hexagon <1,0,0>, <0,1,0>, rgb 0.5 }").unwrap();
    assert_eq!(list(&pigment)[0], Color::opaque(Rgb::new(1.0, 0.0, 0.0)));
    assert_eq!(list(&pigment)[2], Color::opaque(Rgb::splat(0.5)));
}

#[test]
fn a_second_block_changes_the_first() {
    // POV-Ray 3.7 keeps the pattern and adds the transform.
    let first = read("{ checker rgb 1 rgb 0 scale 2 }").unwrap();
    let second = Pigment::read(&mut TextArgs::new("{ translate 1 }"), &first).unwrap();
    let expected = [Step::Scale(DVec3::splat(2.0)), Step::Translate(DVec3::ONE)];
    assert_eq!(second.modifiers.get().unwrap().chain.steps(), expected);
    assert_eq!(list(&second).len(), 2);
}

#[test]
fn a_declared_pigment_can_be_changed() {
    let known = Pigment::plain(Color::opaque(Rgb::WHITE));
    let mut args = TextArgs::new("{ P quick_color rgb 0.5 }").with("P", known);
    let pigment = Pigment::read(&mut args, &Pigment::default()).unwrap();
    assert!(matches!(pigment.kind, PigmentKind::Plain(color) if color.rgb == Rgb::WHITE));
    assert_eq!(
        pigment.quick_color.as_deref(),
        Some(&Color::opaque(Rgb::splat(0.5)))
    );
    assert!(args.is_done());
}

#[test]
fn brick_reads_its_size_after_the_colours() {
    let pigment = read("{ brick rgb 0 rgb 1 brick_size <2, 2, 2> mortar 0.25 }").unwrap();
    let prepared = PreparedPigment::new(&pigment, &[], &Settings::default());
    let grey = |x: f64| {
        prepared
            .color(&SurfacePoint::at(DVec3::new(x, 0.5, 0.5)))
            .rgb
            .r
    };
    assert_eq!((grey(1.9), grey(1.7)), (0.0, 1.0));
}

#[test]
fn a_map_blends_colours_and_pigments() {
    let grey = |text: &str| {
        let prepared = PreparedPigment::new(&read(text).unwrap(), &[], &Settings::default());
        prepared
            .color(&SurfacePoint::at(DVec3::new(0.25, 0.0, 0.0)))
            .rgb
            .r
    };
    assert_eq!(grey("{ gradient <1,0,0> }"), 0.25);
    assert_eq!(
        grey("{ gradient <1,0,0> color_map { [0 rgb 1] [0.5 rgb 0] } }"),
        0.5
    );
    let nested = "{ gradient <1,0,0> pigment_map { [0 rgb 1] [0.5 gradient <1,0,0> scale 2] } }";
    assert_eq!(grey(nested), 0.5625);
    assert_eq!(
        grey("{ checker pigment { rgb 0.5 } pigment { rgb 1 } }"),
        0.5
    );
    assert_eq!(
        grey("{ average pigment_map { [1 rgb 1] [3 rgb 0] } }"),
        0.25
    );
}

#[test]
fn a_map_needs_a_pattern_that_takes_one() {
    let expected = "expected a pattern that takes a map before the map, found `color_map`";
    assert_eq!(error("{ checker color_map { [0 rgb 1] } }"), expected);
    assert_eq!(error("{ rgb 1 color_map { [0 rgb 1] } }"), expected);
    let idle = read("{ color_map { [0 rgb 1] } }").expect("a pigment");
    assert_eq!(idle.plain_color(), Some(Color::opaque(Rgb::BLACK)));
    assert_eq!(
        error("{ average }"),
        "expected `pigment_map` after `average`, found the end of the text"
    );
}

#[test]
fn unsupported_or_misplaced_words_are_named() {
    assert_eq!(
        error("{ pavement number_of_sides 5 }"),
        "`number_of_sides` is 3, 4 or 6, found 5"
    );
    assert_eq!(
        error("{ pavement pattern 13 number_of_sides 4 number_of_tiles 5 }"),
        "`pattern` of 5 tiles with 4 sides is 1 to 12, found 13"
    );
    assert_eq!(
        error("{ rgb 1 uv_mapping }"),
        "expected `uv_mapping` at the start of the pigment, before its pattern, found `uv_mapping`"
    );
}

#[test]
fn brick_size_belongs_to_brick() {
    assert_eq!(
        error("{ checker rgb 1 rgb 0 brick_size 2 }"),
        "expected a modifier or `}` in `pigment`, found `brick_size`"
    );
}

#[test]
fn uv_mapping_begins_another_pigment() {
    // POV-Ray 3.7 drops everything before `uv_mapping` and applies the transforms after it to the
    // texture coordinates.
    let known = Pigment::plain(Color::opaque(Rgb::WHITE));
    for text in [
        "{ uv_mapping gradient <1,0,0> scale 2 }",
        "{ P uv_mapping gradient <1,0,0> scale 2 }",
    ] {
        let mut args = TextArgs::new(text).with("P", known.clone());
        let pigment = Pigment::read(&mut args, &Pigment::default()).unwrap();
        assert!(pigment.uses_uv() && pigment.modifiers.get().is_none());
        let prepared = PreparedPigment::new(&pigment, &[], &Settings::default());
        let spot = SurfacePoint {
            uv: glam::DVec2::new(0.5, 0.0),
            ..SurfacePoint::at(DVec3::ONE)
        };
        assert_eq!(prepared.color(&spot).rgb.r, 0.25);
    }
    let mut args = TextArgs::new("{ uv_mapping bozo }");
    let density = crate::scene::interior::Density::read(&mut args).unwrap();
    assert!(!density.0.uses_uv());
    assert_eq!(args.warnings(), ["`uv_mapping` has no effect here"]);
}
