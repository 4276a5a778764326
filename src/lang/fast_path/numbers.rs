//! Literal numbers and vectors, straight from the tokens: they are most of a generated scene, and the lists of a mesh
//! hold millions of them.
//!
//! Only the unambiguous is taken: numbers with a sign, commas between them, and after the vector a token that cannot
//! continue an expression. Everything else (a name, an operator, a directive) is left to the expression reader.

use crate::lang::expr::value::Number;
use crate::lang::frame::is_bare_directive;
use crate::lang::syntax::{Kind, Token, Tokens};

/// The most components of a vector.
pub(crate) const MAX_COMPONENTS: usize = 5;

/// The literal number or vector at a token if it is a whole expression, and the index after it.
#[inline]
pub(crate) fn literal_at(tokens: &Tokens, at: usize) -> Option<(Number, usize)> {
    let first = tokens.tokens[at];
    let (number, after) = if first.kind == Kind::Number || first.is_mark('-') {
        let (number, after) = signed(tokens, at)?;
        (Number::float(number), after)
    } else if first.is_mark('<') {
        components(tokens, at)?
    } else {
        return None;
    };
    ends_expression(*tokens.tokens.get(after)?).then_some((number, after))
}

/// The number at a token, with an optional sign, and the index after it.
pub(crate) fn signed(tokens: &Tokens, mut at: usize) -> Option<(f64, usize)> {
    let is_negative = tokens.tokens.get(at)?.is_mark('-');
    at += usize::from(is_negative);
    let number = tokens.tokens.get(at)?;
    if number.kind != Kind::Number {
        return None;
    }
    let value = *tokens.numbers.get(number.value as usize)?;
    Some((if is_negative { -value } else { value }, at + 1))
}

/// True if no expression can continue with this token.
pub(crate) fn ends_item(behind: Token) -> bool {
    [',', '}', '<'].iter().any(|mark| behind.is_mark(*mark))
}

/// True if no expression at the additive level can continue with this token, whatever identifiers hold.
fn ends_expression(behind: Token) -> bool {
    match behind.kind {
        Kind::Mark => !['+', '-', '*', '/', '.']
            .iter()
            .any(|mark| behind.is_mark(*mark)),
        Kind::Word => !is_bare_directive(behind),
        Kind::Number | Kind::String => true,
        Kind::LessEqual | Kind::GreaterEqual | Kind::NotEqual => true,
        Kind::Name | Kind::Directive | Kind::DataSegment | Kind::End => false,
    }
}

/// The vector of two to five literal components at a token, and the index after it.
fn components(tokens: &Tokens, start: usize) -> Option<(Number, usize)> {
    let mut number = Number {
        v: [0.0; MAX_COMPONENTS],
        len: 0,
    };
    let mut at = start;
    for component in &mut number.v {
        (*component, at) = signed(tokens, at + 1)?;
        number.len += 1;
        match tokens.tokens.get(at)? {
            comma if comma.is_mark(',') => {}
            end if end.is_mark('>') => return (number.len > 1).then_some((number, at + 1)),
            _ => return None,
        }
    }
    None
}

/// The vector of `len` components at a token, and the index after it.
pub(crate) fn literal_vector(
    tokens: &Tokens,
    mut at: usize,
    len: usize,
) -> Option<([f64; MAX_COMPONENTS], usize)> {
    let token = |at: usize| tokens.tokens.get(at).copied();
    if token(at)?.is_mark(',') {
        at += 1;
    }
    if !token(at)?.is_mark('<') {
        return None;
    }
    let mut vector = [0.0; MAX_COMPONENTS];
    for (i, component) in vector.get_mut(..len)?.iter_mut().enumerate() {
        (*component, at) = signed(tokens, at + 1)?;
        let separator = if i + 1 == len { '>' } else { ',' };
        if !token(at)?.is_mark(separator) {
            return None;
        }
    }
    ends_item(token(at + 1)?).then_some((vector, at + 1))
}

#[cfg(test)]
mod tests {
    use crate::base::options::ReadOptions;
    use crate::base::source::Sources;
    use crate::lang::evaluate;
    use crate::scene::shape::Shape;
    use crate::scene::{Kind, Object, Scene};
    use std::sync::Arc;

    fn scene(text: &str) -> Scene {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov".to_owned(), text);
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        reading
            .scene
            .unwrap_or_else(|| panic!("{:?}", reading.findings))
    }

    fn first(scene: &Scene) -> Arc<Object> {
        scene.objects.iter().next().expect("an object")
    }

    fn mesh(vectors: &str) -> Shape {
        let text = format!(
            "mesh2 {{ vertex_vectors {{ 3, {vectors} }} face_indices {{ 1, <0, 1, 2> }} }}"
        );
        match &first(&scene(&text)).kind {
            Kind::Shape(shape) => (**shape).clone(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn vectors_mean_the_same_however_they_are_written() {
        let plain = mesh("<0, 0, -1.5>, <1, 0, 0>, <0, 1e0, .0>");
        for other in [
            "<0, 0, -1.5> <1, 0, 0> <0, 1, 0>",
            "-1.5*z, x, y",
            "<0, 0, -1.5>, <1, 0, 0>, <0, 1, 0>*1",
            "<0 0, -1.5>, <1 0 0> + 0*x, <0, 1, 0>",
            "<0, 0, - -1 - 2.5>, <1, 0, 0>, <0, 1, 0>",
            "<0, 0, -1.5>, #if (1) <1, 0, 0>, #end <0, 1, 0>",
            "<0, 0, -1.5>, #for (I, 0, 1) <1 - I, I, 0>, #end",
            "<0, /* nothing */ 0, -1.5>, <1, 0, 0>, <0, 1, 0>",
        ] {
            assert_eq!(mesh(other), plain, "{other}");
        }
    }

    #[test]
    fn an_operator_behind_a_macro_call_is_not_lost() {
        let text = "#macro Twice() *2 #end
            mesh { triangle { <0, 0, 0>, <1, 0, 0> Twice(), <0, 1, 0> Twice() } }";
        let plain = "mesh { triangle { <0, 0, 0>, <2, 0, 0>, <0, 2, 0> } }";
        let (one, other) = (scene(text), scene(plain));
        match (&first(&one).kind, &first(&other).kind) {
            (Kind::Shape(one), Kind::Shape(other)) => assert_eq!(one, other),
            kinds => panic!("{kinds:?}"),
        }
    }
}
