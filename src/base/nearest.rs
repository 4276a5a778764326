//! Spelling suggestions for unknown words.

/// The candidate that differs from `word` in the fewest letters, of any case: at most one in words of three to five
/// letters, two in longer ones. Words of up to four letters begin alike.
pub(crate) fn nearest<T: AsRef<str>>(
    word: &str,
    candidates: impl IntoIterator<Item = T>,
) -> Option<T> {
    let word = word.to_lowercase();
    let limit = match word.len() {
        0..=2 => return None,
        3..=5 => 1,
        _ => 2,
    };
    let begins_alike = |name: &str| word.len() > 4 || name.chars().next() == word.chars().next();
    candidates
        .into_iter()
        .filter(|candidate| candidate.as_ref().len().abs_diff(word.len()) <= limit)
        .map(|candidate| (candidate.as_ref().to_lowercase(), candidate))
        .filter(|(name, _)| begins_alike(name))
        .map(|(name, candidate)| (distance(&word, &name), name, candidate))
        .filter(|(distance, ..)| *distance <= limit)
        .min_by_key(|(distance, name, _)| {
            // Letters are rather changed than left out.
            (*distance, name.len().abs_diff(word.len()), name.clone())
        })
        .map(|(_, _, candidate)| candidate)
}

/// The number of letters to insert, delete, change, or swap with a neighbour (Damerau 1964, restricted).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let changed = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = changed.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_word_has_its_neighbour() {
        let commands = ["batch", "check", "compare", "curve", "man", "watch"];
        for (word, expected) in [
            ("wacth", Some("watch")),
            ("wathc", Some("watch")),
            ("Check", Some("check")),
            ("compair", Some("compare")),
            ("mna", Some("man")),
            ("gears", None),
            ("m", None),
            ("", None),
            ("mnaw", None),
        ] {
            assert_eq!(nearest(word, commands), expected, "{word}");
        }
    }
}
