//! How property tests draw their cases.

use proptest::test_runner::{Config, RngSeed};

/// The seed under `CI`, where the same commit must give the same answer each time.
const SEED: u64 = 1_234_567;

/// A property with so many cases: under `CI` always the same ones, elsewhere others in every run (`PROPTEST_RNG_SEED` sets a
/// seed). What failed once is kept in `proptest-regressions/`, and comes first in every later run.
pub fn property(cases: u32) -> Config {
    let config = Config { cases, ..Config::default() };
    let fixed = std::env::var_os("CI").is_some_and(|value| !["", "0", "false"].iter().any(|no| value == *no));
    match config.rng_seed {
        RngSeed::Random if fixed => Config { rng_seed: RngSeed::Fixed(SEED), ..config },
        _ => config,
    }
}
