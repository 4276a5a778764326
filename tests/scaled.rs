//! Every scene of `pov_scenes/`, drawn in a unit of length larger or smaller by a power of two, gives the same picture
//! bit for bit: povr compares no length with a constant that the scene has not set.

mod support;

use glam::DVec3;
use libtest_mimic::{Arguments, Failed, Trial};
use povr::base::film::Film;
use povr::base::math::Normalization;
use povr::base::options::{ReadOptions, RenderOptions};
use povr::base::source::Sources;
use povr::lang::{Probe, Texts};
use povr::scene::{Object, Scene};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

const WIDTH: u32 = 48;
const HEIGHT: u32 = 36;

/// The powers for every scene; one more derives from its name.
const POWERS: [i32; 2] = [-60, 60];

/// Scenes with lengths that no transform reaches, with the reason. Drawn at 160x120 in a unit four times as large, each
/// of them changes in the same pixels in POV-Ray and in povr, which stay equal byte for byte.
const EXCEPT: &[(&str, &str)] = &[
    (
        "radiosity/",
        "rays that gather light do not meet what is nearer than 1/10000 of a unit, as in POV-Ray: that decides which samples \
         are kept",
    ),
    (
        "texture/uv_at_the_object",
        "transforms of what holds an object move textures by its coordinates within these, as in POV-Ray",
    ),
    (
        "shape/smooth_triangle_matrix",
        "a scale behind a matrix makes unit vectors of the normals, as in POV-Ray",
    ),
    (
        "normal/no_bump_scale",
        "bumps that do not keep their slope are flatter where they are larger, as in POV-Ray",
    ),
    (
        "finish/irid_turbulence",
        "the film's turbulence is that of the place in the world, as in POV-Ray",
    ),
    (
        "pattern/slope_altitude",
        "the range of heights is in units of the world, as in POV-Ray",
    ),
    (
        "pattern/slope_waves",
        "the range of heights is in units of the world, as in POV-Ray",
    ),
    ("version38/radiosity_", "as the other scenes with radiosity"),
    (
        "version38/fade_default",
        "without a distance light fades by the units of the world, as in POV-Ray",
    ),
    (
        "version38/fade_inverse",
        "without a distance light fades by the units of the world, as in POV-Ray",
    ),
];

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let trials = match support::scenes(Path::new(support::SCENES)) {
        Ok(scenes) => scenes.into_iter().map(trial).collect(),
        Err(error) => vec![Trial::test("pov_scenes", move || Err(error.into()))],
    };
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn trial(path: PathBuf) -> Trial {
    let relative = path.strip_prefix(support::SCENES).unwrap_or(&path);
    let name = relative.with_extension("").display().to_string();
    let is_left_out = EXCEPT.iter().any(|(scene, _)| name.starts_with(scene));
    let shown = name.clone();
    Trial::test(shown, move || check(&path, &name)).with_ignored_flag(is_left_out)
}

fn check(path: &Path, name: &str) -> Result<(), Failed> {
    // Scenes for messages and for switches may have no picture.
    let Some(scene) = read(path) else {
        return Ok(());
    };
    let expected = drawn(scene.clone());
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    let own = i32::try_from(hasher.finish() % 119).unwrap_or(0) - 59;
    for power in POWERS.into_iter().chain([own]) {
        let film = drawn(scene.clone().scaled(2f64.powi(power)));
        let pairs = expected.pixels.iter().zip(&film.pixels);
        let differing = pairs.filter(|(a, b)| bits(a) != bits(b)).count();
        if differing > 0 {
            return Err(format!("{differing} pixels differ at 2^{power}").into());
        }
    }
    Ok(())
}

fn bits(pixel: &povr::base::film::Pixel) -> [u32; 4] {
    let rgb = pixel.rgb;
    [rgb.r, rgb.g, rgb.b, pixel.transmit].map(f32::to_bits)
}

fn drawn(scene: Scene) -> Film {
    let options = RenderOptions {
        width: WIDTH,
        height: HEIGHT,
        columns: 0..WIDTH,
        rows: 0..HEIGHT,
        ..RenderOptions::default()
    };
    let world = povr::world::compile(scene, &options);
    povr::render::render(&world, &options, povr::render::Earlier::default(), &|_| {}).film
}

/// Objects of the scene, for scenes that trace rays while they are read.
#[derive(Default)]
struct OwnObjects(povr::world::ProbeModel);

impl Probe for OwnObjects {
    fn trace(
        &mut self,
        object: &Arc<Object>,
        from: DVec3,
        dir: DVec3,
        normalization: Normalization,
    ) -> Option<(DVec3, DVec3)> {
        self.0.trace(object, from, dir, normalization)
    }

    fn is_inside(&mut self, object: &Arc<Object>, point: DVec3) -> bool {
        self.0.is_inside(object, point)
    }
}

fn read(path: &Path) -> Option<Scene> {
    let mut library_paths = vec![PathBuf::from("/usr/share/povray-3.7/include")];
    library_paths.extend(path.parent().map(Path::to_owned));
    let options = ReadOptions {
        width: WIDTH,
        height: HEIGHT,
        library_paths: library_paths.clone(),
        ..ReadOptions::default()
    };
    let mut sources = Sources::new(library_paths);
    let file = sources.load_file(path).ok()?;
    let mut probe = OwnObjects::default();
    let texts = Texts {
        scene: file,
        sources: &mut sources,
        token_cache: None,
        literals: None,
    };
    povr::lang::evaluate_with(texts, &options, &mut probe, &mut |_| {}).scene
}
