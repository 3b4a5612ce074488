//! This module holds the layer that a chip is cut from.

/// A layer: the height of its middle and its thickness, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct LayerSlab {
    pub z: f64,
    pub thickness: f64,
}
