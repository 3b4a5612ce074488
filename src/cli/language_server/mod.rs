//! This module runs `clsmith lsp`: a server of the language server protocol over standard input and output.
//!
//! The main thread reads messages and answers requests; a second one reads and checks texts after each pause of typing,
//! and what takes time for other reasons, as a preview of a recipe, has a thread of its own. What is answered is found
//! by [`clsmith::editor`], which knows nothing of the protocol; here are only messages, documents and places.

mod allocator;
mod analysis;
mod answers;
mod commands;
mod documents;
mod jobs;
mod notifications;
mod outbox;
mod path_pages;
mod places;
mod previews;
mod recipe_steps;
mod server;
mod settings;
mod transport;

use super::command_exit::CommandExit;
use super::stop::Stop;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  clsmith lsp                         started by an editor; docs/editor.md has the settings of some
  clsmith lsp --setup shop.yaml       also what the tools and the machine of the setup say to a program

It speaks the language server protocol over standard input and output: findings while typing, the state of
the machine at each line, outline, places, hints, completion, previews of recipes. It never formats, and writes
no file of yours.";

/// Serves editors: findings while typing, the state at each line, outline and more
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct LspArgs {
    /// A setup file: programs are judged for its tools and its machine, and chips are told where it has stock
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// Speak over standard input and output, which is the only way; some editors ask for it by name
    #[arg(long)]
    // It says what is done anyway, so nobody reads it.
    #[allow(dead_code)]
    stdio: bool,
}

impl LspArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        allocator::give_back_large_texts();
        let settings = settings::ServerSettings { setup: self.setup.clone(), ..Default::default() };
        server::serve(settings)
    }
}
