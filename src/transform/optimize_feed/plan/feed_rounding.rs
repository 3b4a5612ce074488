//! This module rounds feeds down.

/// The relative difference that arithmetic leaves between equal numbers.
pub(super) const NOISE: f64 = 1e-12;

/// Rounds a feed down to a multiple of the step. The result is not below the lowest feed that the feed kept,
/// and not zero.
pub(super) fn round_to_step(feed: f64, least: f64, step: f64) -> f64 {
    if step <= 0.0 {
        return feed;
    }
    // A multiple of the step may come out of the division a hair too low. Without the noise it would lose a
    // whole step, and a second run would change the program again.
    let down = ((feed / step * (1.0 + NOISE)).floor() * step).min(feed);
    // A limit below the lowest feed has already been replaced by it, so rounding must not go below it.
    let down = if feed >= least { down.max(least) } else { down };
    if down > 0.0 { down } else { feed }
}
