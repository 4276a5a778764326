//! The `povr` command.

fn main() {}
