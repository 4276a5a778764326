//! `datetime`: days since the start of 2000 as text, by C's `strftime` in the C locale, in UTC.

use std::fmt::Write;

/// The format of `datetime` where the scene gives none.
pub(crate) const DEFAULT: &str = "%Y-%m-%d %H:%M:%SZ";
/// Days are clamped to this: some 270,000 years around 2000, more than a year of four digits needs.
const MAX_DAYS: f64 = 1e8;

const SECONDS_1970_TO_2000: i64 = 946_684_800;
const SECONDS_A_DAY: i64 = 86_400;
const DAYS: [&str; 7] = [
    "Sunday",
    "Monday",
    "Tuesday",
    "Wednesday",
    "Thursday",
    "Friday",
    "Saturday",
];
const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

/// A calendar date and time of day.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Moment {
    seconds_since_1970: i64,
    year: i64,
    /// 0 to 11.
    month: usize,
    /// 1 to 31.
    day: i64,
    hour: i64,
    minute: i64,
    second: i64,
    /// 0 is Sunday.
    weekday: usize,
    /// 0 to 365.
    day_of_year: i64,
}

/// The text of a moment; seconds are rounded.
pub(crate) fn text(days_since_2000: f64, format: &str) -> String {
    let days = days_since_2000.clamp(-MAX_DAYS, MAX_DAYS);
    #[allow(clippy::cast_possible_truncation, reason = "clamped just above")]
    let seconds = (days * SECONDS_A_DAY as f64 + 0.5).floor() as i64;
    let moment = Moment::new(SECONDS_1970_TO_2000 + seconds);
    let mut out = String::new();
    let mut rest = format.chars();
    while let Some(c) = rest.next() {
        if c != '%' {
            out.push(c);
            continue;
        }
        match rest.next() {
            Some(letter) => moment.write(letter, &mut out),
            None => out.push('%'),
        }
    }
    out
}

impl Moment {
    fn new(seconds_since_1970: i64) -> Self {
        let days = seconds_since_1970.div_euclid(SECONDS_A_DAY);
        let seconds = seconds_since_1970.rem_euclid(SECONDS_A_DAY);
        // Years that begin in March have their leap day at the end (Howard Hinnant 2021, "chrono-compatible low-level
        // date algorithms"): 1970 began 719468 days after 1 March of year 0.
        let from_march = days + 719_468;
        let era = from_march.div_euclid(146_097);
        let day_of_era = from_march.rem_euclid(146_097);
        let year_of_era =
            (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
        let day = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let month = (5 * day + 2) / 153;
        let is_next_year = month >= 10;
        let year = 400 * era + year_of_era + i64::from(is_next_year);
        let month_of_year = if is_next_year { month - 10 } else { month + 2 };
        let january_on = if is_next_year {
            day - 306
        } else {
            day + 59 + i64::from(is_leap(year))
        };
        Moment {
            seconds_since_1970,
            year,
            month: usize::try_from(month_of_year).unwrap_or(0),
            day: day - (153 * month + 2) / 5 + 1,
            hour: seconds / 3600,
            minute: seconds / 60 % 60,
            second: seconds % 60,
            weekday: usize::try_from((days + 4).rem_euclid(7)).unwrap_or(0),
            day_of_year: january_on,
        }
    }

    /// Writes the field of a `%` letter; an unknown letter stays as it is.
    fn write(&self, letter: char, out: &mut String) {
        let month = MONTHS[self.month % 12];
        let weekday = DAYS[self.weekday % 7];
        let number = self.month as i64 + 1;
        let hour_of_12 = (self.hour + 11) % 12 + 1;
        let (week_year, week) = self.iso_week();
        // Writing to a string never fails.
        let _ = match letter {
            'a' => write!(out, "{}", &weekday[..3]),
            'A' => write!(out, "{weekday}"),
            'b' | 'h' => write!(out, "{}", &month[..3]),
            'B' => write!(out, "{month}"),
            'c' => self.parts("a b e T Y", out),
            'C' => write!(out, "{:02}", self.year.div_euclid(100)),
            'd' => write!(out, "{:02}", self.day),
            'D' | 'x' => self.parts("m/d/y", out),
            'e' => write!(out, "{:2}", self.day),
            'F' => self.parts("Y-m-d", out),
            'g' => write!(out, "{:02}", week_year.rem_euclid(100)),
            'G' => write!(out, "{week_year}"),
            'H' => write!(out, "{:02}", self.hour),
            'I' => write!(out, "{hour_of_12:02}"),
            'j' => write!(out, "{:03}", self.day_of_year + 1),
            'k' => write!(out, "{:2}", self.hour),
            'l' => write!(out, "{hour_of_12:2}"),
            'm' => write!(out, "{number:02}"),
            'M' => write!(out, "{:02}", self.minute),
            'n' => writeln!(out),
            'p' => write!(out, "{}", if self.hour < 12 { "AM" } else { "PM" }),
            'P' => write!(out, "{}", if self.hour < 12 { "am" } else { "pm" }),
            'r' => self.parts("I:M:S p", out),
            'R' => self.parts("H:M", out),
            's' => write!(out, "{}", self.seconds_since_1970),
            'S' => write!(out, "{:02}", self.second),
            't' => write!(out, "\t"),
            'T' | 'X' => self.parts("H:M:S", out),
            'u' => write!(out, "{}", (self.weekday + 6) % 7 + 1),
            'U' => write!(out, "{:02}", self.week(0)),
            'V' => write!(out, "{week:02}"),
            'w' => write!(out, "{}", self.weekday),
            'W' => write!(out, "{:02}", self.week(1)),
            'y' => write!(out, "{:02}", self.year.rem_euclid(100)),
            'Y' => write!(out, "{}", self.year),
            // The zone is not known to be UTC, and has no name.
            'z' | 'Z' => Ok(()),
            '%' => write!(out, "%"),
            other => write!(out, "%{other}"),
        };
    }

    /// Several fields, with the characters between them.
    fn parts(&self, letters: &str, out: &mut String) -> std::fmt::Result {
        for c in letters.chars() {
            if c.is_ascii_alphabetic() {
                self.write(c, out);
            } else {
                out.push(c);
            }
        }
        Ok(())
    }

    /// The week of the year; weeks begin on `first`, and days before the first such weekday are in week 0.
    fn week(&self, first: usize) -> i64 {
        let since = (self.weekday + 7 - first) % 7;
        (self.day_of_year + 7 - since as i64) / 7
    }

    /// Year and week by ISO 8601: the first week is the one that holds 4 January.
    fn iso_week(&self) -> (i64, i64) {
        let thursday = self.day_of_year + 3 - (self.weekday as i64 + 6) % 7;
        let days = |year| 365 + i64::from(is_leap(year));
        if thursday < 0 {
            let year = self.year - 1;
            (year, (thursday + days(year)) / 7 + 1)
        } else if thursday >= days(self.year) {
            (self.year + 1, (thursday - days(self.year)) / 7 + 1)
        } else {
            (self.year, thursday / 7 + 1)
        }
    }
}

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All measured with POV-Ray.
    #[test]
    fn moments_are_written_as_by_pov_ray() {
        assert_eq!(text(0.0, DEFAULT), "2000-01-01 00:00:00Z");
        assert_eq!(text(7.25, DEFAULT), "2000-01-08 06:00:00Z");
        assert_eq!(text(100.5, "%Y-%m-%d %H:%M:%S"), "2000-04-10 12:00:00");
        assert_eq!(
            text(3000.0, "%j %y %a %B %A %b"),
            "079 08 Wed March Wednesday Mar"
        );
        assert_eq!(text(-1.0, "%c"), "Fri Dec 31 00:00:00 1999");
        assert_eq!(
            text(3000.123456, "%x %X %p %I %U %w %Z %%"),
            "03/19/08 02:57:47 AM 02 11 3  %"
        );
        assert_eq!(
            text(3000.123456, "%D %e %F %h %R %T %u %V %G %C %n %t %z %s"),
            "03/19/08 19 2008-03-19 Mar 02:57 02:57:47 3 12 2008 20 \n \t  1205895467"
        );
    }

    #[test]
    fn weeks_at_the_ends_of_years_belong_to_the_year_of_their_thursday() {
        // 1 January 2005 was a Saturday, 31 December 2008 a Wednesday.
        assert_eq!(text(1827.0, "%F %G-%V %U %W"), "2005-01-01 2004-53 00 00");
        assert_eq!(text(3287.0, "%F %G-%V %j"), "2008-12-31 2009-01 366");
        assert_eq!(text(59.0, "%F %j"), "2000-02-29 060");
    }

    #[test]
    fn no_number_of_days_is_too_large() {
        assert_eq!(text(f64::INFINITY, "%H"), "00");
        assert_eq!(text(f64::NAN, "%H"), "00");
        assert_eq!(text(0.0, "%Q%"), "%Q%");
    }
}
