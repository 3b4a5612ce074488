//! The command line is one hand's work: the same option means the same in every command, old spellings still
//! work, and help, completions and progress fit who reads them.

use super::{clsmith, names};
use crate::support::snapshots;
use std::path::Path;

const COMMANDS: [&str; 23] = [
    "apply",
    "batch",
    "merge",
    "check",
    "init",
    "stats",
    "simulate",
    "axes",
    "machine",
    "setup",
    "chips",
    "section",
    "diff",
    "hook",
    "watch",
    "plot",
    "undo",
    "transforms",
    "schema",
    "explain",
    "completions",
    "man",
    "lsp",
];

fn help(command: &str, columns: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let done = clsmith(folder.path()).args([command, "--help"]).env("COLUMNS", columns).assert().success();
    String::from_utf8_lossy(&done.get_output().stdout).into_owned()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A program that cuts a slot, and its setup.
fn slot() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let part = "TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\nLOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\n\
        GOTO/-10.0000,0.0000,-2.0000\nFEDRAT/MMPM,400.0000\nGOTO/40.0000,0.0000,-2.0000\n";
    std::fs::write(folder.path().join("part.cls"), part).unwrap();
    let shop = "stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n\
        tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
    std::fs::write(folder.path().join("shop.yaml"), shop).unwrap();
    folder
}

#[test]
fn every_command_has_examples_and_help_fits_the_width() {
    for command in COMMANDS {
        for columns in ["60", "80", "100", "160"] {
            let shown = help(command, columns);
            assert!(shown.contains("Examples:"), "{command}");
            let most: usize = columns.parse::<usize>().unwrap().min(100);
            // clap does not wrap the line of usage.
            let long: Vec<&str> = shown
                .lines()
                .filter(|line| line.chars().count() > most && !line.starts_with("Usage:"))
                .collect();
            assert!(long.is_empty(), "{command} in {columns}: {long:#?}");
        }
    }
}

#[test]
fn help_is_read_by_people() {
    let all: Vec<String> = COMMANDS
        .iter()
        .map(|command| format!("$ clsmith {command} --help\n{}", help(command, "100")))
        .collect();
    snapshots("cli").bind(|| insta::assert_snapshot!("help", all.join("\n")));
}

#[test]
fn options_are_spelled_the_same_in_all_commands() {
    for command in COMMANDS {
        let shown = help(command, "100");
        let has = |option: &str| shown.contains(option);
        // Old spellings are hidden.
        assert!(!has("--out ") && !has("--svg") && !has("--budget"), "{command}");
        assert!(!has("--jobs <"), "{command}");
        assert!(!has("--json <"), "{command}");
        // The tasks of `setup` have it themselves.
        let analyses = !["merge", "undo", "schema", "completions", "man", "setup", "lsp"].contains(&command);
        assert_eq!(has("--json[=<FILE>]"), analyses, "{command}");
        assert_eq!(has("--memory"), has("--memory <SIZE>"), "{command}");
        assert_eq!(has("--plot "), has("--plot <FILE>"), "{command}");
        assert_eq!(has("--output"), has("-o, --output"), "{command}");
        let computes = ["apply", "batch", "simulate", "axes", "chips", "plot", "section", "hook", "watch"]
            .contains(&command);
        assert_eq!(has("--memory <SIZE>") && has("--time-limit <SECONDS>"), computes, "{command}");
        let reads = ["check", "stats", "diff", "init"].contains(&command);
        assert_eq!(has("--threads <N>"), computes || reads, "{command}");
        assert_eq!(has("--memory <SIZE>"), computes || reads, "{command}");
        assert_eq!(has("--progress <WHEN>"), computes, "{command}");
    }
}

#[test]
fn json_goes_to_standard_output_or_to_its_file() {
    let folder = slot();
    let run = |words: &str| clsmith(folder.path()).args(words.split(' ')).assert();
    let json = |bytes: &[u8]| serde_json::from_slice::<serde_json::Value>(bytes).unwrap();
    std::fs::write(folder.path().join("slow.yaml"), "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n")
        .unwrap();
    std::fs::write(folder.path().join("slow.cls"), "FEDRAT/MMPM,200.\nGOTO/1,2,3\n").unwrap();
    for command in [
        "check part.cls",
        "stats part.cls",
        "diff part.cls part.cls",
        "simulate part.cls --setup shop.yaml",
        "chips part.cls --setup shop.yaml --layer 0.5",
        "apply slow.yaml part.cls --dry-run",
        "plot part.cls -o plot.svg",
        "machine shop.yaml",
        "transforms scale_feed",
        "transforms",
        "explain CL0001",
        "explain",
    ] {
        let standard = run(&format!("{command} --json")).success();
        let expected = json(&standard.get_output().stdout);
        for spelled in ["--json=out.json", "--json out.json"] {
            run(&format!("{command} {spelled}")).success();
            let file = folder.path().join("out.json");
            assert_eq!(json(&std::fs::read(&file).unwrap()), expected, "{command} {spelled}");
            std::fs::remove_file(&file).unwrap();
        }
    }
    // What is behind `--json` is a program where it cannot be the file.
    let stats = run("stats part.cls --json").success().get_output().stdout.clone();
    assert_eq!(run("stats --json part.cls").success().get_output().stdout, stats);
    assert_eq!(run("stats --json=- part.cls").success().get_output().stdout, stats);
    let piped =
        clsmith(folder.path()).args(["stats", "--json", "-"]).write_stdin("GOTO/1,2,3\n").assert().success();
    assert_eq!(json(&piped.get_output().stdout)["file"], "standard input");
    let both = run("stats part.cls --json both.json").success();
    assert!(text(&both.get_output().stdout).contains("part.cls"));
    // No output goes over an input, whatever the command. A text does not even go where a program is expected.
    std::fs::copy(folder.path().join("part.cls"), folder.path().join("part")).unwrap();
    run("check part.cls -o part.cls").code(2);
    for wrong in ["stats part.cls --json=part.cls", "check part -o part", "diff part.cls part -o part"] {
        assert!(text(&run(wrong).code(1).get_output().stderr).contains("CL0404"), "{wrong}");
    }
    run("stats part.cls --json=a.csv").code(2);
}

#[test]
fn texts_go_to_a_file() {
    let folder = slot();
    for command in [
        "check part.cls",
        "stats part.cls",
        "diff part.cls part.cls",
        "schema",
        "transforms",
        "explain CL0001",
        "completions bash",
        "check --format sarif part.cls",
    ] {
        let words: Vec<&str> = command.split(' ').collect();
        let shown = clsmith(folder.path()).args(&words).assert().success();
        let done = clsmith(folder.path()).args(&words).args(["-o", "text"]).assert().success();
        assert!(done.get_output().stdout.is_empty(), "{command}");
        assert_eq!(
            std::fs::read(folder.path().join("text")).unwrap(),
            shown.get_output().stdout,
            "{command}"
        );
    }
}

#[test]
fn no_text_goes_where_another_program_expects_something_else() {
    let folder = slot();
    let before = names(folder.path());
    for (command, file) in [
        ("check part.cls", "a.pdf"),
        ("check --format sarif part.cls", "a.cls"),
        ("stats part.cls", "a.aptsource"),
        ("diff part.cls part.cls", "a.nc"),
        ("explain CL0001", "a.html"),
        ("transforms", "a.svg"),
    ] {
        let words: Vec<&str> = command.split(' ').collect();
        let done = clsmith(folder.path()).args(&words).args(["-o", file]).assert().code(2);
        let said = text(&done.get_output().stderr);
        assert!(said.contains("-o writes text") && said.contains("give it .txt"), "{command}: {said}");
    }
    assert_eq!(names(folder.path()), before);
}

#[test]
fn old_spellings_work_and_say_what_to_write() {
    let folder = slot();
    let run = |words: &str| {
        let done = clsmith(folder.path()).args(words.split(' ')).assert().success();
        text(&done.get_output().stderr)
    };
    let noted = run("simulate part.cls --setup shop.yaml --budget 1");
    assert!(noted.contains("note: `--budget` is an older spelling; write `--memory` with a unit"), "{noted}");
    let noted = run("chips part.cls --setup shop.yaml --layer 0.5 --svg a.svg");
    assert!(noted.contains("note: `--svg` is an older spelling; write `--plot`"), "{noted}");
    assert!(run("init part.cls --out .").is_empty() || names(folder.path()).contains(&"setup.yaml".into()));
    assert!(!run("chips part.cls --setup shop.yaml --layer 0.5 --plot b.svg").contains("older"));
    assert!(!run("chips part.cls --setup shop.yaml --layer 0.5 --svg a.svg -q").contains("older"));
    assert!(run("man --out .").contains("write `--output`"));
}

#[test]
fn a_drawing_is_what_its_ending_says() {
    let folder = slot();
    let begins =
        |name: &str, magic: &[u8]| std::fs::read(folder.path().join(name)).unwrap().starts_with(magic);
    let chips = ["chips", "part.cls", "--setup", "shop.yaml", "--layer", "0.5", "-q"];
    clsmith(folder.path()).args(chips).args(["--plot", "c.png", "--diagram", "d.svg"]).assert().success();
    assert!(begins("c.png", b"\x89PNG") && begins("d.svg", b"<svg"));
    let profile = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/ball-profile/profile.yaml");
    let section =
        ["section", "--from", "0", "--to", "4", "--step", "2", "--radius", "5", "--feed", "800", "--dry-run"];
    clsmith(folder.path())
        .args(section)
        .arg("--profile")
        .arg(profile)
        .args(["--plot", "p.png"])
        .assert()
        .success();
    assert!(begins("p.png", b"\x89PNG"));
}

#[test]
fn memory_has_a_unit_and_raises_what_stock_may_take() {
    let folder = slot();
    let run = |words: &[&str]| {
        clsmith(folder.path()).args(["simulate", "part.cls", "--setup", "shop.yaml"]).args(words).assert()
    };
    assert!(text(&run(&["--memory", "4"]).code(2).get_output().stderr).contains("a size with its unit"));
    run(&["--memory", "4GiB"]).success();
    run(&["--memory", "1.5G", "--threads", "1"]).success();
    run(&["--memory", "4GiB", "--budget", "1"]).code(2);
}

#[test]
fn progress_names_its_phase_and_never_jumps_back() {
    let folder = slot();
    let quiet =
        clsmith(folder.path()).args(["simulate", "part.cls", "--setup", "shop.yaml"]).assert().success();
    assert!(!text(&quiet.get_output().stderr).contains("simulating"));
    let recipe = "version: 1\nsetup_file: shop.yaml\nsteps:\n  - scale_feed: { factor: 0.5 }\n  \
        - optimize_feed: { target: 0.05, cell: 0.5, max_feed: 8000 }\n";
    std::fs::write(folder.path().join("feed.yaml"), recipe).unwrap();
    let apply =
        ["apply", "feed.yaml", "part.cls", "-o", "out.cls", "--progress", "always", "--report", "a.html"];
    let done = clsmith(folder.path()).args(apply).assert().success();
    let shown = text(&done.get_output().stderr);
    let lines: Vec<&str> =
        shown.lines().filter(|line| line.starts_with("part.cls: ") && line.ends_with(" %")).collect();
    for phase in ["reading", "correcting", "simulating", "planning", "checking", "writing"] {
        assert!(lines.iter().any(|line| line.contains(phase)), "{phase}: {shown}");
    }
    let percent =
        |line: &&str| line.rsplit(' ').nth(1).and_then(|number| number.parse::<u32>().ok()).unwrap();
    let all: Vec<u32> = lines.iter().map(percent).collect();
    assert!(all.is_sorted(), "{shown}");
    let done = clsmith(folder.path()).args(apply).args(["-q"]).assert().success();
    assert_eq!(text(&done.get_output().stderr), "");
}

#[test]
fn completions_know_steps_codes_and_dialects() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let done = clsmith(folder.path()).args(["completions", shell]).assert().success();
        let script = text(&done.get_output().stdout);
        if shell == "elvish" {
            continue;
        }
        for word in ["move_origin", "CL0510", "creo-gpost", "warnings", "comments"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn bash_completes() {
    let folder = tempfile::tempdir().unwrap();
    if std::process::Command::new("bash").arg("-c").arg(":").status().is_err() {
        return;
    }
    clsmith(folder.path()).args(["completions", "bash", "-o", "script"]).assert().success();
    let complete = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        let current = words.len() - 1;
        let before = words[current - 1];
        let asked = format!(
            "source ./script; COMP_WORDS=({}); COMP_CWORD={current}; _clsmith clsmith '{}' '{before}'; echo \"${{COMPREPLY[@]}}\"",
            words.iter().map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" "),
            words[current]
        );
        let done = std::process::Command::new("bash")
            .args(["-c", &asked])
            .current_dir(folder.path())
            .output()
            .unwrap();
        text(&done.stdout).trim().to_owned()
    };
    assert_eq!(complete("clsmith transforms move"), "move_origin");
    assert!(complete("clsmith check --allow CL051").starts_with("CL0510 CL0511 CL0512"));
    assert_eq!(complete("clsmith check --deny warn"), "warnings");
    assert_eq!(complete("clsmith stats --dialect creo"), "creo creo-gpost");
    assert_eq!(complete("clsmith explain CL000"), "CL0001 CL0002 CL0003 CL0004");
}

#[test]
fn lines_that_fit_nothing_tell_what_lines_there_are() {
    let folder = slot();
    let chips = ["chips", "part.cls", "--setup", "shop.yaml", "--layer", "0.5", "--lines", "1..3"];
    let done = clsmith(folder.path()).args(chips).assert().code(1);
    let shown = text(&done.get_output().stderr);
    assert!(shown.contains("motions end on lines 5 and 7"), "{shown}");
}

#[test]
fn transforms_tell_unit_range_and_default_of_every_key() {
    for name in clsmith::transform::NAMES {
        let told = clsmith::report::step_descriptions::describe_step(name).unwrap();
        assert!(told.contains("\nExample:\n  version: 1\n"), "{told}");
        // A key is a line, and what is said of it follows deeper.
        let lines: Vec<&str> = told.split_once("Parameters:\n").unwrap().1.lines().collect();
        let depth = |line: &str| line.len() - line.trim_start().len();
        let is_key = |line: &str| {
            let word = line.trim_start().split(':').next().unwrap_or_default();
            line.contains(": ")
                && depth(line) <= 8
                && word.chars().all(|c| c.is_ascii_lowercase() || c == '_')
        };
        for (index, line) in lines.iter().enumerate().filter(|(_, line)| is_key(line)) {
            let of_key: Vec<&str> = lines[index + 1..]
                .iter()
                .take_while(|next| !is_key(next) && depth(next) > depth(line))
                .copied()
                .collect();
            let said = of_key.join(" ");
            let kind = line.split_once(": ").unwrap().1;
            let is_number = !kind.contains('`')
                && (kind.starts_with("number") || kind.contains("x number") || kind.starts_with("integer ("));
            assert!(!is_number || said.contains("Unit: "), "{name}, {line}: {said}");
            let is_choice = lines.iter().any(|other| {
                let word = line.trim().split(':').next().unwrap_or_default();
                other.contains(&format!("`{word}: "))
            });
            assert!(
                line.contains("(required)") || is_choice || said.contains("Default: "),
                "{name}, {line}: {said}"
            );
        }
    }
}

/// A ball that winds four times around on top of a cylinder, tilted outwards.
fn winding() -> String {
    let head = "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,5.0000,80.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,6000,CLW\n";
    let goto = |step: i32, height: f64| {
        let ((sine, cosine), (st, ct)) =
            (f64::from(10 * step).to_radians().sin_cos(), 20f64.to_radians().sin_cos());
        let [x, y] = [20.0 * cosine, 20.0 * sine];
        format!("GOTO/{x:.5},{y:.5},{height:.5},{:.7},{:.7},{:.7}\n", st * cosine, st * sine, ct)
    };
    let cut: String = (0..=144).map(|step| goto(step, -0.5)).collect();
    format!(
        "{head}RAPID\n{}FEDRAT/MMPM,800.0000\n{cut}RAPID\n{}END-OF-PATH\n",
        goto(0, 30.0),
        goto(144, 40.0)
    )
}

#[test]
fn every_example_of_a_transform_runs() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let profile = "TLDATA/MILL,10.0000,5.0000,50.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,5000,CLW\nRAPID\n\
        GOTO/0.0000,0.0000,40.0000\nFEDRAT/MMPM,400.0000\nGOTO/0.0000,0.0000,0.0000\nGOTO/20.0000,0.0000,4.0000\n\
        GOTO/40.0000,0.0000,4.0000\nGOTO/60.0000,0.0000,0.0000\nRAPID\nGOTO/60.0000,0.0000,40.0000\n";
    for name in clsmith::transform::NAMES {
        let folder = slot();
        let at = |file: &str| folder.path().join(file);
        match *name {
            "optimize_feed" => {}
            "compensate_z" => std::fs::write(at("part.cls"), profile).unwrap(),
            "unwind" => std::fs::write(at("part.cls"), winding()).unwrap(),
            "linearize" | "inverse_time" => {
                assert!(std::fs::copy(examples.join("cradle/part.cls"), at("part.cls")).unwrap() > 0)
            }
            "correct_ramp" => {
                assert!(std::fs::copy(examples.join("web-pocket/part.cls"), at("part.cls")).unwrap() > 0)
            }
            _ => assert!(std::fs::copy(examples.join("pocket/part.cls"), at("part.cls")).unwrap() > 0),
        }
        let example = clsmith::report::step_descriptions::step_example(name).unwrap();
        std::fs::write(at("recipe.yaml"), &example).unwrap();
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls"]).assert().success();
        let changed = std::fs::read(at("out.cls")).unwrap() != std::fs::read(at("part.cls")).unwrap();
        assert!(changed, "{name}: {example}");
    }
}
