//! Shapes of one colour that follow each other at the top level of a scene: taken in by all threads, for there may be
//! millions of them.

use super::flatten::{Lowering, index};
use crate::base::color::Color;
use crate::base::math::Bounds;
use crate::base::memory::{self, prefetch};
use crate::scene::shape::{Geometry, Sphere};
use crate::scene::texture::{Finish, PreparedTexture};
use crate::scene::{Colored, Entry, Object, Objects};
use crate::world::interiors::InteriorId;
use crate::world::lights::LightList;
use crate::world::model::PendingItem;
use crate::world::primitive::{Absorb, Extent, Leaf};
use crate::world::surface::{OwnedOrShared, Surface};
use crate::world::surface_flags::ObjectFlags;
use rayon::prelude::*;
use std::mem::take;
use std::ptr;
use std::sync::Arc;

/// Fewer objects are not worth asking other threads.
const FEW: usize = 64;

/// So many leave much room when they are let go.
const LARGE: usize = 4096;

/// Shapes of one colour: in pieces, of which all but the last are of one size.
#[derive(Debug)]
pub(crate) struct PlainShapes {
    pieces: Vec<Vec<Entry>>,
    /// The size is two to this; a piece by itself may have less.
    log_size: u32,
}

/// The surfaces of what looks alike but for its colour, of which one thread makes many. Each thread keeps the finish of its
/// own: threads that count who has it would wait for each other.
#[derive(Default)]
pub(crate) struct SurfaceTemplate {
    /// Where the finish was seen last.
    seen: usize,
    finish: Arc<Finish>,
    /// What has this finish: in a colour that lets no light through, and in one that does.
    known: [Option<Surface>; 2],
}

impl Lowering {
    /// Takes in all objects of the scene's top level; `let_go` gets those that are needed no more, one by one.
    pub(crate) fn lower_all(&mut self, objects: Objects, let_go: &mut dyn FnMut(Arc<Object>)) {
        let (pieces, size) = objects.into_pieces();
        let suits = |piece: &Vec<Entry>| piece.iter().all(|entry| self.suits_row(entry));
        let suited: Vec<bool> = pieces.par_iter().map(suits).collect();
        let mut pieces = pieces.into_iter().zip(suited).peekable();
        while let Some((piece, is_suited)) = pieces.next() {
            if is_suited {
                let mut row = vec![piece];
                while let Some((piece, _)) = pieces.next_if(|(_, is_suited)| *is_suited) {
                    row.push(piece);
                }
                self.take_row(PlainShapes::new(row, size));
                continue;
            }
            let mut run = Vec::new();
            for entry in piece {
                if self.suits_row(&entry) {
                    run.push(entry);
                } else {
                    self.take_run(take(&mut run), let_go);
                    self.take_one(entry, let_go);
                }
            }
            self.take_run(run, let_go);
        }
    }

    fn take_one(&mut self, entry: Entry, let_go: &mut dyn FnMut(Arc<Object>)) {
        if let Some(object) = self.take(entry.taken()) {
            let_go(object);
        }
    }

    /// Takes in any number of objects that suit.
    fn take_run(&mut self, run: Vec<Entry>, let_go: &mut dyn FnMut(Arc<Object>)) {
        if run.len() < FEW {
            run.into_iter()
                .for_each(|entry| self.take_one(entry, let_go));
        } else {
            let size = run.len();
            self.take_row(PlainShapes::new(vec![run], size));
        }
    }

    /// Whether an object takes nothing but a place in the lists. Photons have to know where things stand.
    fn suits_row(&self, entry: &Entry) -> bool {
        let is_plain = |Colored { shape, finish, .. }: Colored<'_>| {
            shape.skins().is_empty() && !finish.has_interior() && !shape.bounds().is_empty()
        };
        self.targets.is_none() && entry.colored().is_some_and(is_plain)
    }

    fn take_row(&mut self, row: PlainShapes) {
        self.last_surface = None;
        let interior = self.interiors.unnamed_ones(index(row.len()));
        if row.is_of_balls() {
            self.take_balls(row, interior);
        } else {
            self.take_shapes(&row, interior);
            let is_large = row.len() >= LARGE;
            row.forget();
            if is_large {
                memory::trim_heap();
            }
        }
    }

    /// Takes in the balls of a row; their interiors begin at `interior`.
    fn take_balls(&mut self, row: PlainShapes, interior: InteriorId) {
        let count = index(row.len());
        let parts = &mut self.parts;
        let places = (0..row.len()).into_par_iter();
        let bounds = |at| row.ball(at).map_or(Bounds::EMPTY, |ball| ball.bounds());
        parts.bounds.par_extend(places.map(bounds));
        let first = parts.balls.add(row, count, interior);
        let balls = (first..first + count).into_par_iter();
        parts.items.par_extend(balls.map(PendingItem::Ball));
    }

    /// Takes in the shapes of a row as leaves; their interiors begin at `interior`.
    fn take_shapes(&mut self, row: &PlainShapes, interior: InteriorId) {
        let surface = index(self.surfaces.len());
        self.take_looks(row, interior);
        let count = row.len();
        let numbers = |first: u32| first..first + index(count);
        let parts = &mut self.parts;
        let (leaves, surfaces) = (numbers(index(parts.leaves.len())), numbers(surface));
        let places = (0..count).into_par_iter();
        let leaf = |(at, surface)| {
            let Colored { shape, steps, .. } = row.object(at);
            let place = (steps, Absorb::AllItCan);
            Leaf::new(shape.into_owned(), place, surface, Extent::Surface)
        };
        let mut lists = (take(&mut parts.leaves), take(&mut parts.bounds));
        lists.par_extend(places.zip(surfaces).map(leaf));
        (parts.leaves, parts.bounds) = lists;
        parts
            .items
            .par_extend(leaves.into_par_iter().map(PendingItem::Leaf));
    }

    /// Takes in how the shapes of a row look.
    fn take_looks(&mut self, row: &PlainShapes, InteriorId(first): InteriorId) {
        let count = row.len();
        let surface = |alike: &mut SurfaceTemplate, (at, interior)| {
            alike.surface_at(row, at, InteriorId(interior))
        };
        let places = (0..count).into_par_iter();
        let looks = places.zip(first..first + index(count));
        let looks = looks.map_init(SurfaceTemplate::default, surface);
        self.surfaces.par_extend(looks);
    }
}

impl PlainShapes {
    /// Pieces of a size that is a power of two, unless there is but one.
    fn new(pieces: Vec<Vec<Entry>>, size: usize) -> Self {
        debug_assert!(pieces.len() == 1 || size.is_power_of_two());
        PlainShapes {
            pieces,
            log_size: size.next_power_of_two().trailing_zeros(),
        }
    }

    fn len(&self) -> usize {
        self.pieces.iter().map(Vec::len).sum()
    }

    fn entry(&self, at: usize) -> &Entry {
        let piece = at >> self.log_size;
        &self.pieces[piece][at - (piece << self.log_size)]
    }

    /// The object at a place.
    fn object(&self, at: usize) -> Colored<'_> {
        let colored = self.entry(at).colored();
        colored.expect("it was found to be of one colour")
    }

    /// The object at a place, if it is a ball.
    pub(crate) fn ball(&self, at: usize) -> Option<Sphere> {
        self.entry(at).ball()
    }

    /// Says that the object at a place will be asked for soon.
    #[inline]
    pub(crate) fn expect(&self, at: usize) {
        prefetch(self.entry(at));
    }

    fn is_of_balls(&self) -> bool {
        let is_ball = |entry: &Entry| entry.ball().is_some();
        let pieces = self.pieces.par_iter();
        pieces.all(|piece| piece.iter().all(is_ball))
    }

    /// Lets go of them.
    pub(crate) fn forget(self) {
        self.pieces.into_par_iter().for_each(drop);
    }
}

impl SurfaceTemplate {
    /// The surface of the object at a place of a row.
    #[inline]
    pub(crate) fn surface_at(
        &mut self,
        row: &PlainShapes,
        at: usize,
        interior: InteriorId,
    ) -> Surface {
        let looks = row.entry(at).looks();
        let (color, finish) = looks.expect("it was found to be of one colour");
        self.surface(color, finish, interior)
    }

    /// The surface of this colour and finish.
    #[inline]
    fn surface(&mut self, color: Color, finish: &Arc<Finish>, interior: InteriorId) -> Surface {
        let place = ptr::from_ref(&**finish).addr();
        if self.seen != place {
            self.seen = place;
            if *self.finish != **finish {
                self.finish = Arc::new((**finish).clone());
                self.known = [None, None];
            }
        }
        let known = &mut self.known[usize::from(color.is_transparent())];
        let like = known.get_or_insert_with(|| {
            let texture = PreparedTexture::colored(color, Arc::clone(&self.finish));
            let lit = (LightList::default(), ObjectFlags::default());
            Surface::new(
                OwnedOrShared::Own(texture),
                None,
                Box::default(),
                interior,
                lit,
            )
        });
        let surface = like.in_color(color, interior);
        surface.expect("what is alike is of one colour")
    }
}

#[cfg(test)]
mod tests {
    use crate::base::options::{ReadOptions, RenderOptions};
    use crate::base::source::Sources;
    use crate::lang::evaluate;
    use std::fmt::Write;

    #[test]
    fn a_surface_of_one_color_is_a_line_of_memory() {
        assert_eq!(size_of::<crate::world::Surface>(), 64);
    }

    #[test]
    fn balls_in_rows_keep_their_looks_wherever_the_tree_puts_them() {
        let mut text = String::from(
            "#version 3.7; global_settings { assumed_gamma 1 } light_source { 9, 1 } plane { y, -50 pigment { rgb 1 } }\n",
        );
        for at in 0..5000 {
            let (x, z) = (at * 37 % 101, at / 101);
            let red = f64::from(x) / 128.0;
            let ball = format!("sphere {{ <{x}, 0, {z}>, 0.25 pigment {{ rgb <{red}, 0, 0>");
            let more = match at {
                2000 => "} } box { <-9, -9, -9>, <-8, -8, -8> pigment { rgb 1",
                _ if at % 3 == 0 => " transmit 0.5",
                _ => "",
            };
            writeln!(text, "{ball}{more} }} }}").unwrap();
        }
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov", &text);
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        let world = crate::world::compile(reading.scene.unwrap(), &RenderOptions::default());
        let mut balls = 0;
        for leaf in world.leaves() {
            let Some((centre, _)) = leaf.ball() else {
                continue;
            };
            balls += 1;
            let surface = &world.surfaces[leaf.surface as usize];
            let (color, _) = surface.texture.plain().unwrap();
            assert_eq!(f64::from(color.rgb.r), centre.x / 128.0);
            assert_eq!(surface.is_opaque(), !color.is_transparent());
        }
        assert_eq!(balls, 5000);
    }
}
