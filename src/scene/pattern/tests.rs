//! Pattern values, compared with those that POV-Ray 3.7 prints.

use super::*;
use crate::base::args::text::TextArgs;

/// The value of a pattern with its modifiers, with the wave applied.
pub(super) fn value(text: &str, point: DVec3) -> f64 {
    let prepared = prepared(text);
    prepared.value(prepared.to_pattern_space(point), &SurfacePoint::at(point))
}

fn prepared(text: &str) -> PreparedPattern {
    let mut args = TextArgs::new(text);
    let word = args
        .word()
        .unwrap()
        .expect("a pattern begins with its word");
    let mut pattern = read_named(word, &mut args).unwrap().expect("it is built");
    let mut modifiers = Modifiers::default();
    while let Some(word) = args.word().unwrap() {
        let is_own = pattern.read_modifier(word, &mut args).unwrap();
        assert!(is_own || modifiers.read(word, &mut args).unwrap(), "{word}");
    }
    assert!(args.is_done());
    modifiers.prepare(&*pattern, &[], &Settings::default())
}

#[test]
fn packets_of_points_have_the_values_of_single_ones() {
    let apart = [
        DVec3::new(0.3, 0.2, 0.1),
        DVec3::new(-1.7, 2.25, 0.6),
        DVec3::new(12.34, -5.67, 8.9),
        DVec3::new(5e9, -0.5, 3.0),
    ];
    // In one cell in the first octaves.
    let near = [0.02, 0.04, 0.07, 0.03].map(|shift| DVec3::new(0.4 + shift, 0.3, 0.5 - shift));
    for word in [
        "bozo",
        "spotted",
        "granite",
        "wrinkles",
        "marble",
        "agate",
        "wood",
        "gradient <1, 0, 0>",
    ] {
        for modifiers in [
            "",
            "turbulence 0.4 octaves 9 lambda 2.3",
            "warp { turbulence 1 }",
        ] {
            for noise in ["", "noise_generator 1", "noise_generator 3"] {
                let text = format!("{word} {modifiers} scale 2 {noise}");
                let prepared = prepared(&text);
                for points in [apart, near] {
                    let [a, b, c, d] = points.map(SurfacePoint::at);
                    let in_pattern = prepared.to_pattern_space_x4(&points);
                    let together = prepared.values_x4(&in_pattern, [&a, &b, &c, &d]);
                    let alone = points.map(|point| value(&text, point));
                    assert_eq!(
                        together.map(f64::to_bits),
                        alone.map(f64::to_bits),
                        "{text}"
                    );
                }
            }
        }
    }
}

#[test]
fn all_keywords_in_the_table_are_patterns() {
    for (word, _) in PATTERNS {
        assert!(is_pattern(*word), "{word}");
    }
    assert!(is_pattern(Word::Bozo) && is_pattern(Word::Spherical));
    assert!(!is_pattern(Word::Solid) && !is_pattern(Word::Phong));
}

#[test]
fn values_match_pov_ray() {
    // docs/povray-shapes.md, section 14: `function { pattern { ... } }` at three points.
    let points = [
        DVec3::new(0.3, 0.2, 0.1),
        DVec3::new(-1.7, 2.25, 0.6),
        DVec3::new(12.34, -5.67, 8.9),
    ];
    let expected = [
        (
            "bozo noise_generator 1",
            [0.209_924_647_6, 0.801_849_110_5, 0.392_921_149_1],
        ),
        ("bozo", [0.373_438_962_5, 0.663_396_605_6, 0.463_080_863_8]),
        (
            "bozo noise_generator 3",
            [0.578_735_912_4, 0.517_431_379_0, 0.543_519_081_6],
        ),
        (
            "granite",
            [0.371_002_399_5, 0.590_381_938_7, 0.220_615_439_4],
        ),
        (
            "marble turbulence 0.6",
            [0.646_904_208_7, 0.118_907_587_3, 0.165_073_236_1],
        ),
        ("agate", [0.370_484_161_2, 0.976_760_365_2, 0.699_516_322_7]),
        (
            "wood turbulence 0.3",
            [0.441_562_870_5, 0.904_589_165_5, 0.953_111_315_7],
        ),
        (
            "crackle",
            [0.272_295_231_9, 0.338_916_222_9, 0.231_947_774_8],
        ),
        ("cells", [0.711_818_915_3, 0.208_934_925_3, 0.089_998_814_0]),
        (
            "wrinkles",
            [0.321_998_498_8, 0.646_061_256_4, 0.487_418_422_6],
        ),
        (
            "ripples",
            [0.729_252_127_0, 0.452_698_833_1, 0.563_908_183_0],
        ),
        ("waves", [0.724_810_307_7, 0.434_478_222_1, 0.336_429_373_4]),
        (
            "leopard",
            [0.039_207_030_0, 0.013_692_967_4, 0.080_666_227_7],
        ),
        (
            "radial",
            [0.948_791_808_8, 0.554_000_096_7, 0.900_554_611_2],
        ),
    ];
    for (text, expected) in expected {
        for (point, expected) in points.into_iter().zip(expected) {
            let actual = value(text, point);
            assert!(
                (actual - expected).abs() < 1e-10,
                "{text} {point}: {actual}"
            );
        }
    }
}

#[test]
fn turbulence_acts_before_transforms_wherever_it_is_written() {
    let point = DVec3::new(0.3, 1.2, -0.7);
    let first = value("bozo turbulence 0.5 scale 2", point);
    assert_eq!(first, value("bozo scale 2 turbulence 0.5", point));
    let warped = value("bozo warp { turbulence 0.5 } scale 2", point);
    assert!((first - warped).abs() < 1e-12);
    assert!(warped != value("bozo scale 2 warp { turbulence 0.5 }", point));
}

/// Patterns that need a file, a function or an object.
const NEEDS_MORE: [Word; 5] = [
    Word::DensityFile,
    Word::Function,
    Word::ImagePattern,
    Word::Object,
    Word::Potential,
];

#[test]
fn every_pattern_has_a_value_everywhere() {
    let words = PATTERNS.iter().map(|entry| entry.0);
    let far = [f64::NAN, f64::INFINITY, -1e300, -1e17, 0.0, 1e17];
    for word in words.filter(|word| !NEEDS_MORE.contains(word)) {
        let tail = match word {
            Word::Gradient => " <1, 0, 0> turbulence 1",
            Word::Spiral1 | Word::Spiral2 => " 3 turbulence 1",
            Word::Julia => " <0.3, 0.2>, 20 turbulence 1",
            Word::Magnet => " 1 mandel 20 turbulence 1",
            Word::Tiling => " 3 turbulence 1",
            Word::Mandel => " 20 turbulence 1",
            Word::Slope => " <0, 1, 0> turbulence 1",
            _ => " turbulence 1",
        };
        for coordinate in far {
            let _ = value(&format!("{word}{tail}"), DVec3::splat(coordinate));
        }
    }
}
