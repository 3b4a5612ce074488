//! This module takes memory whose size comes from a user's file or setup, so that memory that is not there is an
//! error of that file and does not end the process.

use std::sync::atomic::{AtomicU64, Ordering};

/// There is no memory for what a file or setup asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("there is no memory for {what}: {:.1} MB", *bytes as f64 / 1e6)]
pub struct NoMemory {
    /// What it was for.
    pub what: &'static str,
    /// How much was asked for, in bytes.
    pub bytes: u64,
}

/// Makes an empty vector with room for `count` values.
///
/// # Errors
/// Returns an error if there is no memory for them.
pub(crate) fn reserve_values<T>(count: usize, what: &'static str) -> Result<Vec<T>, NoMemory> {
    let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
    let mut values = Vec::new();
    if is_refused_for_test(bytes) || values.try_reserve_exact(count).is_err() {
        return Err(NoMemory { what, bytes });
    }
    Ok(values)
}

/// Makes a vector of `count` equal values.
///
/// # Errors
/// Returns an error if there is no memory for them.
pub(crate) fn fill_values<T: Clone>(value: T, count: usize, what: &'static str) -> Result<Vec<T>, NoMemory> {
    let mut values = reserve_values(count, what)?;
    values.resize(count, value);
    Ok(values)
}

/// From how many bytes on memory is refused.
static REFUSED_FROM: AtomicU64 = AtomicU64::new(u64::MAX);

/// Refuses memory from so many bytes on. With it, tests of the command see that a file for which there is no memory
/// stops no other file.
#[doc(hidden)]
pub fn refuse_memory_for_test(least_bytes: u64) {
    REFUSED_FROM.store(least_bytes, Ordering::Relaxed);
}

pub(crate) fn is_refused_for_test(bytes: u64) -> bool {
    bytes >= REFUSED_FROM.load(Ordering::Relaxed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_is_not_there_is_an_error() {
        assert_eq!(fill_values(1_u8, 3, "bytes"), Ok(vec![1, 1, 1]));
        let refused = reserve_values::<u64>(usize::MAX / 16, "columns").unwrap_err();
        assert!(refused.to_string().starts_with("there is no memory for columns: "), "{refused}");
        assert!(reserve_values::<u64>(usize::MAX, "columns").is_err());
    }
}
