//! One question of the catalogue and the answer of a renderer.

use super::draw::{Drawn, Picture};
use super::model::{Model, SIZE};
use super::oracle::{Oracle, Shown};

/// Tolerance of a colour: half of the step between colours that must be distinguished.
const TOLERANCE: f32 = 0.02;

/// A question of the catalogue.
pub(crate) struct Case {
    /// The number of its item in the catalogue.
    pub(crate) item: u8,
    /// A name in a few words.
    pub(crate) name: String,
    /// The question.
    pub(crate) asks: Asks,
    /// Wrong pixels that povr may have, and the reason.
    pub(crate) allowed: Option<(usize, &'static str)>,
    /// Runs only with the whole catalogue.
    pub(crate) is_slow: bool,
    /// The reason not to run POV-Ray: it crashes, or takes minutes, or cannot read the scene.
    pub(crate) no_pov_ray: Option<&'static str>,
}

/// Kinds of questions.
pub(crate) enum Asks {
    /// The surface in each pixel, against numbers of 77 digits.
    Model(Box<Model>),
    /// Two scenes with the same picture: the second as the first, within this difference of a channel.
    Same {
        text: String,
        like: String,
        within: f32,
    },
    /// The same colour in every pixel.
    Even {
        text: String,
        color: [f32; 3],
        within: f32,
    },
    /// Each scene is rejected with an error, or drawn without NaN or infinity.
    Sound(Vec<String>),
    /// The scene is rejected with these words.
    Refused { text: String, says: &'static str },
    /// Families of rays for a routine of povr: the number of rays, and of wrong results.
    Rays(fn() -> (usize, usize)),
}

/// The result of a renderer.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// Pixels or rays whose exact answer is known.
    pub(crate) decided: usize,
    /// Wrong ones among those; all of them if there was no picture.
    pub(crate) wrong: usize,
    /// The wrong pixels.
    pub(crate) map: Vec<bool>,
    /// Pixels with NaN or infinity.
    pub(crate) not_numbers: usize,
    /// The picture, if there is one.
    pub(crate) picture: Option<Picture>,
    /// The picture it should equal, by the same renderer.
    pub(crate) like: Option<Picture>,
    /// The messages of the renderer.
    pub(crate) said: String,
}

/// Draws a scene text.
pub(crate) type Draw<'a> = dyn Fn(&str, (u32, u32)) -> Drawn + 'a;

impl Case {
    pub(crate) fn new(item: u8, name: impl Into<String>, asks: Asks) -> Case {
        Case {
            item,
            name: name.into(),
            asks,
            allowed: None,
            is_slow: false,
            no_pov_ray: None,
        }
    }

    pub(crate) fn model(item: u8, name: impl Into<String>, model: Model) -> Case {
        Case::new(item, name, Asks::Model(Box::new(model)))
    }

    pub(crate) fn slow(self) -> Case {
        Case {
            is_slow: true,
            ..self
        }
    }

    pub(crate) fn allowing(self, pixels: usize, because: &'static str) -> Case {
        Case {
            allowed: Some((pixels, because)),
            ..self
        }
    }

    pub(crate) fn without_pov_ray(self, because: &'static str) -> Case {
        Case {
            no_pov_ray: Some(because),
            ..self
        }
    }

    /// The size of its pictures.
    pub(crate) fn size(&self) -> (u32, u32) {
        match &self.asks {
            Asks::Model(model) => model.size,
            // There are thousands of them.
            Asks::Sound(_) => (24, 18),
            _ => SIZE,
        }
    }

    /// The result of a renderer.
    pub(crate) fn outcome(&self, draw: &Draw) -> Outcome {
        let size = self.size();
        match &self.asks {
            Asks::Model(model) => {
                let oracle = Oracle::new(model);
                let drawn = draw(&model.text(), size);
                judged(drawn, size, |x, y, color| {
                    let right = |shown: &Shown| {
                        shown.iter().any(|expected| {
                            (0..3).all(|i| (color[i] - single(expected[i])).abs() < TOLERANCE)
                        })
                    };
                    if right(&oracle.shown(x, y)) {
                        return Some(false);
                    }
                    oracle.is_wrong(x, y, right)
                })
            }
            Asks::Same { text, like, within } => {
                let expected = draw(like, size);
                let drawn = draw(text, size);
                let Some(expected) = expected.picture else {
                    return judged(
                        Drawn {
                            picture: None,
                            said: expected.said,
                        },
                        size,
                        |_, _, _| None,
                    );
                };
                let outcome = judged(drawn, size, |x, y, color| {
                    let other = expected.pixels[(y * size.0 + x) as usize];
                    Some((0..3).any(|i| (color[i] - other[i]).abs() > *within))
                });
                Outcome {
                    like: Some(expected),
                    ..outcome
                }
            }
            Asks::Even {
                text,
                color,
                within,
            } => judged(draw(text, size), size, |_, _, pixel| {
                Some((0..3).any(|i| (pixel[i] - color[i]).abs() > *within))
            }),
            Asks::Sound(texts) => {
                let mut outcome = Outcome {
                    decided: texts.len(),
                    ..Outcome::default()
                };
                for text in texts {
                    let drawn = draw(text, size);
                    let is_sound = match &drawn.picture {
                        None => drawn.said.contains("Error"),
                        Some(picture) => {
                            picture.pixels.as_flattened().iter().all(|c| c.is_finite())
                        }
                    };
                    if !is_sound {
                        outcome.wrong += 1;
                        outcome
                            .said
                            .push_str(text.lines().last().unwrap_or_default());
                        outcome.said.push('\n');
                        outcome.said.push_str(&drawn.said);
                    }
                }
                outcome
            }
            Asks::Refused { text, says } => {
                let drawn = draw(text, size);
                let is_refused = drawn.picture.is_none()
                    && drawn.said.to_lowercase().contains(&says.to_lowercase());
                Outcome {
                    decided: 1,
                    wrong: usize::from(!is_refused),
                    said: drawn.said,
                    ..Outcome::default()
                }
            }
            Asks::Rays(family) => {
                let (rays, wrong) = family();
                Outcome {
                    decided: rays,
                    wrong,
                    ..Outcome::default()
                }
            }
        }
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are few and far apart"
)]
fn single(x: f64) -> f32 {
    x as f32
}

/// Counts the wrong pixels of a picture; `is_wrong` is `None` where the exact answer is unknown.
fn judged(
    drawn: Drawn,
    size: (u32, u32),
    is_wrong: impl Fn(u32, u32, [f32; 3]) -> Option<bool>,
) -> Outcome {
    let pixels = (size.0 * size.1) as usize;
    let Some(picture) = drawn.picture else {
        return Outcome {
            decided: pixels,
            wrong: pixels,
            said: drawn.said,
            ..Outcome::default()
        };
    };
    let mut outcome = Outcome {
        map: vec![false; pixels],
        said: drawn.said,
        ..Outcome::default()
    };
    for y in 0..size.1 {
        for x in 0..size.0 {
            let at = (y * size.0 + x) as usize;
            let color = picture.pixels[at];
            if color.iter().any(|c| c.is_nan()) {
                outcome.not_numbers += 1;
            }
            match is_wrong(x, y, color) {
                None => {}
                Some(false) => outcome.decided += 1,
                Some(true) => {
                    outcome.decided += 1;
                    outcome.wrong += 1;
                    outcome.map[at] = true;
                }
            }
        }
    }
    outcome.picture = Some(picture);
    outcome
}

/// The exact picture of a model, for the sheet.
pub(crate) fn reference(model: &Model) -> Picture {
    let oracle = Oracle::new(model);
    let (width, height) = model.size;
    let pixels = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .map(|(x, y)| oracle.shown(x, y)[0].map(single))
        .collect();
    Picture {
        size: model.size,
        pixels,
    }
}
