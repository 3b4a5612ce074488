//! Programs cut in layers: what is told, what is left out, and real five-axis programs.

use super::{SETUP, near, nx};
use crate::support;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::{LengthUnit, StatementId};
use clsmith::setup::Setup;
use clsmith::simulation_run::layer_run::{LayerRunOptions, LayerRunResult, UncutReason};
use clsmith::simulation_run::{Machining, RunWatcher, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use std::sync::atomic::Ordering::Relaxed;

/// Line, volume and why it was left out, of every motion.
type Motions = Vec<(usize, f64, Option<UncutReason>)>;

fn run(
    text: &str,
    setup: &str,
    options: &LayerRunOptions,
) -> Result<(Motions, LayerRunResult), Vec<Diagnostic>> {
    let program = support::program(text);
    let setup = Setup::load(&Source::new("shop.yaml", setup.as_bytes().to_vec()).unwrap())
        .map_err(Failure::into_findings)?;
    let machining =
        Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).map_err(Failure::into_findings)?;
    let mut motions = Vec::new();
    let ran = machining.simulate_layers(options, &SilentWatcher, &mut |cut| {
        motions.push((cut.line, cut.volume_mm3(), cut.left_out));
    });
    Ok((motions, ran.map_err(Failure::into_findings)?))
}

fn codes(ran: &LayerRunResult) -> Vec<&'static str> {
    ran.findings.iter().map(|found| found.code.id()).collect()
}

/// The line on which a finding stands, and its message.
fn told(found: &Diagnostic) -> (usize, &str) {
    let label = found.labels.first().unwrap();
    (label.source.line_column(label.span.start).0, &found.message)
}

/// A watcher that asks to stop when it has been asked so often.
struct StopAfter(std::sync::atomic::AtomicUsize);

impl RunWatcher for StopAfter {
    fn report_progress(&self, _: f64, _: f64) {}

    fn is_stop_requested(&self) -> bool {
        self.0.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1)).is_err()
    }
}

/// Two motions wait together, and each is cut in 200 layers: the wish to stop is heard within.
#[test]
fn a_stop_is_heard_between_layers() {
    let program = support::program(nx(FLAT, "GOTO/10.0000,0.0000,-3.0000\nGOTO/20.0000,0.0000,-3.0000\n"));
    let setup = Setup::load(&Source::new("shop.yaml", SETUP.as_bytes().to_vec()).unwrap()).unwrap();
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let motions = program.motions().count();
    let watch = StopAfter((motions + 20).into());
    let mut told = 0;
    let ran = machining.simulate_layers(&LayerRunOptions::new(0.05), &watch, &mut |_| told += 1);
    assert!(matches!(ran, Err(Failure::Interrupted)) && told == 0, "{told} motions were told");
}

const FLAT: &str = "10.0000,0.0000,60.0000,0.0000,0.0000";

fn whole() -> LayerRunOptions {
    LayerRunOptions::new(1.0)
}

#[test]
fn volumes_agree_with_those_of_columns() {
    let body = "GOTO/-20.0000,0.0000,-3.0000\nGOTO/40.0000,0.0000,-3.0000\n\
        CIRCLE/40.0000,10.0000,-3.0000,0.0000000,0.0000000,1.0000000,10.0000,0.0600,0.5000,10.0000,0.0000\n\
        GOTO/50.0000,10.0000,-3.0000\nGOTO/60.0000,10.0000,-3.0000,0.2588190,0.0000000,0.9659258\n";
    let text = nx(FLAT, body);
    let (motions, ran) = run(&text, SETUP, &LayerRunOptions::new(0.25)).unwrap();
    assert_eq!(codes(&ran), [""; 0]);
    let columns = super::machine(&text, SETUP, 0.1).0;
    let chips: Vec<f64> = motions.iter().skip(1).map(|(_, volume, _)| *volume).collect();
    assert_eq!(chips.len(), columns.len());
    for (chip, column) in chips.iter().zip(&columns) {
        // Columns know a border to half a cell, layers the lowest to half a layer.
        near(*chip, column.removed_mm3, 0.02 * column.removed_mm3 + 12.0);
    }
    let left = ran.left.volume_mm3();
    near(ran.before_mm3 - left, chips.iter().sum(), 1e-3 * ran.before_mm3.sqrt());
}

#[test]
fn other_tools_are_told_once_and_left_out() {
    for (tool, has) in [
        ("10.0000,1.0000,60.0000,0.0000,0.0000", "a corner radius of 1 mm"),
        ("10.0000,5.0000,60.0000,0.0000,0.0000", "a ball of radius 5 mm"),
        ("10.0000,0.0000,60.0000,5.0000,0.0000", "a taper of 5.00 degrees"),
        ("10.0000,0.0000,60.0000,0.0000,5.0000", "a bottom that is 5.0 degrees from flat"),
    ] {
        let body = "GOTO/-20.0000,0.0000,-3.0000\nGOTO/40.0000,0.0000,-3.0000\n";
        let (motions, ran) = run(&nx(tool, body), SETUP, &whole()).unwrap();
        assert_eq!(codes(&ran), ["CL0520"], "{tool}");
        let (line, message) = told(&ran.findings[0]);
        assert_eq!(line, 9);
        assert!(message.contains(has) && message.contains("2 motions are left out"), "{message}");
        assert!(
            motions.iter().skip(1).all(|(_, volume, out)| *volume == 0.0 && *out == Some(UncutReason::Tool))
        );
        near(ran.left.volume_mm3(), ran.before_mm3, 0.0);
    }
}

#[test]
fn an_axis_in_the_layers_is_told_at_its_line() {
    let body = "GOTO/10.0000,0.0000,-3.0000,0.0000000,0.9961947,0.0871557\nGOTO/40.0000,0.0000,-3.0000\n\
        GOTO/40.0000,0.0000,-3.0000,0.0000000,0.0000000,1.0000000\nGOTO/50.0000,0.0000,-3.0000\n";
    let (motions, ran) = run(&nx(FLAT, body), SETUP, &whole()).unwrap();
    assert_eq!(codes(&ran), ["CL0521"; 3]);
    let (line, message) = told(&ran.findings[1]);
    assert_eq!(line, 10);
    assert!(message.contains("85.0 degrees from upright"), "{message}");
    // The last motion is upright again, and what the others would have removed is still there.
    let (_, last, _) = motions.last().unwrap();
    assert!(*last > 80.0, "{motions:?}");
}

#[test]
fn far_from_the_stock_nothing_is_told() {
    let body = "GOTO/10.0000,500.0000,300.0000,0.0000000,0.0000000,1.0000000\n\
        GOTO/10.0000,500.0000,300.0000,0.0000000,1.0000000,0.0000000\n\
        GOTO/10.0000,500.0000,300.0000,0.0000000,0.0000000,1.0000000\n";
    let (_, ran) = run(&nx(FLAT, body), SETUP, &whole()).unwrap();
    assert_eq!(codes(&ran), [""; 0]);
}

#[test]
fn every_refusal_has_its_place() {
    let points: String =
        (0..15).map(|x| format!("GOTO/{x}.0000,0.0000,-3.0000,0.0000000,0.9961947,0.0871557\n")).collect();
    let (_, ran) = run(&nx(FLAT, &points), SETUP, &whole()).unwrap();
    let lines: std::collections::BTreeSet<usize> = ran.findings.iter().map(|found| told(found).0).collect();
    assert_eq!((ran.findings.len(), lines.len()), (15, 15));
}

#[test]
fn a_repeated_point_is_a_note_at_its_line() {
    let body = "GOTO/10.0000,0.0000,-3.0000\nGOTO/10.0000,0.0000,-3.0000\nGOTO/20.0000,0.0000,-3.0000\n";
    let (motions, ran) = run(&nx(FLAT, body), SETUP, &whole()).unwrap();
    assert_eq!(codes(&ran), ["CL0522"]);
    assert_eq!(told(&ran.findings[0]).0, 10);
    assert_eq!(motions[2].2, Some(UncutReason::Still));
    assert!(!ran.findings[0].is_error());
}

#[test]
fn rapids_and_standing_spindles_are_told_as_by_the_simulation() {
    let body = "RAPID\nGOTO/10.0000,0.0000,-3.0000\n";
    let (_, ran) = run(&nx(FLAT, body), SETUP, &whole()).unwrap();
    assert_eq!(codes(&ran), ["CL0510"]);
    let text = nx(FLAT, "GOTO/10.0000,0.0000,-3.0000\n").replace("SPINDL/RPM,5000,CLW", "SPINDL/OFF");
    assert_eq!(codes(&run(&text, SETUP, &whole()).unwrap().1), ["CL0512"]);
    // Out along the way that was cut: nothing is left there.
    let body = "GOTO/10.0000,0.0000,-3.0000\nRAPID\nGOTO/10.0000,0.0000,20.0000\nRAPID\nGOTO/-20.0000,0.0000,20.0000\n";
    assert_eq!(codes(&run(&nx(FLAT, body), SETUP, &whole()).unwrap().1), [""; 0]);
}

#[test]
fn stock_and_tools_that_cannot_be_are_errors_with_their_codes() {
    let text = nx(FLAT, "GOTO/10.0000,0.0000,-3.0000\n");
    let code = |text: &str, setup: &str, layer: f64| {
        run(text, setup, &LayerRunOptions::new(layer)).unwrap_err().first().unwrap().code.id()
    };
    assert_eq!(code(&text, SETUP, 1e-7), "CL0523");
    assert_eq!(code(&text, SETUP, f64::NAN), "CL0523");
    assert_eq!(code(&text, "tools: []\n", 1.0), "CL0503");
    let without = text.replace("TLDATA/MILL,10.0000,0.0000,60.0000,0.0000,0.0000\n", "");
    assert_eq!(code(&without, SETUP, 1.0), "CL0501");
    let folder = tempfile::tempdir().unwrap();
    let open = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    std::fs::write(folder.path().join("open.stl"), open).unwrap();
    let path = folder.path().join("shop.yaml");
    std::fs::write(&path, "stock: { stl: open.stl }\n").unwrap();
    let source = Source::new(path.to_string_lossy(), std::fs::read(&path).unwrap()).unwrap();
    let setup = Setup::load(&source).unwrap();
    let program = support::program(&text);
    let errors = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap_err();
    assert!(errors.findings().iter().any(|found| found.code.id() == "CL0504"), "{errors:?}");
}

/// A real program over a block around its points, up to some line.
fn real(end: &str, tool: &str, units: LengthUnit, lines: usize) {
    let Some(path) = support::require_corpus_file(end) else { return };
    let parsed = clsmith::parse::parse(&support::source(&path), None);
    let unit = units.mm_per_unit();
    let line = |statement: StatementId| {
        let start = parsed.program.statement(statement).origin().start;
        parsed.program.source().line_column(start).0
    };
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for motion in
        parsed.program.motions().filter(|motion| !motion.rapid && line(motion.last_statement()) <= lines)
    {
        let [low, high] = &mut bounds;
        for ((low, high), at) in low.iter_mut().zip(high).zip(motion.to.point.iter()) {
            (*low, *high) = (low.min(at * unit), high.max(at * unit));
        }
    }
    let [low, high] = bounds.map(|corner| format!("{corner:?}"));
    let setup =
        format!("stock: {{ block: {{ from: {low}, to: {high} }} }}\ntools: [ {{ match: {{}}, {tool} }} ]\n");
    let setup = Setup::load(&support::text(setup)).unwrap();
    let machining = Machining::new(&parsed.program, &setup, units, &mut Vec::new()).unwrap();
    let height = (bounds[1][2] - bounds[0][2]).max(1.0);
    let options = LayerRunOptions::new(height / 4.0).with_lines(1..=lines).with_tolerance_mm(0.02);
    let (mut cutting, mut refused, mut removed) = (0, 0, 0.0);
    let ran = machining.simulate_layers(&options, &SilentWatcher, &mut |cut| {
        let volume = cut.volume_mm3();
        assert!(volume.is_finite() && volume >= 0.0, "line {}: {volume}", cut.line);
        for layer in cut.piece_chips().flat_map(|chip| &chip.layers) {
            assert!(layer.area_mm2 >= 0.0 && layer.advance_mm.is_finite() && layer.inside_mm2 >= 0.0);
            let borders =
                layer.pieces.iter().flat_map(|piece| std::iter::once(&piece.outer).chain(&piece.holes));
            assert!(borders.flatten().flatten().all(|at| at.is_finite()));
            removed += (layer.area_mm2 + layer.inside_mm2) * layer.thickness_mm;
        }
        cutting += usize::from(volume > 0.0);
        refused += usize::from(cut.first_refusal().is_some());
    });
    let ran = ran.unwrap();
    assert!(cutting > 20, "{cutting} motions cut, {refused} were refused");
    near(ran.before_mm3 - ran.left.volume_mm3(), removed, 1e-3 * ran.before_mm3);
}

#[test]
fn a_turbine_blade_in_five_axes() {
    real("creo-ncl/finition2.ncl", "diameter: 152.4, flute_length: 200", LengthUnit::Inch, 1500);
}

#[test]
fn a_contour_in_five_axes() {
    real("nx-clsf/ust_a.cls", "corner_radius: 0, flute_length: 75", LengthUnit::Mm, 200);
}

#[test]
fn the_options_of_the_simulation_stay_apart() {
    // One machining, both ways of cutting: neither changes what the other finds.
    let program = support::program(nx(FLAT, "GOTO/-20.0000,0.0000,-3.0000\nGOTO/40.0000,0.0000,-3.0000\n"));
    let setup = Setup::load(&support::text(SETUP)).unwrap();
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let chips =
        || machining.simulate_layers(&whole(), &SilentWatcher, &mut |_| {}).unwrap().left.volume_mm3();
    let before = chips();
    machining
        .simulate_program(&SimulationRunOptions::default().with_cell_mm(0.5), &SilentWatcher, &mut |_| {})
        .unwrap();
    assert_eq!(chips(), before);
}
