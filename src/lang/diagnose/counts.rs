//! Lists that announce another number of points than they have.

use crate::base::args::Word;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::reader::Reader;
use crate::lang::syntax::Kind;

/// Most tokens of a list that are counted.
const COUNTED_TOKENS: usize = 20_000;

impl Reader<'_> {
    /// The number of points of the list around the next token, which announces another one.
    pub(super) fn number_of_points(&self) -> Option<Remedy> {
        let open = self.span_of(*self.blocks.last()?);
        let tokens = &self.here.tokens;
        if tokens.file != open.file || !self.words_of_blocks().next().is_some_and(has_count) {
            return None;
        }
        let start = tokens
            .tokens
            .partition_point(|token| token.start <= open.start);
        let (mut depth, mut points, mut count) = (0, 0, None);
        for at in start..start + COUNTED_TOKENS {
            let token = self.token(at)?;
            match token.kind {
                Kind::Mark if token.is_mark('<') => {
                    points += usize::from(depth == 0);
                    depth += 1;
                }
                Kind::Mark if token.is_mark('>') => depth -= 1,
                Kind::Mark if depth == 0 && token.is_mark('}') => break,
                Kind::Mark if [',', '-'].iter().any(|&mark| token.is_mark(mark)) => {}
                Kind::Number if points == 0 => count = Some(at),
                Kind::Number => {}
                Kind::Word if depth == 0 && points > 0 => break,
                Kind::Word => {}
                _ => return None,
            }
        }
        let count = tokens.span(count?);
        let announced: usize = self.source_text(count).parse().ok()?;
        (points > 0 && points != announced).then(|| {
            let hint = format!(
                "This list announces {announced} points and has {points}: write `{points}`."
            );
            Remedy::fix(hint, count, points.to_string())
        })
    }
}

/// True for blocks in which the number of points precedes them.
fn has_count(word: Word) -> bool {
    matches!(
        word,
        Word::Lathe
            | Word::Sor
            | Word::Prism
            | Word::Polygon
            | Word::SphereSweep
            | Word::VertexVectors
            | Word::NormalVectors
            | Word::UvVectors
            | Word::FaceIndices
            | Word::NormalIndices
            | Word::UvIndices
    )
}
