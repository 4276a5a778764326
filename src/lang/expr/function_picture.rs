//! `function W, H { ... }`: the values of a function as an image.

use crate::base::args::{Args, Parse, SampledFunction};
use crate::base::color::Color;
use crate::base::source::Diagnostic;
use crate::lang::reader::Reader;

/// Pixel limit of such an image: each pixel is a call of the function.
const MAX_PIXELS: f64 = 67_108_864.0;

impl Reader<'_> {
    /// Reads the sizes and the function, and calls it for each pixel.
    pub(crate) fn picture_of_function(&mut self) -> Parse<SampledFunction> {
        let start = self.start()?;
        let columns = self.float()?.trunc();
        self.comma()?;
        let rows = self.float()?.trunc();
        let span = self.span_of(start).to(self.taken_span());
        if !(columns >= 1.0 && rows >= 1.0 && columns * rows <= MAX_PIXELS) {
            let message = format!(
                "an image of a function has 1 to {MAX_PIXELS} pixels, found {columns} by {rows}"
            );
            return Err(self.with_trace(Diagnostic::error(span, message)));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "both are whole numbers of a small range"
        )]
        let (width, height) = (columns as usize, rows as usize);
        let function = self.function_block()?;
        if function.parameters() != 3 {
            let message = "the function of an image takes x, y and z";
            return Err(self.with_trace(Diagnostic::error(span, message)));
        }
        let is_grey = function.is_scalar();
        let mut colors = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let point = [share(column, width), share(row, height), 0.0];
                colors.push(if is_grey {
                    let grey = stored_number(function.eval(&point));
                    Color::from_components([grey, grey, grey, 0.0, 0.0])
                } else {
                    stored_color(Color::from_components(function.eval_vector(&point)))
                });
            }
        }
        Ok(SampledFunction {
            width,
            height,
            colors,
            is_grey,
        })
    }
}

/// Position of a pixel in its row or column, from 0 to 1.
fn share(at: usize, count: usize) -> f64 {
    if count > 1 {
        at as f64 / (count - 1) as f64
    } else {
        0.0
    }
}

/// A value as POV-Ray stores it in the image: the low sixteen bits.
fn stored_number(value: f64) -> f64 {
    (value * 65535.0).trunc().rem_euclid(65536.0) / 65535.0
}

/// A colour as POV-Ray stores it in the image: sixteen bits a channel, and its opacity; `filter` is lost.
fn stored_color(color: Color) -> Color {
    let stored = |channel: f32| (channel * 65535.0).trunc().rem_euclid(65536.0) / 65535.0;
    Color {
        rgb: color.rgb.map(stored),
        filter: 0.0,
        transmit: 1.0 - stored(1.0 - color.transmit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_channel_keeps_sixteen_bits_and_loses_what_is_above() {
        let color = Color::from_components([0.5, -0.3, 1.9, 0.4, 0.811]);
        let stored = stored_color(color);
        let steps = |channel: f32| f64::from(channel) * 65535.0;
        assert_eq!(steps(stored.rgb.r).round(), 32767.0);
        assert_eq!(steps(stored.rgb.g).round(), 45876.0);
        assert_eq!(steps(stored.rgb.b).round(), 58980.0);
        assert_eq!(stored.filter, 0.0);
        assert_eq!(steps(stored.transmit).round(), 53149.0);
    }
}
