use super::*;
use crate::base::math::Ray;
use crate::base::math::sampling::random::Random;
use crate::base::options::{ReadOptions, RenderOptions};
use crate::base::source::Sources;
use crate::scene::shape::{Crossing, Geometry, Shape, Start};
use crate::world::{Leaf, compile};

#[test]
fn every_primitive_has_a_sheet() {
    for word in Shape::WORDS {
        let name = word.to_string();
        let sample = SHAPES.iter().find(|sample| sample.name == name);
        let sample = sample.unwrap_or_else(|| panic!("`{name}` is missing"));
        assert!(sample.text.starts_with(&name));
    }
}

/// The primitives of an object.
fn leaves(object: &str) -> Vec<Leaf> {
    let mut sources = Sources::new(Vec::new());
    let file = sources.add_text("sheet.pov", format!("#version 3.8;\n{object}"));
    let reading = crate::lang::evaluate(file, &mut sources, &ReadOptions::default());
    let scene = reading
        .scene
        .unwrap_or_else(|| panic!("{object}: {:?}", reading.findings));
    compile(scene, &RenderOptions::default()).leaves().to_vec()
}

/// Shorter spans are ignored: the roots of some surfaces have limited accuracy.
const SHORTEST: f64 = 0.02;

/// Counts how often the inside test agrees with the roots of random rays, and how often not.
fn agreement(leaf: &Leaf, rng: &mut Random) -> (u32, u32) {
    let (mut right, mut wrong) = (0, 0);
    for _ in 0..300 {
        let origin = 4.0 * rng.vector(1.0).normalize();
        let ray = Ray::new(origin, (rng.vector(1.0) - origin).normalize());
        let mut roots = Vec::new();
        let mut is_inside = leaf.roots(&ray, &mut roots) == Start::Inside;
        let mut from = -10.0;
        let end = roots.last().map_or(0.0, |root| root.t) + 1.0;
        let hits = roots.iter().map(|root| (root.t, root.crossing));
        for (to, crossing) in hits.chain([(end, Crossing::Touch)]) {
            if to - from > SHORTEST {
                let agrees = leaf.contains(ray.at(0.5 * (from + to))) == is_inside;
                *(if agrees { &mut right } else { &mut wrong }) += 1;
            }
            match crossing {
                Crossing::Enter => is_inside = true,
                Crossing::Leave => is_inside = false,
                Crossing::Touch => {}
            }
            from = to;
        }
    }
    (right, wrong)
}

#[test]
fn the_inside_test_of_every_solid_agrees_with_its_hits() {
    let mut rng = Random::new(5);
    // Shapes that read files, an image or a font, are tested in their own modules.
    let reads_files = |sample: &&shapes::Sample| ["height_field", "text"].contains(&sample.name);
    let alone = SHAPES.iter().filter(|sample| !reads_files(sample));
    for sample in alone {
        let moved = format!(
            "object {{ {} scale <1.3, 0.8, 1> rotate <20, 30, 40> translate 0.2 }}",
            sample.text
        );
        for text in [sample.text, &moved] {
            for leaf in leaves(text).iter().filter(|leaf| leaf.shape.is_solid()) {
                let (right, wrong) = agreement(leaf, &mut rng);
                // The steps of a march through a fractal are longer than its thinnest parts.
                let most = if matches!(leaf.shape, Shape::JuliaFractal(_)) {
                    right / 50
                } else {
                    0
                };
                assert!(right > 300 && wrong <= most, "{text}: {right} {wrong}");
            }
        }
    }
}
