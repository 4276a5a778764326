//! The picture of a live scene in progress: its finished tiles over a coarse picture, or over the last one.

use crate::base::film::{Film, Pixel};
use crate::base::options::RenderOptions;
use crate::base::sync::lock;
use crate::output::{self, EncodeOptions};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Least time from one picture in progress to the next, and its ratio to the time that one takes.
const PAUSE: Duration = Duration::from_millis(250);
const SHARE: u32 = 20;

/// A picture in progress.
pub(super) struct Mosaic<'a> {
    encode: EncodeOptions,
    /// Receives a file of the picture now and then.
    send: &'a (dyn Fn(&[u8]) + Sync),
    state: Mutex<State>,
}

struct State {
    film: Film,
    /// The part in which it differs from the picture that it began with.
    changed: Option<Part>,
    /// The time of the next file; `None` while one is being made.
    next: Option<Instant>,
}

impl<'a> Mosaic<'a> {
    /// A picture without tiles, over an earlier one.
    pub(super) fn over(
        film: Film,
        encode: EncodeOptions,
        send: &'a (dyn Fn(&[u8]) + Sync),
    ) -> Self {
        Mosaic {
            encode,
            send,
            state: Mutex::new(State {
                film,
                changed: None,
                next: Some(Instant::now() + PAUSE),
            }),
        }
    }

    /// Adds a tile, and sends the picture if it is time.
    pub(super) fn add(&self, columns: &Range<u32>, rows: &Range<u32>, pixels: &[Pixel]) {
        let film = {
            let mut state = lock(&self.state);
            let changed = put(&mut state.film, (columns, rows), pixels);
            state.changed = Part::around(state.changed.take(), changed);
            let start = Instant::now();
            if state.next.is_none_or(|next| start < next) {
                return;
            }
            state.next = None;
            state.film.clone()
        };
        let start = Instant::now();
        if let Ok(file) = output::encode(&film, &self.encode) {
            (self.send)(&file);
        }
        let pause = PAUSE.max(SHARE * start.elapsed());
        lock(&self.state).next = Some(Instant::now() + pause);
    }

    /// The picture with all tiles so far, and the part in which it differs from the one that it began with.
    pub(super) fn end(self) -> (Film, Option<Part>) {
        let state = self.state.into_inner();
        let State { film, changed, .. } = state.unwrap_or_else(PoisonError::into_inner);
        (film, changed)
    }
}

/// A rectangle of pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
}

impl Part {
    /// The smallest part that holds both.
    pub(super) fn around(one: Option<Part>, other: Option<Part>) -> Option<Part> {
        let (Some(one), Some(other)) = (&one, &other) else {
            return one.or(other);
        };
        let both = |a: &Range<u32>, b: &Range<u32>| a.start.min(b.start)..a.end.max(b.end);
        Some(Part {
            columns: both(&one.columns, &other.columns),
            rows: both(&one.rows, &other.rows),
        })
    }

    /// The pixels of this part of a picture, as a picture of its own.
    pub(super) fn of(&self, film: &Film) -> Film {
        let Part { columns, rows } = self;
        let [width, height] = [columns, rows].map(|range| range.end - range.start);
        let mut part = Film::whole(width, height);
        let columns = columns.start as usize..columns.end as usize;
        let lines = film.rows_of_pixels().skip(rows.start as usize);
        for (to, from) in part.pixels.chunks_mut(columns.len()).zip(lines) {
            to.copy_from_slice(&from[columns.clone()]);
        }
        part
    }
}

/// Copies a tile into a picture; returns the part in which that changes.
fn put(film: &mut Film, (columns, rows): Tile<'_>, pixels: &[Pixel]) -> Option<Part> {
    let width = film.width as usize;
    let mut changed = None;
    for (row, pixels) in rows.clone().zip(pixels.chunks(columns.len().max(1))) {
        let start = row as usize * width + columns.start as usize;
        let old = &mut film.pixels[start..start + pixels.len()];
        let mut columns = columns.clone().zip(old.iter().zip(pixels));
        let differ = |(_, (old, new)): &(u32, (&Pixel, &Pixel))| old != new;
        if let Some((first, _)) = columns.find(differ) {
            let last = columns.rfind(differ).map_or(first, |(last, _)| last);
            let line = Part {
                columns: first..last + 1,
                rows: row..row + 1,
            };
            changed = Part::around(changed, Some(line));
            old.copy_from_slice(pixels);
        }
    }
    changed
}

/// The columns and rows of a tile.
type Tile<'a> = (&'a Range<u32>, &'a Range<u32>);

/// A coarse picture in the size of another one; a black one if there is none.
pub(super) fn enlarged(coarse: Option<&Film>, render: &RenderOptions) -> Film {
    let mut film = Film::whole(render.width, render.height);
    let Some(coarse) = coarse else {
        return film;
    };
    let part = |at: usize, of: u32, whole: u32| at * of as usize / whole as usize;
    let (width, height) = (film.width, film.height);
    for (y, row) in film.pixels.chunks_mut(width as usize).enumerate() {
        let start = part(y, coarse.height, height) * coarse.width as usize;
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = coarse.pixels[start + part(x, coarse.width, width)];
        }
    }
    film
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use crate::output::Format;

    fn grey(level: f32) -> Pixel {
        Pixel::new(Rgb::new(level, level, level), 0.0)
    }

    #[test]
    fn tiles_replace_the_coarse_picture() {
        let mut coarse = Film::whole(2, 1);
        coarse.pixels = vec![grey(0.0), grey(1.0)];
        let sent = Mutex::new(Vec::new());
        let send = |file: &[u8]| lock(&sent).push(file.to_vec());
        let encode = EncodeOptions::new(Format::PNG);
        let film = enlarged(Some(&coarse), &RenderOptions::of_size(4, 2));
        let mosaic = Mosaic::over(film, encode, &send);
        mosaic.add(&(0..1), &(0..1), &[grey(1.0)]);
        assert!(lock(&sent).is_empty());
        lock(&mosaic.state).next = Some(Instant::now());
        mosaic.add(&(3..4), &(0..2), &[grey(0.0), grey(0.0)]);
        let file = lock(&sent).pop().expect("a file");
        let picture = image::load_from_memory(&file)
            .expect("a picture")
            .to_luma8();
        assert_eq!(picture.into_raw(), [255, 0, 255, 0, 0, 0, 255, 0]);
        assert!(lock(&mosaic.state).next.is_some());
    }

    #[test]
    fn the_part_that_tiles_change_is_known() {
        let send = |_: &[u8]| {};
        let mosaic = Mosaic::over(Film::whole(8, 6), EncodeOptions::new(Format::PNG), &send);
        let mut tile = vec![grey(0.0); 16];
        mosaic.add(&(0..4), &(0..4), &tile);
        tile[6] = grey(1.0);
        mosaic.add(&(4..8), &(1..5), &tile);
        tile[6] = grey(0.0);
        tile[4] = grey(0.5);
        mosaic.add(&(0..4), &(2..6), &tile);
        let (film, part) = mosaic.end();
        let part = part.expect("a part");
        assert_eq!((&part.columns, &part.rows), (&(0..7), &(2..4)));
        let cut = part.of(&film);
        assert_eq!((cut.width, cut.height), (7, 2));
        for (number, pixel) in cut.pixels.iter().enumerate() {
            let level = match number {
                6 => 1.0,
                7 => 0.5,
                _ => 0.0,
            };
            assert_eq!(*pixel, grey(level), "{number}");
        }
    }
}
