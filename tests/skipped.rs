//! The last of the tests, without a harness: shows which tests of `tests/main.rs` were skipped, and why.
//!
//! Cargo runs test binaries in the order of their names, `all` before `skipped`. The list stays in
//! `target/skipped-tests.txt`.

use std::io::ErrorKind;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let list = folder.join("skipped-tests.txt");
    let skipped = match std::fs::read_to_string(&list) {
        Ok(text) => text,
        // `cargo test --test skipped` alone: no test has run.
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(error),
    };
    let mut lines: Vec<&str> = skipped.lines().collect();
    lines.sort_unstable();
    lines.dedup();
    let shown = lines.iter().map(|line| format!("{line}\n")).collect::<String>();
    std::fs::write(folder.with_file_name("skipped-tests.txt"), &shown)?;
    std::fs::remove_file(list)?;
    println!("{shown}{} tests skipped for what is missing here", lines.len());
    Ok(())
}
