//! Every example and every shipped configuration works.

use crate::support;
use clsmith::diagnostic::Diagnostic;
use clsmith::job::CorrectionJob;
use clsmith::program::LengthUnit;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::setup::{Setup, WorkMaterial};
use clsmith::source::Source;
use clsmith::transform::Recipe;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[allow(dead_code)] // its `main`
#[path = "../examples/figurine/generate.rs"]
mod figurine;

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path()).collect();
    found.sort();
    found
}

fn recipe(path: &Path) -> (Recipe, Setup) {
    let recipe =
        Recipe::load(&support::source(path)).unwrap_or_else(|found| panic!("{}: {found:?}", path.display()));
    let read = |name: &str| Ok(support::source(&path.parent().unwrap().join(name)));
    let named = recipe.load_setup_file(read).unwrap();
    let setup = recipe.merge_setups(named, Setup::default());
    let setup = setup.read_machine_file(|path| Ok(support::source(path))).unwrap();
    (recipe, setup)
}

fn run(recipe: &Recipe, setup: &Setup, source: &Arc<Source>) -> String {
    let done = CorrectionJob::new(recipe, setup, &FindingPolicy::default()).correct_source(source).unwrap();
    assert!(!done.findings.iter().any(Diagnostic::is_error), "{:?}", done.findings);
    let mut patch = Vec::new();
    clsmith::report::unified_diff::write_unified_diff(&mut patch, &done.program, &Default::default())
        .unwrap();
    String::from_utf8_lossy(&patch).into_owned()
}

/// A program, or the first lines of a long one: what is simulated in a test must be short.
fn beginning(part: &Path) -> Arc<Source> {
    const LINES: usize = 200;
    let whole = std::fs::read_to_string(part).unwrap();
    if whole.lines().count() < 10 * LINES {
        return support::source(part);
    }
    support::text(whole.split_inclusive('\n').take(LINES).collect::<String>())
}

#[test]
fn examples_do_what_their_pages_show() {
    // What a recipe corrects; the others have tests of their own.
    for example in files(&folder("examples")).into_iter().filter(|path| path.join("recipe.yaml").exists()) {
        let name = example.file_name().unwrap().to_string_lossy().into_owned();
        let page = std::fs::read_to_string(example.join("README.md")).unwrap();
        assert!(
            page.contains(&format!("examples/{name}/recipe.yaml")),
            "{name}: the page shows how to run it"
        );
        let (recipe, setup) = recipe(&example.join("recipe.yaml"));
        let part = files(&example)
            .into_iter()
            .find(|path| path.file_stem().is_some_and(|stem| stem == "part"))
            .unwrap();
        let patch = run(&recipe, &setup, &beginning(&part));
        support::snapshots("examples").bind(|| insta::assert_snapshot!(name, patch));
    }
}

#[test]
fn the_ball_over_a_profile_is_what_its_page_makes() {
    let shipped = folder("examples/ball-profile");
    let page = std::fs::read_to_string(shipped.join("README.md")).unwrap();
    let command = page.lines().find_map(|line| line.strip_prefix("clsmith ")).unwrap();
    let made = crate::cli::example("ball-profile");
    let file = |folder: &Path, name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    for name in ["part.cls", "figure.svg"] {
        std::fs::remove_file(made.path().join(name)).unwrap();
    }
    let done = crate::cli::clsmith(made.path()).args(command.split(' ')).assert().success();
    let shown = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    assert!(page.contains(&format!("```text\n{shown}```")), "{shown}");
    for name in ["part.cls", "figure.svg"] {
        assert!(file(made.path(), name) == file(&shipped, name), "{name} is what the command makes");
    }
}

#[test]
fn the_chips_in_five_axes_are_what_their_page_shows() {
    let shipped = folder("examples/five-axis-chip");
    let page = std::fs::read_to_string(shipped.join("README.md")).unwrap();
    let made = crate::cli::example("five-axis-chip");
    let figures = ["chip.svg", "diagram.svg", "corner.svg"];
    for name in figures {
        std::fs::remove_file(made.path().join(name)).unwrap();
    }
    let mut shown = String::new();
    for command in page.lines().filter_map(|line| line.strip_prefix("clsmith ")) {
        let done = crate::cli::clsmith(made.path()).args(command.split(' ')).assert().success();
        shown = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    }
    assert!(page.contains(&format!("```text\n{shown}```")), "{shown}");
    for name in figures {
        let file = |folder: &Path| std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(file(made.path()) == file(&shipped), "{name} is what the command makes");
    }
}

#[test]
fn the_cradle_is_what_its_page_shows() {
    let shipped = folder("examples/cradle");
    let page = std::fs::read_to_string(shipped.join("README.md")).unwrap();
    let made = crate::cli::example("cradle");
    let figures = ["machine.svg", "axes.svg"];
    for name in figures {
        std::fs::remove_file(made.path().join(name)).unwrap();
    }
    let mut shown = String::new();
    let commands = page.lines().filter_map(|line| line.strip_prefix("clsmith "));
    for command in commands.filter(|command| !command.starts_with("apply ")) {
        let done = crate::cli::clsmith(made.path()).args(command.split(' ')).assert().success();
        shown = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    }
    assert!(page.contains(&format!("```text\n{shown}```")), "{shown}");
    for name in figures {
        let file = |folder: &Path| std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(file(made.path()) == file(&shipped), "{name} is what the command makes");
    }
}

#[test]
fn the_dynamometer_is_what_its_page_shows() {
    let shipped = folder("examples/dynamometer");
    let page = std::fs::read_to_string(shipped.join("README.md")).unwrap();
    let made = crate::cli::example("dynamometer");
    let figures = ["residuals.svg", "turn.svg"];
    for name in figures {
        std::fs::remove_file(made.path().join(name)).unwrap();
        assert!(page.contains(&format!("]({name})")), "the page shows {name}");
    }
    for command in page.lines().filter_map(|line| line.strip_prefix("clsmith ")) {
        crate::cli::clsmith(made.path()).args(command.split(' ')).assert().success();
    }
    for name in figures {
        let file = |folder: &Path| std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(file(made.path()) == file(&shipped), "{name} is what the command makes");
    }
}

#[test]
fn the_figurine_is_what_its_generator_prints() {
    let part = std::fs::read_to_string(folder("examples/figurine/part.cls")).unwrap();
    let differs = part.lines().zip(figurine::program().lines()).position(|(file, printed)| file != printed);
    assert_eq!(differs, None, "the first line that differs");
    assert!(part == figurine::program(), "to the last byte");
}

#[test]
fn shipped_configurations_load_and_run() {
    let part = support::source(&folder("examples/pocket/part.cls"));
    for path in files(&folder("configs/recipes")) {
        let (recipe, setup) = recipe(&path);
        run(&recipe, &setup, &part);
    }
    for path in files(&folder("configs/machines")) {
        let setup = Setup::load(&support::source(&path)).unwrap();
        assert!(setup.machine.max_acceleration.is_some(), "{}", path.display());
    }
    for path in files(&folder("configs/tools")) {
        let setup = Setup::load(&support::source(&path)).unwrap();
        assert!(!setup.tools.is_empty(), "{}", path.display());
        for entry in setup.tools.iter().filter(|entry| entry.number.is_some()) {
            let tool = support::named_tool(entry.number, None);
            let cutter = setup.resolve_cutter(&tool, LengthUnit::Mm).unwrap().cutter;
            assert!(cutter.teeth.is_some(), "{}: tool {:?}", path.display(), entry.number);
        }
    }
    for path in files(&folder("configs/materials")) {
        let material = WorkMaterial::load(&support::source(&path)).unwrap();
        assert!(material.name.is_some(), "{}", path.display());
    }
}

#[test]
fn the_page_about_the_setup_shows_one_that_loads() {
    let page = std::fs::read_to_string(folder("configs/README.md")).unwrap();
    let shown = page.split("```yaml\n").nth(1).unwrap().split("```").next().unwrap();
    let setup = Setup::load(&support::text(shown)).unwrap();
    assert_eq!((setup.stock.unwrap().bodies.len(), setup.tools.len()), (5, 2));
    let schema = Setup::schema().to_string();
    for line in shown.lines() {
        let key = line.trim_start_matches([' ', '-', '#']).split(':').next().unwrap();
        let is_key =
            !key.is_empty() && line.contains(':') && key.chars().all(|c| c.is_ascii_lowercase() || c == '_');
        assert!(!is_key || schema.contains(&format!("\"{key}\"")), "{key}");
    }
}

#[test]
fn the_readme_shows_what_happens() {
    let readme = std::fs::read_to_string(folder("README.md")).unwrap();
    let (recipe, setup) = recipe(&folder("examples/pocket/recipe.yaml"));
    let patch = run(&recipe, &setup, &support::source(&folder("examples/pocket/part.cls")));
    let shown = readme.split("```diff\n").nth(1).unwrap().split("```").next().unwrap();
    for line in shown.lines() {
        assert!(patch.lines().any(|found| found == line), "{line}\n{patch}");
    }
}

#[test]
fn on_the_stairs_removal_rate_and_force_mislead_in_both_directions() {
    let folder = folder("examples/stairs");
    let part = support::source(&folder.join("part.cls"));
    let setup = Setup::load(&support::source(&folder.join("shop.yaml"))).unwrap();
    let setup = setup.read_material_file(|path| Ok(support::source(&folder.join(path)))).unwrap();
    let program = clsmith::parse::parse(&part, None).program;
    let mut assumed = Vec::new();
    let machining =
        clsmith::simulation_run::Machining::new(&program, &setup, LengthUnit::Mm, &mut assumed).unwrap();
    let options = clsmith::simulation_run::SimulationRunOptions::default().with_cell_mm(0.2);
    let watch = clsmith::simulation_run::SilentWatcher;
    let ran = clsmith::report::simulation::SimulationReport::simulate_program(&machining, &options, &watch)
        .unwrap();
    assert!(!ran.findings.iter().any(Diagnostic::is_error), "{:?}", ran.findings);
    let begins = std::str::from_utf8(part.bytes()).unwrap().lines().position(|line| line.contains("/STAIRS"));
    let begins = begins.unwrap();
    let largest = |of: fn(&clsmith::report::simulation::MotionRow) -> Option<f64>, stairs: bool| {
        let rows = ran.motions.rows.iter().filter(|row| row.line.is_some_and(|line| line > begins) == stairs);
        rows.filter_map(of).fold(0.0, f64::max)
    };
    let [chip, rate, force]: [fn(&clsmith::report::simulation::MotionRow) -> Option<f64>; 3] =
        [|row| row.chip_thickness_mm, |row| row.peak_removal_rate_mm3_min, |row| row.force_n];
    assert!(largest(chip, true) > 1.5 * largest(chip, false), "the chips are thicker on the stairs");
    assert!(largest(rate, true) < 0.3 * largest(rate, false), "less is removed there");
    assert!(largest(force, true) < largest(force, false), "and the force is smaller");
}
