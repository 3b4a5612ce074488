//! Cutters lowered onto a mesh: the height at which the tip first touches.
