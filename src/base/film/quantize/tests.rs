//! Tests of the rounding to levels.

use super::*;

fn curves() -> Vec<Rounded> {
    let spaces = [
        Gamma::LINEAR,
        Gamma::Srgb,
        Gamma::power(1.8),
        Gamma::power(2.2),
    ];
    spaces
        .iter()
        .flat_map(|&working| {
            spaces.iter().map(move |&file| {
                Rounded::of(&EncodeOptions {
                    working: Some(working),
                    file_gamma: file,
                    ..EncodeOptions::new(crate::output::Format::PNG)
                })
            })
        })
        .collect()
}

#[test]
fn table_matches_the_curve_on_both_sides_of_every_step() {
    let linear_to_srgb = Rounded::of(&EncodeOptions::new(crate::output::Format::PNG));
    assert!(StepTable::new(linear_to_srgb).is_some());
    for curve in curves() {
        let Some(table) = StepTable::new(curve) else {
            continue;
        };
        for range in &table.ranges {
            if range.next_at.is_infinite() {
                continue;
            }
            // The curves are monotone up to rounding; a failure would occur next to a step.
            let bits = range.next_at.to_bits();
            for c in (bits - 300..bits + 300).map(f32::from_bits) {
                assert_eq!(table.level(c), curve.level_8(c), "{curve:?} at {c:e}");
            }
        }
    }
}

#[test]
fn table_matches_the_curve_at_a_million_floats() {
    let end = 1.5f32.to_bits();
    for curve in curves() {
        let Some(table) = StepTable::new(curve) else {
            continue;
        };
        for c in (0..=end).step_by(8191).map(f32::from_bits) {
            assert_eq!(table.level(c), curve.level_8(c), "{curve:?} at {c:e}");
            assert_eq!(table.level(-c), 0);
        }
    }
}

/// The middle between two levels in light lies above that of the encoding.
#[test]
fn version_3_8_rounds_in_light() {
    let options = EncodeOptions::new(crate::output::Format::PNG);
    let encoded = Rounded::of(&options);
    let light = Rounded::of(&EncodeOptions {
        rounding: Rounding::Working,
        ..options
    });
    let middle = Gamma::Srgb.decode(107.5 / 255.0);
    let levels = |c: f32| (encoded.level_8(c), light.level_8(c));
    assert_eq!(levels(middle * 0.999_99), (107, 107));
    assert_eq!(levels(middle * 1.000_01), (108, 107));
    assert_eq!(levels(middle * 1.000_04), (108, 108));
    assert_eq!(
        (
            light.level_8(0.0),
            light.level_8(1.0),
            light.level_8(f32::NAN)
        ),
        (0, 255, 0)
    );
}

/// `rgb <0.2, 0.4, 0.7>` of POV-Ray 3.8 for each `assumed_gamma`.
#[test]
fn version_3_8_rounds_in_the_working_space() {
    let levels = |working: Gamma| {
        let rounded = Rounded::of(&EncodeOptions {
            rounding: Rounding::Working,
            working: Some(working),
            ..EncodeOptions::new(crate::output::Format::PNG)
        });
        [0.2, 0.4, 0.7].map(|c| rounded.level_8(c))
    };
    assert_eq!(levels(Gamma::power(2.2)), [48, 102, 180]);
    assert_eq!(levels(Gamma::Srgb), [51, 102, 179]);
}

/// Levels in files of POV-Ray 3.8 with `+FN1` to `+FN10`.
#[test]
fn a_level_is_repeated_to_fill_its_bytes() {
    let high = |level, bits| spread(level, bits) >> 8;
    assert_eq!([high(1, 1), high(2, 2), high(9, 4)], [0xff, 0xaa, 0x99]);
    assert_eq!(high(0b11110, 5), 0xf7);
    assert_eq!(spread(0x3e2, 10), 0xf8be);
    assert_eq!(spread(0x1234, 16), 0x1234);
    let bits = |bits, rounding| {
        bits_of(&EncodeOptions {
            bits,
            rounding,
            ..EncodeOptions::new(crate::output::Format::PNG)
        })
    };
    assert_eq!(bits(4, Rounding::Encoded), 5);
    assert_eq!(bits(4, Rounding::Working), 4);
    assert_eq!(bits(20, Rounding::Working), 16);
}

#[test]
fn nan_is_black_and_infinity_white() {
    for curve in curves() {
        assert_eq!(curve.level_8(f32::NAN), 0);
        assert_eq!(word(curve.level(f32::INFINITY, 65535.0)), 65535);
        assert_eq!(word(curve.level(f32::NEG_INFINITY, 65535.0)), 0);
    }
}

#[test]
fn a_pixel_brighter_than_its_coverage_gets_a_larger_coverage() {
    // POV-Ray: rgbt <1,.8,.6,.5> with ambient 1.2 and +FN16 +UA File_Gamma=1 is 65535 62668 47001 32896.
    let pixel = Pixel {
        rgb: Rgb::new(0.6, 0.48, 0.36),
        transmit: 0.5,
    };
    let (rgb, alpha) = straight(pixel);
    let same = Rounded {
        curve: Curve::Same,
        spaces: None,
        rounding: Rounding::Encoded,
    };
    let levels = [rgb.r, rgb.g, rgb.b].map(|c| word(same.level(c, 65535.0)));
    assert_eq!(levels, [65535, 62668, 47001]);
    assert_eq!(word(same.level(alpha, 65535.0)), 32896);
}
