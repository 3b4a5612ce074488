//! This module runs `clsmith materials`.

use super::command_exit::CommandExit;
use super::output_args::{JsonArgs, TextOutputArgs};
use super::stop::Stop;
use clap::Args;
use clsmith::report::material_table::{describe_materials, materials_to_json};
use clsmith::setup::WorkMaterial;

const EXAMPLES: &str = "\
Examples:
  clsmith materials                 all that are built in: numbers, sources, ranges
  clsmith materials --json | jq     the same for programs

A setup takes one by its name, `material: { file: steel-c45 }`, or a file of your own by its path. `clsmith calibrate`
makes such a file from measured forces; `clsmith schema --material` is its JSON Schema.";

/// Lists the materials that are built in, with the sources of their numbers
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct MaterialsArgs {
    #[command(flatten)]
    output: TextOutputArgs,
    #[command(flatten)]
    json: JsonArgs,
}

impl MaterialsArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let materials = WorkMaterial::load_shipped()?;
        self.json.write_document(&[], || materials_to_json(&materials))?;
        if !self.json.is_standard() || !self.output.is_standard() {
            self.output.write_text(&describe_materials(&materials), &[])?;
        }
        Ok(CommandExit::Done)
    }
}
