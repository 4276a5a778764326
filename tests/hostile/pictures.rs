//! Pictures, whole and damaged, in everything that a scene makes of them.

use image::{DynamicImage, ImageFormat, RgbaImage};
use povr::base::options::{Input, ReadOptions, RenderOptions};
use std::fs;
use std::io::Cursor;

/// Uses of a picture `p` of the type `TYPE`.
const USES: [&str; 12] = [
    "height_field { TYPE \"p\" smooth translate -0.5 }",
    "height_field { TYPE \"p\" water_level 0.3 }",
    "sphere { 0, 1 pigment { image_map { TYPE \"p\" map_type 1 interpolate 2 transmit all 0.2 } } }",
    "box { -1, 1 pigment { image_map { TYPE \"p\" once filter 0, 0.5 interpolate 3 } } }",
    "plane { z, 1 pigment { rgb 1 } normal { bump_map { TYPE \"p\" use_index interpolate 4 } } }",
    "plane { z, 1 texture { material_map { TYPE \"p\" texture { pigment { rgb 1 } } } } }",
    "plane { z, 1 pigment { image_pattern { TYPE \"p\" use_alpha interpolate 2 } } }",
    "plane { z, 1 pigment { image_pattern { TYPE \"p\" use_index } } }",
    "#declare F = function { pigment { image_map { TYPE \"p\" } } } plane { z, 1 pigment { rgb F(0.1, 0.2, 0).red } }",
    "isosurface { function { y - function { pattern { image_pattern { TYPE \"p\" } } }(x, z, 0) }
contained_by { box { -1, 1 } } }",
    "#declare P = pigment { image_map { TYPE \"p\" } } #declare S = max_extents(P); plane { z, 1 pigment { P scale S } }",
    "sky_sphere { pigment { image_map { TYPE \"p\" map_type 1 } } }",
];

/// Damaged copies of each picture for each use.
const COPIES: usize = 12;

/// A sequence of random numbers (Marsaglia 2003, Xorshift RNGs).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).expect("31 bits") % limit.max(1)
    }
}

/// Small pictures in all formats, by the words of scenes for them.
fn pictures(random: &mut Random) -> Vec<(&'static str, Vec<u8>)> {
    let mut pictures = Vec::new();
    for (word, format) in [
        ("bmp", ImageFormat::Bmp),
        ("exr", ImageFormat::OpenExr),
        ("gif", ImageFormat::Gif),
        ("hdr", ImageFormat::Hdr),
        ("jpeg", ImageFormat::Jpeg),
        ("png", ImageFormat::Png),
        ("ppm", ImageFormat::Pnm),
        ("tga", ImageFormat::Tga),
        ("tiff", ImageFormat::Tiff),
    ] {
        for (width, height) in [(1, 1), (5, 3), (1, 4), (17, 2)] {
            let bytes = (0..width * height * 4).map(|_| u8::try_from(random.below(256)));
            let bytes = bytes.collect::<Result<_, _>>().expect("below 256");
            let image = RgbaImage::from_vec(width, height, bytes).expect("it has this size");
            let image = DynamicImage::from(image);
            for image in [
                image.to_luma8().into(),
                image.to_luma16().into(),
                image.to_rgb8().into(),
                image.to_rgb32f().into(),
                image,
            ] as [DynamicImage; 5]
            {
                let mut file = Cursor::new(Vec::new());
                if image.write_to(&mut file, format).is_ok() {
                    pictures.push((word, file.into_inner()));
                }
            }
        }
    }
    pictures
}

/// Cuts a file off, or changes some bytes, most of them in its header.
fn damage(file: &mut Vec<u8>, random: &mut Random) {
    if random.below(4) == 0 {
        file.truncate(random.below(file.len()));
        return;
    }
    for _ in 0..=random.below(4) {
        let limit = [file.len(), file.len().min(64)][random.below(2)];
        let at = random.below(limit);
        let Some(byte) = file.get_mut(at) else {
            return;
        };
        *byte = match random.below(3) {
            0 => *byte ^ (1 << random.below(8)),
            1 => [0, 1, 2, 4, 8, 16, 127, 255][random.below(8)],
            _ => u8::try_from(random.below(256)).expect("below 256"),
        };
    }
}

#[test]
fn no_picture_breaks_the_program_in_any_use() {
    let folder = tempfile::tempdir().expect("temporary folders can be made");
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let pictures = pictures(&mut random);
    assert!(pictures.len() > 60);
    let read = ReadOptions {
        library_paths: vec![folder.path().to_owned()],
        memory: Some(200 << 20),
        ..ReadOptions::default()
    };
    let (mut drawn, mut rejected) = (0, 0);
    for (word, picture) in &pictures {
        for scene in USES {
            for copy in 0..=COPIES {
                let mut file = picture.clone();
                if copy > 0 && random.below(COPIES) < COPIES / 4 {
                    damage(&mut file, &mut random);
                } else if copy > 0 {
                    continue;
                }
                fs::write(folder.path().join("p"), &file).expect("files can be written");
                let input = Input::Text {
                    name: "scene".to_owned(),
                    text: format!("camera {{ location <0.3, 0.4, -3> look_at 0 }} light_source {{ -9, 1 }} {}", scene.replace("TYPE", word)).into(),
                };
                let render = RenderOptions::of_size(8, 6);
                match povr::draw(&input, &read, &render, &|_| {}) {
                    Ok(_) => drawn += 1,
                    Err(_) => rejected += 1,
                }
            }
        }
    }
    assert!(
        drawn > pictures.len() && rejected > pictures.len(),
        "{drawn} {rejected}"
    );
}
