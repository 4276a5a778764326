//! The syntax of objects.

use crate::base::args::Word;
use crate::lang::reader::Reader;

impl Reader<'_> {
    /// The syntax of an object, for messages about a missing part.
    pub(crate) fn usage(word: Word) -> Option<&'static str> {
        Some(match word {
            Word::Sphere => "`sphere { <centre>, radius ... }`",
            Word::Box => "`box { <corner>, <opposite corner> ... }`",
            Word::Cylinder => "`cylinder { <end>, <other end>, radius ... }`",
            Word::Cone => "`cone { <end>, radius, <other end>, radius ... }`",
            Word::Plane => "`plane { <normal>, distance ... }`",
            Word::Disc => "`disc { <centre>, <normal>, radius [, hole] ... }`",
            Word::Torus => "`torus { major, minor ... }`",
            Word::Quadric => "`quadric { <A, B, C>, <D, E, F>, <G, H, I>, J ... }`",
            Word::Blob => "`blob { threshold value sphere { <centre>, radius, strength } ... }`",
            Word::Superellipsoid => "`superellipsoid { <e, n> ... }`",
            Word::Prism => "`prism { height, other height, number of points, <x, z>, ... }`",
            Word::Lathe => "`lathe { number of points, <r, y>, ... }`",
            Word::Sor => "`sor { number of points, <r, y>, ... }`",
            Word::Polygon => "`polygon { number of points, <point>, ... }`",
            Word::Poly => "`poly { order, <coefficients> ... }`",
            Word::Polynomial => "`polynomial { order, xyz(2, 0, 0): coefficient, ... }`",
            Word::Cubic => "`cubic { <20 coefficients> ... }`",
            Word::Quartic => "`quartic { <35 coefficients> ... }`",
            Word::Lemon => "`lemon { <base>, base radius, <apex>, apex radius, inner radius ... }`",
            Word::Ovus => "`ovus { bottom radius, top radius ... }`",
            Word::Triangle => "`triangle { <corner>, <corner>, <corner> ... }`",
            Word::SmoothTriangle => {
                "`smooth_triangle { <corner>, <normal>, <corner>, <normal>, <corner>, <normal> ... }`"
            }
            Word::Text => "`text { ttf \"cyrvetic.ttf\" \"words\" thickness, <offset> ... }`",
            Word::LightSource => "`light_source { <location>, colour ... }`",
            _ => return None,
        })
    }
}
