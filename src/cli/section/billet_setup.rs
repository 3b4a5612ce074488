//! This module writes the setup of a program that `clsmith section` made, and simulates the program with it.

use super::SectionArgs;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::parse::parse;
use clsmith::program::LengthUnit;
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, RunWatcher, SimulationRunOptions};
use clsmith::source::{Source, read_file_bytes};
use clsmith::surface_milling::{SurfaceMillingOptions, SurfaceProgram};
use std::path::Path;

/// Lengths in a setup are written with so many decimals at most.
const DECIMALS: f64 = 1e9;

impl SectionArgs {
    /// Returns the setup of the program as YAML: the billet around the model, and the ball. The model is named as it is seen
    /// from the folder of the setup, or by its whole path.
    pub(super) fn build_setup_text(
        &self,
        options: &SurfaceMillingOptions,
        allowance_mm: f64,
        setup_file: Option<&Path>,
    ) -> String {
        let unit = options.words.units.mm_per_unit();
        let length = |mm: f64| (mm / unit * DECIMALS).round() / DECIMALS;
        let model = self.input_path();
        let is_beside = setup_file.is_some_and(|setup| setup.parent() == model.parent());
        let named = match model.file_name().filter(|_| is_beside) {
            Some(name) => Path::new(name).to_path_buf(),
            None => std::path::absolute(model).unwrap_or_else(|_| model.to_path_buf()),
        };
        // A string of JSON is one of YAML.
        let named = serde_json::Value::from(named.to_string_lossy().into_owned()).to_string();
        let units = match options.words.units {
            LengthUnit::Mm => "mm",
            LengthUnit::Inch => "inch",
        };
        let (radius, teeth) = (options.radius_mm, self.teeth.unwrap_or_default());
        format!(
            "# The billet around the model and the ball, as `clsmith section` had them.\n\
             units: {units}\n\
             stock: {{ around: {{ model: {named}, allowance: {} }} }}\n\
             tools:\n  - {{ match: {{ number: {} }}, diameter: {}, corner_radius: {}, taper: 0, tip: 0, teeth: {teeth} }}\n",
            length(allowance_mm),
            options.words.tool,
            length(2.0 * radius),
            length(radius),
        )
    }

    /// Simulates the program on its billet and compares what is left with the model.
    pub(super) fn simulate_surface(
        &self,
        surfaced: &SurfaceProgram,
        options: &SurfaceMillingOptions,
        allowance_mm: f64,
        watch: &dyn RunWatcher,
    ) -> Result<SimulationReport, Failure> {
        let unread = |why: String| {
            Diagnostic::new(codes::MODEL_FILE, format!("the program cannot be simulated: {why}"))
        };
        let text = self.build_setup_text(options, allowance_mm, None);
        let setup =
            Source::new("setup.yaml", text.into_bytes()).map_err(|error| unread(error.to_string()))?;
        let setup = Setup::load(&setup)?;
        let name = self.output.as_deref().unwrap_or(Path::new("part")).to_string_lossy();
        let source = Source::new(name, surfaced.text.clone()).map_err(|error| unread(error.to_string()))?;
        let program = parse(&source, Some(options.words.dialect)).program;
        let units = options.words.units;
        let mut findings = Vec::new();
        let machining = Machining::new(&program, &setup, units, &mut findings)?;
        let mut simulated =
            SimulationReport::simulate_program(&machining, &SimulationRunOptions::default(), watch)?;
        let path = self.input_path();
        let bytes = read_file_bytes(path).map_err(|error| unread(error.to_string()))?;
        let mesh = Machining::read_target_part(&bytes, units).map_err(|error| unread(error.to_string()))?;
        simulated.compare_with_target(&mesh, &path.to_string_lossy(), None);
        findings.append(&mut simulated.findings);
        simulated.findings = findings;
        Ok(simulated)
    }
}
