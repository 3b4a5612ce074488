//! This module rounds the numbers of reports to six decimals: nanometres and micronewtons, far below the
//! precision of the model.

/// Rounds a number to at most six decimals. The result is never `-0`.
pub(super) fn round_to_micro(value: f64) -> f64 {
    let scaled = value * 1e6;
    // Beyond 2^53 there are no decimals to round.
    if scaled.abs() < 9e15 { scaled.round() / 1e6 + 0.0 } else { value }
}
