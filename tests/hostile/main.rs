//! Untrusted scenes, and failing systems: each run ends soon, with a message or a picture, and changes nothing else on
//! disk.

#![cfg(unix)]

#[path = "../support/mod.rs"]
mod support;

mod files;
mod folder;
mod limits;
mod matrix;
mod pictures;
mod reproducers;
mod sandbox;
