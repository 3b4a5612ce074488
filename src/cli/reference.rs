//! This module holds commands that print what clsmith knows about itself: `transforms`, `schema`, `explain`,
//! `completions`, `man`.

use super::choice_parser::ChoiceParser;
use super::command_exit::CommandExit;
use super::completions;
use super::finding_args::list_codes;
use super::output_args::{JsonArgs, TextOutputArgs};
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clap::builder::StringValueParser;
use clsmith::diagnostic::{CATALOGUE, DiagnosticCode};
use clsmith::report::{explain, finding_policy, step_descriptions};
use clsmith::setup::{Setup, WorkMaterial};
use clsmith::transform;
use std::io::{self, Write};
use std::path::PathBuf;

/// Lists the steps of recipes, or describes one
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  clsmith transforms\n  clsmith transforms move_origin\n  clsmith transforms optimize_feed --json | jq .properties"
)]
pub(super) struct TransformsArgs {
    /// The step to describe
    #[arg(hide_possible_values = true,
        value_parser = ChoiceParser::new(StringValueParser::new(), || transform::NAMES.to_vec()))]
    name: Option<String>,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    output: TextOutputArgs,
}

impl TransformsArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let columns = terminal::width_columns(self.output.is_standard() && terminal::is_stdout_terminal());
        let (text, schema) = match &self.name {
            None => {
                let all = transform::NAMES.iter().map(|name| ((*name).to_owned(), step_schema(name)));
                (step_descriptions::list_steps(), serde_json::Value::Object(all.collect()))
            }
            Some(name) => match step_descriptions::describe_step_in(name, columns) {
                Some(text) => (text, step_schema(name)),
                None => {
                    let steps = transform::NAMES.join(", ");
                    return Err(Stop::Usage(format!("`{name}` is not a step; the steps are {steps}")));
                }
            },
        };
        show_text_and_json(&text, &schema, &self.output, &self.json)
    }
}

fn step_schema(name: &str) -> serde_json::Value {
    transform::schema_of(name).map(schemars::Schema::to_value).unwrap_or_default()
}

/// Writes a text, unless its JSON takes its place on standard output.
fn show_text_and_json(
    text: &str,
    value: &serde_json::Value,
    output: &TextOutputArgs,
    json: &JsonArgs,
) -> Result<CommandExit, Stop> {
    json.write_document(&[], || format!("{value:#}"))?;
    if !json.is_standard() || !output.is_standard() {
        output.write_text(text, &[])?;
    }
    Ok(CommandExit::Done)
}

/// Prints the JSON Schema of recipes, with which editors complete and check
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  clsmith schema -o clsmith-recipe.schema.json\n  clsmith schema --setup -o clsmith-setup.schema.json\n  clsmith schema --select -o clsmith-select.schema.json\n  clsmith schema --jobs -o clsmith-jobs.schema.json\n  clsmith schema --material -o clsmith-material.schema.json\n  clsmith schema --profile -o clsmith-profile.schema.json"
)]
pub(super) struct SchemaArgs {
    /// The schema of setup files instead
    #[arg(long)]
    setup: bool,
    /// The schema of files that choose the recipe (`hook --select`) instead
    #[arg(long, conflicts_with = "setup")]
    select: bool,
    /// The schema of jobs files instead, for `clsmith batch`
    #[arg(long, conflicts_with_all = ["setup", "select"])]
    jobs: bool,
    /// The schema of material files instead
    #[arg(long, conflicts_with_all = ["setup", "select", "jobs"])]
    material: bool,
    /// The schema of profile files instead, for `clsmith section --profile`
    #[arg(long, conflicts_with_all = ["setup", "select", "jobs", "material"])]
    profile: bool,
    #[command(flatten)]
    output: TextOutputArgs,
}

impl SchemaArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let schema = match self {
            Self { jobs: true, .. } => clsmith::batch::jobs_file::jobs_schema(),
            Self { material: true, .. } => WorkMaterial::schema(),
            Self { profile: true, .. } => clsmith::surface_milling::profile_schema(),
            Self { setup: true, .. } => Setup::schema(),
            Self { select: true, .. } => clsmith::recipe_rules::rules_schema(),
            _ => clsmith::recipe::recipe_schema::<transform::Step>(),
        };
        self.output.write_text(&serde_json::to_string_pretty(&schema).map_err(io::Error::from)?, &[])?;
        Ok(CommandExit::Done)
    }
}

/// Explains a code of a finding, or lists all codes
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  clsmith explain CL0001\n  clsmith explain")]
pub(super) struct ExplainArgs {
    /// The code
    #[arg(hide_possible_values = true, value_parser = ChoiceParser::new(StringValueParser::new(), list_codes))]
    code: Option<String>,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    output: TextOutputArgs,
}

impl ExplainArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let (text, value) = match &self.code {
            None => {
                let codes = CATALOGUE.iter().flat_map(|rows| rows.iter()).copied();
                (explain::list_codes(), codes.map(code_to_json).collect())
            }
            Some(code) => {
                let code =
                    finding_policy::parse_code(code).map_err(|unknown| Stop::Usage(unknown.to_string()))?;
                (explain::explain_code(code), code_to_json(code))
            }
        };
        show_text_and_json(&text, &value, &self.output, &self.json)
    }
}

fn code_to_json(code: DiagnosticCode) -> serde_json::Value {
    serde_json::json!({
        "code": code.id(),
        "severity": code.severity().to_string(),
        "meaning": code.meaning(),
        "explanation": code.explanation(),
        "help": code.help(),
    })
}

/// Prints a completion script for a shell
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  clsmith completions bash -o /etc/bash_completion.d/clsmith\n  clsmith completions zsh -o ~/.zfunc/_clsmith\n  clsmith completions fish -o ~/.config/fish/completions/clsmith.fish\n  clsmith completions powershell >> $PROFILE"
)]
pub(super) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: clap_complete::Shell,
    #[command(flatten)]
    output: TextOutputArgs,
}

impl CompletionsArgs {
    pub(super) fn run(&self, command: &mut clap::Command) -> Result<CommandExit, Stop> {
        let script = completions::write_completion_script(self.shell, command);
        self.output.write_text(&script, &[])?;
        Ok(CommandExit::Done)
    }
}

/// Prints the manual page, or writes one for each command into a folder
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  clsmith man | man -l -\n  clsmith man -o man1/")]
pub(super) struct ManArgs {
    /// A folder for the pages of all commands
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: Option<PathBuf>,
}

impl ManArgs {
    pub(super) fn run(&self, command: clap::Command) -> Result<CommandExit, Stop> {
        match &self.output {
            Some(folder) => clap_mangen::generate_to(command, folder)?,
            None => {
                let mut page = Vec::new();
                clap_mangen::Man::new(command).render(&mut page)?;
                io::stdout().lock().write_all(&page)?;
            }
        }
        Ok(CommandExit::Done)
    }
}
