//! The parser's shortcuts against the grammar, which defines the language, over ten million fuzzed statements.
//!
//! `cargo bench --bench agreement` ends with an error at the first difference. `CLSMITH_BENCH_STATEMENTS` sets how
//! many statements are compared, `CLSMITH_BENCH_SEED` which.

// Seeds of the tests that share it; what is picked is there.
#[allow(clippy::indexing_slicing)]
#[path = "../tests/support/fuzzed_statements.rs"]
mod fuzzed_statements;

use clsmith::internals::parse::compare_with_grammar;
use fuzzed_statements::FuzzedStatements;
use std::time::Instant;

fn main() -> Result<(), String> {
    let number =
        |name: &str, default| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default);
    let count = number("CLSMITH_BENCH_STATEMENTS", 10_000_000_u64);
    let seed = number("CLSMITH_BENCH_SEED", 1);
    let (mut taken, mut bytes) = (0_u64, 0_u64);
    let begun = Instant::now();
    for (text, _) in FuzzedStatements::new(seed).zip(0..count) {
        let (_, by_shortcut) = compare_with_grammar(&text)?;
        taken += u64::from(by_shortcut);
        bytes += text.len() as u64;
    }
    println!(
        "{count} statements ({} MB) agree, {taken} of them read by a shortcut, in {:.0} s",
        bytes / 1_000_000,
        begun.elapsed().as_secs_f64()
    );
    Ok(())
}
