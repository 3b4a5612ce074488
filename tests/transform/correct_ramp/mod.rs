//! `correct_ramp`: ramps that an indexable cutter survives.

mod geometry;
