//! This module holds `--display-units`, the option for the unit in which lengths are shown.

use super::input_files;
use clap::Args;
use clsmith::parameters::LengthUnit;
use clsmith::report::DisplayUnits;

/// What people and other programs see.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct DisplayArgs {
    /// Unit that lengths and feeds are shown in, in every output of the command; that of the program if not
    /// given
    #[arg(long, value_parser = input_files::length_unit_parser(), value_name = "UNIT")]
    display_units: Option<LengthUnit>,
}

impl DisplayArgs {
    /// Returns the unit that was asked for, if there is one.
    pub(super) fn asked(self) -> Option<LengthUnit> {
        self.display_units
    }

    /// Returns the units that outputs about a program show. `program_unit` is the unit of its lengths.
    pub(super) fn of_program(self, program_unit: LengthUnit) -> DisplayUnits {
        DisplayUnits::of_program(program_unit, self.display_units)
    }
}
