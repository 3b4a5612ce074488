//! This module writes the page of a program for an editor: that of reports, for a single program.

use super::program_view::ProgramView;
use crate::diagnostic::Failure;
use crate::report::comparison::{Comparison, ComparisonRuns, ComparisonSubject};
use crate::report::html;
use crate::setup::Setup;
use crate::simulation_run::{RunWatcher, SimulationRunOptions};

/// What a page shows beside the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathPageContent {
    /// The path alone, at once.
    Path,
    /// Stock, chips and loads as well, if the setup has what that needs; the page says what is missing.
    Simulation,
}

/// Writes the page of a program. It needs no network and no other file, and follows the editor that shows it
/// (`page/editor_link.js`).
///
/// # Errors
/// Returns an interruption if `watch` asks for one.
pub fn make_path_page(
    view: &ProgramView,
    setup: Option<&Setup>,
    content: PathPageContent,
    watch: &dyn RunWatcher,
) -> Result<String, Failure> {
    let without = Setup::default();
    let subject = ComparisonSubject {
        before: None,
        program: view.program(),
        recipe: None,
        setup: setup.unwrap_or(&without),
        setup_files: &[],
        units: None,
        shown_in: None,
        findings: view.findings(),
        reports: &[],
        print: None,
    };
    let runs = match content {
        PathPageContent::Path => ComparisonRuns::default(),
        PathPageContent::Simulation => {
            ComparisonRuns::simulate_subject(&subject, None, &SimulationRunOptions::default(), watch)?
        }
    };
    let comparison = Comparison::from_runs(subject, &runs);
    let mut page = Vec::new();
    // Nothing that is written into memory fails.
    let written = html::write_page(&comparison, &mut page);
    debug_assert!(written.is_ok(), "{written:?}");
    Ok(String::from_utf8_lossy(&page).into_owned())
}
