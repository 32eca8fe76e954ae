//! Numbers as arguments.

/// A number as angles, lengths and speeds are given.
pub(super) fn finite(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| "a number is wanted, such as 90 or -12.5".to_owned())
}
