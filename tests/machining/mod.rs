//! Programs over their stock: frames, arcs, cycles, crashes, and the fast chip against the exact one.

mod chips;
mod exact;
mod paths;
mod pillars;
mod pointed;
mod undercut;

use crate::support;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::engagement::Engagement;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::simulation_run::{DexelRunResult, Machining, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;

/// A setup of a block, any tool with four teeth and 40 mm of flutes.
pub const SETUP: &str = "stock: { block: { from: [0, -30, -20], to: [100, 30, 0] } }\n\
    tools: [ { match: {}, teeth: 4, helix: 0, flute_length: 40 } ]\n";

/// An NX program of one operation that starts above the block; `tool` is what follows TLDATA/MILL.
pub fn nx(tool: &str, body: &str) -> String {
    format!(
        "TOOL PATH/OP,TOOL,T1\nTLDATA/MILL,{tool}\n\
         MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n\
         LOAD/TOOL,1\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-20.0000,0.0000,10.0000,0.0000000,0.0000000,1.0000000\n\
         FEDRAT/MMPM,1000.0000\n{body}END-OF-PATH\n"
    )
}

/// Runs a program; gives each feed motion's engagement, and what is left.
pub fn machine(text: &str, setup: &str, cell: f64) -> (Vec<Engagement>, DexelRunResult) {
    try_machine(text, setup, SimulationRunOptions::default().with_cell_mm(cell).with_forces(true)).unwrap()
}

pub fn try_machine(
    text: &str,
    setup: &str,
    options: SimulationRunOptions,
) -> Result<(Vec<Engagement>, DexelRunResult), Vec<Diagnostic>> {
    let program = support::program(text);
    let setup = Setup::load(&Source::new("shop.yaml", setup.as_bytes().to_vec()).unwrap())
        .map_err(Failure::into_findings)?;
    let machining =
        Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).map_err(Failure::into_findings)?;
    let mut found = Vec::new();
    let ran = machining.simulate_program(&options, &SilentWatcher, &mut |cut| {
        found.extend(cut.whole_engagement().filter(|_| !cut.motion.rapid));
    });
    Ok((found, ran.map_err(Failure::into_findings)?))
}

/// Codes of findings.
pub fn codes(ran: &DexelRunResult) -> Vec<&'static str> {
    ran.findings.iter().map(|found| found.code.id()).collect()
}

#[track_caller]
pub fn near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "found {found}, wanted {wanted} within {tolerance}");
}
