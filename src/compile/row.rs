//! Shapes of one colour that follow each other at the top level of a scene: taken in by all threads, for there may be
//! millions of them.

use super::flatten::{Flat, index};
use super::interiors::InteriorId;
use super::leaf::{Absorb, Extent, Leaf};
use super::lights::LightList;
use super::model::Item;
use super::surface::{Flags, Kept, Surface};
use crate::scene::{Colored, Entry, Object, Objects};
use crate::shape::Geometry;
use crate::texture::{Finish, PreparedTexture};
use rayon::prelude::*;
use std::mem::take;
use std::ptr;
use std::sync::Arc;

/// Fewer objects are not worth asking other threads.
const FEW: usize = 64;

/// Shapes of one colour: in pieces, of which all but the last are of one size.
struct Row {
    pieces: Vec<Vec<Entry>>,
    size: usize,
}

/// A finish that is kept once for many objects that have it. Each thread has its own: threads that count who has it
/// would wait for each other.
#[derive(Default)]
struct Finishes {
    /// Where it was seen last, and the finish.
    last: Option<(usize, Arc<Finish>)>,
}

impl Flat {
    /// Takes in all objects of the scene's top level; `let_go` gets those that are needed no more, one by one.
    pub(super) fn take_all(&mut self, objects: Objects, let_go: &mut dyn FnMut(Arc<Object>)) {
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
                self.take_row(Row { pieces: row, size });
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
            self.take_row(Row {
                size: run.len(),
                pieces: vec![run],
            });
        }
    }

    /// Whether an object takes nothing but a place in the lists. Photons have to know where things stand.
    fn suits_row(&self, entry: &Entry) -> bool {
        let is_plain = |Colored { shape, finish, .. }: Colored<'_>| {
            shape.skins().is_empty() && !finish.has_interior() && !shape.bounds().is_empty()
        };
        self.targets.is_none() && entry.colored().is_some_and(is_plain)
    }

    fn take_row(&mut self, row: Row) {
        let count = row.len();
        let numbers = |first: usize| index(first)..index(first + count);
        let parts = &mut self.parts;
        let (leaves, surfaces) = (numbers(parts.leaves.len()), numbers(self.surfaces.len()));
        let places = (0..count).into_par_iter();
        let leaf = |(at, surface)| {
            let Colored { shape, steps, .. } = row.object(at);
            let place = (steps, Absorb::AllItCan);
            Leaf::new(shape.into_owned(), place, surface, Extent::Surface)
        };
        let mut lists = (take(&mut parts.leaves), take(&mut parts.bounds));
        lists.par_extend(places.clone().zip(surfaces).map(leaf));
        (parts.leaves, parts.bounds) = lists;
        parts
            .items
            .par_extend(leaves.into_par_iter().map(Item::Leaf));
        let InteriorId(first) = self.interiors.unnamed_ones(index(count));
        let surface = |finishes: &mut Finishes, (at, interior)| {
            let Colored { color, finish, .. } = row.object(at);
            let texture = Kept::Own(PreparedTexture::colored(color, finishes.kept(finish)));
            let lit = (LightList::default(), Flags::default());
            Surface::new(texture, None, Box::default(), InteriorId(interior), lit)
        };
        let looks = places.zip(first..first + index(count));
        let looks = looks.map_init(Finishes::default, surface);
        self.surfaces.par_extend(looks);
        self.last_surface = None;
        row.pieces.into_par_iter().for_each(drop);
    }
}

impl Row {
    fn len(&self) -> usize {
        self.pieces.iter().map(Vec::len).sum()
    }

    /// The object at a place.
    fn object(&self, at: usize) -> Colored<'_> {
        let entry = &self.pieces[at / self.size][at % self.size];
        entry.colored().expect("it was found to be of one colour")
    }
}

impl Finishes {
    fn kept(&mut self, finish: &Arc<Finish>) -> Arc<Finish> {
        let place = ptr::from_ref(&**finish).addr();
        match &mut self.last {
            Some((seen, kept)) if *seen == place || **kept == **finish => {
                *seen = place;
                Arc::clone(kept)
            }
            last => {
                let kept = Arc::new((**finish).clone());
                *last = Some((place, Arc::clone(&kept)));
                kept
            }
        }
    }
}
