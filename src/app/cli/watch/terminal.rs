//! The picture in the terminal, if it has graphics: by the protocols of kitty and iTerm, by sixels, else by coloured
//! half-block characters.

use std::io::{IsTerminal, stdout};

/// Rows of a preview in the terminal, and of a picture.
const ROWS: (u32, u32) = (12, 24);

/// Shows a picture on standard output, if that is a terminal.
pub(super) fn show(png: &[u8], is_preview: bool) {
    if !stdout().is_terminal() {
        return;
    }
    let Ok(picture) = image::load_from_memory(png) else {
        return;
    };
    let config = viuer::Config {
        absolute_offset: false,
        height: Some(if is_preview { ROWS.0 } else { ROWS.1 }),
        ..viuer::Config::default()
    };
    // A terminal without graphics shows nothing.
    let _ = viuer::print(&picture, &config);
}
