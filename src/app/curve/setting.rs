//! The settings that are measured: which program draws, and with which switches.

use serde::{Deserialize, Serialize};

use crate::base::options::Sampling;

/// Who draws, and by which kind of method: the settings of one are a line of the plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// This program without antialiasing.
    Centres,
    /// This program, sampling until the error is small.
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

    /// What a legend calls it.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Family::Centres => "povr, one ray a pixel",
            Family::Converging => "povr --error",
            Family::Grid => "povr +AM1 +AM2",
            Family::PovRay => "POV-Ray",
        }
    }

    /// Its colour in the plot and on the page, told apart by people who see few colours too (Okabe and Ito 2008).
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
    /// Who draws.
    pub family: Family,
    /// The switches, as they are typed.
    pub switches: String,
    /// How this program samples; of no account for POV-Ray.
    pub sampling: Sampling,
}

impl Setting {
    /// What tells it from all others: who draws, and the switches.
    #[must_use]
    pub fn name(&self) -> String {
        match self.family {
            Family::PovRay => format!("povray {}", self.switches),
            _ => format!("povr {}", self.switches),
        }
    }

    /// Its name as that of a file.
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

/// What is measured unless somebody chooses: our errors by halves, and of POV-Ray's methods those that cost least for
/// what they give, and the usual ones.
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
