//! This module holds boxes along the axes, and the largest coordinate that any part of the stock may have.

/// A box along the axes: its lower and its upper corner.
pub type AxisBox = ([f64; 3], [f64; 3]);

/// The largest coordinate or length of a body in mm. It is far beyond any workpiece, and far below what `f32`
/// heights can hold.
pub(super) const FARTHEST: f64 = 1e9;

/// Returns the box around two boxes.
pub(super) fn union_boxes(([a, b, c], [d, e, f]): AxisBox, ([g, h, i], [j, k, l]): AxisBox) -> AxisBox {
    ([a.min(g), b.min(h), c.min(i)], [d.max(j), e.max(k), f.max(l)])
}
