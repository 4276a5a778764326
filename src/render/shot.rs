//! Photons before a picture: shot on one thread, read by all.

use crate::options::PhotonsTaken;
use crate::trace::Tracer;
use std::time::Instant;

/// The tracer with photons, if the scene asks for them and some are kept, and what they took.
pub(super) fn with_photons(tracer: Tracer<'_>) -> (Tracer<'_>, Option<PhotonsTaken>) {
    let start = Instant::now();
    let Some(kept) = tracer.shoot() else {
        return (tracer, None);
    };
    if let Some(photons) = &tracer.world().photons
        && let Some(path) = &photons.settings.save_file
    {
        let _ = std::fs::write(path, crate::photons::write([&kept.surface, &kept.media]));
    }
    let taken = PhotonsTaken {
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
    (tracer, Some(taken))
}
