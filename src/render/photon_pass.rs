//! Photons before a picture: shot on one thread, read by all.

use crate::base::options::PhotonStatistics;
use crate::render::photons;
use crate::render::shade::Tracer;
use std::time::Instant;

/// Photons that were shot.
#[derive(Clone, Debug)]
pub struct PhotonPass {
    /// What they took.
    pub taken: PhotonStatistics,
    /// The bytes of the file in which the scene wants them.
    pub file: Option<Vec<u8>>,
}

/// The tracer with photons, if the scene asks for them and some are kept, and what is to be told of them.
pub(super) fn with_photons(tracer: Tracer<'_>) -> (Tracer<'_>, Option<PhotonPass>) {
    let start = Instant::now();
    let Some(kept) = tracer.emit_photons() else {
        return (tracer, None);
    };
    let settings = tracer.world().photons.as_ref();
    let is_saved = settings.is_some_and(|photons| photons.settings.save_file.is_some());
    let file = is_saved.then(|| photons::write([&kept.surface, &kept.media]));
    let taken = PhotonStatistics {
        shot: kept.shot,
        on_surfaces: kept.surface.photons().len(),
        in_media: kept.media.photons().len(),
        bytes: kept.bytes(),
        radius: kept.on_surfaces.radius,
        seconds: start.elapsed().as_secs_f64(),
    };
    let is_any = taken.on_surfaces + taken.in_media > 0;
    let tracer = if is_any {
        tracer.with_photons(kept)
    } else {
        tracer
    };
    (tracer, Some(PhotonPass { taken, file }))
}
