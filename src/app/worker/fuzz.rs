//! Reads damaged replies as a command does: reading ends, and takes no more memory than there are bytes. `tools/fuzz_all`
//! reads many more.

use super::read_replies;
use super::wire::{Limit, Reply, Report};
use crate::base::source::{Dependency, Diagnostic, Message, Sources};
use crate::lang::fuzz::random::Random;

/// Number of inputs.
const INPUTS: u64 = 200_000;

/// Replies of each kind about a picture of three bytes.
fn replies() -> Vec<u8> {
    let message = Message::new(&Diagnostic::error(None, "a message"), &Sources::default());
    let texts = ["a line", "an excerpt", "in colour"].map(str::to_owned);
    let dependencies = ["/scene.pov", "/other.inc"].map(|path| Dependency {
        path: path.into(),
        is_there: true,
    });
    let replies = [
        Reply::Report(Report::Weaker("no Landlock".to_owned())),
        Reply::Output("text".to_owned()),
        Reply::Finding(Box::new(message), texts),
        Reply::Read {
            dependencies: dependencies.to_vec(),
            wrote_files: true,
        },
        Reply::Drawn(9),
        Reply::Limit(Limit::Time),
        Reply::Partial(3),
        Reply::Done(vec![3]),
    ];
    let encoded = replies.iter().map(|reply| {
        let mut bytes = reply.encoded().unwrap();
        if matches!(reply, Reply::Partial(_) | Reply::Done(_)) {
            bytes.extend(b"abc");
        }
        bytes
    });
    encoded.collect::<Vec<_>>().concat()
}

#[test]
fn damaged_replies_are_read_to_an_end() {
    let right = replies();
    assert_eq!(read_replies(&right), Some(1));
    let mut read = 0;
    for number in 0..INPUTS {
        let random = &mut Random::new(number, "replies");
        let mut bytes = right.clone();
        for _ in 0..=random.below(4) {
            let at = random.below(bytes.len());
            match random.pick(&[0, 1, 2, 3]) {
                0 => bytes.truncate(at),
                1 => bytes.insert(at, random.byte()),
                2 if !bytes.is_empty() => bytes[at] = random.byte(),
                _ => drop(bytes.drain(at..(at + random.below(9)).min(bytes.len()))),
            }
        }
        read += u64::from(read_replies(&bytes).is_some());
    }
    assert!(read > INPUTS / 1000, "some replies stay right: {read}");
}
