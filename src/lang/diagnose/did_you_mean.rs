//! Spelling suggestions.

/// The candidate nearest to a misspelt word, if one is near enough: one edit in words of three to five letters, two in
/// longer ones.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    let limit = match word.len() {
        0..=2 => return None,
        3..=5 => 1,
        _ => 2,
    };
    candidates
        .filter(|candidate| candidate.len().abs_diff(word.len()) <= limit)
        .filter(|candidate| word.len() > 4 || begins_alike(word, candidate))
        .map(|candidate| (distance(word, candidate), candidate))
        .filter(|&(d, _)| d <= limit)
        .min()
        .map(|(_, candidate)| candidate)
}

/// Short words with different first letters are different words.
fn begins_alike(a: &str, b: &str) -> bool {
    let first = |word: &str| {
        word.chars()
            .next()
            .map(|letter| letter.to_ascii_lowercase())
    };
    first(a) == first(b)
}

/// The number of letters to insert, delete, replace or swap with a neighbour (Damerau 1964, restricted).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (
        a.to_lowercase().chars().collect(),
        b.to_lowercase().chars().collect(),
    );
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replace = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replace.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        before = above;
        above = row;
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn two_swapped_letters_are_found() {
        assert_eq!(
            nearest("pigmnet", ["pigment", "finish"].into_iter()),
            Some("pigment")
        );
    }

    #[test]
    fn a_different_word_is_not_suggested() {
        assert_eq!(nearest("leg", ["box", "torus"].into_iter()), None);
    }
}
