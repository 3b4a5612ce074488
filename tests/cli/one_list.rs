//! One list of findings: every kind of finding, in every command, says the same numbers in every output and ends with the
//! same exit code.

use super::{clsmith, names};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Findings by code, and how many of them stop the run or are allowed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
struct Told {
    codes: BTreeMap<String, usize>,
    errors: usize,
    allowed: usize,
}

/// A kind of finding: a program, what its recipe and setup are, and the codes that are to be told.
struct Kind {
    name: &'static str,
    program: &'static str,
    recipe: &'static str,
    /// Codes that every command that reads the program tells.
    input: &'static [(&'static str, usize)],
    /// Codes that only commands that run the recipe tell.
    run: &'static [(&'static str, usize)],
    /// Codes that only commands that are given the setup tell: all that correct, too.
    setup: &'static [(&'static str, usize)],
    /// What in the setup is something else.
    edit: [&'static str; 2],
    /// Codes that only commands that simulate tell: all that correct, and `simulate`.
    simulated: &'static [(&'static str, usize)],
    is_error: bool,
}

const SETUP: &str = "machine: { rapid_feed: 5000 }
stock: { block: { from: [0, 0, -10], to: [40, 40, 0] } }
tools:
  - match: { number: 1 }
    diameter: 10
    teeth: 2
    flute_length: 20
";

const HALF: &str = "scale_feed: { factor: 0.5 }";

const KINDS: &[Kind] = &[
    Kind {
        name: "nothing",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/-20,20,5\nRAPID\nGOTO/-20,20,-1\nGOTO/20,20,-1\nRAPID\nGOTO/20,20,50\n",
        recipe: HALF,
        input: &[],
        run: &[],
        setup: &[],
        edit: ["", ""],
        simulated: &[],
        is_error: false,
    },
    Kind {
        name: "a travel that the machine does not have",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/-20,20,5\nRAPID\nGOTO/-20,20,-1\nGOTO/20,20,-1\nRAPID\nGOTO/20,20,50\n",
        recipe: HALF,
        input: &[],
        run: &[],
        setup: &[("CL0703", 2)],
        edit: [
            "rapid_feed: 5000",
            "rapid_feed: 5000, head: [ { name: X, kind: linear, direction: [1, 0, 0], limits: [-250, 10], max_speed: 9000, rapid: 9000, acceleration: 900 }, \
            { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 9000, rapid: 9000, acceleration: 900 }, \
            { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 9000, rapid: 9000, acceleration: 900 } ]",
        ],
        simulated: &[],
        is_error: true,
    },
    Kind {
        name: "a tool whose diameter is a slip of units",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/-20,20,5\nRAPID\nGOTO/-20,20,-1\nGOTO/20,20,-1\nRAPID\nGOTO/20,20,50\n",
        recipe: HALF,
        input: &[],
        run: &[],
        setup: &[("CL0311", 1)],
        edit: ["diameter: 10", "diameter: 1.2"],
        simulated: &[],
        is_error: false,
    },
    Kind {
        name: "an arc that misses its circle",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/0,0,50\nCIRCLE/10,0,50,0,0,1,10\nGOTO/29.5,0,50\n",
        recipe: HALF,
        input: &[("CL0102", 1)],
        run: &[],
        setup: &[],
        edit: ["", ""],
        simulated: &[],
        is_error: true,
    },
    Kind {
        name: "a selection that selects nothing",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/0,0,50\nGOTO/10,0,50\n",
        recipe: "scale_feed: { factor: 0.5, where: { tools: [99] } }",
        input: &[],
        run: &[("CL0303", 1)],
        setup: &[],
        edit: ["", ""],
        simulated: &[],
        is_error: true,
    },
    Kind {
        name: "a warning of the input",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/0,0,50\nGOTO/10,0,50\nGOTO/200000,0,50\nRAPID\nGOTO/0,0,50\n",
        recipe: HALF,
        input: &[("CL0115", 1)],
        run: &[],
        setup: &[],
        edit: ["", ""],
        simulated: &[],
        is_error: false,
    },
    Kind {
        name: "a rapid through the stock",
        program: "FEDRAT/500,MMPM\nRAPID\nGOTO/-20,20,5\nRAPID\nGOTO/-20,20,-1\nRAPID\nGOTO/20,20,-1\nRAPID\nGOTO/20,20,50\n",
        recipe: HALF,
        input: &[],
        run: &[],
        setup: &[],
        edit: ["", ""],
        simulated: &[("CL0510", 1)],
        is_error: true,
    },
];

fn write_kind(folder: &Path, kind: &Kind) {
    let head = "UNITS/MM\nCUTTER/10.0\nLOAD/TOOL,1\nSPINDL/1000,RPM,CLW\n";
    fs::write(folder.join("part.apt"), format!("PARTNO/ONE\n{head}{}FINI\n", kind.program)).unwrap();
    fs::write(folder.join("setup.yaml"), SETUP.replace(kind.edit[0], kind.edit[1])).unwrap();
    fs::write(
        folder.join("recipe.yaml"),
        format!("version: 1\nunits: mm\nsetup_file: setup.yaml\nsteps:\n  - {}\n", kind.recipe),
    )
    .unwrap();
}

/// Runs a command; gives its exit code, standard output and standard error.
fn run(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let done = clsmith(folder).args(args).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (done.status.code().unwrap(), text(done.stdout), text(done.stderr))
}

/// What a JSON document of findings tells.
fn told_by_json(document: &Value) -> Told {
    let mut told = Told::default();
    for found in document["diagnostics"].as_array().unwrap() {
        *told.codes.entry(found["code"].as_str().unwrap().to_owned()).or_default() += 1;
        let allowed = found["allowed"].as_bool().unwrap();
        told.allowed += usize::from(allowed);
        told.errors += usize::from(!allowed && found["severity"] == "error");
    }
    assert_eq!(document["counts"]["errors"], told.errors);
    assert_eq!(document["counts"]["allowed"], told.allowed);
    told
}

/// What lines `file:1:2: CODE: message` tell.
fn told_by_lines(text: &str) -> BTreeMap<String, usize> {
    let mut codes = BTreeMap::new();
    for code in text
        .lines()
        .filter_map(|line| line.split(": ").find(|part| part.len() == 6 && part.starts_with("CL")))
    {
        *codes.entry(code.to_owned()).or_default() += 1;
    }
    codes
}

fn told_by_sarif(text: &str) -> Told {
    let log: Value = serde_json::from_str(text).unwrap();
    let mut told = Told::default();
    for found in log["runs"][0]["results"].as_array().unwrap() {
        *told.codes.entry(found["ruleId"].as_str().unwrap().to_owned()).or_default() += 1;
        let allowed = found["suppressions"].is_array();
        told.allowed += usize::from(allowed);
        told.errors += usize::from(!allowed && found["level"] == "error");
    }
    told
}

/// The line in which text for people counts findings.
fn counts_line(told: &Told) -> String {
    let warnings = told.codes.values().sum::<usize>() - told.errors - told.allowed;
    let one = |count: usize, name: &str| match count {
        0 => None,
        1 => Some(format!("1 {name}")),
        _ => Some(format!("{count} {name}s")),
    };
    let parts: Vec<String> =
        [one(told.errors, "error"), one(warnings, "warning")].into_iter().flatten().collect();
    let counts = if parts.is_empty() { "no problems found".to_owned() } else { parts.join(", ") };
    match told.allowed {
        0 => counts,
        _ => {
            let codes: Vec<String> =
                told.codes.iter().map(|(code, count)| format!("{count} x {code}")).collect();
            format!("{counts}; allowed by hand: {}", codes.join(", "))
        }
    }
}

fn expect(parts: &[&[(&str, usize)]], is_error: bool, allow: bool) -> Told {
    let mut told = Told::default();
    for (code, count) in parts.iter().flat_map(|part| part.iter()) {
        *told.codes.entry((*code).to_owned()).or_default() += count;
    }
    let all = told.codes.values().sum();
    if allow {
        told.allowed = all;
    } else if is_error {
        told.errors = all;
    }
    told
}

/// The options that allow all codes of a kind, or deny warnings.
fn policy_args(kind: &Kind, allow: bool) -> Vec<&'static str> {
    let codes = [kind.input, kind.run, kind.setup, kind.simulated];
    let codes = codes.iter().flat_map(|part| part.iter().map(|(code, _)| *code));
    if allow { codes.flat_map(|code| ["--allow", code]).collect() } else { vec![] }
}

#[test]
fn every_output_of_every_command_tells_the_same() {
    for kind in KINDS {
        for allow in [false, true] {
            let folder = tempfile::tempdir().unwrap();
            let at = folder.path();
            write_kind(at, kind);
            let policy = policy_args(kind, allow);
            let case = format!("{}, allowed: {allow}", kind.name);
            check_command(at, &policy, &expect(&[kind.input], kind.is_error, allow), &case);
            let with_setup = expect(&[kind.input, kind.setup], kind.is_error, allow);
            let asked = [&["--setup", "setup.yaml"], &policy[..]].concat();
            check_command(at, &asked, &with_setup, &format!("{case}, with its setup"));
            measuring_commands(at, &policy, &expect(&[kind.input], kind.is_error, allow), false, &case);
            measuring_commands(at, &asked, &with_setup, kind.edit[1].contains("head"), &case);
            apply_command(at, &policy, kind, allow, &case);
            simulate_command(
                at,
                &policy,
                &expect(&[kind.input, kind.setup, kind.simulated], kind.is_error, allow),
                &case,
            );
            first_commands(at, &policy, &expect(&[kind.input], kind.is_error, allow), &case);
            plot_command(at, &policy, kind, allow, &case);
            let all = [kind.input, kind.run, kind.setup, kind.simulated];
            unattended_commands(at, &policy, &expect(&all, kind.is_error, allow), &case);
        }
    }
}

fn check_command(at: &Path, policy: &[&str], expected: &Told, case: &str) {
    let code = i32::from(expected.errors > 0);
    let check = |format: &str| run(at, &[&["check", "part.apt", "--format", format], policy].concat());
    let (exit, human, _) = check("human");
    assert_eq!(exit, code, "check, {case}: {human}");
    assert!(human.contains(&format!("part.apt: {}\n", counts_line(expected))), "check, {case}: {human}");
    assert_eq!(told_by_lines(&check("line").1), expected.codes, "check lines, {case}");
    assert_eq!(
        &told_by_json(&serde_json::from_str(&check("json").1).unwrap()),
        expected,
        "check json, {case}"
    );
    assert_eq!(&told_by_sarif(&check("sarif").1), expected, "check sarif, {case}");
    let (exit, said, _) = run(at, &[&["check", "part.apt", "--json"], policy].concat());
    assert_eq!(
        (exit, &told_by_json(&serde_json::from_str(&said).unwrap())),
        (code, expected),
        "check --json, {case}"
    );
}

/// `stats`, and `axes` where the machine has some.
fn measuring_commands(at: &Path, options: &[&str], expected: &Told, has_axes: bool, case: &str) {
    for command in if has_axes { &["stats", "axes"][..] } else { &["stats"] } {
        let (exit, said, human) = run(at, &[&[command, "part.apt", "--json"], options].concat());
        let case = format!("{command} {options:?}, {case}: {human}");
        assert_eq!(exit, i32::from(expected.errors > 0), "{case}");
        let json: Value = serde_json::from_str(&said).unwrap();
        assert_eq!(&told_by_json(&json["findings"]), expected, "{case}");
        if !expected.codes.is_empty() {
            assert!(human.contains(&format!("part.apt: {}\n", counts_line(expected))), "{case}");
        }
    }
}

fn read_json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// `init`, and its JSON.
fn first_commands(at: &Path, policy: &[&str], expected: &Told, case: &str) {
    let code = i32::from(expected.errors > 0);
    let _ = fs::remove_dir_all(at.join("starters"));
    fs::create_dir_all(at.join("starters")).unwrap();
    let init = ["init", "part.apt", "-o", "starters", "--json", "init.json"];
    let (exit, said, human) = run(at, &[&init, policy].concat());
    let case = format!("init, {case}: {human}");
    assert_eq!((exit, said.as_str()), (code, ""), "{case}");
    let json = read_json(&at.join("init.json"));
    assert_eq!(&told_by_json(&json["findings"]), expected, "{case}");
    assert_eq!(json["program"]["tools"][0]["number"], 1, "{case}");
    let written: Vec<&str> =
        json["written"].as_array().unwrap().iter().map(|path| path.as_str().unwrap()).collect();
    let there: Vec<String> =
        names(&at.join("starters")).iter().map(|name| format!("starters/{}", name.display())).collect();
    let sorted = |mut paths: Vec<String>| {
        paths.sort();
        paths
    };
    assert_eq!(sorted(written.iter().map(|path| (*path).to_owned()).collect()), there, "{case}");
    assert_eq!(there.len(), if code == 0 { 4 } else { 0 }, "{case}");
    if !expected.codes.is_empty() {
        assert!(human.contains(&format!("part.apt: {}\n", counts_line(expected))), "{case}");
    }
}

/// `plot`, with and without a simulation, and its JSON.
fn plot_command(at: &Path, policy: &[&str], kind: &Kind, allow: bool, case: &str) {
    for simulated in [false, true] {
        let parts: &[_] = if simulated { &[kind.input, kind.setup, kind.simulated] } else { &[kind.input] };
        let expected = &expect(parts, kind.is_error, allow);
        if simulated && expected.codes.contains_key("CL0102") {
            continue;
        }
        let mut args = vec!["plot", "part.apt", "-o", "plot.svg", "--json", "plot.json", "--along", "path"];
        if simulated {
            args.extend(["--setup", "setup.yaml", "--of", "chip,feed"]);
        }
        let _ = fs::remove_file(at.join("plot.svg"));
        let (exit, said, human) = run(at, &[&args, policy].concat());
        let case = format!("plot, simulated: {simulated}, {case}: {human}");
        assert_eq!((exit, said.as_str()), (i32::from(expected.errors > 0), ""), "{case}");
        let json = read_json(&at.join("plot.json"));
        assert_eq!(&told_by_json(&json["findings"]), expected, "{case}");
        // What is wrong is seen best in the drawing.
        assert_eq!(
            (json["written"].as_str(), at.join("plot.svg").exists()),
            (Some("plot.svg"), true),
            "{case}"
        );
        assert_eq!(json["panels"][0]["curves"][0]["name"], "part.apt", "{case}");
        if !expected.codes.is_empty() {
            assert!(human.contains(&format!("part.apt: {}\n", counts_line(expected))), "{case}");
        }
        let standard = run(at, &[&args[..4], &["--json"], &args[6..], policy].concat());
        assert_eq!(serde_json::from_str::<Value>(&standard.1).unwrap(), json, "{case}");
    }
}

fn apply_command(at: &Path, policy: &[&str], kind: &Kind, allow: bool, case: &str) {
    // Whether a report is wanted makes no difference to what is found and written.
    let expected = &expect(&[kind.input, kind.run, kind.setup, kind.simulated], kind.is_error, allow);
    for reports in [false, true] {
        let mut args = vec!["apply", "recipe.yaml", "part.apt", "-o", "out.apt", "--json", "out.json"];
        if reports {
            args.extend(["--report", "out.html", "--summary", "out.md"]);
        }
        let _ = fs::remove_file(at.join("out.apt"));
        let (exit, _, human) = run(at, &[&args, policy].concat());
        let case = format!("apply, reports: {reports}, {case}: {human}");
        assert_eq!(exit, i32::from(expected.errors > 0), "{case}");
        assert_eq!(at.join("out.apt").exists(), expected.errors == 0, "{case}");
        if !expected.codes.is_empty() {
            assert!(human.contains(&format!("part.apt: {}\n", counts_line(expected))), "{case}");
        }
        let json: Value = serde_json::from_slice(&fs::read(at.join("out.json")).unwrap()).unwrap();
        assert_eq!(&told_by_json(&json["findings"]), expected, "{case}");
        assert_eq!(json["output"].is_null(), expected.errors > 0, "{case}");
        if reports {
            let markdown = fs::read_to_string(at.join("out.md")).unwrap();
            let says =
                if expected.codes.is_empty() { "None." } else { &format!("{}.\n", counts_line(expected)) };
            assert!(markdown.contains(&format!("### Findings\n\n{says}")), "{case}{markdown}");
            assert_eq!(markdown.contains("corrected program (of"), expected.errors == 0, "{case}{markdown}");
            let page = fs::read_to_string(at.join("out.html")).unwrap();
            assert!(page.contains(&format!("<p class=\"counts\">{}</p>", counts_line(expected))), "{case}");
        }
        let lines = run(at, &[&args, policy, &["--format", "line", "--quiet"]].concat()).2;
        assert_eq!(told_by_lines(&lines), expected.codes, "{case}");
    }
}

fn simulate_command(at: &Path, policy: &[&str], expected: &Told, case: &str) {
    if expected.codes.contains_key("CL0102") {
        // What is no arc cannot be simulated; `check` and `apply` have told why, and so does the JSON.
        let (exit, said, _) =
            run(at, &[&["simulate", "part.apt", "--setup", "setup.yaml", "--json"], policy].concat());
        let json: Value = serde_json::from_str(&said).unwrap();
        assert_eq!(exit, i32::from(expected.errors > 0), "simulate, {case}");
        let told = told_by_json(&json["findings"]);
        assert_eq!(told.codes["CL0102"], expected.codes["CL0102"], "simulate, {case}");
        return;
    }
    let outputs =
        ["--json", "s.json", "--csv", "s.csv", "--stl", "s.stl", "--report", "s.html", "--summary", "s.md"];
    let args = [&["simulate", "part.apt", "--setup", "setup.yaml"], &outputs[..], policy].concat();
    let (exit, _, human) = run(at, &args);
    let case = format!("simulate, {case}: {human}");
    assert_eq!(exit, i32::from(expected.errors > 0), "{case}");
    let json: Value = serde_json::from_slice(&fs::read(at.join("s.json")).unwrap()).unwrap();
    assert_eq!(&told_by_json(&json["findings"]), expected, "{case}");
    for output in ["s.csv", "s.stl"] {
        assert!(at.join(output).exists(), "{output} of {case}");
    }
    let page = fs::read_to_string(at.join("s.html")).unwrap();
    assert!(page.contains(&format!("<p class=\"counts\">{}</p>", counts_line(expected))), "{case}");
    if !expected.codes.is_empty() {
        assert!(human.contains(&format!("part.apt: {}\n", counts_line(expected))), "{case}");
        let markdown = fs::read_to_string(at.join("s.md")).unwrap();
        assert!(markdown.contains(&counts_line(expected)), "{case}{markdown}");
    }
}

fn unattended_commands(at: &Path, policy: &[&str], expected: &Told, case: &str) {
    let post = ["--", "cp", "{}", "posted"];
    let hook = ["hook", "--recipe", "recipe.yaml", "part.apt", "--log", "hook.log", "--json=hook.json"];
    let _ = (fs::remove_file(at.join("posted")), fs::remove_file(at.join("hook.log")));
    let (exit, _, human) = run(at, &[&hook, policy, &post[..]].concat());
    assert_eq!(exit, if expected.errors > 0 { 125 } else { 0 }, "hook, {case}: {human}");
    assert_eq!(at.join("posted").exists(), expected.errors == 0, "hook, {case}: {human}");
    let log: Value = serde_json::from_slice(&fs::read(at.join("hook.log")).unwrap()).unwrap();
    assert_eq!(&told_by_log(&log, expected), expected, "hook, {case}");
    let json = read_json(&at.join("hook.json"));
    assert_eq!((json["version"].as_u64(), &json["run"]), (Some(1), &log), "hook, {case}");
    assert_eq!(&told_by_json(&json["findings"]), expected, "hook, {case}");

    let _ = fs::remove_dir_all(at.join("done"));
    let (exit, _, human) = run(
        at,
        &[
            &["batch", "--recipe", "recipe.yaml", "--output", "done", "part.apt", "--json", "batch.json"],
            policy,
        ]
        .concat(),
    );
    assert_eq!(exit, i32::from(expected.errors > 0), "batch, {case}: {human}");
    let results = fs::read_to_string(at.join("done/results.jsonl")).unwrap();
    let records = results.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let record = records.into_iter().find(|record| record["input"] == "part.apt").unwrap();
    let mut told = Told::default();
    for found in record["findings"].as_array().unwrap() {
        *told.codes.entry(found["code"].as_str().unwrap().to_owned()).or_default() +=
            found["count"].as_u64().unwrap() as usize;
    }
    told.errors = record["counts"]["errors"].as_u64().unwrap() as usize;
    told.allowed = record["counts"]["allowed"].as_u64().unwrap() as usize;
    assert_eq!(&told, expected, "batch, {case}");
    let json = read_json(&at.join("batch.json"));
    let lines: Vec<Value> = results.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let (head, files) = lines.split_first().unwrap();
    assert_eq!(
        (&json["batch"], json["files"].as_array().unwrap().as_slice()),
        (head, files),
        "batch, {case}"
    );
    assert_eq!(told_by_json(&json["findings"]), Told::default(), "batch, {case}");

    let watched = at.join("watched");
    fs::create_dir_all(&watched).unwrap();
    fs::copy(at.join("part.apt"), watched.join("part.apt")).unwrap();
    let _ = (fs::remove_dir_all(at.join("out")), fs::remove_file(at.join("watch.log")));
    let watch = [
        "watch",
        "watched",
        "--recipe",
        "recipe.yaml",
        "--output",
        "out",
        "--once",
        "--log",
        "watch.log",
        "--json=watch.json",
        "*.apt",
    ];
    let (exit, _, human) = run(at, &[&watch, policy].concat());
    assert_eq!(exit, i32::from(expected.errors > 0), "watch, {case}: {human}");
    let log = fs::read_to_string(at.join("watch.log")).unwrap();
    let log: Value = serde_json::from_str(log.lines().next().unwrap()).unwrap();
    assert_eq!(&told_by_log(&log, expected), expected, "watch, {case}");
    let json = read_json(&at.join("watch.json"));
    assert_eq!((json["version"].as_u64(), &json["run"]), (Some(1), &log), "watch, {case}");
    assert_eq!(&told_by_json(&json["findings"]), expected, "watch, {case}");
    assert_eq!(names(&at.join("out")).contains(&"part.apt".into()), expected.errors == 0, "watch, {case}");
}

/// What a line of a log tells; it repeats errors, so their number is that of its lines.
fn told_by_log(log: &Value, expected: &Told) -> Told {
    let counted = |key: &str| -> BTreeMap<String, usize> {
        let counts = log[key].as_object().unwrap().iter();
        counts.map(|(code, count)| (code.clone(), count.as_u64().unwrap() as usize)).collect()
    };
    let errors = log["errors"].as_array().unwrap().len();
    assert!(errors <= 5 && expected.errors <= 5, "a log repeats the first five errors");
    Told { codes: counted("findings"), errors, allowed: counted("allowed").values().sum() }
}

#[test]
fn denied_warnings_are_errors_in_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let kind = KINDS.iter().find(|kind| kind.name == "a warning of the input").unwrap();
    write_kind(at, kind);
    let deny = ["--deny", "warnings"];
    let expected = expect(&[kind.input], true, false);
    check_command(at, &deny, &expected, kind.name);
    simulate_command(at, &deny, &expected, kind.name);
    first_commands(at, &deny, &expected, kind.name);
    unattended_commands(at, &deny, &expected, kind.name);
    let (exit, _, human) =
        run(at, &[&["apply", "recipe.yaml", "part.apt", "-o", "out.apt"], &deny[..]].concat());
    assert_eq!(exit, 1, "{human}");
    assert!(!at.join("out.apt").exists());
}

#[test]
fn a_wall_of_equal_findings_is_one_with_a_count_and_its_lines() {
    let folder = tempfile::tempdir().unwrap();
    let points: String = (0..40).map(|x| format!("GOTO/{},0,0\n", 200_000 + x)).collect();
    fs::write(
        folder.path().join("part.apt"),
        format!("PARTNO/A\nUNITS/MM\nFEDRAT/500,MMPM\nRAPID\nGOTO/0,0,0\n{points}FINI\n"),
    )
    .unwrap();
    let (_, human, _) = run(folder.path(), &["check", "part.apt"]);
    assert_eq!(human.matches("warning[CL0115]").count(), 1, "{human}");
    assert!(human.contains("39 more of CL0115, on lines"), "{human}");
    let (_, all, _) = run(folder.path(), &["check", "part.apt", "--max-per-code", "0"]);
    assert_eq!(all.matches("warning[CL0115]").count(), 40, "{all}");
    let (_, json, _) = run(folder.path(), &["check", "part.apt", "--format", "json"]);
    assert_eq!(told_by_json(&serde_json::from_str(&json).unwrap()).codes["CL0115"], 40);
}

#[test]
fn a_file_is_not_what_its_ending_does_not_promise() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write_kind(at, &KINDS[0]);
    let apply = ["apply", "recipe.yaml", "part.apt"];
    let simulate = ["simulate", "part.apt", "--setup", "setup.yaml"];
    let chips = ["chips", "part.apt", "--setup", "setup.yaml", "--layer", "0.5"];
    for args in [
        [&apply[..], &["-o", "part.nc"]].concat(),
        [&apply[..], &["--dry-run", "--report", "a.pdf"]].concat(),
        [&apply[..], &["--dry-run", "--summary", "a.html"]].concat(),
        [&simulate[..], &["--csv", "a.json"]].concat(),
        [&simulate[..], &["--save-stock", "a.stl"]].concat(),
        [&chips[..], &["--plot", "a.pdf"]].concat(),
    ] {
        let (exit, _, said) = run(at, &args);
        assert_eq!(exit, 2, "{args:?}: {said}");
        assert!(said.contains("give it "), "{said}");
    }
    assert_eq!(names(at).len(), 3);
}
