//! Moments as maps and the store write them. The clock itself is always the caller's.

use std::fmt;
use std::str::FromStr;

/// Milliseconds since 1970-01-01T00:00:00 UTC. Printed and read as `2026-11-21T09:30:00.000Z`.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    Default,
    serde::Serialize,
    serde::Deserialize,
)]
#[serde(try_from = "String", into = "String")]
pub struct Timestamp(pub i64);

const DAY_MS: i64 = 86_400_000;

impl Timestamp {
    /// Hours from an earlier moment to this one; negative when it is a later one.
    #[must_use]
    pub fn hours_since(self, earlier: Self) -> f64 {
        self.0.saturating_sub(earlier.0) as f64 / 3_600_000.0
    }
}

impl Timestamp {
    /// As people read it: `2026-11-21 09:30:00 UTC`.
    #[must_use]
    pub fn in_words(self) -> String {
        let text = self.to_string();
        let (date, time) = text.split_once('T').unwrap_or((&text, ""));
        format!("{date} {} UTC", time.get(..8).unwrap_or(time))
    }
}

impl From<std::time::SystemTime> for Timestamp {
    fn from(time: std::time::SystemTime) -> Self {
        let ms = |d: std::time::Duration| i64::try_from(d.as_millis()).unwrap_or(i64::MAX);
        Self(match time.duration_since(std::time::UNIX_EPOCH) {
            Ok(after) => ms(after),
            Err(before) => -ms(before.duration()),
        })
    }
}

impl fmt::Display for Timestamp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (year, month, day) = civil(self.0.div_euclid(DAY_MS));
        let ms = self.0.rem_euclid(DAY_MS);
        let (hour, minute) = (ms / 3_600_000, ms / 60_000 % 60);
        let (second, rest) = (ms / 1000 % 60, ms % 1000);
        write!(f, "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{rest:03}Z")
    }
}

/// A text that is no moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimestampError;

impl TryFrom<String> for Timestamp {
    type Error = TimestampError;

    fn try_from(text: String) -> Result<Self, TimestampError> {
        text.parse()
    }
}

impl From<Timestamp> for String {
    fn from(time: Timestamp) -> Self {
        time.to_string()
    }
}

impl FromStr for Timestamp {
    type Err = TimestampError;

    /// Also without the milliseconds or the seconds, and a bare date as its midnight.
    fn from_str(text: &str) -> Result<Self, TimestampError> {
        let (date, time) = text.split_once(['T', ' ']).unwrap_or((text, "00:00:00"));
        let time = time.strip_suffix('Z').unwrap_or(time);
        let (time, ms) = time.split_once('.').unwrap_or((time, "0"));
        let parts = |text: &str, by: char| -> Result<[i64; 3], TimestampError> {
            let parts: Vec<i64> =
                text.split(by).map(number).collect::<Option<_>>().ok_or(TimestampError)?;
            parts.try_into().map_err(|_too_many_or_few: Vec<i64>| TimestampError)
        };
        let [year, month, day] = parts(date, '-')?;
        let whole = if time.matches(':').count() == 1 { &format!("{time}:00") } else { time };
        let [hour, minute, second] = parts(whole, ':')?;
        let ms = match ms.len() {
            1..=3 => number(ms).ok_or(TimestampError)? * 10i64.pow(3 - ms.len() as u32),
            _ => return Err(TimestampError),
        };
        let days = days(year, month, day);
        let fits = year <= 9999 && hour < 24 && minute < 60 && second < 60;
        if !fits || civil(days) != (year, month, day) {
            return Err(TimestampError);
        }
        Ok(Self(days * DAY_MS + ((hour * 60 + minute) * 60 + second) * 1000 + ms))
    }
}

fn number(digits: &str) -> Option<i64> {
    let plain = (1..=4).contains(&digits.len()) && digits.bytes().all(|b| b.is_ascii_digit());
    if plain { digits.parse().ok() } else { None }
}

/// Year, month, day of a day counted from 1970-01-01. After H. Hinnant, "chrono-compatible low-level date
/// algorithms": years begin in March, so that the leap day is the last of its year.
fn civil(days: i64) -> (i64, i64, i64) {
    let z = days + 719_468;
    let era = z.div_euclid(146_097);
    let of_era = z.rem_euclid(146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let march_month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * march_month + 2) / 5 + 1;
    let month = if march_month < 10 { march_month + 3 } else { march_month - 9 };
    (year_of_era + era * 400 + i64::from(month <= 2), month, day)
}

/// The inverse of [`civil`].
fn days(year: i64, month: i64, day: i64) -> i64 {
    let y = year - i64::from(month <= 2);
    let era = y.div_euclid(400);
    let year_of_era = y.rem_euclid(400);
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + of_year - 719_468
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_written_as_everyone_writes_them() {
        assert_eq!(Timestamp(0).to_string(), "1970-01-01T00:00:00.000Z");
        assert_eq!(Timestamp(951_827_696_789).to_string(), "2000-02-29T12:34:56.789Z");
        assert_eq!(Timestamp(-1).to_string(), "1969-12-31T23:59:59.999Z");
    }

    #[test]
    fn what_is_written_is_read() {
        for ms in (-2_000_000_000_000..4_000_000_000_000).step_by(86_311_111_117) {
            assert_eq!(Timestamp(ms).to_string().parse(), Ok(Timestamp(ms)));
        }
        assert_eq!("2000-02-29".parse(), Ok(Timestamp(951_782_400_000)));
        assert_eq!("2000-02-29T00:01Z".parse(), Ok(Timestamp(951_782_460_000)));
        for wrong in ["", "вчера", "2001-02-29", "2000-13-01", "2000-01-01T25:00:00Z", "1-2-3-4"]
        {
            assert!(wrong.parse::<Timestamp>().is_err(), "{wrong}");
        }
    }
}
