//! Line drawings as data: panels, each with a few paths laid over each other.

use super::display_units::{ColumnUnit, DisplayUnits};

/// One drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPanel {
    /// What stands above it.
    pub title: String,
    /// What goes to the right.
    pub right: String,
    /// What goes up.
    pub up: String,
    /// Whether both directions have one scale.
    pub one_scale: bool,
    /// The paths; later ones are drawn over earlier ones.
    pub paths: Vec<PanelPath>,
}

impl PathPanel {
    /// Converts lengths along both axes to the units that a reader sees.
    #[must_use]
    pub fn convert_lengths(mut self, units: DisplayUnits) -> Self {
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
    /// Its name in the legend; none when empty.
    pub name: String,
    /// How it looks.
    pub look: PanelPathStyle,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// How a path looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PanelPathStyle {
    /// As it was: grey.
    Before,
    /// As it is: blue, its points marked.
    After,
    /// What it is compared with: black and thin.
    Reference,
    /// A wrong way: red.
    Wrong,
}
