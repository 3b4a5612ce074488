//! This module defines line drawings as data: panels, each with a few paths on top of each other.

use super::display_units::{ColumnUnit, DisplayUnits};

/// One drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPanel {
    /// The title above it.
    pub title: String,
    /// The title of the horizontal axis: quantity and unit.
    pub right: String,
    /// The title of the vertical axis: quantity and unit.
    pub up: String,
    /// Whether both axes have the same scale.
    pub one_scale: bool,
    /// The paths. Later ones are drawn over earlier ones.
    pub paths: Vec<PanelPath>,
}

impl PathPanel {
    /// Converts lengths along both axes to the units that a reader sees.
    #[must_use]
    pub(crate) fn convert_lengths(mut self, units: DisplayUnits) -> Self {
        let shown = |value: f64| units.convert(ColumnUnit::Length, value);
        for (right, up) in self.paths.iter_mut().flat_map(|path| &mut path.points) {
            (*right, *up) = (shown(*right), shown(*up));
        }
        self
    }
}

/// A path in a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelPath {
    /// Its name in the legend. It has no entry there if the name is empty.
    pub name: String,
    /// The style in which it is drawn.
    pub look: PanelPathStyle,
    /// Its points: the values along the horizontal and the vertical axis.
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
