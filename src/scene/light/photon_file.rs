//! Layout of photon map files (POV-Ray's `save_file`): the map of surfaces, then that of media. Each is a little-endian
//! 32-bit count followed by [`RECORD_SIZE`] bytes for each photon.

/// The size of a photon in bytes.
pub const RECORD_SIZE: usize = 20;

/// The photon records of surfaces and of media. A missing map is empty. `None` if the format is wrong.
#[must_use]
pub fn records(bytes: &[u8]) -> Option<[&[u8]; 2]> {
    let mut rest = bytes;
    let mut maps: [&[u8]; 2] = [&[]; 2];
    for map in &mut maps {
        if rest.is_empty() {
            break;
        }
        let (count, after) = rest.split_first_chunk::<4>()?;
        let size = (u32::from_le_bytes(*count) as usize).checked_mul(RECORD_SIZE)?;
        (*map, rest) = after.split_at_checked(size)?;
    }
    Some(maps)
}
