use std::fs;

use image::{DynamicImage, ImageFormat, load_from_memory_with_format};

use super::*;
use crate::base::color::Gamma;
use crate::base::color::Rgb;
use crate::base::film::Pixel;
use crate::base::film::{Levels, Quantizer};

/// Eight pixels of `rgbt <1, .8, .6, .5>` with increasing `ambient`: some colours exceed their coverage, some exceed 1.
fn film() -> Film {
    let mut film = Film::whole(8, 1);
    for (pixel, ambient) in film
        .pixels
        .iter_mut()
        .zip([0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 2.8])
    {
        *pixel = Pixel {
            rgb: Rgb::new(1.0, 0.8, 0.6) * ambient * 0.5f32,
            transmit: 0.5,
        };
    }
    film
}

fn gamma(text: &str) -> Gamma {
    match text {
        "srgb" => Gamma::Srgb,
        number => Gamma::power(number.parse().expect("the table holds numbers")),
    }
}

/// Parses options such as `N16+UA`.
fn options(kind: &str) -> EncodeOptions {
    let (kind, alpha) = match kind.strip_suffix("+UA") {
        Some(kind) => (kind, true),
        None => (kind, false),
    };
    let format = match kind.as_bytes()[0] {
        b'N' => Format::PNG,
        b'T' => Format::TGA,
        b'C' => Format::COMPRESSED_TGA,
        b'B' => Format::BMP,
        b'P' => Format::PPM,
        b'E' => Format::EXR,
        b'H' => Format::HDR,
        other => panic!("no such format: {other}"),
    };
    let mut options = EncodeOptions::new(format);
    options.alpha = alpha;
    options.grayscale = kind.ends_with('g');
    if kind.ends_with("16") || options.grayscale {
        options.bits = 16;
    }
    options
}

fn image_format(format: Format) -> ImageFormat {
    ImageFormat::from_extension(format.extension()).expect("the image crate reads all formats")
}

/// The stored values as the `image` crate reads them.
fn decoded(file: &[u8], format: Format) -> Vec<f64> {
    let image = load_from_memory_with_format(file, image_format(format)).expect("a file we wrote");
    match image {
        DynamicImage::ImageRgb16(i) => i.into_raw().into_iter().map(f64::from).collect(),
        DynamicImage::ImageRgba16(i) => i.into_raw().into_iter().map(f64::from).collect(),
        DynamicImage::ImageLuma16(i) => i.into_raw().into_iter().map(f64::from).collect(),
        DynamicImage::ImageLumaA16(i) => i.into_raw().into_iter().map(f64::from).collect(),
        DynamicImage::ImageRgb32F(i) => i.into_raw().into_iter().map(f64::from).collect(),
        DynamicImage::ImageRgba32F(i) => i.into_raw().into_iter().map(f64::from).collect(),
        other => other.into_bytes().into_iter().map(f64::from).collect(),
    }
}

/// `povray.txt` contains the decoded values that POV-Ray 3.7.0.10 stores for the picture of [`film`].
#[test]
fn stored_values_equal_those_of_povray() {
    let mut lines = 0;
    for line in include_str!("povray.txt")
        .lines()
        .filter(|l| !l.starts_with('#'))
    {
        let (settings, values) = line.split_once(':').expect("a line is `what: values`");
        let mut words = settings.split(' ');
        let (working, kind) = (words.next().unwrap(), words.next().unwrap());
        let mut options = options(kind);
        options.working = (working != "none").then(|| gamma(working));
        options.file_gamma = words.next().map_or(Gamma::Srgb, gamma);
        let file = encode(&film(), &options).unwrap();
        let ours = match options.format {
            // The stored bytes after the header: decoding would lose the shared exponent.
            Format::HDR => rgbe_of(&file),
            format => decoded(&file, format),
        };
        let theirs: Vec<f64> = values
            .split_whitespace()
            .map(|v| v.parse().unwrap())
            .collect();
        assert_eq!(ours, theirs, "{settings}");
        lines += 1;
    }
    assert!(lines > 80, "only {lines} lines");
}

/// The RGBE bytes of each of the eight pixels, from the run-length encoded channels of the only row.
fn rgbe_of(file: &[u8]) -> Vec<f64> {
    let start = file
        .windows(5)
        .position(|w| w == b"+X 8\n")
        .expect("the size")
        + 5;
    let mut coded = file[start + 4..].iter().copied();
    let mut planes = Vec::new();
    while let Some(count) = coded.next() {
        if count > 128 {
            let value = coded.next().expect("a run has a value");
            planes.extend(std::iter::repeat_n(value, usize::from(count) - 128));
        } else {
            planes.extend(coded.by_ref().take(usize::from(count)));
        }
    }
    assert_eq!(planes.len(), 32);
    (0..8)
        .flat_map(|x| (0..4).map(move |c| (x, c)))
        .map(|(x, c)| f64::from(planes[c * 8 + x]))
        .collect()
}

#[test]
fn every_format_is_read_by_the_image_crate() {
    let mut film = Film::whole(37, 23);
    for (i, pixel) in film.pixels.iter_mut().enumerate() {
        let v = f32::from(u8::try_from(i % 251).unwrap()) / 250.0;
        *pixel = Pixel {
            rgb: Rgb::new(v, 1.0 - v, v * v),
            transmit: v * 0.5,
        };
    }
    for format in formats() {
        for alpha in [false, true] {
            for (bits, grayscale) in [(8, false), (16, false), (32, false), (8, true), (16, true)] {
                let options = EncodeOptions {
                    alpha,
                    bits,
                    grayscale,
                    ..EncodeOptions::new(format)
                };
                let file = encode(&film, &options).unwrap();
                let image = load_from_memory_with_format(&file, image_format(format))
                    .unwrap_or_else(|e| panic!("{options:?}: {e}"));
                assert_eq!((image.width(), image.height()), (37, 23), "{options:?}");
                assert_eq!(
                    image.color().has_alpha(),
                    alpha && format.has_alpha,
                    "{options:?}"
                );
            }
        }
    }
}

/// Pillow, among others, refuses packets that go on in the next row.
#[test]
fn packets_of_a_targa_file_end_with_their_row() {
    let film = Film::whole(40, 5);
    for (alpha, channels) in [(false, 3), (true, 4)] {
        let options = EncodeOptions {
            alpha,
            ..EncodeOptions::new(Format::COMPRESSED_TGA)
        };
        let file = encode(&film, &options).unwrap();
        let mut packets = &file[18..];
        let (mut pixels, mut row_ends) = (0, 0);
        while let [head, rest @ ..] = packets {
            let count = usize::from(head & 127) + 1;
            let stored = if *head < 128 { count } else { 1 };
            packets = &rest[stored * channels..];
            pixels += count;
            row_ends += usize::from(pixels % 40 == 0);
        }
        assert_eq!((pixels, row_ends), (200, 5));
    }
}

#[test]
fn a_jpeg_is_within_8_levels_of_the_png() {
    let mut film = Film::whole(64, 16);
    for (i, pixel) in film.pixels.iter_mut().enumerate() {
        let v = f32::from(u8::try_from(i % 64).unwrap()) / 63.0;
        pixel.rgb = Rgb::new(v, v * 0.8, 0.2 - 0.1 * v);
    }
    let of = |format| decoded(&encode(&film, &EncodeOptions::new(format)).unwrap(), format);
    let pairs = of(Format::JPEG).into_iter().zip(of(Format::PNG));
    let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst <= 8.0, "{worst}");
}

#[test]
fn a_png_declares_its_transfer_curve() {
    let chunk = |file: &[u8], name: &[u8]| {
        let at = file.windows(4).position(|w| w == name)?;
        Some(file[at + 4..at + 8].to_vec())
    };
    let mut options = EncodeOptions::new(Format::PNG);
    let file = encode(&film(), &options).unwrap();
    assert_eq!(chunk(&file, b"gAMA"), Some(45455u32.to_be_bytes().to_vec()));
    assert!(chunk(&file, b"sRGB").is_some());
    options.file_gamma = Gamma::LINEAR;
    let file = encode(&film(), &options).unwrap();
    assert_eq!(
        chunk(&file, b"gAMA"),
        Some(100_000u32.to_be_bytes().to_vec())
    );
    assert_eq!(chunk(&file, b"sRGB"), None);
    options.working = None;
    let file = encode(&film(), &options).unwrap();
    assert_eq!(chunk(&file, b"gAMA"), Some(45455u32.to_be_bytes().to_vec()));
    assert!(chunk(&file, b"sRGB").is_some());
}

#[test]
fn a_single_precision_exr_is_lossless() {
    let options = EncodeOptions {
        bits: 32,
        alpha: true,
        ..EncodeOptions::new(Format::EXR)
    };
    let file = encode(&film(), &options).unwrap();
    let expected: Vec<f64> = film()
        .pixels
        .iter()
        .flat_map(|p| [p.rgb.r, p.rgb.g, p.rgb.b, 1.0 - p.transmit].map(f64::from))
        .collect();
    assert_eq!(decoded(&file, Format::EXR), expected);
}

#[test]
fn no_float_makes_an_encoder_panic() {
    let mut film = Film::whole(9, 1);
    let extreme = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        1e-45,
        -0.0,
        1e-38,
        2e38,
    ];
    for (pixel, value) in film.pixels.iter_mut().zip(extreme) {
        pixel.rgb = Rgb::splat(value);
        pixel.transmit = value;
    }
    for format in formats() {
        for alpha in [false, true] {
            let options = EncodeOptions {
                alpha,
                ..EncodeOptions::new(format)
            };
            encode(&film, &options).unwrap();
        }
    }
}

#[test]
fn a_side_beyond_the_limit_of_the_format_is_an_error() {
    let film = Film::whole(70_000, 1);
    let target = Target::File("unused.tga".into());
    let error = write(&film, &target, &EncodeOptions::new(Format::JPEG)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot make a jpg file of this picture: a side is longer than 65535 pixels"
    );
    assert!(encode(&film, &EncodeOptions::new(Format::TGA)).is_err());
    assert!(encode(&Film::whole(0, 4), &EncodeOptions::new(Format::PNG)).is_err());
}

#[test]
fn a_new_file_replaces_the_old_one_and_leaves_no_temporary_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").unwrap();
    write(
        &film(),
        &Target::File(path.clone()),
        &EncodeOptions::new(Format::PNG),
    )
    .unwrap();
    assert!(image::open(&path).is_ok());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn an_encoding_error_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.jpg");
    fs::write(&path, "old").unwrap();
    let target = Target::File(path.clone());
    write(
        &Film::whole(70_000, 1),
        &target,
        &EncodeOptions::new(Format::JPEG),
    )
    .unwrap_err();
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_check_knows_the_errors_of_writing() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("old.png"), "old").unwrap();
    fs::create_dir(path("folder")).unwrap();
    let size = (37, 23);
    for (name, is_right) in [
        ("new.png", true),
        ("old.png", true),
        ("folder", false),
        ("none/new.png", false),
        ("old.png/new.png", false),
    ] {
        let target = Target::File(path(name));
        let checked = check(&target, size, Format::PNG).map_err(|error| error.to_string());
        assert_eq!(checked.is_ok(), is_right, "{checked:?}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
        if let Err(error) = checked {
            let film = Film::whole(size.0, size.1);
            let written = write(&film, &target, &EncodeOptions::new(Format::PNG));
            assert_eq!(written.unwrap_err().to_string(), error);
        }
    }
    for format in [Format::JPEG, Format::TGA, Format::COMPRESSED_TGA] {
        assert!(check(&Target::Stdout, (65535, 1), format).is_ok());
        assert!(check(&Target::Stdout, (1, 65536), format).is_err());
    }
    assert!(check(&Target::Stdout, (1 << 20, 1), Format::PPM).is_ok());
}

#[test]
fn a_file_on_the_path_of_a_picture_is_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a"), "").unwrap();
    let target = Target::File(folder.path().join("a/b.png"));
    let error = check(&target, (1, 1), Format::PNG).unwrap_err();
    assert!(error.to_string().ends_with("b.png`: not a directory"));
    assert_eq!(
        error.hint().unwrap(),
        "A part of this path is a file: name a file in a folder with `+O`."
    );
}

#[test]
fn a_missing_folder_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none").join("a.png");
    let target = Target::File(path.clone());
    let error = write(&film(), &target, &EncodeOptions::new(Format::PNG)).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "cannot write `{}`: no such file or directory",
            path.display()
        )
    );
    assert_eq!(
        error.hint().unwrap(),
        format!(
            "The folder `{}` does not exist: create it, or name another file with `+O`.",
            folder.path().join("none").display()
        )
    );
}

#[test]
fn a_folder_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let target = Target::File(folder.path().to_owned());
    let error = write(&film(), &target, &EncodeOptions::new(Format::PNG)).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("cannot write `{}`: is a directory", folder.path().display())
    );
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link_and_its_file_keeps_its_mode() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (
        folder.path().join("file.png"),
        folder.path().join("link.png"),
    );
    fs::write(&file, "old").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&file, &link).unwrap();
    write(
        &film(),
        &Target::File(link.clone()),
        &EncodeOptions::new(Format::PNG),
    )
    .unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(
        fs::metadata(&file).unwrap().permissions().mode() & 0o777,
        0o640
    );
    assert!(image::open(&file).is_ok());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named() {
    let target = Target::File("/dev/full".into());
    let error = write(&film(), &target, &EncodeOptions::new(Format::PNG)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot write `/dev/full`: no space left on device"
    );
    assert_eq!(
        error.hint().unwrap(),
        "Make room, or name a file on another disk with `+O`."
    );
}

/// A picture with many combinations of negative, small, large and NaN channels.
fn film_of_extremes() -> Film {
    let mut film = Film::whole(37, 23);
    let parts = [-0.5, 0.0, 1e-4, 0.3, 0.999, 1.0, 7.0, f32::NAN];
    for (i, pixel) in film.pixels.iter_mut().enumerate() {
        let part = |step: usize| parts[i / step % parts.len()];
        *pixel = Pixel::new(
            Rgb::new(part(1), part(5), part(29)),
            part(3).clamp(0.0, 1.0),
        );
    }
    film
}

#[test]
fn levels_quantized_row_by_row_give_the_same_file() {
    let film = film_of_extremes();
    for format in formats() {
        for (bits, grayscale, alpha) in [(8, false, false), (8, true, true), (16, false, true)] {
            let options = EncodeOptions {
                bits,
                grayscale,
                alpha,
                ..EncodeOptions::new(format)
            };
            let Some(quantizer) = Quantizer::of(&options) else {
                assert!(matches!(format, Format::EXR | Format::HDR));
                continue;
            };
            let mut levels = Levels::black(&quantizer, film.width, film.height);
            let row = film.width as usize * levels.bytes_per_pixel();
            let rows = levels.bytes_mut().chunks_mut(row);
            for (stored, pixels) in rows.zip(film.rows_of_pixels()) {
                stored.copy_from_slice(&quantizer.levels(pixels));
            }
            let quantized = Film::of_levels(levels, film.columns.clone(), film.rows.clone());
            let expected = encode(&film, &options).unwrap();
            assert!(
                encode(&quantized, &options).unwrap() == expected,
                "{options:?}"
            );
        }
    }
}

#[test]
fn pixels_outside_the_crop_are_black_and_opaque() {
    for (format, alpha) in [(Format::PNG, true), (Format::TGA, false)] {
        let options = EncodeOptions {
            alpha,
            ..EncodeOptions::new(format)
        };
        let quantizer = Quantizer::of(&options).unwrap();
        let black = Film::of_levels(Levels::black(&quantizer, 4, 3), 0..4, 0..3);
        let expected = encode(&Film::whole(4, 3), &options).unwrap();
        assert!(encode(&black, &options).unwrap() == expected);
    }
}

#[test]
fn levels_of_one_kind_of_file_cannot_be_written_as_another() {
    let options = EncodeOptions::new(Format::PNG);
    let quantizer = Quantizer::of(&options).unwrap();
    let film = Film::of_levels(Levels::black(&quantizer, 4, 3), 0..4, 0..3);
    for format in [Format::TGA, Format::EXR] {
        let error = encode(&film, &EncodeOptions::new(format)).unwrap_err();
        assert!(error.to_string().contains("another kind of file"));
    }
}

#[test]
fn a_plain_ppm_has_a_line_for_each_pixel() {
    let mut film = Film::whole(2, 1);
    film.pixels[1].rgb = Rgb::new(1.0, 0.0, 1.0);
    let mut options = EncodeOptions {
        is_plain: true,
        ..EncodeOptions::new(Format::PPM)
    };
    let text = |options: &EncodeOptions| String::from_utf8(encode(&film, options).unwrap());
    assert_eq!(text(&options).unwrap(), "P3\n2 1\n255\n0 0 0\n255 0 255\n");
    (options.bits, options.grayscale) = (16, true);
    assert!(text(&options).unwrap().starts_with("P2\n2 1\n65535\n0\n"));
}
