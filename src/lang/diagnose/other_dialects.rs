//! Words of other programs and languages that people write into scenes, and their equivalents in the scene language.

/// The equivalent of a foreign word.
#[derive(Debug, PartialEq)]
pub(crate) struct Meant {
    /// A sentence that names it.
    pub(crate) hint: String,
    /// The word to write instead, if it is one.
    pub(crate) word: Option<&'static str>,
}

/// The equivalent of a foreign word; case and `_` are ignored.
///
/// `is_value` is true in expressions, where other words are meant than in a block.
pub(crate) fn translated(name: &str, is_value: bool) -> Option<Meant> {
    let instead = equivalent(name, if is_value { VALUES } else { WORDS })?;
    Some(if instead.contains(' ') {
        Meant {
            hint: format!("{instead}."),
            word: None,
        }
    } else {
        Meant {
            hint: format!("The scene language says `{instead}`."),
            word: Some(instead),
        }
    })
}

/// The directive that is meant by a foreign one, written without `#`.
pub(crate) fn directive(name: &str) -> Option<&'static str> {
    equivalent(name, WORDS).filter(|instead| instead.starts_with('#'))
}

fn equivalent(name: &str, words: &[(&str, &'static str)]) -> Option<&'static str> {
    let bare: String = name
        .chars()
        .filter(|&c| c != '_')
        .map(|c| c.to_ascii_lowercase())
        .collect();
    let is_it = |(words, _): &&(&str, &str)| words.split(' ').any(|word| word == bare);
    words.iter().find(is_it).map(|&(_, instead)| instead)
}

/// True for a word of HG-POV, a program with a larger language than POV-Ray's.
pub(crate) fn is_of_hg_povray(name: &str) -> bool {
    OF_HG_POVRAY
        .split_ascii_whitespace()
        .any(|word| word == name)
}

/// Words of HG-POV that public scenes use: shapes, files of meshes, patterns and splines, then projections of the
/// camera.
const OF_HG_POVRAY: &str = "akima_spline basic_x_spline bourke cristal cubicle extended_x_spline galley general_x_spline gts_load gts_save
    heller intermerge interunion masonry nurbs parsed_tokens rational_bezier_patch stl_save tcb_spline tesselation
    uv_reference voronoi
    aitoff_hammer balthasart behrmann eckert_iv eckert_vi edwards gall hobo_dyer icosa lambert_azimuthal mercator
    mollweide octa parallaxe peters smyth_craster stereo tetra van_der_grinten";

/// Foreign words in blocks and at the top level, and the word that is meant, or a sentence without its full stop.
const WORDS: &[(&str, &str)] = &[
    (
        "shininess shiny gloss glossy glossiness specularity",
        "A highlight is `phong 0.8 phong_size 40` or `specular 0.5 roughness 0.02`",
    ),
    ("smoothness", "roughness"),
    ("reflect reflective reflectivity mirror", "reflection"),
    ("emissive emit emits glow luminosity", "emission"),
    (
        "opacity transparency transparent translucent translucency",
        "Transparency belongs to the colour: `rgb <1, 0, 0> transmit 0.5`",
    ),
    (
        "refraction indexofrefraction refractiveindex",
        "`ior 1.5` in `interior { }` bends light",
    ),
    (
        "basecolor albedocolor diffusecolor",
        "A colour belongs in `pigment { }`",
    ),
    (
        "hsl hsv",
        "`colors.inc` has the macros `CHSL2RGB` and `CHSV2RGB` for such colours",
    ),
    (
        "inner",
        "A spotlight has `radius` and `falloff`, in degrees",
    ),
    (
        "bump bumpiness",
        "Bumps are a pattern: `normal { bumps 0.5 }`",
    ),
    (
        "intensity energy",
        "The brightness of a light is that of its colour: `rgb 2`",
    ),
    ("position pos origin eye", "location"),
    ("target lookto", "look_at"),
    ("fov fieldofview", "angle"),
    ("cube cuboid", "box"),
    ("ball globe", "sphere"),
    ("circle", "disc"),
    ("ring donut doughnut", "torus"),
    (
        "capsule pill",
        "`sphere_sweep { linear_spline 2, <end>, radius, <end>, radius }` has round ends",
    ),
    ("tube pipe rod", "cylinder"),
    (
        "pyramid",
        "`cone { }` is round; `prism { conic_sweep ... }` has corners",
    ),
    ("ground", "plane"),
    ("light lamp pointlight omnilight sun", "light_source"),
    (
        "directionallight",
        "`light_source { }` with `parallel` and `point_at` shines in one direction",
    ),
    ("spot", "spotlight"),
    ("arealight", "`area_light` belongs in `light_source { }`"),
    ("skybox skydome", "sky_sphere"),
    ("subtract subtraction minus", "difference"),
    ("intersect and", "intersection"),
    ("group add join combine", "union"),
    ("move moved translation shift", "translate"),
    ("rotation turn rotated", "rotate"),
    ("scaling resize scaled", "scale"),
    ("endif endwhile endfor endmacro endswitch fi done", "#end"),
    ("elsif elif elseif", "#elseif"),
    ("foreach repeat loop", "#for"),
    (
        "define let var const set float vector string double",
        "#declare",
    ),
    ("def func sub proc module procedure subroutine", "#macro"),
    ("import require use", "#include"),
    ("print printf echo log", "#debug"),
    (
        "then begin",
        "Remove it: the text after the `)` of a directive is what it decides about",
    ),
    (
        "return",
        "A macro returns what it writes last: `#macro Double(X) (2*X) #end`",
    ),
    ("deg degree", "Remove it: `rotate` takes degrees"),
];

/// The same in expressions.
const VALUES: &[(&str, &str)] = &[
    ("power", "pow"),
    ("length magnitude norm", "vlength"),
    ("dot dotproduct", "vdot"),
    ("cross crossproduct", "vcross"),
    ("normalize normalise unit", "vnormalize"),
    (
        "random rnd",
        "`rand(stream)` draws a number; `#declare stream = seed(1);` makes the stream",
    ),
    ("ceiling", "ceil"),
    ("math", "Functions have no prefix: write `sin(x)`"),
    ("round", "`int(value + 0.5)` rounds"),
    (
        "null none nil",
        "There is no empty value; `#undef` takes a name away, `#ifdef` asks for it",
    ),
];

#[cfg(test)]
mod tests {
    use super::translated;

    #[test]
    fn foreign_words_are_translated() {
        let hint = |name, is_value| Some(translated(name, is_value)?.hint);
        assert_eq!(
            hint("fieldOfView", false).as_deref(),
            Some("The scene language says `angle`.")
        );
        assert_eq!(
            hint("Shininess", false).as_deref(),
            Some("A highlight is `phong 0.8 phong_size 40` or `specular 0.5 roughness 0.02`.")
        );
        assert_eq!(translated("Chair", false), None);
        assert_eq!(translated("power", false), None);
        assert_eq!(
            hint("power", true).as_deref(),
            Some("The scene language says `pow`.")
        );
    }

    #[test]
    fn no_word_is_listed_twice() {
        let mut words: Vec<&str> = [super::WORDS, super::VALUES]
            .into_iter()
            .flatten()
            .flat_map(|(words, _)| words.split(' '))
            .collect();
        let count = words.len();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), count);
    }
}
