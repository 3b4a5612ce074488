//! Undeformed chips.
