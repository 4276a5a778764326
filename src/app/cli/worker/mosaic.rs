//! The picture of a live scene in progress: its finished tiles over the coarse picture before it.

use crate::base::film::{Film, Pixel};
use crate::base::options::RenderOptions;
use crate::base::sync::lock;
use crate::output::{self, EncodeOptions};
use std::ops::Range;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Least time from one picture in progress to the next, and its ratio to the time that one takes.
const PAUSE: Duration = Duration::from_millis(150);
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
                next: Some(Instant::now() + PAUSE),
            }),
        }
    }

    /// Adds a tile, and sends the picture if it is time.
    pub(super) fn add(&self, columns: &Range<u32>, rows: &Range<u32>, pixels: &[Pixel]) {
        let film = {
            let mut state = lock(&self.state);
            let width = state.film.width as usize;
            for (row, pixels) in rows.clone().zip(pixels.chunks(columns.len().max(1))) {
                let start = row as usize * width + columns.start as usize;
                state.film.pixels[start..start + pixels.len()].copy_from_slice(pixels);
            }
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
}

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
}
