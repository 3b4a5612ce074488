//! This module holds the roles of numbers in a statement, which tell a transform whether and how a number
//! changes.
//!
//! Transforms of geometry and units work on roles, so they need no list of records of their own.

/// The role of one number. The numbers `0..=2` are the components x, y, z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NumberRole {
    /// A coordinate of a point in the program's frame; it moves, turns and scales.
    Point(u8),
    /// A component of a step between points (GODLTA); it turns and scales, but does not move.
    Step(u8),
    /// A component of a unit vector; it only turns.
    Direction(u8),
    /// A component of an arc's axis; it turns, and changes its sign in a mirror (it is a pseudo-vector).
    ArcAxis(u8),
    /// A coordinate of the frame's origin, seen from outside; it scales, and only moves with the frame.
    FrameOrigin(u8),
    /// A component (second number) of the frame's x, y or z axis (first number), seen from outside.
    FrameAxis(u8, u8),
    /// A length, or a distance relative to a point; it only scales.
    Length,
    /// A feed whose unit is in the record or in force.
    Feed,
    /// A surface speed, whose unit is in the record.
    SurfaceSpeed,
    /// A count, an angle, a time or a knot; it never changes.
    Plain,
}
