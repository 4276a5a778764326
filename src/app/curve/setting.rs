//! The settings to measure: the program, and its switches.

use serde::{Deserialize, Serialize};

use crate::base::options::Sampling;

/// A program and a kind of method: the settings of one family are a line of the plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// This program without antialiasing.
    Centres,
    /// This program, with adaptive sampling.
    Converging,
    /// This program with POV-Ray's methods.
    Grid,
    /// POV-Ray itself.
    PovRay,
}

impl Family {
    /// All of them, in the order of legends.
    pub const ALL: [Family; 4] = [
        Family::Converging,
        Family::Grid,
        Family::PovRay,
        Family::Centres,
    ];

    /// The name in legends.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Family::Centres => "povr, one ray per pixel",
            Family::Converging => "povr --error",
            Family::Grid => "povr +AM1 +AM2",
            Family::PovRay => "POV-Ray",
        }
    }

    /// The colour in the plot and on the page, distinct for people with colour blindness too (Okabe and Ito 2008).
    #[must_use]
    pub fn color(self) -> (u8, u8, u8) {
        match self {
            Family::Centres => (90, 90, 90),
            Family::Converging => (0, 114, 178),
            Family::Grid => (0, 158, 115),
            Family::PovRay => (213, 94, 0),
        }
    }
}

/// A setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The program and kind of method.
    pub family: Family,
    /// The switches as typed.
    pub switches: String,
    /// The sampling of this program; ignored for POV-Ray.
    pub sampling: Sampling,
}

impl Setting {
    /// A unique name: the program and the switches.
    #[must_use]
    pub fn name(&self) -> String {
        match self.family {
            Family::PovRay => format!("povray {}", self.switches),
            _ => format!("povr {}", self.switches),
        }
    }

    /// A file name for the setting.
    #[must_use]
    pub fn file_stem(&self) -> String {
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() || ".-+".contains(c) {
                c
            } else {
                '_'
            }
        };
        self.name().chars().map(plain).collect()
    }
}

/// The default settings: halved errors for this program, and for POV-Ray's methods the ones with the best quality for
/// their cost, and the usual ones.
pub const USUAL: &[&str] = &[
    "-A",
    "--error 16",
    "--error 8",
    "--error 4",
    "--error 2",
    "--error 1",
    "--error 0.5",
    "--error 0.25",
    "+A0.3 +AM1 +R3 -J",
    "+A0.3 +AM1 +R9 -J",
    "+A0.1 +AM1 +R2 -J",
    "+A0.1 +AM1 +R4 -J",
    "+A0.03 +AM1 +R4 -J",
    "+A0.03 +AM1 +R9 -J",
    "+A0.0 +AM1 +R4 -J",
    "+A0.0 +AM1 +R9 -J",
    "+A0.3 +AM2 +R3 -J",
    "+A0.0 +AM2 +R3 -J",
    "+A0.0 +AM2 +R4 -J",
];
