//! This module holds line drawings as data: panels, each with a few paths on top of each other.

/// A drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPanel {
    /// The title above it.
    pub title: String,
    /// The label of the horizontal axis.
    pub right: &'static str,
    /// The label of the vertical axis.
    pub up: &'static str,
    /// Whether both axes have the same scale.
    pub one_scale: bool,
    /// The paths. Later ones are drawn over earlier ones.
    pub paths: Vec<PanelPath>,
}

/// A path in a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelPath {
    /// Its name in the legend. It has no entry there if the name is empty.
    pub name: String,
    /// The style in which it is drawn.
    pub look: PanelPathStyle,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// The style of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PanelPathStyle {
    /// The path before a change, in grey.
    Before,
    /// The path after a change, in blue with marked points.
    After,
    /// A path for comparison, as a thin black line.
    Reference,
    /// A wrong path, in red.
    Wrong,
}
