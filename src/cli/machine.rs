//! This module runs `clsmith machine`.

use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::finding_args::FindingArgs;
use super::input_files::{self, STANDARD};
use super::output_args::{JsonArgs, TextOutputArgs};
use super::output_endings::{OutputContent, find_wrong_ending};
use super::plot::encode_drawing;
use super::stop::Stop;
use clap::Args;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::report::machine_axes::{describe_machine, draw_machine, machine_to_json};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith machine configs/machines/cradle.yaml                   the axes, their limits and speeds
  clsmith machine configs/machines/cradle.yaml --plot cradle.svg   and where they lie
  clsmith machine configs/machines/cradle.yaml --json | jq .axes   the same for programs

A machine is the `machine:` of a setup file: see configs/README.md. `clsmith axes` shows what its axes do in a program,
`clsmith check --setup` what they cannot do.";

/// Shows the machine of a setup: its axes, limits and speeds
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct MachineArgs {
    /// The setup file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    output: TextOutputArgs,
    /// The axes as a drawing, as SVG, or as PNG if the file ends in .png
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl MachineArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let wrong = find_wrong_ending([("--plot", self.plot.as_deref(), OutputContent::Drawing)]);
        wrong.map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        let machine = input_files::read_setup(&self.file)?.machine;
        let inputs = [self.file.as_path()];
        if let Some(path) = &self.plot {
            refuse_overwritten_input([path.as_path()].into_iter(), &inputs)?;
            let Some(chain) = &machine.chain else {
                let message = format!("the machine of {} has no axes to draw", self.file.display());
                return Err(Diagnostic::new(codes::MACHINE_WITHOUT_AXES, message).into());
            };
            let name = machine.name.as_deref().unwrap_or("machine");
            let drawing = encode_drawing(path, draw_machine(chain, name))?;
            let outputs = CommandOutputs::default().for_inputs(inputs);
            outputs.write_output(path, |out| out.write_all(&drawing))?;
        }
        let name = self.file.to_string_lossy();
        self.json.write_document(&inputs, || machine_to_json(&machine, &name))?;
        if self.plot.as_deref() != Some(Path::new(STANDARD)) && !self.json.is_standard() {
            self.output.write_text(&describe_machine(&machine), &inputs)?;
        }
        Ok(CommandExit::Done)
    }
}
