//! The photon pass before a picture: emitted on one thread, read by all.

use crate::base::options::PhotonStatistics;
use crate::render::photons;
use crate::render::shade::{Emission, Tracer};
use std::time::Instant;

/// The photons of a picture.
#[derive(Clone, Debug)]
pub struct PhotonPass {
    /// Photon statistics.
    pub taken: PhotonStatistics,
    /// The contents of the file in which the scene saves them.
    pub file: Option<Vec<u8>>,
    /// False if there was no memory for all photons; then nothing was rendered.
    pub is_complete: bool,
}

/// The tracer with photon maps, if the scene uses photon mapping and some photons are stored, and a report of them.
pub(super) fn with_photons(tracer: Tracer<'_>) -> (Tracer<'_>, Option<PhotonPass>) {
    let start = Instant::now();
    let maps = match tracer.emit_photons() {
        None => return (tracer, None),
        Some(Emission::OutOfMemory) => {
            let pass = PhotonPass {
                taken: PhotonStatistics::default(),
                file: None,
                is_complete: false,
            };
            return (tracer, Some(pass));
        }
        Some(Emission::Maps(maps)) => *maps,
    };
    let settings = tracer.world().photons.as_ref();
    let is_saved = settings.is_some_and(|photons| photons.settings.save_file.is_some());
    let file = is_saved.then(|| photons::write([&maps.surface, &maps.media]));
    let taken = PhotonStatistics {
        shot: maps.emitted,
        on_surfaces: maps.surface.photons().len(),
        in_media: maps.media.photons().len(),
        bytes: maps.bytes(),
        radius: maps.on_surfaces.radius,
        seconds: start.elapsed().as_secs_f64(),
    };
    let is_any = taken.on_surfaces + taken.in_media > 0;
    let tracer = if is_any {
        tracer.with_photons(maps)
    } else {
        tracer
    };
    let pass = PhotonPass {
        taken,
        file,
        is_complete: true,
    };
    (tracer, Some(pass))
}
