//! `compensate_z`: passes in planes, normals, models, leads, regrinds.

mod against_mesh;
mod against_normals;
mod against_profile;
mod around;
mod refused;
mod regrind;

use crate::support;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::Program;
use clsmith::program::motion::Motion;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::compensate_z::CompensateZReport;
use clsmith::transform::{Recipe, run_recipe};
use nalgebra::Point3;
use std::fmt::Write;

/// What a step made of a program.
pub struct Done {
    pub text: String,
    pub program: Program,
    pub findings: Vec<Diagnostic>,
    pub report: CompensateZReport,
}

impl Done {
    /// The passes as points: the starts and ends of cuts.
    pub fn passes(&self) -> Vec<Vec<Point3<f64>>> {
        cuts(&self.program)
    }

    pub fn gouge(&self) -> f64 {
        self.report.passes.iter().map(|pass| pass.gouge_mm).fold(0.0, f64::max)
    }

    pub fn gap(&self) -> f64 {
        self.report.passes.iter().filter_map(|pass| pass.gap_mm).fold(0.0, f64::max)
    }
}

/// The runs of motions marked as cuts, each with its start.
pub fn cuts(program: &Program) -> Vec<Vec<Point3<f64>>> {
    let motions: Vec<Motion> = program.motions().collect();
    let mut runs: Vec<Vec<Point3<f64>>> = Vec::new();
    let mut open = false;
    for motion in &motions {
        let cuts = motion.class == clsmith::program::MotionClass::Cut;
        if cuts && !open {
            runs.push(vec![motion.from.point]);
        }
        if cuts {
            runs.last_mut().unwrap().push(motion.to.point);
        }
        open = cuts;
    }
    runs
}

/// Applies `compensate_z` with parameters to a text.
pub fn compensate(parameters: &str, text: &str) -> Result<Done, Vec<Diagnostic>> {
    compensate_beside("recipe.yaml", parameters, text)
}

/// The same with the path of the recipe, beside which models are looked for.
pub fn compensate_beside(path: &str, parameters: &str, text: &str) -> Result<Done, Vec<Diagnostic>> {
    let recipe = format!("version: 1\nunits: mm\nsteps:\n  - compensate_z: {{ {parameters} }}\n");
    let recipe = Source::new(path, recipe.into_bytes()).unwrap();
    let recipe = Recipe::load(&recipe).map_err(Failure::into_findings)?;
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let mut outcome = run_recipe(&recipe, &setup, support::program(text)).map_err(Failure::into_findings)?;
    let report = outcome.reports.pop().expect("a report");
    let report = report.downcast_ref::<CompensateZReport>().unwrap().clone();
    let text = String::from_utf8_lossy(&outcome.program.to_bytes()).into_owned();
    Ok(Done { text, program: outcome.program, findings: outcome.findings, report })
}

/// An NX operation of a ball R5 over passes given as contact points, with a plunge to each and a retract from it.
pub fn operation(passes: &[Vec<[f64; 3]>]) -> String {
    let mut text = String::from(
        "TOOL PATH/FINISH,TOOL,BALL_R5\nTLDATA/MILL,10.0000,5.0000,60.0000,0.0000,0.0000\nSPINDL/RPM,6000,CLW \n",
    );
    for (index, pass) in passes.iter().enumerate() {
        let point = |at: &[f64; 3]| format!("{:.4},{:.4},{:.4}", at[0], at[1], at[2]);
        let (first, last) = (pass.first().unwrap(), pass.last().unwrap());
        let above = |at: &[f64; 3], z: f64| point(&[at[0], at[1], z]);
        let axis = if index == 0 { ",0.0000000,0.0000000,1.0000000" } else { "" };
        let _ = writeln!(text, "PAINT/COLOR,211\nRAPID\nGOTO/{}{axis}", above(first, 60.0));
        let _ = writeln!(text, "PAINT/COLOR,42\nFEDRAT/MMPM,300.0000\nGOTO/{}", point(first));
        let _ = writeln!(text, "PAINT/COLOR,31\nFEDRAT/MMPM,900.0000");
        for at in &pass[1..] {
            let _ = writeln!(text, "GOTO/{}", point(at));
        }
        let _ = writeln!(text, "PAINT/COLOR,37\nGOTO/{}", above(last, last[2] + 3.0));
        let _ = writeln!(text, "PAINT/COLOR,211\nRAPID\nGOTO/{}", above(last, 60.0));
    }
    text.push_str("END-OF-PATH\n");
    text
}

/// Points (u, z) put into the vertical plane through a place in a direction.
pub fn in_plane(profile: &[(f64, f64)], origin: [f64; 2], degrees: f64) -> Vec<[f64; 3]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    profile.iter().map(|(u, z)| [origin[0] + u * cos, origin[1] + u * sin, *z]).collect()
}

/// The height of the tip of a ball over a profile of straight lines, by brute force: every 0.002 mm of it.
pub fn envelope(profile: &[(f64, f64)], radius: f64, u: f64) -> f64 {
    let mut highest = f64::NEG_INFINITY;
    for pair in profile.windows(2) {
        let ((u0, z0), (u1, z1)) = (pair[0], pair[1]);
        let count = ((u1 - u0).hypot(z1 - z0) / 0.002).ceil().max(1.0) as usize;
        for part in 0..=count {
            let share = part as f64 / count as f64;
            let (q, z) = (u0 + (u1 - u0) * share, z0 + (z1 - z0) * share);
            if (u - q).abs() <= radius {
                highest = highest.max(z + (radius * radius - (u - q) * (u - q)).sqrt() - radius);
            }
        }
    }
    highest
}
