//! The items of the catalogue: their subjects, and the reasons for POV-Ray's errors.

/// The subject of each item, from item 1 on.
pub(crate) const ITEMS: [&str; 54] = [
    "thin tori close up",
    "tori from far away",
    "horn and spindle tori",
    "torus edge-on",
    "rays that touch the top circle of a torus",
    "rays along axes and in the plane of a torus",
    "rays through the axis of a torus",
    "tori of tiny and huge radii",
    "stretched, sheared and mirrored tori",
    "sphere as a floor, with objects on it",
    "tiny spheres, and spheres from far away",
    "narrow and wide angles of the camera",
    "a room with every length times 10^k",
    "a room moved by 10^k",
    "quadric and sphere far from the origin",
    "a thousand turns, a thousand nested objects",
    "flat ellipsoids",
    "membranes left by a difference",
    "front faces that coincide",
    "back faces that coincide",
    "intersection of a solid with itself",
    "difference of a solid and itself",
    "cylinders with the same caps",
    "merge of glass solids that touch",
    "merge of stacked glass cylinders",
    "deep differences",
    "deep unions in differences",
    "a crowd cut by a box",
    "scale 0, singular matrices",
    "numbers that are none",
    "odd numbers in every primitive, camera and light",
    "bodies without thickness",
    "empty combinations, and of one child",
    "camera inside and on solids",
    "cameras without a direction",
    "lights in, on and far from things",
    "clear plate above a floor",
    "opaque plate above a floor",
    "slabs and shells",
    "glass shells against none",
    "the critical angle",
    "facing mirrors",
    "cones that are almost cylinders",
    "long and wide cylinders",
    "tiny boxes",
    "terminator of a sphere",
    "terminator and shadow of a torus",
    "rays that graze a sphere",
    "horizons",
    "polynomials of small and large coefficients",
    "superellipsoid, blob, lathe, sor at their limits",
    "slivers and shared edges of meshes and height fields",
    "bounded_by and clipped_by",
    "every length times 10^-300 to 10^150",
];

/// The reason for POV-Ray's errors, by item, where it is known.
pub(crate) fn why(item: u8) -> &'static str {
    match item {
        1 | 2 | 8 => {
            "a hit must be 1e-4 away; roots of the quartic are compared with fixed numbers"
        }
        11 | 12 | 45 => {
            "half chords below 1e-5, boxes thinner than 1e-6 and depths beyond 1e7 do not exist"
        }
        9 | 17 => "depths are compared in units of the object",
        10 | 46 | 47 => "a shadow's cause must be 1e-3 away",
        13 | 54 => "1e-4, 1e-3, 1e7 are lengths of the scene",
        14 | 15 => "boxes in single precision; translations multiplied into coefficients",
        19..=25 | 53 => {
            "points of a face are asked whether they are inside the other face: rounding decides"
        }
        26 | 27 => "one stack frame for each difference",
        36 => "a light's last 1e-3 casts no shadow; nothing is met beyond 1e7",
        37..=40 => "surfaces within 1e-4 (shadows: 1e-3) of the last one are skipped",
        43 | 44 => "1e-9 and 1e-10 in the solid's own space count as nothing",
        49 => "nothing is met beyond 1e7",
        50 | 51 => "coefficients and roots are compared with fixed numbers",
        52 => "a ray through an edge may miss both triangles",
        _ => "",
    }
}
