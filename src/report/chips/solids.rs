//! tbd
use super::ChipReport;
use std::io::{self, Write};
/// tbd
pub fn to_stl(_: &ChipReport, _: &mut dyn Write) -> io::Result<()> { Ok(()) }
