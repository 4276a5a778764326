//! Methods to damage a valid scene.

use super::random::Random;

/// Makes a broken scene from one or two of the given ones.
pub(crate) type Damage = fn(&mut Random, &[Vec<u8>]) -> Vec<u8>;

/// All methods, by name.
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
    ("blocks_moved", blocks_moved),
    ("blocks_nested", blocks_nested),
    ("directives_strewn", directives_strewn),
    ("macros_made", macros_made),
    ("soup", soup),
];

/// Directives, which may stand between any two tokens.
const DIRECTIVES: &[&str] = &[
    "#if (1)",
    "#if (0)",
    "#ifdef (A)",
    "#else",
    "#elseif (A)",
    "#end",
    "#end #end",
    "#while (0)",
    "#while (1)",
    "#for (A, 0, 3)",
    "#for (A, 1, 0, -1)",
    "#switch (A) #case (1)",
    "#range (0, 2)",
    "#break",
    "#macro A(B, C)",
    "#macro B()",
    "#declare A =",
    "#declare A = 1;",
    "#local B =",
    "#declare A[1] =",
    "#declare A = array[2][2]",
    "#undef A",
    "#include \"ball.inc\"",
    "#version 3.1;",
    "#version 3.7;",
    "#default {",
    "#debug",
    "#error \"x\"",
    "A",
    "A(B, 1)",
    "B()",
    "A[1]",
    "A.x",
    "declare A = 2;",
];
/// Most tokens of a soup. Longer ones detect nothing new: reading gives up after some errors.
const SOUP: usize = 120;
/// Number of times a block is nested into itself.
const NESTED: usize = 40;

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

/// Moves or copies a `{ ... }` with the word before it to another position.
fn blocks_moved(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let here = some_tokens(random, scenes);
    let mut there = some_tokens(random, scenes);
    for _ in 0..=random.below(3) {
        let block = some_block(random, &here);
        let at = random.below(there.len());
        let end = (at + random.below(2) * random.below(12)).min(there.len());
        there.splice(
            at..end,
            [&b" "[..]].into_iter().chain(block.iter().copied()),
        );
    }
    there.concat()
}

/// Nests a block into itself, many times over.
fn blocks_nested(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let tokens = some_tokens(random, scenes);
    let block = some_block(random, &tokens).concat();
    let at = random.below(block.len());
    let (open, close) = block.split_at(at);
    let times = random.below(NESTED);
    let (mut nested, rest) = (open.repeat(times), close.repeat(times));
    nested.extend_from_slice(&block);
    nested.extend_from_slice(&rest);
    nested
}

fn directives_strewn(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    for _ in 0..=random.below(6) {
        let at = random.below(tokens.len());
        let directive = random.pick(DIRECTIVES).as_bytes();
        tokens.splice(at..at, [&b" "[..], directive, b" "]);
    }
    tokens.concat()
}

/// Turns spans of tokens into macros, called where they stood and elsewhere.
fn macros_made(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let mut tokens = some_tokens(random, scenes);
    let mut head = Vec::new();
    for name in 0..=random.below(3) {
        let start = random.below(tokens.len());
        let end = (start + 1 + random.below(30)).min(tokens.len());
        let call: &[u8] = [&b" M0(1) "[..], b" M1(x, 2) ", b" M2() "][name.min(2)];
        let parameters = ["A", "A, B", ""][name.min(2)];
        head.extend_from_slice(format!("#macro M{name}({parameters}) ").as_bytes());
        head.extend(tokens.splice(start..end, [call]).flatten());
        head.extend_from_slice(b" #end\n");
        let elsewhere = random.below(tokens.len());
        tokens.insert(elsewhere, call);
    }
    [head, tokens.concat()].concat()
}

/// Some tokens of one scene, mixed with those of others.
fn soup(random: &mut Random, scenes: &[Vec<u8>]) -> Vec<u8> {
    let tokens = some_tokens(random, scenes);
    let start = random.below(tokens.len());
    let end = (start + 1 + random.below(SOUP)).min(tokens.len());
    let mut soup = tokens.get(start..end).unwrap_or_default().to_vec();
    for _ in 0..random.below(8) {
        let others = some_tokens(random, scenes);
        let at = random.below(soup.len());
        let other = others[random.below(others.len())];
        match random.below(4) {
            0 => soup[at] = other,
            1 => soup.insert(at, other),
            2 => soup.insert(at, soup[at]),
            _ if soup.len() > 1 => drop(soup.remove(at)),
            _ => {}
        }
    }
    soup.join(&b' ')
}

/// The tokens of a `{ ... }` and of the word before it; some other tokens where braces are not paired.
fn some_block<'a>(random: &mut Random, tokens: &[&'a [u8]]) -> Vec<&'a [u8]> {
    let opens: Vec<usize> = (0..tokens.len()).filter(|&i| tokens[i] == b"{").collect();
    let open = opens.get(random.below(opens.len())).copied().unwrap_or(0);
    let mut depth = 0i32;
    let length = tokens[open..]
        .iter()
        .position(|&token| {
            depth += i32::from(token == b"{") - i32::from(token == b"}");
            depth <= 0
        })
        .unwrap_or(0);
    tokens[open.saturating_sub(2)..=open + length].to_vec()
}

/// The tokens of one of the scenes.
fn some_tokens<'a>(random: &mut Random, scenes: &'a [Vec<u8>]) -> Vec<&'a [u8]> {
    let scene: &Vec<u8> = random.pick(scenes);
    tokens(scene)
}

/// Splits a scene into words, numbers, blanks and single marks; joined they are the scene again.
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
