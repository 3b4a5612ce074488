//! This module holds the command line, with one file for each command, over a library that does not know it.

mod apply;
mod bad_argument;
mod batch;
mod check;
mod chips;
mod command_exit;
mod command_outputs;
mod diff;
mod display_args;
mod finding_args;
mod hook;
mod init;
mod input_files;
mod measuring_command;
mod output_endings;
mod plot;
mod progress;
mod reference;
mod report_args;
mod section;
mod simulate;
mod stats;
mod stop;
mod terminal;
mod unattended;
mod undo;
mod watch;

use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  clsmith apply recipe.yaml part.cls -o out.cls    correct a program by a recipe
  clsmith apply recipe.yaml part.cls --diff        see what would change
  clsmith batch --recipe recipe.yaml --out done 'programs/**/*.cls'
                                                   correct many programs
  clsmith check part.cls                           what is wrong with a program
  clsmith stats part.cls                           what is in it
  clsmith simulate part.cls --setup shop.yaml      what its tools cut and bear
  clsmith chips part.cls --setup shop.yaml --layer 0.5
                                                   the exact chips of flat end mills, in five axes too
  clsmith section part.stl --radius 5 --step 0.5 --feed 800 -o part.cls
                                                   a program for a ball over a part
  clsmith hook --recipe recipe.yaml part.cls -- mypost {}
                                                   correct a program and post the result
  clsmith watch exports --recipe recipe.yaml --out corrected '*.cls'
                                                   correct what lands in a folder
  clsmith diff part.cls out.cls                    what changed, by meaning
  clsmith plot part.cls --after out.cls -o feed.svg
                                                   feed and z, before and after
  clsmith undo out.cls --report out.json -o part.cls
                                                   the original back, from the report of `apply --json`
  clsmith transforms scale_feed                    what a recipe step does

Exit codes:
  0  done, nothing stands in the way (warnings may have been shown)
  1  errors were found; the program they are in was not written
  2  the command line is wrong
  3  `diff`: the programs differ in meaning
  124-127, 128+n  `hook`: the post was stopped, nothing was posted, it could not be started,
     it was not found, it was ended by signal n; all other codes are the post's own
  130  stopped by Ctrl-C; no half file is left
  141  the reader of the output went away (`| head`)";

/// Reads, checks, corrects and writes cutter-location data: Siemens NX CLSF, CATIA APT, Creo NCL and others.
///
/// It runs between the CAM system's export and the post-processor. What a recipe does not change is written
/// byte for byte, and nothing is written if there is an error.
#[derive(Debug, Parser)]
#[command(name = "clsmith", version, after_help = EXAMPLES, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: CliCommand,
}

#[derive(Debug, Subcommand)]
enum CliCommand {
    Apply(apply::ApplyArgs),
    Batch(Box<batch::BatchArgs>),
    Merge(batch::MergeArgs),
    Check(check::CheckArgs),
    Init(init::InitArgs),
    Stats(stats::StatsArgs),
    Simulate(simulate::SimulateArgs),
    Chips(Box<chips::ChipsArgs>),
    Section(Box<section::SectionArgs>),
    Diff(diff::DiffArgs),
    Hook(Box<hook::HookArgs>),
    Watch(Box<watch::WatchArgs>),
    Plot(plot::PlotArgs),
    Undo(undo::UndoArgs),
    Transforms(reference::TransformsArgs),
    Schema(reference::SchemaArgs),
    Explain(reference::ExplainArgs),
    Completions(reference::CompletionsArgs),
    Man(reference::ManArgs),
}

/// Runs the command of the process's arguments.
pub fn run_command_line() -> ExitCode {
    let cli = Cli::parse();
    let (name, findings, done) = match &cli.command {
        CliCommand::Apply(command) => ("apply", Some(&command.findings), command.run()),
        CliCommand::Batch(command) => ("batch", Some(&command.findings), command.run()),
        CliCommand::Merge(command) => ("merge", Some(&command.findings), command.run()),
        CliCommand::Check(command) => ("check", Some(&command.findings), command.run()),
        CliCommand::Init(command) => ("init", Some(&command.findings), command.run()),
        CliCommand::Stats(command) => ("stats", Some(&command.findings), command.run()),
        CliCommand::Simulate(command) => ("simulate", Some(&command.findings), command.run()),
        CliCommand::Chips(command) => ("chips", Some(&command.findings), command.run()),
        CliCommand::Section(command) => ("section", Some(&command.findings), command.run()),
        CliCommand::Diff(command) => ("diff", Some(&command.findings), command.run()),
        CliCommand::Hook(command) => ("hook", Some(&command.findings), command.run()),
        CliCommand::Watch(command) => ("watch", Some(&command.findings), command.run()),
        CliCommand::Plot(command) => ("plot", Some(&command.findings), command.run()),
        CliCommand::Undo(command) => ("undo", Some(&command.findings), command.run()),
        CliCommand::Transforms(command) => ("transforms", None, command.run()),
        CliCommand::Schema(command) => ("schema", None, command.run()),
        CliCommand::Explain(command) => ("explain", None, command.run()),
        CliCommand::Completions(command) => ("completions", None, command.run(&mut Cli::command())),
        CliCommand::Man(command) => ("man", None, command.run(Cli::command())),
    };
    done.unwrap_or_else(|stop| stop.finish_command(name, findings)).exit_process()
}
