//! This module marks programs, so that builds with debug assertions find an id that is used with the wrong one.

#[cfg(debug_assertions)]
use std::sync::atomic::{AtomicU32, Ordering};

/// The mark of a program and of the ids that it makes. A clone has the mark of its original, since their ids mean the
/// same statements; an insertion gives a new mark, since from then on they do not.
///
/// In builds without debug assertions it has no content and takes no memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProgramStamp {
    #[cfg(debug_assertions)]
    number: u32,
}

impl ProgramStamp {
    /// Makes a mark that no program has yet.
    #[cfg(debug_assertions)]
    pub(super) fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        Self { number: NEXT.fetch_add(1, Ordering::Relaxed) }
    }

    /// Makes a mark.
    #[cfg(not(debug_assertions))]
    pub(super) fn new() -> Self {
        Self {}
    }

    /// Asserts that an id with this mark belongs to a program with the mark `program`.
    #[inline]
    pub(super) fn assert_belongs_to(self, program: Self) {
        #[cfg(debug_assertions)]
        assert!(self.number == program.number, "an id is used with a program that did not make it");
        #[cfg(not(debug_assertions))]
        let _ = program;
    }
}
