//! `user_defined`: a colour by functions of the point, one for each component; since version 3.8.

use super::numbers::single;
use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::scene::function::{self, Function};
use glam::DVec3;
use std::sync::Arc;

/// The functions of a point that give the components of a colour; those left out give 0.
#[derive(Clone, Debug, Default)]
pub struct ColorFunctions([Option<Arc<Function>>; 5]);

impl ColorFunctions {
    /// Reads `{ function { ... }, function { ... }, , ... }`: red, green, blue, filter, transmit.
    pub(super) fn read(args: &mut dyn Args) -> Parse<ColorFunctions> {
        let mut functions = ColorFunctions::default();
        let mut at = 0;
        args.open()?;
        while !args.accept_close()? {
            if args.accept(Word::Function)? {
                let read = function::read_of_point(args)?;
                match functions.0.get_mut(at) {
                    Some(slot) => *slot = Some(read),
                    None => return Err(args.expected("`}` after five functions of `user_defined`")),
                }
                args.comma()?;
            } else if !args.comma()? {
                return Err(args.expected("`function`, `,` or `}` in `user_defined`"));
            }
            at += 1;
        }
        Ok(functions)
    }

    /// The colour at a point.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let value = |function: &Option<Arc<Function>>| {
            let value = function
                .as_ref()
                .map(|function| function.eval(&point.to_array()));
            single(value.unwrap_or(0.0))
        };
        let [r, g, b, filter, transmit] = self.0.each_ref().map(value);
        Color {
            rgb: Rgb { r, g, b },
            filter,
            transmit,
        }
    }

    /// True if it gives filter or transmit.
    #[must_use]
    pub fn can_be_transparent(&self) -> bool {
        self.0[3..].iter().any(Option::is_some)
    }
}
