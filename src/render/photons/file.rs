//! Photon maps in the format of POV-Ray's `save_file`.

use super::{Map, Photon};
use crate::scene::light::photon_file::{RECORD_SIZE, records};

/// The bytes of a file with the photons of both maps.
#[must_use]
pub fn write(maps: [&Map; 2]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for map in maps {
        let photons = map.photons();
        bytes.extend(u32::try_from(photons.len()).unwrap_or(0).to_le_bytes());
        for photon in photons {
            bytes.extend(photon.position.iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend(photon.light);
            bytes.push(photon.axis);
            bytes.extend(photon.from.map(|angle| angle.to_le_bytes()[0]));
            bytes.push(0);
        }
    }
    bytes
}

/// The two maps of a file; a missing map is empty. `None` if the format is wrong.
#[must_use]
pub fn read(bytes: &[u8]) -> Option<[Map; 2]> {
    let mut maps = [Map::default(), Map::default()];
    for (map, records) in maps.iter_mut().zip(records(bytes)?) {
        let photons = records.chunks_exact(RECORD_SIZE).map(photon);
        *map = Map::of_sorted(photons.collect::<Option<_>>()?);
    }
    Some(maps)
}

fn photon(record: &[u8]) -> Option<Photon> {
    let (coordinates, rest) = record.split_at_checked(12)?;
    let mut photon = Photon::default();
    for (x, bytes) in photon.position.iter_mut().zip(coordinates.chunks_exact(4)) {
        *x = f32::from_le_bytes(bytes.try_into().ok()?);
    }
    let (light, rest) = rest.split_first_chunk::<4>()?;
    photon.light = *light;
    let [axis, rise, around, ..] = *rest else {
        return None;
    };
    photon.axis = axis;
    photon.from = [rise, around].map(|byte| i8::from_le_bytes([byte]));
    Some(photon)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use glam::DVec3;

    #[test]
    fn a_file_holds_both_maps() {
        let photon = Photon::new(
            DVec3::new(1.0, 2.0, -3.5),
            Rgb::WHITE,
            DVec3::new(4.0, -5.0, 0.0),
        );
        let maps = [
            Map::new(vec![photon; 3]),
            Map::new(vec![Photon::default(); 2]),
        ];
        let bytes = write([&maps[0], &maps[1]]);
        assert_eq!(bytes.len(), 8 + 5 * RECORD_SIZE);
        let [surface, media] = read(&bytes).unwrap();
        assert_eq!(surface.photons(), maps[0].photons());
        assert_eq!(media.photons(), maps[1].photons());
        assert!(read(&bytes[..bytes.len() - 1]).is_none());
        assert!(read(&bytes[..4 + 3 * RECORD_SIZE]).unwrap()[1].is_empty());
    }
}
