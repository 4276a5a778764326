//! Reader of `translate`, `rotate`, `scale`, `matrix` and `transform`.

use super::{Args, Parse, Word, declared, trailing_comma};
use crate::base::math::{Step, Transform};
use crate::base::source::Diagnostic;
use glam::{DAffine3, DMat3, DVec3};
use std::sync::Arc;

/// Below this, POV-Ray treats every entry of a matrix column as zero.
const ZERO_COLUMN: f64 = 1e-10;

/// Reads the transform that begins at the next word; `None` if that word begins none.
///
/// # Errors
/// A malformed vector or block, or a singular matrix.
pub fn transform_step(args: &mut dyn Args) -> Parse<Option<Step>> {
    let step = match args.word()? {
        Some(Word::Translate) => {
            args.accept(Word::Translate)?;
            Step::Translate(args.vector()?)
        }
        Some(Word::Rotate) => {
            args.accept(Word::Rotate)?;
            Step::Rotate(args.vector()?)
        }
        Some(Word::Scale) => {
            args.accept(Word::Scale)?;
            Step::Scale(scale_vector(args)?)
        }
        Some(Word::Matrix) => {
            args.accept(Word::Matrix)?;
            Step::General(Arc::new(matrix(args)?))
        }
        Some(Word::Transform) => {
            args.accept(Word::Transform)?;
            Step::General(Arc::new(transform_block(args)?))
        }
        _ => return Ok(None),
    };
    Ok(Some(step))
}

fn scale_vector(args: &mut dyn Args) -> Parse<DVec3> {
    let at = args.span();
    let mut by = args.vector()?;
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        if by[axis] == 0.0 {
            by[axis] = 1.0;
            args.warn(Diagnostic::warning(
                at,
                format!("Illegal Value: Scale {name} by 0.0. Changed to 1.0."),
            ));
        }
    }
    Ok(by)
}

/// `< 12 numbers >`: three rows of the linear part, then the translation, in POV-Ray's row-vector convention.
fn matrix(args: &mut dyn Args) -> Parse<Transform> {
    let at = args.span();
    if !args.accept_mark('<')? {
        return Err(args.expected("`<` and twelve numbers after `matrix`"));
    }
    let mut m = [0.0; 12];
    for (i, entry) in m.iter_mut().enumerate() {
        if i > 0 {
            args.comma()?;
        }
        if !args.at_expression()? {
            let error = args.expected(&format!(
                "twelve numbers after `matrix`, of which {i} are here"
            ));
            return Err(Box::new(error.with_hint(
                "Write three rows of three, and then the translation: `<a, b, c,  d, e, f,  g, h, i,  x, y, z>`.",
            )));
        }
        *entry = args.float()?;
    }
    trailing_comma(args)?;
    if !args.is_for_3_8() && args.comma()? && args.at_mark('>')? {
        let error = Diagnostic::error(
            args.last_span(),
            "a comma behind the last item needs version 3.8",
        );
        let hint = "Remove the comma, or begin the scene with `#version 3.8;`.";
        return Err(Box::new(error.with_hint(hint)));
    }
    if !args.accept_mark('>')? {
        return Err(args.expected("`>` after the twelve numbers of `matrix`"));
    }
    for column in 0..3 {
        if (0..3).all(|row| m[3 * row + column].abs() < ZERO_COLUMN) {
            m[4 * column] = 1.0;
            args.warn(Diagnostic::warning(
                at,
                format!("matrix column {column} is all zero; its diagonal is set to 1"),
            ));
        }
    }
    let row = |i: usize| DVec3::new(m[3 * i], m[3 * i + 1], m[3 * i + 2]);
    let world_from_object = DAffine3 {
        matrix3: DMat3::from_cols(row(0), row(1), row(2)),
        translation: row(3),
    };
    Transform::matrix(world_from_object).ok_or_else(|| {
        Box::new(
            Diagnostic::error(
                at.to(args.last_span()),
                "this matrix is singular: it flattens space and has no inverse",
            )
            .with_hint("Make the three rows independent of each other."),
        )
    })
}

/// `transform Identifier` or `transform { steps [inverse] }`.
fn transform_block(args: &mut dyn Args) -> Parse<Transform> {
    if let Some(known) = declared::<Transform>(args)? {
        return Ok(*known);
    }
    args.open()?;
    let mut sum = Transform::IDENTITY;
    let mut is_inverse = false;
    loop {
        if args.accept_close()? {
            return Ok(if is_inverse { sum.inverse() } else { sum });
        }
        if args.accept(Word::Inverse)? {
            is_inverse = true;
        } else if let Some(known) = declared::<Transform>(args)? {
            sum = sum.then(&known);
        } else if let Some(step) = transform_step(args)? {
            sum = sum.then(&step.transform());
        } else {
            return Err(args.expected("a transform or `}` in `transform`"));
        }
    }
}
