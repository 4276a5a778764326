//! Comparison with the samples of libjpeg-turbo 2.1.5, by their CRC-32.

use super::{decode, size};

const FULL: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/full.jpg");
const QUARTER: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/quarter.jpg");
const PROGRESSIVE: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/progressive.jpg");
const HALF: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/half.jpg");
const TALL: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/tall.jpg");
const FOURTH: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/fourth.jpg");
const NARROW: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/narrow.jpg");
const GREY: &[u8] = include_bytes!("../../../../pov_scenes/texture/images/grey.jpg");

#[test]
fn samples_equal_those_of_libjpeg() {
    let cases = [
        ("full", FULL, [29, 23], 0xfd94_9214),
        ("half", HALF, [29, 23], 0x6c2a_88d3),
        (
            "quarter, with restart markers",
            QUARTER,
            [29, 23],
            0x8593_268a,
        ),
        ("tall", TALL, [29, 23], 0xfee9_a527),
        ("fourth, progressive", FOURTH, [29, 23], 0xa5be_8e0e),
        ("progressive", PROGRESSIVE, [29, 23], 0xf538_3249),
        ("narrow", NARROW, [3, 5], 0xd2d5_d95e),
        ("grey", GREY, [29, 23], 0xa833_0fdd),
    ];
    for (name, bytes, [width, height], crc) in cases {
        let image = decode(bytes).expect(name);
        assert_eq!((image.width(), image.height()), (width, height));
        assert_eq!(crc32fast::hash(image.as_bytes()), crc, "{name}");
        let (claimed, _) = size(bytes).expect(name);
        assert_eq!(claimed, [width, height].map(u64::from));
    }
}

#[test]
fn a_file_without_its_end_is_rejected() {
    for bytes in [FULL, PROGRESSIVE] {
        for length in [0, 1, 20, bytes.len() / 2, bytes.len() - 2] {
            assert!(decode(&bytes[..length]).is_err());
        }
        // A truncated scan followed by an EOI marker is accepted.
        let mut early = bytes[..bytes.len() * 3 / 4].to_vec();
        early.extend([0xff, 0xd9]);
        assert!(decode(&early).is_ok());
    }
}

#[test]
fn damaged_files_do_not_panic() {
    for bytes in [QUARTER, PROGRESSIVE, FOURTH] {
        for at in 0..bytes.len() {
            let mut damaged = bytes.to_vec();
            damaged[at] ^= [0x01, 0x80, 0xff][at % 3];
            // Skip sizes that take too long.
            if size(&damaged).is_ok_and(|(_, bytes)| bytes < 1 << 22) {
                let _ = decode(&damaged);
            }
        }
    }
}
