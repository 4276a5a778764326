//! Ways to damage a good scene.

use crate::random::Random;

/// Makes a broken scene from one or two of the given ones.
pub(crate) type Damage = fn(&mut Random, &[Vec<u8>]) -> Vec<u8>;

/// All ways, by name.
pub(crate) const KINDS: &[(&str, Damage)] = &[
    ("cut_off", cut_off),
    ("bytes_flipped", bytes_flipped),
    ("bytes_removed", bytes_removed),
    ("nul_bytes", nul_bytes),
    ("junk_inserted", junk_inserted),
    ("junk_alone", junk_alone),
    ("tokens_removed", tokens_removed),
    ("tokens_doubled", tokens_doubled),
    ("tokens_swapped", tokens_swapped),
    ("tokens_from_elsewhere", tokens_from_elsewhere),
    ("numbers_extreme", numbers_extreme),
    ("braces_changed", braces_changed),
    ("lines_shuffled", lines_shuffled),
    ("two_spliced", two_spliced),
];

/// Numbers at which arithmetic breaks.
const EXTREMES: &[&str] = &[
    "1e308",
    "-1e308",
    "1e999",
    "-1e999",
    "1e-320",
    "0",
    "-0.0",
    "(1/0)",
    "(0/0)",
    "1e15",
    "4294967296",
    "-2147483649",
    "0.1e-15",
    "99999999999999999999999999",
];

fn cut_off(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut scene = random.pick(scenes).clone();
    scene.truncate(random.below(scene.len()));
    scene
}

fn bytes_flipped(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut scene = random.pick(scenes).clone();
    for _ in 0..=random.below(20) {
        let at = random.below(scene.len());
        scene[at] ^= 1 << random.below(8);
    }
    scene
}

fn bytes_removed(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut scene = random.pick(scenes).clone();
    for _ in 0..=random.below(10) {
        scene.remove(random.below(scene.len()));
    }
    scene
}

fn nul_bytes(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut scene = random.pick(scenes).clone();
    for _ in 0..=random.below(4) {
        scene.insert(random.below(scene.len()), 0);
    }
    scene
}

fn junk_inserted(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut scene = random.pick(scenes).clone();
    let at = random.below(scene.len());
    let junk: Vec<u8> = (0..=random.below(400)).map(|_| random.byte()).collect();
    scene.splice(at..at, junk);
    scene
}

fn junk_alone(random: &mut Random, _: &[Vec<u8>]) -> Vec<u8> {
    (0..random.below(5000)).map(|_| random.byte()).collect()
}

fn tokens_removed(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    for _ in 0..=random.below(4) {
        tokens.remove(random.below(tokens.len()));
    }
    tokens.concat()
}

fn tokens_doubled(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    for _ in 0..=random.below(4) {
        let at = random.below(tokens.len());
        let token = tokens[at];
        tokens.splice(at..at, [token, &b" "[..]]);
    }
    tokens.concat()
}

fn tokens_swapped(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    for _ in 0..=random.below(4) {
        let (a, b) = (random.below(tokens.len()), random.below(tokens.len()));
        tokens.swap(a, b);
    }
    tokens.concat()
}

fn tokens_from_elsewhere(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut here = some_tokens(random, scenes);
    let there = some_tokens(random, scenes);
    for _ in 0..=random.below(6) {
        let at = random.below(here.len());
        here[at] = there[random.below(there.len())];
    }
    here.concat()
}

fn numbers_extreme(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    let numbers: Vec<usize> = (0..tokens.len())
        .filter(|&i| tokens[i][0].is_ascii_digit())
        .collect();
    for _ in 0..=random.below(5) {
        if !numbers.is_empty() {
            tokens[*random.pick(&numbers)] = random.pick(EXTREMES).as_bytes();
        }
    }
    tokens.concat()
}

fn braces_changed(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    let marks: Vec<usize> = (0..tokens.len())
        .filter(|&i| b"{}()<>[]\"#".contains(&tokens[i][0]))
        .collect();
    for _ in 0..=random.below(3) {
        if !marks.is_empty() {
            let others = ["{", "}", "(", ")", "<", ">", "\"", "#", "/*", "*/"];
            tokens[*random.pick(&marks)] = random.pick(&others).as_bytes();
        }
    }
    tokens.concat()
}

fn lines_shuffled(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let scene = random.pick(scenes);
    let mut lines: Vec<&[u8]> = scene.split_inclusive(|&byte| byte == b'\n').collect();
    for i in (1..lines.len()).rev() {
        lines.swap(i, random.below(i + 1));
    }
    lines.concat()
}

fn two_spliced(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let (first, second) = (random.pick(scenes), random.pick(scenes));
    let (end, start) = (random.below(first.len()), random.below(second.len()));
    [&first[..end], &second[start..]].concat()
}

/// The tokens of one of the scenes.
fn some_tokens<'a>(random: &mut Random, scenes: &'a [Vec<u8>]) -> Vec<&'a [u8]> {
    let scene: &Vec<u8> = random.pick(scenes);
    tokens(scene)
}

/// Words, numbers, blanks and single marks; together they are the scene again.
fn tokens(scene: &[u8]) -> Vec<&[u8]> {
    let class = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'_' | b'.' => 1,
        byte if byte.is_ascii_whitespace() => 2,
        _ => 0,
    };
    scene
        .chunk_by(|&a, &b| class(a) == class(b) && class(a) != 0)
        .collect()
}
