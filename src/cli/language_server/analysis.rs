//! This module reads and checks texts after each pause of typing, in a thread of its own, and sends what it finds.

use super::documents::SharedState;
use super::jobs::MOST_MEMORY_BYTES;
use super::outbox::Outbox;
use super::places::{moved_span, path_to_uri, span_to_json};
use super::server::STACK_BYTES;
use crate::cli::input_files;
use clsmith::diagnostic::{Diagnostic, Failure, Severity};
use clsmith::editor::{EditedLines, ProgramView, check_yaml_text};
use clsmith::job::catch_defect;
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, RunWatcher, SimulationRunOptions};
use clsmith::source::Source;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// A text is read when nobody has typed for so long.
const PAUSE: Duration = Duration::from_millis(150);

/// No more findings of one file are sent; those of the highest severity come first.
const MOST_FINDINGS: usize = 500;

/// The thread that reads texts.
pub(super) struct AnalysisThread {
    pub(super) shared: Arc<SharedState>,
    pub(super) outbox: Outbox,
    /// The addresses of documents that were changed.
    pub(super) changed: Receiver<String>,
    /// How many of them wait.
    pub(super) waiting: Arc<AtomicUsize>,
}

impl AnalysisThread {
    /// Works until nobody can change a document any more. Texts are read by this thread alone: the other cores are left to
    /// those who answer meanwhile, and reading in one go takes less memory.
    pub(super) fn run(self) {
        match make_pool(1) {
            Some(pool) => pool.install(|| self.work()),
            // Without a pool of its own it takes the threads of everybody.
            None => self.work(),
        }
    }

    fn work(self) {
        let mut unsimulated: BTreeSet<String> = BTreeSet::new();
        loop {
            let mut changed = BTreeSet::new();
            // Simulations are for pauses in which nothing is to be read.
            let first = match unsimulated.is_empty() {
                true => self.changed.recv().map_err(|_| RecvTimeoutError::Disconnected),
                false => self.changed.recv_timeout(PAUSE),
            };
            match first {
                Ok(uri) => {
                    changed.insert(uri);
                    while let Ok(uri) = self.changed.recv_timeout(PAUSE) {
                        changed.insert(uri);
                    }
                }
                Err(RecvTimeoutError::Timeout) => {
                    if let Some(uri) = unsimulated.pop_first() {
                        self.simulate(&uri, &mut unsimulated);
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return,
            }
            self.waiting.store(0, Ordering::Relaxed);
            for uri in changed {
                if self.read_document(&uri) {
                    unsimulated.insert(uri);
                }
            }
        }
    }

    /// Reads a document and sends its findings. Returns whether it is a program that a setup with stock is known for.
    fn read_document(&self, uri: &str) -> bool {
        let taken = {
            let mut state = self.shared.lock();
            let setup = state.settings.setup.clone();
            let Some(document) = state.documents.get_mut(uri) else { return false };
            let kind = document.yaml_kind();
            (document.take_text(), document.is_yaml, kind, document.version, setup)
        };
        let (source, is_yaml, kind, version, setup_file) = taken;
        let (mut view, mut findings, mut has_stock) = (None, Vec::new(), false);
        let done = catch_defect(source.name(), || match is_yaml {
            true => findings = kind.map(|kind| check_yaml_text(&source, kind)).unwrap_or_default(),
            false => {
                let setup = setup_file.as_deref().and_then(|path| read_setup(path, &mut findings));
                has_stock = setup.as_ref().is_some_and(|setup| setup.stock.is_some());
                view = Some(Arc::new(ProgramView::new(&source, setup.as_ref())));
            }
        });
        findings.extend(done.err());
        let sent = {
            let mut state = self.shared.lock();
            let documentation = state.settings.documentation.clone();
            let Some(document) = state.documents.get_mut(uri) else { return false };
            document.put_found(version, view.clone(), findings.clone());
            let of_program = view.as_ref().map(|view| view.findings()).unwrap_or_default();
            let all = findings.iter().chain(of_program);
            // A newer text is read next, and then its findings are sent.
            (document.version == version).then(|| findings_to_json(all, &source, documentation.as_deref()))
        };
        if let Some(diagnostics) = sent {
            let params = json!({ "uri": uri, "version": version, "diagnostics": diagnostics });
            self.outbox.notify("textDocument/publishDiagnostics", &params);
            self.outbox.refresh_hints();
        }
        view.is_some() && has_stock
    }

    /// Simulates a program for its chips. It stops when something is to be read, and begins again afterwards.
    fn simulate(&self, uri: &str, again: &mut BTreeSet<String>) {
        let (view, setup_file) = {
            let state = self.shared.lock();
            let view = state.documents.get(uri).and_then(|document| document.read.view.clone());
            (view, state.settings.setup.clone())
        };
        let (Some(view), Some(path)) = (view, setup_file) else { return };
        let Some(setup) = read_setup(&path, &mut Vec::new()) else { return };
        let watch = StopForWork { waiting: &self.waiting };
        // A simulation may have all cores but one.
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let pool = make_pool(cores.saturating_sub(1).max(1));
        let find = || find_chips(&view, &setup, &watch);
        let run = || pool.as_ref().map_or_else(find, |pool| pool.install(find));
        match catch_defect(uri, run).unwrap_or_else(|defect| Err(defect.into())) {
            Ok(chips) => {
                let mut state = self.shared.lock();
                if let Some(document) = state.documents.get_mut(uri)
                    && document.read.view.as_ref().is_some_and(|now| Arc::ptr_eq(now, &view))
                {
                    document.read.chips = Arc::new(chips);
                }
            }
            Err(Failure::Interrupted) => {
                again.insert(uri.to_owned());
            }
            // What forbids a simulation is told by `simulate`; the editor shows programs without chips.
            Err(Failure::Found(_)) => {}
        }
    }
}

fn make_pool(threads: usize) -> Option<rayon::ThreadPool> {
    rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_BYTES).build().ok()
}

/// Reads the setup with the files that it names. What is wrong with it is a finding of the program, at the setup's place.
pub(super) fn read_setup(path: &Path, findings: &mut Vec<Diagnostic>) -> Option<Setup> {
    let read = || input_files::read_setup(path)?.read_material_file(input_files::read_bytes);
    match read() {
        Ok(setup) => Some(setup),
        Err(failure) => {
            findings.extend(failure.into_findings());
            None
        }
    }
}

/// Returns the thickest chip of the motions of each line.
fn find_chips(
    view: &ProgramView,
    setup: &Setup,
    watch: &dyn RunWatcher,
) -> Result<BTreeMap<u32, f64>, Failure> {
    let machining = Machining::new(view.program(), setup, view.unit(), &mut Vec::new())?;
    let report = SimulationReport::simulate_program(&machining, &SimulationRunOptions::default(), watch)?;
    let mut chips = BTreeMap::new();
    for row in &report.motions.rows {
        if let (Some(line), Some(chip)) = (row.line, row.chip_thickness_mm) {
            let thickest = chips.entry(line.saturating_sub(1) as u32).or_insert(chip);
            *thickest = chip.max(*thickest);
        }
    }
    Ok(chips)
}

/// Stops a simulation when something is to be read.
struct StopForWork<'w> {
    waiting: &'w AtomicUsize,
}

impl RunWatcher for StopForWork<'_> {
    fn report_progress(&self, _: f64, _: f64) {}

    fn is_stop_requested(&self) -> bool {
        self.waiting.load(Ordering::Relaxed) > 0
    }

    fn memory_limit_bytes(&self) -> Option<u64> {
        Some(MOST_MEMORY_BYTES)
    }
}

/// Returns findings as the protocol has them. Those whose first place is in another file stand at the start of this one,
/// with a link to their place. Where there are too many, the last one says how many are left out.
pub(super) fn findings_to_json<'f>(
    all: impl Iterator<Item = &'f Diagnostic>,
    source: &Arc<Source>,
    documentation: Option<&str>,
) -> Vec<Value> {
    let mut all: Vec<&Diagnostic> = all.collect();
    all.sort_by_key(|found| std::cmp::Reverse(found.severity));
    let left_out = all.len().saturating_sub(MOST_FINDINGS);
    all.truncate(MOST_FINDINGS);
    let mut told: Vec<Value> =
        all.into_iter().map(|found| finding_to_json(found, source, documentation)).collect();
    if left_out > 0 {
        let start = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } });
        let message =
            format!("{left_out} more findings are not shown here; `clsmith check` tells all of them");
        told.push(json!({ "range": start, "severity": 3, "source": "clsmith", "message": message }));
    }
    told
}

/// Returns a finding as the protocol has it.
pub(super) fn finding_to_json(
    found: &Diagnostic,
    source: &Arc<Source>,
    documentation: Option<&str>,
) -> Value {
    let start = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } });
    let own = found.labels.first().filter(|label| label.source.name() == source.name());
    let range = own.and_then(|label| moved_span(&label.source, label.span, &EditedLines::default()));
    let mut message = found.message.clone();
    for more in [own.map(|label| label.message.as_str()), found.help.as_deref()].into_iter().flatten() {
        if !more.is_empty() {
            message.push('\n');
            message.push_str(more);
        }
    }
    let others = found.labels.iter().skip(usize::from(own.is_some()));
    let related: Vec<Value> = others
        .map(|label| {
            let uri = path_to_uri(Path::new(label.source.name()));
            let text = if label.message.is_empty() { "here" } else { label.message.as_str() };
            json!({ "location": { "uri": uri, "range": span_to_json(&label.source, label.span) }, "message": text })
        })
        .collect();
    let severity = match found.severity {
        Severity::Error => 1,
        Severity::Warning => 2,
        Severity::Note => 3,
    };
    let id = found.code.id();
    let mut told = json!({
        "range": range.unwrap_or(start),
        "severity": severity,
        "code": id,
        "source": "clsmith",
        "message": message,
        "relatedInformation": related,
    });
    if let (Some(address), Value::Object(fields)) = (documentation, &mut told) {
        let link = format!("{address}#{}", id.to_ascii_lowercase());
        fields.insert("codeDescription".to_owned(), json!({ "href": link }));
    }
    told
}
