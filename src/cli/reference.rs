//! This module holds commands that print what clsmith knows about itself: `transforms`, `schema`, `explain`,
//! `completions`, `man`.

use super::command_exit::CommandExit;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::report::{explain, finding_policy, step_descriptions};
use clsmith::setup::Setup;
use clsmith::transform;
use std::io::{self, Write};
use std::path::PathBuf;

fn print_text(text: &str) -> Result<CommandExit, Stop> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    if !text.ends_with('\n') {
        out.write_all(b"\n")?;
    }
    Ok(CommandExit::Done)
}

/// Lists the steps of recipes, or describes one
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  clsmith transforms\n  clsmith transforms move_origin")]
pub(super) struct TransformsArgs {
    /// The step to describe
    name: Option<String>,
}

impl TransformsArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let Some(name) = &self.name else { return print_text(&step_descriptions::list_steps()) };
        match step_descriptions::describe_step(name) {
            Some(text) => print_text(&text),
            None => {
                let steps = transform::NAMES.join(", ");
                Err(Stop::Usage(format!("`{name}` is not a step; the steps are {steps}")))
            }
        }
    }
}

/// Prints the JSON Schema of recipes, with which editors complete and check
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  clsmith schema > clsmith-recipe.schema.json\n  clsmith schema --setup > clsmith-setup.schema.json\n  clsmith schema --select > clsmith-select.schema.json\n  clsmith schema --jobs > clsmith-jobs.schema.json"
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
}

impl SchemaArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let schema = match self {
            Self { jobs: true, .. } => clsmith::batch::jobs_file::jobs_schema(),
            Self { setup: true, .. } => Setup::schema(),
            Self { select: true, .. } => clsmith::recipe_rules::rules_schema(),
            _ => clsmith::recipe::recipe_schema::<transform::Step>(),
        };
        print_text(&serde_json::to_string_pretty(&schema).map_err(io::Error::from)?)
    }
}

/// Explains a code of a finding, or lists all codes
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  clsmith explain CL0001\n  clsmith explain")]
pub(super) struct ExplainArgs {
    /// The code
    code: Option<String>,
}

impl ExplainArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let Some(code) = &self.code else { return print_text(&explain::list_codes()) };
        match finding_policy::parse_code(code) {
            Ok(code) => print_text(&explain::explain_code(code)),
            Err(unknown) => Err(Stop::Usage(unknown.to_string())),
        }
    }
}

/// Prints a completion script for a shell
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  clsmith completions bash > /etc/bash_completion.d/clsmith\n  clsmith completions powershell >> $PROFILE"
)]
pub(super) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: clap_complete::Shell,
}

impl CompletionsArgs {
    pub(super) fn run(&self, command: &mut clap::Command) -> Result<CommandExit, Stop> {
        // The script is made in memory first, because clap_complete treats a closed pipe as a bug.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, command, "clsmith", &mut script);
        io::stdout().lock().write_all(&script)?;
        Ok(CommandExit::Done)
    }
}

/// Prints the manual page, or writes one for each command into a folder
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  clsmith man | man -l -\n  clsmith man --out man1/")]
pub(super) struct ManArgs {
    /// A folder for the pages of all commands
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
}

impl ManArgs {
    pub(super) fn run(&self, command: clap::Command) -> Result<CommandExit, Stop> {
        match &self.out {
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
