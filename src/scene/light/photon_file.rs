//! Layout of photon files, POV-Ray's `save_file`: for surfaces and for media the count and then [`RECORD`] bytes for each
//! photon, little-endian.

/// The size of a photon in bytes.
pub const RECORD: usize = 20;

/// The records of the photons on surfaces and of those in media; a missing map is empty. `None` if the format is wrong.
#[must_use]
pub fn records(bytes: &[u8]) -> Option<[&[u8]; 2]> {
    let mut rest = bytes;
    let mut maps: [&[u8]; 2] = [&[]; 2];
    for map in &mut maps {
        if rest.is_empty() {
            break;
        }
        let (count, behind) = rest.split_first_chunk::<4>()?;
        let size = (u32::from_le_bytes(*count) as usize).checked_mul(RECORD)?;
        (*map, rest) = behind.split_at_checked(size)?;
    }
    Some(maps)
}
