use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::CommandFactory;

use super::draw::{Draw, carry_out};
use super::options::long_options::LongOptions;
use super::options::output_kinds::Stream;
use super::*;
use crate::base::color::Gamma;
use crate::base::encoding::Rounding;
use crate::base::film::{Film, Pixel};
use crate::base::options::{
    Adaptive, Antialias, Event, Failure, Input, Method, Picture, ReadOptions, Sampling,
};
use crate::output::{DitherMethod, EncodeOptions, Format, Target};

/// The settings of a command line, without any ini file around it.
fn settings(arguments: &[&str]) -> Settings {
    match try_settings(arguments) {
        Ok(settings) => settings,
        Err(refused) => panic!("{arguments:?}: {refused}"),
    }
}

fn try_settings(arguments: &[&str]) -> Result<Settings, String> {
    let arguments: Vec<String> = arguments.iter().map(|&a| a.to_owned()).collect();
    match request(&arguments, &Environment::default()) {
        Ok(Request::Draw(settings)) => Ok(*settings),
        Ok(Request::Print(text)) => Err(format!("printed: {text}")),
        Err(refused) => Err(refused.to_string()),
    }
}

fn refusal(arguments: &[&str]) -> String {
    try_settings(arguments).expect_err("a refusal")
}

/// A folder with files of the given names and texts.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("the folder")).expect("folders in it");
        fs::write(path, text).expect("a file in it");
    }
    folder
}

fn file_of(settings: &Settings) -> (PathBuf, EncodeOptions) {
    match settings.output.clone() {
        Some((Target::File(path), options)) => (path, options),
        other => panic!("no file: {other:?}"),
    }
}

/// The result of a client's call in short: scene, size, file, type, bits, alpha.
fn summary(settings: &Settings, folder: &Path) -> String {
    let short = |path: &Path| {
        let inside = path.strip_prefix(folder).unwrap_or(path);
        inside.display().to_string()
    };
    let scene = match &settings.scene {
        Scene::File(path) => short(path),
        Scene::Stdin => "-".to_owned(),
    };
    let output = match &settings.output {
        None => "nowhere".to_owned(),
        Some((Target::Stdout, options)) => format!("stdout {:?} {}", options.format, options.bits),
        Some((Target::File(path), options)) => {
            format!("{} {:?} {}", short(path), options.format, options.bits)
        }
    };
    let alpha = if settings.render.alpha { " alpha" } else { "" };
    let (width, height) = (settings.render.width, settings.render.height);
    format!("{scene} {width}x{height} > {output}{alpha}")
}

#[test]
fn clients_get_what_they_ask_povray_for() {
    let here = folder(&[("s.pov", ""), ("-0.25_90.pov", ""), ("out.png.pov", "")]);
    let at = here.path().display().to_string();
    // `@` stands for the folder of the scene.
    for (client, arguments, expected) in [
        (
            "vapory",
            "@/s.pov +H120 +W160 -D Output_File_Type=N +O@/out.png",
            "s.pov 160x120 > out.png PNG 8",
        ),
        (
            "vapory as numpy",
            "@/s.pov +H120 +W160 -D Output_File_Type=P +O-",
            "s.pov 160x120 > stdout PPM 8",
        ),
        (
            "vapory with extras",
            "@/s.pov +H9 +W9 +Q9 -A Output_Alpha=on -D +L/dir Output_File_Type=N +O@/o.png",
            "s.pov 9x9 > o.png PNG 8 alpha",
        ),
        (
            "plato",
            "+I@/out.png.pov +O@/out.png +W240.0 +H180.0 +WT2 +UA",
            "out.png.pov 240x180 > out.png PNG 8 alpha",
        ),
        (
            "PyMOL",
            "+FN -D +I@/s.pov +O@/t.png +W240 +H180 ",
            "s.pov 240x180 > t.png PNG 8",
        ),
        (
            "PyElastica",
            "+I@/s.pov +O@/f.png -H90 -W120 Work_Threads=2 Antialias=off Quality=11 Display=Off",
            "s.pov 120x90 > f.png PNG 8",
        ),
        (
            "feverdream",
            "+I@/s.pov +O@/o.png +W1280 +H720 +Llib +WT4 -D",
            "s.pov 1280x720 > o.png PNG 8",
        ),
        (
            "VMD",
            "+W669 +H834 -I@/s.pov -O@/s.pov.tga +D +X -A +FT",
            "s.pov 669x834 > s.pov.tga TGA 8",
        ),
        (
            "Coot",
            "+FN16 -UV +H600 +W600 @/s.pov",
            "s.pov 600x600 > s.png PNG 16",
        ),
        (
            "Morpho",
            "@/-0.25_90.pov -A +W2048 +H1536",
            "-0.25_90.pov 2048x1536 > -0.25_90.png PNG 8",
        ),
        (
            "FreeCAD",
            "+W8 +H9 -D +O\"@/f\" +AM1 +R3 \"@/s.pov\"",
            "s.pov 8x9 > f.png PNG 8",
        ),
        (
            "Deadline",
            "+I@/s.pov +O@/o +W8 +H9 +FN +Q9 +V -D",
            "s.pov 8x9 > o.png PNG 8",
        ),
        (
            "lower case",
            "@/s.pov +w800 +h600 +q3 -d +fp",
            "s.pov 800x600 > s.ppm PPM 8",
        ),
        (
            "ssh farms",
            "Declare=Photo2=1 +AM2 +R2 +WT4 @/s.pov",
            "s.pov 800x600 > s.png PNG 8",
        ),
        (
            "polymake",
            "+I@/s.pov +O@/k.tga",
            "s.pov 800x600 > k.tga.png PNG 8",
        ),
        ("grey", "@/s.pov +FNg", "s.pov 800x600 > s.png PNG 16"),
        ("EXR", "@/s.pov +FE", "s.pov 800x600 > s.exr EXR 16"),
        (
            "HDR",
            "@/s.pov +fh +ua",
            "s.pov 800x600 > s.hdr HDR 8 alpha",
        ),
        ("no file", "@/s.pov -F", "s.pov 800x600 > nowhere"),
        ("stdin", "+I- +O-", "- 800x600 > stdout PNG 8"),
        ("stdin by itself", "- +W9 +H8", "- 9x8 > stdin.png PNG 8"),
        (
            "modern",
            "@/s.pov --size 320x240 -o @/o.jpg --threads 3",
            "s.pov 320x240 > o.jpg JPEG 8",
        ),
        (
            "later wins",
            "--size 320x240 +W100 @/s.pov",
            "s.pov 100x240 > s.png PNG 8",
        ),
    ] {
        let arguments: Vec<String> = arguments.split(' ').map(|a| a.replace('@', &at)).collect();
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        assert_eq!(
            summary(&settings(&arguments), here.path()),
            expected,
            "{client}"
        );
    }
}

#[test]
fn an_ini_file_of_ase_is_read() {
    let here = folder(&[("X.pov", "")]);
    let ini = here.path().join("X.ini");
    let text = format!(
        "Input_File_Name={}\nOutput_To_File=True\nOutput_File_Type=N\nOutput_Alpha=on\n; if you adjust Height, and width, you must preserve the ratio\n; Width / Height = 1.175752\nWidth=220\nHeight=187.12603122169838\nAntialias=False\nAntialias_Threshold=0.1\nDisplay=False\nDisplay_Gamma=sRGB\nPause_When_Done=True\nVerbose=False\n",
        here.path().join("X.pov").display()
    );
    fs::write(&ini, text).unwrap();
    let settings = settings(&[ini.to_str().unwrap()]);
    assert_eq!(
        summary(&settings, here.path()),
        "X.pov 220x187 > X.png PNG 8 alpha"
    );
}

#[test]
fn an_ini_file_of_blender_is_read() {
    let here = folder(&[("b4.pov", "")]);
    let ini = here.path().join("b.ini");
    let text = format!(
        "Version=3.7\r\nAll_File=1\r\nInput_File_Name='{at}/b4.pov'\r\nOutput_File_Name='{at}/b4.png'\r\nWidth=40\r\nHeight=30\r\nStart_Column=0.25\r\nEnd_Column=0.75\r\nStart_Row= 0.1\r\nEnd_Row=0.9\r\nBounding_Method=2\r\nDisplay=1\r\nPause_When_Done=0\r\nOutput_File_Type=N\r\nAntialias=off\r\nAntialias_Gamma=2.5\r\nJitter=off\r\nOutput_Alpha=1\r\n",
        at = here.path().display()
    );
    fs::write(&ini, text).unwrap();
    let settings = settings(&[ini.to_str().unwrap(), "-d"]);
    assert_eq!(
        summary(&settings, here.path()),
        "b4.pov 40x30 > b4.png PNG 8 alpha"
    );
    assert_eq!(
        (settings.render.columns, settings.render.rows),
        (10..30, 3..26)
    );
    assert_eq!(settings.read.version, Some(3.7));
    assert_eq!(
        settings.notes,
        ["povr: note: `Bounding_Method=2` has no effect here"]
    );
    assert_eq!(
        settings.streams,
        [(Stream::All, PathBuf::from("alltext.out"))]
    );
}

#[test]
fn ini_files_have_sections_switches_and_further_files() {
    let here = folder(&[
        ("s.pov", ""),
        ("n.ini", "Height=31\n"),
        (
            "z.ini",
            "+W8 Height=7 ; both\n@/s.pov\n@/n.ini\n[Big]\nWidth = 20\n[sm]\n  Width\t=\t4\n",
        ),
    ]);
    let at = here.path().to_str().unwrap();
    let ini = here.path().join("z.ini");
    fs::write(&ini, fs::read_to_string(&ini).unwrap().replace('@', at)).unwrap();
    for (word, width) in [
        ("z.ini", 8),
        ("z", 8),
        ("z.ini[big]", 20),
        ("z[SM]", 4),
        ("z.ini[none]", 8),
    ] {
        let settings = settings(&[&format!("{at}/{word}")]);
        assert_eq!(
            (settings.read.width, settings.read.height),
            (width, 31),
            "{word}"
        );
    }
    let library = format!("+L{at}");
    assert_eq!(settings(&[&library, "z[big]", "+W5"]).read.width, 5);
    assert_eq!(settings(&["+W5", &library, "z[big]"]).read.width, 20);
}

#[test]
fn ini_files_that_name_themselves_are_refused() {
    let here = folder(&[("z.ini", "")]);
    let ini = here.path().join("z.ini").display().to_string();
    fs::write(&ini, format!("Include_Ini={ini}\n")).unwrap();
    assert_eq!(
        refusal(&[&ini]),
        format!("`{ini}` line 1: ini files name each other more than 16 deep, the last is `{ini}`")
    );
}

#[test]
fn a_refusal_in_an_ini_file_names_the_line() {
    let here = folder(&[("z.ini", "Width=3\n\nFoo=1\n")]);
    let ini = here.path().join("z.ini").display().to_string();
    assert_eq!(
        refusal(&[&ini]),
        format!(
            "`{ini}` line 3: unknown option `Foo`\n  hint: `povr --help` tells which options there are."
        )
    );
}

#[test]
fn refusals_say_what_is_wrong_and_what_to_do() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let stem = here.path().join("s").display().to_string();
    for (arguments, expected) in [
        (vec![], "no scene is named\n  hint: Write `povr scene.pov`, or `povr --help`.".to_owned()),
        (vec!["+Zz"], "unknown switch `+Zz`\n  hint: `povr --help` tells which switches there are.".to_owned()),
        (vec!["-nosuch"], "unknown switch `-nosuch`\n  hint: `povr --help` tells which switches there are.".to_owned()),
        (vec!["+W"], "`+W` needs a value\n  hint: Write it after the switch without a space, like `+W320`.".to_owned()),
        (vec!["Width=abc"], "`Width=abc` needs a number, found `abc`".to_owned()),
        (vec!["Width="], "`Width=` needs a number, found nothing".to_owned()),
        (vec!["+W20x"], "`+W20x` needs a number, found `20x`".to_owned()),
        (vec!["+W0"], "`+W0` needs a size from 1 to 1048576 pixels".to_owned()),
        (vec!["+H-5"], "`+H-5` needs a size from 1 to 1048576 pixels".to_owned()),
        (vec!["+W100000", "+H100000", &scene], "a picture of 100000 by 100000 pixels is too large: the most is 536870912 pixels".to_owned()),
        (vec!["+FX"], "`+FX` names no file type\n  hint: N is PNG, T is TGA, C is compressed TGA, B is BMP, P is PPM, J is JPEG, E is EXR, H is HDR; N16 has 16 bits, Ng is grey.".to_owned()),
        (vec!["+FTg"], "`+FTg` names no file type\n  hint: N is PNG, T is TGA, C is compressed TGA, B is BMP, P is PPM, J is JPEG, E is EXR, H is HDR; N16 has 16 bits, Ng is grey.".to_owned()),
        (vec!["File_Gamma=bt601"], "`File_Gamma=bt601` needs `sRGB`, `BT709`, `BT2020` or a number greater than 0, found `bt601`".to_owned()),
        (vec![&scene, "+AM5"], "`+AM5`: there is no sampling method 5; there are 1 to 4\n  hint: 4 samples until the error is small, see `--error`.".to_owned()),
        (vec![&scene, "+KFF3", "+UO"], "`+UO`: rendering of fields is not supported yet\n  hint: Use `-UO` (or `Odd_Field=off`).".to_owned()),
        (vec![&scene, "+KFF3", "Field_Render=on"], "`Field_Render=on`: rendering of fields is not supported yet\n  hint: Use `-UF` (or `Field_Render=off`).".to_owned()),
        (vec![&scene, "Clockless_Animation=on"], "`Clockless_Animation=on`: animation by several cameras is not supported yet\n  hint: Leave `Clockless_Animation` out and move one camera with `clock`.".to_owned()),
        (vec![&scene, "+C", "+KFF3"], "`+C`: continuing an animation is not supported yet\n  hint: Draw the frames that are missing: `+SF` is the first, `+EF` the last.".to_owned()),
        (vec![&stem], format!("no scene, ini file or command named `{stem}`; did you mean `{scene}`?")),
        (vec!["/none.pov"], "cannot find the scene `/none.pov`\n  hint: Looked in the current folder.".to_owned()),
        (vec![&scene, "-o", "a.xyz"], "no file type has the ending `.xyz` of `a.xyz`\n  hint: End the name in .png, .jpg, .ppm, .tga, .bmp, .exr or .hdr, or choose a type with `+F`.".to_owned()),
    ] {
        assert_eq!(refusal(&arguments), expected, "{arguments:?}");
    }
    assert!(refusal(&["--size", "3"]).starts_with("`--size 3`: a size is written like 320x240"));
    assert_eq!(
        refusal(&["wacth", &scene]),
        "no scene, ini file or command named `wacth`; did you mean `povr watch`?"
    );
    assert_eq!(
        refusal(&["--serve", &scene]),
        "`--serve` is an option of `povr watch`"
    );
    let near = here.path().join("s.ini").display().to_string();
    assert_eq!(refusal(&[&near]), format!("no ini file named `{near}`"));
}

#[test]
fn a_request_for_an_unbuilt_feature_can_be_withdrawn() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    settings(&[&scene, "+UF", "+UO", "-UO", "-UF"]);
    assert!(refusal(&[&scene, "-UF", "Field_Render=on"]).starts_with("`Field_Render=on`: "));
}

#[test]
fn antialiasing_is_set_by_switches_and_by_ini_words() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let how = |more: &[&str]| {
        let arguments: Vec<&str> = std::iter::once(scene.as_str())
            .chain(more.iter().copied())
            .collect();
        settings(&arguments).render.sampling
    };
    assert_eq!(how(&[]), Sampling::Centres);
    assert_eq!(how(&["+A"]), Sampling::PovRay(Antialias::default()));
    assert_eq!(how(&["+A0.1", "-A"]), Sampling::Centres);
    let fine = Antialias {
        method: Method::Three,
        threshold: 0.1,
        confidence: 0.95,
        depth: 5,
        jitter: 0.5,
        gamma: 1.5,
    };
    assert_eq!(
        how(&["+A0.1", "+AM3", "+AC0.95", "+R5", "+J0.5", "+AG1.5"]),
        Sampling::PovRay(fine)
    );
    let words = [
        "Antialias=on",
        "Antialias_Threshold=0.1",
        "Sampling_Method=3",
        "Antialias_Confidence=0.95",
        "Antialias_Depth=5",
    ];
    let more = ["Jitter_Amount=0.5", "Antialias_Gamma=1.5"];
    assert_eq!(
        how(&[&words[..], &more[..]].concat()),
        Sampling::PovRay(fine)
    );
    let still = Antialias {
        jitter: 0.0,
        ..Antialias::default()
    };
    assert_eq!(how(&["+A", "-J"]), Sampling::PovRay(still));
    let deepest = Antialias {
        depth: 9,
        ..Antialias::default()
    };
    assert_eq!(how(&["+A", "+R20"]), Sampling::PovRay(deepest));
}

#[test]
fn the_language_gets_its_clock_declares_and_folders() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let read = settings(&[
        &scene,
        "+K0.5",
        "Declare=A=2",
        "+La",
        "Library_Path=\"b c\"",
        "+HIh.inc",
        "+MV3.6",
    ])
    .read;
    assert_eq!(
        (read.clock, read.clock_on, read.frame_number),
        (0.5, true, 0)
    );
    assert_eq!(read.declares, [("A".to_owned(), 2.0)]);
    assert_eq!(read.library_paths, [Path::new("a"), Path::new("b c")]);
    assert_eq!(read.include_header.as_deref(), Some(Path::new("h.inc")));
    assert_eq!(read.version, Some(3.6));
    assert!(!settings(&[&scene]).read.clock_on);
}

#[test]
fn the_system_gives_folders_and_the_user_settings() {
    let here = folder(&[
        (
            "system.ini",
            "Width=1\nDisplay=On\nVerbose=On\nLibrary_Path=/lib\n",
        ),
        ("user.ini", "Width=33\nLibrary_Path=/mine\n"),
        ("s.pov", ""),
    ]);
    let environment = Environment {
        system_ini: Some(here.path().join("system.ini")),
        user_ini: Some(here.path().join("user.ini")),
        ..Environment::default()
    };
    let scene = here.path().join("s.pov").display().to_string();
    let Ok(Request::Draw(settings)) = request(&[scene, "+La".to_owned()], &environment) else {
        panic!("a scene is named");
    };
    assert_eq!(settings.read.width, 33);
    assert!(!settings.verbosity.verbose);
    assert_eq!(
        settings.read.library_paths,
        ["/mine", "a", "/lib"].map(PathBuf::from)
    );
    assert_eq!(settings.read.library_paths_of_3_8, Vec::<PathBuf>::new());
}

#[test]
fn scenes_of_3_8_have_the_folders_of_3_8_before_the_standard_ones() {
    let here = folder(&[
        ("etc/3.7/povray.ini", "Library_Path=/lib37\n"),
        ("etc/3.8/povray.ini", "Library_Path=/lib38\n"),
        ("s.pov", ""),
    ]);
    let environment = Environment {
        system_ini: Some(here.path().join("etc/3.7/povray.ini")),
        ..Environment::default()
    };
    let scene = here.path().join("s.pov").display().to_string();
    let arguments = [scene, "+La".to_owned(), "Library_Path_38=/own".to_owned()];
    let Ok(Request::Draw(settings)) = request(&arguments, &environment) else {
        panic!("a scene is named");
    };
    let paths = |names: &[&str]| names.iter().map(PathBuf::from).collect::<Vec<_>>();
    assert_eq!(settings.read.library_paths, paths(&["a", "/lib37"]));
    assert_eq!(
        settings.read.library_paths_of_3_8,
        paths(&["a", "/own", "/lib38", "/lib37"])
    );
}

#[test]
fn doubtful_values_are_named() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let settings = settings(&[&scene, "Output_Alpha=maybe", "+FJ", "+UA"]);
    assert_eq!(
        settings.warnings,
        [
            "povr: warning: `Output_Alpha=maybe` is taken for off: `maybe` is neither on nor off",
            "povr: warning: jpg files have no alpha channel: it is left out"
        ]
    );
}

#[test]
fn a_scene_behind_two_dashes_may_have_any_name() {
    let here = folder(&[("+W9.txt", "")]);
    let scene = here.path().join("+W9.txt").display().to_string();
    let settings = settings(&["+W7", "--", &scene]);
    assert_eq!(
        summary(&settings, here.path()),
        "+W9.txt 7x600 > +W9.png PNG 8"
    );
}

#[test]
fn the_output_of_the_short_option_is_that_very_file() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let at = here.path().to_str().unwrap();
    for (arguments, expected) in [
        (vec!["-o", "q.PNG"], "q.PNG PNG 8"),
        (vec!["-o", "q"], "q.png PNG 8"),
        (vec!["--output=q.exr"], "q.exr EXR 16"),
        (vec!["-o", "q.xyz", "+FJ"], "q.xyz JPEG 8"),
        (vec!["-o", "-"], "stdout PNG 8"),
        (vec!["-o", at], "s.png PNG 8"),
        (vec!["-o", "sub/"], "sub/s.png PNG 8"),
        (vec!["-F", "-o", "q.png"], "q.png PNG 8"),
        (vec!["-o", "q.png", "-F"], "nowhere"),
    ] {
        let arguments = [arguments, vec![&scene]].concat();
        let result = summary(&settings(&arguments), here.path());
        assert_eq!(
            result,
            format!("s.pov 800x600 > {expected}"),
            "{arguments:?}"
        );
    }
}

#[test]
fn quality_of_files_and_gamma_reach_the_encoder() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let (_, options) = file_of(&settings(&[
        &scene,
        "+FJ",
        "Compression=40",
        "File_Gamma=1.0",
    ]));
    assert_eq!((options.quality, options.file_gamma), (40, Gamma::LINEAR));
    let (_, options) = file_of(&settings(&[&scene, "+FN16", "+FN"]));
    assert_eq!((options.format, options.bits), (Format::PNG, 8));
    let (_, options) = file_of(&settings(&[&scene, "Bits_Per_Color=16", "File_Gamma=sRGB"]));
    assert_eq!((options.bits, options.file_gamma), (16, Gamma::Srgb));
}

#[test]
fn dithering_has_a_default_method_in_each_version() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let of = |arguments: &[&str]| {
        let (_, options) = file_of(&settings(&[&[scene.as_str()][..], arguments].concat()));
        [Rounding::Encoded, Rounding::Working]
            .map(|rounding| options.for_scene(Some(Gamma::LINEAR), rounding).dither)
    };
    let both = |method| [Some(method); 2];
    let defaults = [
        Some(DitherMethod::FloydSteinberg),
        Some(DitherMethod::BlueNoise),
    ];
    assert_eq!(of(&["+TH"]), defaults);
    assert_eq!(of(&["Dither=on"]), defaults);
    assert_eq!(of(&["+THb3"]), both(DitherMethod::Bayer3));
    assert_eq!(of(&["+TH", "Dither_Method=ST"]), both(DitherMethod::Stucki));
    assert_eq!(of(&["Dither_Method=ST"]), [None; 2]);
    assert_eq!(of(&["+THST", "-TH"]), [None; 2]);
}

/// Measured by the files of POV-Ray 3.8.
#[test]
fn files_of_scenes_of_3_8_differ_in_bits_gamma_and_form() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let of = |arguments: &[&str]| {
        let (_, options) = file_of(&settings(&[&[scene.as_str()][..], arguments].concat()));
        let options = options.for_scene(Some(Gamma::LINEAR), Rounding::Working);
        (options.bits, options.file_gamma, options.is_plain)
    };
    assert_eq!(of(&["+FNg"]), (8, Gamma::Srgb, false));
    assert_eq!(of(&["+FNg16"]), (16, Gamma::Srgb, false));
    assert_eq!(of(&["+FP"]), (8, Gamma::Bt709, false));
    let power = Gamma::power(2.2);
    assert_eq!(of(&["+FP", "File_Gamma=2.2"]), (8, power, false));
    assert_eq!(of(&["+FPg", "File_Gamma=2.2"]), (8, Gamma::LINEAR, false));
    assert_eq!(of(&["+FP16", "Compression=0"]), (16, Gamma::Bt709, true));
}

#[test]
fn help_fits_terminals_of_80_100_and_120_columns() {
    let commands = COMMANDS.iter().map(|command| (command.options)());
    for command in commands.chain([LongOptions::command()]) {
        for width in [80, 100, 120] {
            let help = command.clone().term_width(width).render_long_help();
            for line in help.to_string().lines() {
                assert!(line.chars().count() <= width, "{width}: {line}");
            }
        }
        for option in command.get_arguments() {
            let help = option.get_help().map(ToString::to_string);
            let is_broken = help.is_some_and(|help| help.contains('\n'));
            assert!(!is_broken, "{option}: clap breaks lines where they end");
        }
    }
}

#[test]
fn help_and_version_are_texts() {
    let text = |argument: &str| match request(&[argument.to_owned()], &Environment::default()) {
        Ok(Request::Print(text)) => text,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        text("--version").trim_end(),
        format!("povr {}", env!("CARGO_PKG_VERSION"))
    );
    for argument in ["--help", "-h", "-help"] {
        let help = text(argument);
        assert!(help.contains("--size") && help.contains("+FN16"), "{help}");
        assert!(help.lines().count() < 70, "short is a screen");
    }
}

/// The settings of a scene in a temporary folder, and the result of running them with a small film.
fn carried_out(extra: &[&str], draw: &Draw) -> (tempfile::TempDir, Result<ExitCode, CliError>) {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let arguments = [extra, &[scene.as_str(), "+W4", "+H3", "-GA"]].concat();
    let done = carry_out(&settings(&arguments), draw);
    (here, done)
}

fn white(read: &ReadOptions, alpha: bool) -> Picture {
    let mut film = Film::whole(read.width, read.height);
    film.pixels.fill(Pixel {
        rgb: crate::base::color::Rgb::WHITE,
        transmit: if alpha { 0.5 } else { 0.0 },
    });
    Picture {
        film,
        working: Some(Gamma::LINEAR),
        rounding: crate::base::encoding::Rounding::default(),
        statistics: crate::base::options::Statistics::default(),
    }
}

#[test]
fn a_drawn_scene_becomes_a_file() {
    let (here, done) = carried_out(&["+UA"], &|input, read, render, listen| {
        assert!(matches!(input, Input::File(path) if path.ends_with("s.pov")));
        listen(Event::Drawn(u64::from(render.width * render.height)));
        Ok(white(read, render.alpha))
    });
    assert_eq!(done, Ok(ExitCode::SUCCESS));
    let image = image::open(here.path().join("s.png")).expect("a picture");
    assert_eq!((image.width(), image.height()), (4, 3));
    assert!(image.color().has_alpha());
}

#[test]
fn a_failed_drawing_leaves_no_file() {
    let (here, done) = carried_out(&[], &|_, _, _, _| Err(Failure { errors: Vec::new() }));
    assert_eq!(done, Ok(ExitCode::FAILURE));
    assert!(!here.path().join("s.png").exists());
}

#[test]
fn a_folder_that_is_not_there_is_named_with_a_remedy() {
    let (_here, done) = carried_out(&["+O/none/x.png"], &|_, read, _, _| Ok(white(read, false)));
    assert_eq!(
        done.map_err(|refusal| refusal.to_string()),
        Err(
            "cannot write `/none/x.png`: no such file or directory\n  hint: The folder `/none` does not exist: create it, or name another file with `+O`.".to_owned()
        )
    );
}

#[test]
fn an_error_or_a_time_chooses_the_method_that_converges() {
    let here = folder(&[("s.pov", "")]);
    let scene = here.path().join("s.pov").display().to_string();
    let how = |more: &[&str]| {
        let arguments = [&[scene.as_str()], more].concat();
        settings(&arguments).render.sampling
    };
    let converging = |error, seconds: Option<u64>| {
        Sampling::Adaptive(Adaptive {
            error,
            time: seconds.map(Duration::from_secs),
        })
    };
    for (arguments, expected) in [
        (vec!["+AM4"], converging(1.0, None)),
        (vec!["--error", "0.5"], converging(0.5, None)),
        (vec!["Antialias_Error=0.5"], converging(0.5, None)),
        (vec!["--time=2m"], converging(0.0, Some(120))),
        (
            vec!["Antialias_Time=3s", "--error", "2"],
            converging(2.0, Some(3)),
        ),
        (
            vec!["--error", "2", "+A0.3", "+AM1"],
            Sampling::PovRay(Antialias::default()),
        ),
        (vec!["--error", "2", "-A"], Sampling::Centres),
    ] {
        assert_eq!(how(&arguments), expected, "{arguments:?}");
    }
}
