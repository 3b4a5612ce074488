//! This module defines the style of tables.

use crate::presentation::display_units::{ColumnUnit, DisplayUnits};

/// The style of a table: its units, and whether it is plain text or markup.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TableLooks {
    /// The units that the reader sees.
    pub units: DisplayUnits,
    /// The kind of text.
    pub style: TableStyle,
    /// Whether heads give the units of their columns.
    pub has_units_in_heads: bool,
}

/// The kind of text that a table becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TableStyle {
    /// Plain text in a terminal, where a cell without a value has a dash.
    Plain,
    /// Markdown or HTML, where such a cell is empty and units have raised exponents.
    Markup,
}

impl TableLooks {
    /// Makes the style of plain text.
    pub(crate) const fn plain(units: DisplayUnits) -> Self {
        Self { units, style: TableStyle::Plain, has_units_in_heads: true }
    }

    /// Makes the style of Markdown and HTML.
    pub(crate) const fn markup(units: DisplayUnits) -> Self {
        Self { units, style: TableStyle::Markup, has_units_in_heads: true }
    }

    /// Leaves the units out of the heads, because a line above the table gives them.
    pub(crate) fn without_units_in_heads(self) -> Self {
        Self { has_units_in_heads: false, ..self }
    }

    /// Returns a unit as people write it.
    pub(crate) fn unit_symbol(self, unit: ColumnUnit) -> &'static str {
        match self.style {
            TableStyle::Plain => unit.symbol(self.units.shown_in),
            TableStyle::Markup => unit.marked_symbol(self.units.shown_in),
        }
    }
}
