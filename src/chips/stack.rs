//! (stand-in until the real one is here)
use super::Polygon;
use crate::sim::Stock;

/// stand-in
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stack {
    layers: Vec<Layer>,
}
/// stand-in
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// z
    pub z: f64,
    /// thickness
    pub thickness: f64,
}
impl Layer {
    /// polygons
    pub fn polygons(&self) -> Vec<Polygon> {
        Vec::new()
    }
}
/// stand-in
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("no")]
pub struct StackError;
impl Stack {
    /// new
    pub fn new(_: &Stock, _: f64) -> Result<Self, StackError> {
        Ok(Self::default())
    }
    /// layers
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }
    /// volume
    pub fn volume_mm3(&self) -> f64 {
        0.0
    }
}
