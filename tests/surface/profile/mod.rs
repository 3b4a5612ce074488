//! Balls over profiles.
