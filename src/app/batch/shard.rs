//! A part of a run, for one of several machines.

use std::str::FromStr;

/// One of several parts that make up the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// The number of this part, from 1.
    pub number: usize,
    /// The number of parts.
    pub of: usize,
}

impl Shard {
    /// The part for a task of a Slurm array, from its environment variables: number, first, step and count of the
    /// array's tasks.
    #[must_use]
    pub fn of_slurm(variable: impl Fn(&str) -> Option<String>) -> Option<Self> {
        let number = |name: &str| variable(&format!("SLURM_ARRAY_TASK_{name}"))?.parse().ok();
        let (id, of): (usize, usize) = (number("ID")?, number("COUNT")?);
        let first = number("MIN").unwrap_or(1);
        let step = number("STEP").filter(|&step| step > 0).unwrap_or(1);
        let shard = Shard {
            number: id.checked_sub(first)? / step + 1,
            of,
        };
        // An array like 1,2,7 has no even steps: the part of a task cannot be derived.
        (shard.number <= of).then_some(shard)
    }

    /// True if an item of the work list is in this part. Items are interleaved, so that large neighbouring scenes go to
    /// different parts.
    #[must_use]
    pub fn has(self, index: usize) -> bool {
        index % self.of == self.number - 1
    }

    /// The name of its files.
    pub(super) fn name(shard: Option<Shard>) -> String {
        match shard {
            None | Some(Shard { of: 1, .. }) => "all".to_owned(),
            Some(Shard { number, of }) => format!("{number}-of-{of}"),
        }
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let parts = text.split_once('/');
        parts
            .and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)))
            .filter(|&(number, of)| (1..=of).contains(&number))
            .map(|(number, of)| Shard { number, of })
            .ok_or_else(|| "a part is written like 2/8: the second of eight".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_the_whole_and_share_nothing() {
        for of in 1..6 {
            let shards = (1..=of).map(|number| Shard { number, of });
            let shards: Vec<Shard> = shards.collect();
            for index in 0..20 {
                let owners = shards.iter().filter(|shard| shard.has(index)).count();
                assert_eq!(owners, 1, "{index} of {of}");
            }
        }
    }

    #[test]
    fn a_part_is_written_with_a_stroke() {
        assert_eq!("2/8".parse(), Ok(Shard { number: 2, of: 8 }));
        for text in ["0/8", "9/8", "2", "a/b", "2/", "1/0"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn tasks_of_slurm_are_parts() {
        let part = |id: &str, min: &str, step: &str, count: &str| {
            let values = [("ID", id), ("MIN", min), ("STEP", step), ("COUNT", count)];
            Shard::of_slurm(|name| {
                let value = values.iter().find(|(end, _)| name.ends_with(end))?;
                (!value.1.is_empty()).then(|| value.1.to_owned())
            })
        };
        let shard = |number, of| Some(Shard { number, of });
        assert_eq!(part("0", "0", "1", "4"), shard(1, 4));
        assert_eq!(part("4", "1", "1", "4"), shard(4, 4));
        assert_eq!(part("9", "1", "4", "3"), shard(3, 3));
        assert_eq!(part("7", "1", "1", "3"), None);
        assert_eq!(part("", "1", "1", "3"), None);
    }
}
