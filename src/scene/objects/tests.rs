//! Tests of the list of objects.

use super::*;
use glam::DVec3;

fn sphere(x: f64) -> Shape {
    Shape::Sphere(Sphere {
        centre: DVec3::X * x,
        radius: 1.0,
    })
}

fn red() -> ColorOrTexture {
    ColorOrTexture::Color(
        Color::from_components([1.0, 0.0, 0.0, 0.25, 0.5]),
        Arc::default(),
    )
}

fn debug_text(object: &Object) -> String {
    format!("{object:?}")
}

#[test]
fn a_sphere_entry_takes_64_bytes() {
    assert_eq!(size_of::<Entry>(), 64);
}

#[test]
fn plain_objects_are_stored_unchanged() {
    let texture = Arc::new(Texture::from(Layer::default()));
    let shared = ColorOrTexture::Texture(Arc::clone(&texture));
    let disc = Shape::read(
        crate::base::args::Word::Disc,
        &mut crate::base::args::text::TextArgs::new("0, <0, 1, 0>, 1 }"),
    );
    let mut objects = Objects::default();
    let mut expected = Vec::new();
    for shape in [sphere(1.0), disc.unwrap().unwrap()] {
        for look in [red(), shared.clone()] {
            let plain = PlainObject {
                shape: shape.clone(),
                look,
            };
            let object = Object::from(plain.clone());
            expected.push(debug_text(&object));
            expected.push(debug_text(&object));
            objects.push_plain(plain);
            objects.push(Arc::new(object));
        }
    }
    let made: Vec<String> = objects.iter().map(|object| debug_text(&object)).collect();
    assert_eq!(made, expected);
    assert_eq!(objects.whole().count(), 0);
    assert_eq!(objects.into_objects().count(), 8);
}

#[test]
fn an_object_with_more_to_it_stays_whole() {
    let plain = || {
        Object::from(PlainObject {
            shape: sphere(0.0),
            look: red(),
        })
    };
    let changes: [fn(&mut Object); 4] = [
        |object| object.is_inverse = true,
        |object| object.flags.hollow = Some(false),
        |object| object.interior = Some(Arc::default()),
        |object| object.texture = None,
    ];
    for change in changes {
        let mut objects = Objects::default();
        let mut object = plain();
        change(&mut object);
        objects.push(Arc::new(object));
        assert_eq!(objects.whole().count(), 1);
    }
}

#[test]
fn a_transformed_shape_of_one_colour_is_stored_compactly_and_unchanged() {
    let moved = |look: ColorOrTexture| {
        let shape = sphere(1.0);
        let mut object = Object::from(PlainObject { shape, look });
        object.steps = vec![Step::Rotate(DVec3::X), Step::Translate(DVec3::Y)];
        object
    };
    let object = moved(red());
    let expected = debug_text(&object);
    let mut objects = Objects::default();
    objects.push(Arc::new(object));
    assert_eq!(objects.whole().count(), 0);
    let out: Vec<String> = objects.iter().map(|out| debug_text(&out)).collect();
    assert_eq!(out, [expected]);
    // An entry with a shared texture stays an object.
    let texture = Arc::new(Texture::from(Layer::default()));
    let shared = moved(ColorOrTexture::Texture(Arc::clone(&texture)));
    objects.push(Arc::new(shared));
    assert_eq!(objects.whole().count(), 1);
}

#[test]
fn objects_like_another_differ_in_shape_and_colour() {
    let color = |index: usize| Color::from_components([0.1, 0.0, 0.0, 0.0, f64::from(index == 1)]);
    let center = |index: usize| sphere(if index == 1 { 5.0 } else { 0.0 });
    let plain = || {
        Object::from(PlainObject {
            shape: sphere(0.0),
            look: red(),
        })
    };
    let mut moved = plain();
    moved.steps = vec![Step::Translate(DVec3::Y)];
    moved.flags.no_shadow = true;
    for model in [plain(), moved] {
        for colors in [None, Some(&color as &(dyn Fn(usize) -> Color + Sync))] {
            let mut objects = Objects::default();
            objects.extend_like(&model, 3, center, colors);
            for (index, object) in objects.iter().enumerate() {
                let mut expected = model.clone();
                expected.kind = Kind::Shape(Arc::new(center(index)));
                if let (Some(color), Some(texture)) = (colors, &mut expected.texture) {
                    texture.what = Arc::new(texture.what.with_color(color(index)));
                }
                assert_eq!(debug_text(&object), debug_text(&expected));
            }
        }
    }
}

#[test]
fn lists_share_entries() {
    let entry = |x: f64| {
        Entry::from(PlainObject {
            shape: sphere(x),
            look: red(),
        })
    };
    let piece = |x: f64, count| SharedEntries::from(vec![entry(x); count]);
    let pieces = [piece(1.0, 3), piece(2.0, CHUNK + 5), piece(3.0, 10)];
    let list = |middle: &SharedEntries| {
        let mut objects = Objects::default();
        objects.append(vec![entry(0.0); 7]);
        objects.append_shared(&pieces[0]);
        objects.append_shared(middle);
        objects.push_plain(PlainObject {
            shape: sphere(4.0),
            look: red(),
        });
        objects.append_shared(&pieces[2]);
        objects
    };
    let (one, other) = (list(&pieces[1]), list(&piece(5.0, CHUNK + 5)));
    assert_eq!(one.len(), CHUNK + 26);
    assert_eq!(one.iter().count(), one.len());
    assert_eq!(
        (one.whole().count(), one.textures_of_plain().count()),
        (0, 0)
    );
    let mut compared = Vec::new();
    assert!(one.unshared_pairs(&one, |_, _, _| false));
    assert!(one.unshared_pairs(&other, |index, _, _| {
        compared.push(index);
        true
    }));
    let expected: Vec<usize> = (0..7).chain(10..CHUNK + 16).collect();
    assert_eq!(compared, expected);
    let texts: Vec<String> = one.iter().map(|object| debug_text(&object)).collect();
    let (chunks, size) = one.clone().into_chunks();
    let (last, full) = chunks.split_last().unwrap();
    assert!(full.iter().all(|chunk| chunk.len() == size) && last.len() <= size);
    let chunked = chunks.into_iter().flatten().map(Entry::into_object);
    assert!(chunked.map(|object| debug_text(&object)).eq(texts));
    let mut rest = one;
    for _ in 0..14 {
        rest.pop();
    }
    assert_eq!(rest.len(), CHUNK + 12);
    assert_eq!(rest.iter().count(), rest.len());
}

#[test]
fn objects_are_counted_over_all_chunks() {
    let shape = sphere(0.0);
    let plain = || PlainObject {
        shape: shape.clone(),
        look: red(),
    };
    let mut objects = Objects::default();
    assert!(objects.is_empty());
    for count in 1..=2 * CHUNK + 3 {
        objects.push_plain(plain());
        assert_eq!(objects.len(), count);
    }
    let more = vec![Entry::from(plain()); CHUNK + 10];
    objects.append(more);
    assert_eq!(objects.len(), 3 * CHUNK + 13);
    assert_eq!(objects.iter().count(), objects.len());
}
