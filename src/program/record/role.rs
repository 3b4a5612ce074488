//! What a number in a statement is, so that a transform knows whether and how it changes.

/// The role of one number. `0..=2` are the components x, y, z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberRole {
    /// A coordinate of a point in the program's frame: moves, turns, scales.
    Point(u8),
    /// A component of a step between points (GODLTA): turns and scales, does not move.
    Step(u8),
    /// A component of a unit vector: turns only.
    Direction(u8),
    /// A component of an arc's axis: turns, and turns over in a mirror (it is a pseudo-vector).
    ArcAxis(u8),
    /// A coordinate of the frame's origin, seen from outside: scales, and moves only with the frame.
    FrameOrigin(u8),
    /// A component of the frame's x, y or z axis (first number), seen from outside.
    FrameAxis(u8, u8),
    /// A length or distance relative to a point: scales only.
    Length,
    /// A feed whose unit stands in the record or is in force.
    Feed,
    /// A surface speed (its unit stands in the record).
    SurfaceSpeed,
    /// A count, an angle, a time, a knot: never changes.
    Plain,
}
