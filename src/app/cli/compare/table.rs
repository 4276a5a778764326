//! A comparison as text: a table for people, and one object a line for programs.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use super::row::{Row, Status};

/// With more scenes than this, those that pass get no line of their own.
const SHORT_LIST: usize = 60;

/// Statistics of a missing keyword.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Missing {
    /// The keyword.
    pub(super) word: String,
    /// Scenes that use it.
    pub(super) scenes: usize,
    /// Scenes that lack nothing else.
    pub(super) alone: usize,
}

/// Totals of a run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Total {
    pub(super) scenes: usize,
    pub(super) counts: BTreeMap<Status, usize>,
    /// Seconds of both, over the scenes that both have rendered.
    pub(super) povray_seconds: f64,
    pub(super) povr_seconds: f64,
    /// The geometric mean of povr's speed relative to POV-Ray.
    pub(super) faster: Option<f64>,
    pub(super) missing: Vec<Missing>,
}

#[derive(Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Line<'a> {
    Comparison(&'a Row),
    Total(&'a Total),
}

impl Total {
    pub(super) fn of(rows: &[Row]) -> Total {
        let mut total = Total {
            scenes: rows.len(),
            counts: BTreeMap::new(),
            povray_seconds: 0.0,
            povr_seconds: 0.0,
            faster: None,
            missing: Vec::new(),
        };
        let mut words: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
        let (mut logarithms, mut ratios) = (0.0, 0.0);
        for row in rows {
            *total.counts.entry(row.status).or_default() += 1;
            if let Some(ratio) = row.ratio() {
                total.povray_seconds += row.povray_seconds.unwrap_or(0.0);
                total.povr_seconds += row.povr_seconds.unwrap_or(0.0);
                logarithms += ratio.ln();
                ratios += 1.0;
            }
            for word in &row.missing {
                let count = words.entry(word).or_default();
                count.0 += 1;
                count.1 += usize::from(row.missing.len() == 1);
            }
        }
        total.faster = (ratios > 0.0).then(|| (logarithms / ratios).exp());
        let counted = words.into_iter().map(|(word, (scenes, alone))| Missing {
            word: word.to_owned(),
            scenes,
            alone,
        });
        total.missing = counted.collect();
        total
            .missing
            .sort_by_key(|missing| std::cmp::Reverse(missing.scenes));
        total
    }

    /// The worst of all exit codes, in this order: difference, size, not rendered, warning.
    pub(super) fn exit_code(&self) -> u8 {
        let codes = self.counts.keys().map(|status| status.exit_code());
        let rank = |code: &u8| [0, 1, 4, 3, 2].iter().position(|one| one == code);
        codes.max_by_key(rank).unwrap_or(0)
    }

    /// `5 PASS, 1 FAILURE`.
    pub(super) fn counts(&self) -> String {
        let counts = self.counts.iter();
        let each = counts.map(|(status, count)| format!("{count} {}", status.title()));
        each.collect::<Vec<_>>().join(", ")
    }
}

/// One object a line, and one for the totals.
pub(super) fn json(rows: &[Row], total: &Total) -> String {
    let lines = rows.iter().map(Line::Comparison);
    let lines = lines.chain([Line::Total(total)]);
    let lines = lines.filter_map(|line| serde_json::to_string(&line).ok());
    lines.map(|line| line + "\n").collect()
}

/// The table, worst first.
pub(super) fn text(rows: &[Row], total: &Total) -> String {
    let shown: Vec<&Row> = rows
        .iter()
        .filter(|row| {
            rows.len() <= SHORT_LIST || row.status > Status::Pass || row.status < Status::Pass
        })
        .collect();
    let wide = shown.iter().map(|row| row.name.chars().count()).max();
    let wide = wide.unwrap_or(0).clamp(5, 48);
    let mut text = format!(
        "{:<15} {:<wide$} {:>9} {:>9} {:>8} {:>7} {:>5} {:>7} {:>9} {:>8}\n",
        "", "scene", "differ %", "by >1 %", "RMS", "PSNR", "max", "FLIP", "POV-Ray s", "povr s"
    );
    for row in &shown {
        let _ = writeln!(text, "{}", line(row, wide).trim_end());
    }
    if shown.len() < rows.len() {
        let _ = writeln!(text, "and {} that pass", rows.len() - shown.len());
    }
    if !total.missing.is_empty() {
        text += "\nscenes  lack nothing else  missing word\n";
        for Missing {
            word,
            scenes,
            alone,
        } in &total.missing
        {
            let _ = writeln!(text, "{scenes:6}  {alone:17}  {word}");
        }
    }
    let _ = write!(text, "\n{} scenes: {}", total.scenes, total.counts());
    if let Some(faster) = total.faster {
        let _ = write!(
            text,
            "\nwhere both draw: POV-Ray {:.2} s, povr {:.2} s; povr is {faster:.1} times as fast (geometric mean)",
            total.povray_seconds, total.povr_seconds
        );
    }
    text.push('\n');
    text
}

fn line(row: &Row, wide: usize) -> String {
    let title = row.status.title();
    let seconds = |seconds: Option<f64>| seconds.map_or_else(String::new, |s| format!("{s:.3}"));
    let times = format!(
        "{:>9} {:>8}",
        seconds(row.povray_seconds),
        seconds(row.povr_seconds)
    );
    let Some(n) = &row.numbers else {
        return format!("{title:<15} {:<wide$} {}", row.name, row.why);
    };
    let many = 100.0 * crate::app::compare::as_f64(n.off_by_many)
        / crate::app::compare::as_f64(n.pixels.max(1));
    let psnr = n
        .psnr
        .map_or_else(|| "∞".to_owned(), |psnr| format!("{psnr:.1}"));
    let max = if n.full > 1.0 {
        format!("{:.0}", n.max)
    } else {
        format!("{:.4}", n.max)
    };
    let why = match row.why.as_str() {
        "" => String::new(),
        why => format!("\n{:<15} {why}", ""),
    };
    format!(
        "{title:<15} {:<wide$} {:>9.3} {many:>9.3} {:>8.3} {psnr:>7} {max:>5} {:>7.4} {times}{why}",
        row.name, n.differing_percent, n.rms, n.flip
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, status: Status, missing: &[&str]) -> Row {
        let mut row = Row::unread(name, "");
        row.status = status;
        row.missing = missing.iter().map(|&word| word.to_owned()).collect();
        row
    }

    #[test]
    fn missing_words_are_counted_with_what_would_be_gained() {
        let rows = [
            row("a", Status::Missing, &["media"]),
            row("b", Status::Missing, &["media", "normal"]),
            row("c", Status::Missing, &["normal"]),
            row("d", Status::Missing, &["media"]),
            row("e", Status::Pass, &[]),
        ];
        let total = Total::of(&rows);
        let counted: Vec<_> = total
            .missing
            .iter()
            .map(|m| (m.word.as_str(), m.scenes, m.alone))
            .collect();
        assert_eq!(counted, [("media", 3, 2), ("normal", 2, 1)]);
        assert_eq!(total.counts(), "4 MISSING, 1 PASS");
        let lines = json(&rows, &total);
        assert_eq!(lines.lines().count(), 6);
        assert!(
            lines
                .lines()
                .all(|line| serde_json::from_str::<serde_json::Value>(line).is_ok())
        );
    }

    #[test]
    fn the_exit_code_is_that_of_the_worst() {
        let code = |all: &[Status]| {
            let rows: Vec<_> = all.iter().map(|&status| row("a", status, &[])).collect();
            Total::of(&rows).exit_code()
        };
        assert_eq!(code(&[]), 0);
        assert_eq!(code(&[Status::Pass, Status::Refused]), 0);
        assert_eq!(code(&[Status::Pass, Status::Warning]), 1);
        assert_eq!(code(&[Status::Warning, Status::Missing]), 4);
        assert_eq!(code(&[Status::Late, Status::Size]), 3);
        assert_eq!(code(&[Status::Lost, Status::Size, Status::Failure]), 2);
    }
}
