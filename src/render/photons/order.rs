//! The k-d tree order of a photon map, in an array (Bentley 1975): the middle photon of a range divides those before it
//! from those behind it along one axis, recursively.

use super::Photon;

/// Sorts photons into tree order and sets their splitting axes.
pub(super) fn sort(photons: &mut [Photon]) {
    if photons.len() <= 1 {
        return;
    }
    let axis = widest_axis(photons);
    let middle = (photons.len() - 1) / 2;
    // A range of two is left unsorted, as in POV-Ray: a search may miss one of them.
    if photons.len() > 2 {
        select(photons, middle, axis);
    }
    photons[middle].axis = axis;
    let (before, behind) = photons.split_at_mut(middle);
    sort(before);
    sort(&mut behind[1..]);
}

/// The axis of the largest extent, the first of equal ones.
fn widest_axis(photons: &[Photon]) -> u8 {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for photon in photons {
        for (axis, &x) in photon.position.iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    let width = |axis: usize| high[axis] - low[axis];
    let mut widest = 0;
    for axis in 1..3 {
        if width(axis) > width(widest) {
            widest = axis;
        }
    }
    u8::try_from(widest).unwrap_or(0)
}

/// Selects the photon of a rank along an axis, with lesser ones before it and greater ones behind (Hoare 1961), in the
/// exact steps of POV-Ray: all photons end up in its order. Of the last two the greater comes first, so one may lie on
/// the wrong side, where searches may miss it.
fn select(photons: &mut [Photon], rank: usize, axis: u8) {
    let axis = usize::from(axis);
    let (mut left, mut right) = (0, photons.len() - 1);
    let swap_if_more = |photons: &mut [Photon], a: usize, b: usize| {
        if photons[a].position[axis] > photons[b].position[axis] {
            photons.swap(a, b);
        }
    };
    while left < right {
        photons.swap(usize::midpoint(left, right), left + 1);
        swap_if_more(photons, left + 1, right);
        swap_if_more(photons, left, right);
        swap_if_more(photons, left + 1, left);
        let pivot = photons[left].position[axis];
        let (mut up, mut down) = (left + 1, right);
        while up <= down {
            up += 1;
            while up <= right && photons[up].position[axis] < pivot {
                up += 1;
            }
            down -= 1;
            while down > left && photons[down].position[axis] > pivot {
                down -= 1;
            }
            if up < down {
                photons.swap(up, down);
            }
        }
        photons.swap(left, down);
        if rank < down {
            right = down - 1;
        } else if rank > down {
            left = down + 1;
        } else {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;
    use glam::DVec3;

    /// Pseudo-random numbers below 1.
    fn scattered(count: u32) -> Vec<Photon> {
        let position = |number: u32| {
            let part = |factor: f64| (f64::from(number) * factor).fract();
            DVec3::new(part(0.618_034), part(0.324_717), part(0.819_173))
        };
        (0..count)
            .map(|number| Photon::new(position(number), Rgb::WHITE, DVec3::Y))
            .collect()
    }

    fn check(photons: &[Photon]) {
        if photons.len() <= 2 {
            return;
        }
        let middle = (photons.len() - 1) / 2;
        let axis = usize::from(photons[middle].axis);
        let at = photons[middle].position[axis];
        let (before, behind) = (&photons[..middle], &photons[middle + 1..]);
        let more = before.iter().filter(|photon| photon.position[axis] > at);
        let less = behind.iter().filter(|photon| photon.position[axis] < at);
        assert!(more.count() + less.count() <= 1);
        check(before);
        check(behind);
    }

    #[test]
    fn each_median_splits_its_range_except_for_one() {
        for count in [0, 1, 2, 3, 4, 5, 17, 1000] {
            let mut photons = scattered(count);
            sort(&mut photons);
            check(&photons);
        }
        let mut same = vec![Photon::default(); 50];
        sort(&mut same);
        check(&same);
    }
}
