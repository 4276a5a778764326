use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::tests::check;
use crate::scene::texture::Texture;

fn mesh(text: &str) -> Mesh {
    let mut args = TextArgs::new(text);
    let mesh = Mesh::read(&mut args).unwrap();
    assert!(args.is_done() && args.warnings().is_empty());
    mesh
}

fn mesh2(text: &str) -> Mesh {
    let mut args = TextArgs::new(text);
    let mesh = Mesh::read_mesh2(&mut args).unwrap();
    assert!(args.is_done());
    mesh
}

fn fault(text: &str) -> String {
    Mesh::read(&mut TextArgs::new(text)).unwrap_err().message
}

/// The error of a `mesh2`, and the text that its span covers.
fn fault2(text: &str) -> (String, &str) {
    let error = Mesh::read_mesh2(&mut TextArgs::new(text)).unwrap_err();
    let span = error.span.unwrap();
    (error.message, &text[span.start as usize..span.end as usize])
}

const TETRAHEDRON: &str = "vertex_vectors { 4, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,1> }";

/// A closed sphere-like mesh with dents, of `rows × columns` and two caps; no triangle is parallel to an axis.
fn dented_sphere(rows: u32, columns: u32, inside: &str) -> Mesh {
    let mut points = vec!["<0.01,1,0.02>".to_owned(), "<0,-1,0>".to_owned()];
    for i in 1..rows {
        for j in 0..columns {
            let (s, c) = (std::f64::consts::PI * f64::from(i) / f64::from(rows)).sin_cos();
            let (sin, cos) = (std::f64::consts::TAU * f64::from(j) / f64::from(columns)).sin_cos();
            let dent = if j % 5 == 0 { 0.6 } else { 1.0 };
            points.push(format!("<{},{},{}>", s * cos * dent, c, s * sin * dent));
        }
    }
    let at = |i: u32, j: u32| match i {
        0 => 0,
        i if i == rows => 1,
        i => 2 + (i - 1) * columns + j % columns,
    };
    let mut faces = Vec::new();
    for i in 0..rows {
        for j in 0..columns {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if i + 1 < rows {
                faces.push(format!("<{a},{b},{c}>"));
            }
            if i > 0 {
                faces.push(format!("<{a},{c},{d}>"));
            }
        }
    }
    mesh2(&format!(
        "vertex_vectors {{ {}, {} }} face_indices {{ {}, {} }} {inside}",
        points.len(),
        points.join(", "),
        faces.len(),
        faces.join(", ")
    ))
}

#[test]
fn a_mesh_without_an_inside_is_a_patch() {
    check::patch(&dented_sphere(7, 11, ""));
    check::patch(&mesh(
        "triangle { <1,2,3>, <-2,3,5>, <0.5,-1,2> } triangle { <1,2,3>, <-2,3,5>, <3,3,3> }",
    ));
}

#[test]
fn a_closed_mesh_with_an_inside_is_a_solid() {
    for inside in ["inside_vector <0,1,0>", "inside_vector <0.3,-0.2,5>"] {
        let sphere = dented_sphere(7, 11, inside);
        assert!(sphere.is_solid() && sphere.triangles.inside.unwrap().is_closed);
        solid(&sphere);
    }
}

/// As `check::solid`, but without the test of normals: those of a mesh follow the winding of its triangles as written.
fn solid(shape: &dyn Geometry) {
    let bounds = shape.bounds();
    let mut rng = check::Random::new(1);
    let mut hits = 0;
    for _ in 0..4000 {
        let ray = rng.ray_near(&bounds);
        let mut roots = Vec::new();
        assert_eq!(shape.roots(&ray, &mut roots), Start::Outside);
        assert!(roots.is_sorted_by(|a, b| a.t <= b.t));
        assert_eq!(roots.len() % 2, 0);
        hits += roots.len();
        let mut from = f64::NEG_INFINITY;
        for (i, root) in roots.iter().enumerate() {
            let expected = [Crossing::Enter, Crossing::Leave][i % 2];
            assert_eq!(root.crossing, expected);
            if root.t > from {
                assert_eq!(shape.nearest(&ray, from, f64::INFINITY), Some(*root));
                assert_eq!(shape.nearest(&ray, from, root.t), None);
            }
            from = root.t;
        }
        for (i, pair) in roots.windows(2).enumerate() {
            if pair[1].t - pair[0].t > 1e-9 {
                let middle = ray.at(0.5 * (pair[0].t + pair[1].t));
                assert_eq!(shape.contains(middle), i % 2 == 0);
            }
        }
    }
    assert!(hits > 500, "only {hits} hits");
}

#[test]
fn rays_through_corners_and_edges_cross_a_solid_an_even_number_of_times() {
    let sphere = dented_sphere(8, 10, "inside_vector <0,1,0>");
    let mut rng = check::Random::new(5);
    for at in 0..sphere.len() {
        let corners = sphere.triangles.corners(u32::try_from(at).unwrap());
        for target in [corners[0], corners[1].lerp(corners[2], 0.5)] {
            for origin in [rng.vector(3.0), target - 4.0 * DVec3::X, DVec3::ZERO] {
                let mut roots = Vec::new();
                sphere.roots(&Ray::new(origin, target - origin), &mut roots);
                assert_eq!(roots.len() % 2, 0, "{origin} to {target}: {roots:?}");
                assert!(roots.iter().all(|root| root.crossing != Crossing::Touch));
            }
        }
    }
}

#[test]
fn a_ray_misses_the_triangle_it_leaves_but_not_its_neighbours() {
    for inside in ["", "inside_vector <0,1,0>"] {
        let sphere = dented_sphere(7, 11, inside);
        let mut rng = check::Random::new(9);
        for _ in 0..2000 {
            let ray = rng.ray_near(&sphere.bounds());
            let Some(hit) = sphere.nearest(&ray, 0.0, f64::INFINITY) else {
                continue;
            };
            let on = Ray::new(ray.at(hit.t), ray.dir);
            let next = sphere.nearest_beside(&on, 0.0, f64::INFINITY, hit.face);
            let expected = sphere.nearest(&ray, hit.t, f64::INFINITY);
            assert_eq!(next.map(|next| next.face), expected.map(|next| next.face));
            assert_eq!(
                next.map(|next| next.crossing),
                expected.map(|next| next.crossing)
            );
        }
    }
}

#[test]
fn an_open_mesh_is_inside_only_between_its_surfaces() {
    // A roof without a floor: a ray from below crosses one triangle.
    let roof = mesh("triangle { <-1,1,-1>, <1,1,-1>, <0,0,1> } inside_vector <0,1,0>");
    assert!(roof.is_solid() && !roof.triangles.inside.unwrap().is_closed);
    let mut roots = Vec::new();
    roof.roots(&Ray::new(DVec3::new(0.0, 4.0, 0.0), -DVec3::Y), &mut roots);
    assert_eq!(roots.len(), 1);
    assert_eq!(roots[0].crossing, Crossing::Touch);
    let none = mesh("triangle { <-1,1,-1>, <1,1,-1>, <0,0,1> } inside_vector <0,0,0>");
    assert!(!none.is_solid());
}

#[test]
fn corners_are_single_precision_and_shared() {
    let pair =
        mesh("triangle { <0.1,0,0>, <1,0,0>, <0,1,0> } triangle { <0.1,0,0>, <-0,1,0>, <0,0,1> }");
    assert_eq!(pair.triangles.vertices.len(), 4);
    assert_eq!(pair.bounds().min, DVec3::ZERO);
    assert_eq!(pair.triangles.corners(0)[0].x, f64::from(0.1_f32));
}

#[test]
fn smooth_triangles_have_the_mean_of_the_normals() {
    let text = "smooth_triangle { <-1,-1,0>, <-1,0,-2>, <1,-1,0>, <1,0,-2>, <0,1,0>, <0,1,-1> }";
    let smooth = mesh(text);
    let normal = smooth
        .shading_normal(DVec3::new(0.0, -1.0, 0.0), 0)
        .unwrap();
    let expected = DVec3::new(0.0, 0.0, -2.0) / 5.0_f64.sqrt();
    assert!((normal - expected).length() < 1e-6);
    // Equal normals have no effect: POV-Ray shades such a triangle flat.
    let flat = mesh("smooth_triangle { <0,0,0>, <1,0,1>, <1,0,0>, <1,0,1>, <0,1,0>, <1,0,1> }");
    assert_eq!(flat.shading_normal(DVec3::ZERO, 0), None);
}

#[test]
fn mesh2_takes_normals_by_their_own_indices_or_those_of_the_corners() {
    let normals = "normal_vectors { 4, <-1,0,-1>, <1,0,-1>, <0,1,-1>, <0,0,-1> }";
    let by_corner = mesh2(&format!(
        "{TETRAHEDRON} {normals} face_indices {{ 1, <0,1,2> }}"
    ));
    let by_index = mesh2(&format!(
        "{TETRAHEDRON} {normals} face_indices {{ 1, <0,1,2> }} normal_indices {{ 1, <0,1,2> }}"
    ));
    assert_eq!(by_corner, by_index);
    // With fewer triples than triangles the rest are flat; indices are truncated.
    let partial = mesh2(&format!(
        "{TETRAHEDRON} {normals} face_indices {{ 2, <0,1,3>, <0.2,1.9,2> }} normal_indices {{ 1, <0,1,2> }}"
    ));
    assert_eq!(partial.triangles.smooth, [[0, 1, 2], FLAT]);
    assert_eq!(partial.triangles.corners, [[0, 1, 3], [0, 1, 2]]);
}

#[test]
fn degenerate_triangles_are_dropped_with_their_normals() {
    let normals = "normal_vectors { 3, <-1,0,-1>, <1,0,-1>, <0,1,-1> }";
    let mesh = mesh2(&format!(
        "{TETRAHEDRON} {normals} uv_vectors {{ 1, <0,0> }} face_indices {{ 3, <0,1,1>, <0,1,2>, <3,3,3> }}
        normal_indices {{ 3, <0,0,0>, <0,1,2>, <0,1,0> }} uv_indices {{ 3, <0,0,0>, <0,0,0>, <0,0,0> }}"
    ));
    assert_eq!(mesh.triangles.corners, [[0, 1, 2]]);
    assert_eq!(mesh.triangles.smooth, [[0, 1, 2]]);
    let none = mesh2(&format!("{TETRAHEDRON} face_indices {{ 1, <0,1,1> }}"));
    assert!(none.is_empty() && none.bounds().is_empty());
}

#[test]
fn a_normal_without_direction_is_warned_of() {
    let text = format!(
        "{TETRAHEDRON} normal_vectors {{ 4, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,0> }} face_indices {{ 1, <0,1,2> }}"
    );
    let mut args = TextArgs::new(&text);
    Mesh::read_mesh2(&mut args).unwrap();
    let messages = args.warnings();
    assert_eq!(
        messages,
        ["a normal of a mesh has no direction; it is taken as <1, 0, 0>"]
    );
}

#[test]
fn errors_of_mesh_name_the_fault() {
    assert_eq!(
        fault("inside_vector <0,1,0>"),
        "expected `triangle` or `smooth_triangle` in `mesh`, found the end of the text"
    );
    assert_eq!(
        fault("triangle { <0,0,0>, <1,1,1>, <2,2,2> }"),
        "all triangles of this mesh are degenerate: none is left to draw"
    );
    assert_eq!(
        fault("triangle { <0,0,0>, <1,1,1>, <2,2,nan> }"),
        "the corners and normals of a triangle must be finite, found <2, 2, NaN>"
    );
    assert_eq!(
        fault("triangle { <0,0,0>, <1,1,1>, <2,2,1e39> }"),
        "the corners of a mesh are stored in single precision: <2, 2, 1000000000000000000000000000000000000000> is too large"
    );
    assert_eq!(
        fault("triangle { <0,0,0>, <1,0,0>, <0,1,0> texture_list { T } }"),
        "expected the names of three textures in `texture_list`, found `T`"
    );
    assert_eq!(
        fault("triangle { <0,0,0>, <1,0,0>, <0,1,0>, <0,0,0> }"),
        "expected `}`, found `,`"
    );
}

#[test]
fn errors_of_mesh2_name_the_fault_and_its_location() {
    let two = "normal_vectors { 2, <0,0,1>, <0,1,0> }";
    for (text, message, location) in [
        (
            "face_indices { 1, <0,1,2> }".to_owned(),
            "expected `vertex_vectors` at the start of `mesh2`, found `face_indices`",
            "face_indices",
        ),
        (
            "vertex_vectors { 0 }".to_owned(),
            "a mesh needs at least one vertex",
            "vertex_vectors",
        ),
        (
            "vertex_vectors { -1 }".to_owned(),
            "the count of `vertex_vectors` must be zero or more, found -1",
            "-1",
        ),
        (
            "vertex_vectors { 2, <0,0,0> }".to_owned(),
            "expected vertex 2 of 2 in `vertex_vectors`, found `}`",
            "}",
        ),
        (
            "vertex_vectors { 1, <0,0,0>, <1,1,1> }".to_owned(),
            "expected `}` after item 1, the last of `vertex_vectors`, found `<`",
            "<",
        ),
        (
            "vertex_vectors { 1, <0,0,inf> }".to_owned(),
            "vertex 1 in `vertex_vectors` must be finite",
            "<0,0,inf>",
        ),
        (
            format!("{TETRAHEDRON} inside_vector"),
            "expected `face_indices` after the lists of vectors in `mesh2`, found `inside_vector`",
            "inside_vector",
        ),
        (
            format!("{TETRAHEDRON} texture_list {{ 1 }}"),
            "expected `texture` 1 of 1 in `texture_list`, found `}`",
            "}",
        ),
        (
            format!("{TETRAHEDRON} face_indices {{ 0 }}"),
            "a mesh needs at least one triangle",
            "face_indices",
        ),
        (
            format!("{TETRAHEDRON} face_indices {{ 2, <0,1,2>, <1,2,4> }}"),
            "vertex 4 is out of range: this mesh has 4 vertices, from 0 to 3",
            "<1,2,4>",
        ),
        (
            format!("{TETRAHEDRON} face_indices {{ 1, <-1,1,2> }}"),
            "vertex -1 is out of range: this mesh has 4 vertices, from 0 to 3",
            "<-1,1,2>",
        ),
        (
            format!("{TETRAHEDRON} face_indices {{ 1, <0,1,2> }} normal_indices {{ 1, <0,0,0> }}"),
            "normal 0 is out of range: this mesh has no normals",
            "<0,0,0>",
        ),
        (
            format!("{TETRAHEDRON} {two} face_indices {{ 1, <0,1,2> }}"),
            "`normal_indices` is missing: 2 normals do not match 4 vertices",
            "face_indices",
        ),
        (
            format!(
                "{TETRAHEDRON} {two} face_indices {{ 1, <0,1,2> }} normal_indices {{ 2, <0,0,1>, <0,0,1> }}"
            ),
            "`normal_indices` has 2 triangles, `face_indices` only 1",
            "normal_indices",
        ),
        (
            format!(
                "{TETRAHEDRON} uv_vectors {{ 1, <0,0> }} face_indices {{ 1, <0,1,2> }} uv_indices {{ 1, <0,0,1> }}"
            ),
            "uv vector 1 is out of range: this mesh has one, with the index 0",
            "<0,0,1>",
        ),
        (
            format!("{TETRAHEDRON} uv_vectors {{ 1, <0,0> }} face_indices {{ 1, <0,1,2> }}"),
            "`uv_indices` is missing: 1 uv vectors do not match 4 vertices",
            "face_indices",
        ),
        (
            format!("{TETRAHEDRON} face_indices {{ 1, <0,1,2> }} uv_indices {{ 0 }}"),
            "`uv_indices` has 0 triangles, `face_indices` has 1",
            "uv_indices",
        ),
    ] {
        assert_eq!(fault2(&text), (message.to_owned(), location), "{text}");
    }
}

#[test]
fn texture_coordinates_are_interpolated() {
    let uv = "uv_vectors { 3, <0,0>, <1,0>, <0,2> }";
    let mesh = mesh2(&format!(
        "{TETRAHEDRON} {uv} face_indices {{ 2, <0,1,2>, <0,1,3> }} uv_indices {{ 2, <0,1,2>, <2,2,2> }}"
    ));
    let at = DVec3::new(0.25, 0.5, 0.0);
    assert_eq!(mesh.uv(at, 0), Some([0.25, 1.0]));
    assert_eq!(mesh.uv(DVec3::new(0.25, 0.0, 0.5), 1), Some([0.0, 2.0]));
    let by_corner = mesh2(
        "vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0> } uv_vectors { 3, <0,0>, <1,0>, <0,2> }
        face_indices { 1, <0,1,2> }",
    );
    assert_eq!(by_corner.uv(at, 0), Some([0.25, 1.0]));
}

#[test]
fn a_triangle_of_a_mesh_without_texture_coordinates_has_zeros() {
    let mesh = mesh(
        "triangle { <0,0,0>, <1,0,0>, <0,1,0> }
        triangle { <0,0,0>, <1,0,0>, <0,0,1> uv_vectors <0,1>, <1,1>, <1,0> }
        triangle { <0,0,0>, <0,1,0>, <0,0,1> }",
    );
    let at = DVec3::new(0.25, 0.0, 0.0);
    let all = [0, 1, 2].map(|face| mesh.uv(at, face).unwrap());
    assert_eq!(all, [[0.0, 0.0], [0.25, 1.0], [0.0, 0.0]]);
}

#[test]
fn triangles_have_textures_of_their_own() {
    let named = || Texture::from(crate::scene::texture::Layer::default());
    let mut args = TextArgs::new(
        "triangle { <0,0,0>, <1,0,0>, <0,1,0> }
        triangle { <0,0,0>, <1,0,0>, <0,0,1> texture_list { A B, A } }
        triangle { <0,0,0>, <0,1,0>, <0,0,1> }",
    )
    .with("A", named())
    .with("B", named());
    let mesh = Mesh::read(&mut args).unwrap();
    assert_eq!(mesh.face_textures().len(), 2);
    let shares = mesh.texture_weights(DVec3::new(0.25, 0.0, 0.5), 1);
    let shares: Vec<_> = shares.iter().map(|s| (s.weight, s.texture)).collect();
    assert_eq!(shares, [(0.25, 0), (0.25, 1), (0.5, 0)]);
    assert!(mesh.texture_weights(DVec3::ZERO, 0).is_empty());
    assert!(mesh.texture_weights(DVec3::ZERO, 2).is_empty());
}

#[test]
fn absent_attributes_take_no_memory() {
    let bare = mesh("triangle { <0,0,0>, <1,0,0>, <0,1,0> }");
    assert!(
        bare.triangles.attributes.is_none()
            && bare.triangles.smooth.is_empty()
            && bare.triangles.normals.is_empty()
    );
}

#[test]
fn a_mesh_takes_about_a_hundred_bytes_a_triangle_at_most() {
    let sphere = dented_sphere(60, 60, "");
    let each = sphere.bytes() / sphere.len();
    assert!(each < 100, "{each} bytes");
}

#[test]
fn lists_make_the_mesh_of_their_text() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let faces = [[0, 1, 2], [0, 1, 1], [1, 2, 3]];
    let texture = std::sync::Arc::new(Texture::from(crate::scene::texture::Layer::default()));
    let lists = MeshLists {
        vertices: &points,
        faces: &faces,
        ..MeshLists::default()
    };
    let plain = Mesh::from_lists(&lists);
    let text = format!("{TETRAHEDRON} face_indices {{ 3, <0,1,2>, <0,1,1>, <1,2,3> }}");
    assert_eq!(plain, Ok(mesh2(&text)));
    let solid = MeshLists {
        inside_vector: Some(DVec3::X),
        ..lists
    };
    let solid_text = format!("{text} inside_vector <1, 0, 0>");
    assert_eq!(Mesh::from_lists(&solid), Ok(mesh2(&solid_text)));
    let textured = MeshLists {
        normals: Some(&points),
        textures: &[texture],
        texture_of_face: &[u32::MAX, 7, 0],
        ..lists
    };
    let textured = Mesh::from_lists(&textured);
    let textured = textured.unwrap();
    assert_eq!(textured.triangles.corners, [[0, 1, 2], [1, 2, 3]]);
    let attributes = textured.triangles.attributes.as_ref().unwrap();
    assert_eq!(attributes.textures_of, TexturesOf::One(vec![u32::MAX, 0]));
    let wrong = [
        MeshLists {
            faces: &[[0, 1, 4]],
            ..lists
        },
        MeshLists {
            normals: Some(&points[1..]),
            ..lists
        },
        MeshLists {
            texture_of_face: &[0],
            ..lists
        },
        MeshLists {
            faces: &[[0, 0, 1]],
            ..lists
        },
    ];
    assert_eq!(
        wrong.map(|lists| Mesh::from_lists(&lists).unwrap_err()),
        [
            "vertex 4 of 4, counted from 0, is not there",
            "there are 3 normals for 4 vertices",
            "there are 1 textures of faces for 3 faces",
            "all triangles of this mesh are degenerate",
        ]
    );
}
