//! `clsmith machine`, `clsmith axes` and `clsmith setup`.

use super::clsmith;
use std::path::Path;
use tempfile::TempDir;

const PART: &str = "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,0.0000,60.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,6000,CLW\n\
    RAPID\nGOTO/0.0000,0.0000,20.0000,0.0000000,0.0000000,1.0000000\nFEDRAT/MMPM,600.0000\n\
    GOTO/10.0000,0.0000,5.0000,0.3420201,0.0000000,0.9396926\nGOTO/20.0000,8.0000,5.0000,0.3213938,0.1169778,0.9396926\n\
    GOTO/20.0000,20.0000,5.0000,0.2418448,0.2418448,0.9396926\nEND-OF-PATH\n";

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let machines = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/machines");
    std::fs::copy(machines.join("cradle.yaml"), folder.path().join("cradle.yaml")).unwrap();
    std::fs::write(folder.path().join("part.cls"), PART).unwrap();
    std::fs::write(folder.path().join("shop.yaml"), "machine: { file: cradle.yaml, max_feed: 500 }\n")
        .unwrap();
    folder
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_machine_is_shown_and_drawn() {
    let folder = job();
    let done = clsmith(folder.path()).args(["machine", "shop.yaml", "--plot", "a.svg"]).assert().success();
    let said = text(&done.get_output().stdout);
    for part in
        ["cradle", "turns without end", "[0, 0, 77.5]", "-110 to 35 deg", "tcp: false", "highest feed: 500"]
    {
        assert!(said.contains(part), "{part} in\n{said}");
    }
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("B: -110 to 35 deg") && svg.contains("without end"));
    clsmith(folder.path()).args(["machine", "shop.yaml", "--plot", "a.png"]).assert().success();
    assert!(std::fs::read(folder.path().join("a.png")).unwrap().starts_with(b"\x89PNG"));
    std::fs::write(folder.path().join("none.yaml"), "machine: { max_feed: 3 }\n").unwrap();
    let done = clsmith(folder.path()).args(["machine", "none.yaml", "--plot", "b.svg"]).assert().code(1);
    assert!(text(&done.get_output().stderr).contains("CL0700"));
    assert!(!folder.path().join("b.svg").exists());
}

#[test]
fn a_machine_file_that_is_not_there_is_told_at_its_name() {
    let folder = job();
    std::fs::write(folder.path().join("shop.yaml"), "machine: { file: lost.yaml }\n").unwrap();
    for command in [&["machine", "shop.yaml"][..], &["check", "part.cls", "--setup", "shop.yaml"]] {
        let done = clsmith(folder.path()).args(command).assert().code(1);
        let output = done.get_output();
        let said = text(&output.stderr) + &text(&output.stdout);
        assert!(said.contains("CL0508") && said.contains("lost.yaml"), "{said}");
    }
}

#[test]
fn the_values_of_all_axes_are_written_in_three_forms() {
    let folder = job();
    let args =
        ["axes", "part.cls", "--setup", "shop.yaml", "--csv", "a.csv", "--json=a.json", "--npy", "a.npy"];
    let done =
        clsmith(folder.path()).args(args).args(["--plot", "a.svg", "--along", "line"]).assert().success();
    let said = text(&done.get_output().stdout);
    assert!(said.contains("3 motions") && said.contains("-110 to 35"), "{said}");
    let csv = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 5);
    let column = |name: &str| {
        rows[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("{name} in {:?}", rows[0]))
    };
    assert_eq!(rows[2][column("line")], "8");
    let b: f64 = rows[2][column("B_deg")].parse().unwrap();
    assert!((b.abs() - 20.0).abs() < 1e-5, "{b}");
    assert_eq!(rows[1][column("pole")], "1");
    let json: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("a.json")).unwrap()).unwrap();
    assert!((json["motions"][1]["joints"]["B"].as_f64().unwrap() - b).abs() < 1e-12);
    assert_eq!(json["axes"][0]["limits"], serde_json::Value::Null);
    let npy = std::fs::read(folder.path().join("a.npy")).unwrap();
    let header = 10 + usize::from(u16::from_le_bytes([npy[8], npy[9]]));
    assert_eq!(header % 64, 0);
    assert!(text(&npy[..header]).contains("'shape': (4, 7)"));
    let number = |index: usize| {
        let at = header + 8 * index;
        f64::from_le_bytes(npy[at..at + 8].try_into().unwrap())
    };
    assert_eq!(npy.len(), header + 8 * 4 * 7);
    // Line, time, C, B: of the second motion.
    assert_eq!((number(7), number(7 + 3)), (8.0, b));
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("B, deg") && svg.contains("X, mm") && svg.contains("line"));
}

#[test]
fn check_tells_what_the_machine_does_with_the_tip() {
    let folder = job();
    let done = clsmith(folder.path()).args(["check", "part.cls", "--setup", "shop.yaml"]).assert().success();
    let said = text(&done.get_output().stdout);
    assert!(said.contains("CL0708") && said.contains("the tip leaves its line by"), "{said}");
    // The same findings in the other command that reads the axes.
    let args = ["axes", "part.cls", "--setup", "shop.yaml", "-q"];
    let done = clsmith(folder.path()).args(args).assert().success();
    assert!(text(&done.get_output().stderr).contains("CL0708"));
    // And in that which corrects the program: what it writes is what the machine runs.
    let recipe = "version: 1\nsetup_file: shop.yaml\nsteps:\n  - scale_feed: { factor: 0.9 }\n";
    std::fs::write(folder.path().join("r.yaml"), recipe).unwrap();
    let args = ["apply", "r.yaml", "part.cls", "--dry-run", "--format", "line"];
    let done = clsmith(folder.path()).args(args).assert().success();
    assert!(text(&done.get_output().stderr).contains("CL0708"));
}

#[test]
fn all_commands_tell_the_same_time() {
    let folder = job();
    let json = |args: &[&str]| -> serde_json::Value {
        let done = clsmith(folder.path()).args(args).assert().success();
        serde_json::from_slice(&done.get_output().stdout).unwrap()
    };
    let stats = json(&["stats", "part.cls", "--setup", "shop.yaml", "--json"]);
    let at_feed = stats["totals"]["accelerated_seconds"].as_f64().unwrap();
    let parts = &stats["machine_time"];
    let sum: f64 = ["at_feed", "corners", "start_stop", "feed_steps"]
        .map(|key| parts[key].as_f64().unwrap())
        .iter()
        .sum();
    assert!((at_feed - sum).abs() < 1e-5, "{at_feed} and {sum}");
    // By hand: the first point takes no time, and three feed motions start and stop once.
    assert_eq!(parts["rapids"], 0.0);
    assert!(parts["corners"].as_f64().unwrap() > 0.0 && parts["spindle_start"] == 1.5);
    let axes = json(&["axes", "part.cls", "--setup", "shop.yaml", "--json", "-q"]);
    assert!((axes["seconds"].as_f64().unwrap() - parts["seconds"].as_f64().unwrap()).abs() < 1e-5);
    // `apply` tells the same time of a program that it leaves alone.
    std::fs::write(
        folder.path().join("r.yaml"),
        "version: 1\nsetup_file: shop.yaml\nsteps:\n  - clamp_feed: { max: 9000 }\n",
    )
    .unwrap();
    let applied = json(&["apply", "r.yaml", "part.cls", "--dry-run", "--json"]);
    let text = applied.to_string();
    assert!(
        text.contains(&format!("\"accelerated_seconds\":{}", stats["totals"]["accelerated_seconds"])),
        "{text}"
    );
}

#[test]
fn times_are_measured_from_a_log() {
    let folder = job();
    std::fs::write(
        folder.path().join("log.csv"),
        "corner_deg,feed_mm_min,lost_s\n90,576,0.0312\n45,576,0.0252\n",
    )
    .unwrap();
    let done = clsmith(folder.path()).args(["setup", "measure-time", "log.csv"]).assert().success();
    let said = text(&done.get_output().stdout);
    assert!(said.starts_with("machine:\n  corner_constant: 0.0087"), "{said}");
    let done = clsmith(folder.path()).args(["setup", "measure-time", "part.cls"]).assert().code(1);
    assert!(text(&done.get_output().stderr).contains("CL0710"));
}

#[test]
fn axes_of_a_program_in_inches_are_told_in_inches() {
    let folder = job();
    let at = folder.path();
    // The same pose 254 mm along x, and the feed of 1 in/min.
    let program = "UNITS/INCHES\nCUTTER/0.5\nLOAD/TOOL,1\nSPINDL/6000,RPM,CLW\nFEDRAT/10,IPM\nGOTO/0,0,1,0,0,1\nGOTO/5,0,1,0,0,1\nFINI\n";
    std::fs::write(at.join("in.apt"), program).unwrap();
    let run = |more: &[&str]| {
        let args = [&["axes", "in.apt", "--setup", "shop.yaml"], more].concat();
        text(&clsmith(at).args(args).assert().success().get_output().stdout)
    };
    let csv = run(&["--csv", "-", "-q"]);
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let cell = |row: usize, name: &str| {
        let column = rows[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("{name}: {csv}"));
        rows[row][column].parse::<f64>().unwrap()
    };
    for name in ["tip_x_in", "X_in"] {
        assert!((cell(2, name) - 5.0).abs() < 1e-9, "{csv}");
    }
    // X makes 20 m/min at most.
    assert!((cell(2, "feed_limit_in_min") - 20_000.0 / 25.4).abs() < 1e-6, "{csv}");
    let said = run(&[]);
    // 250 mm of travel, and one motion: the first point is none.
    assert!(said.contains("1 motion,") && said.contains("5.0000 in  -9.8425 to 9.8425"), "{said}");
    let json: serde_json::Value = serde_json::from_str(&run(&["--json"])).unwrap();
    assert_eq!((&json["units"], &json["axes"][2]["unit"]), (&"inch".into(), &"in".into()));
    assert!((json["motions"][1]["joints"]["X"].as_f64().unwrap() - 5.0).abs() < 1e-9);
    assert!(run(&["--display-units", "mm", "--csv", "-", "-q"]).contains("127"));
}

#[test]
fn no_spreadsheet_runs_the_name_of_an_axis() {
    let folder = job();
    let machine = std::fs::read_to_string(folder.path().join("cradle.yaml")).unwrap();
    let named = machine.replace("name: X,", "name: \"=X\",").replace("name: C,", "name: \"+C\",");
    std::fs::write(folder.path().join("cradle.yaml"), named).unwrap();
    let args = ["axes", "part.cls", "--setup", "shop.yaml", "--csv", "-", "-q"];
    let said = text(&clsmith(folder.path()).args(args).assert().success().get_output().stdout);
    let head = said.lines().next().unwrap();
    assert!(head.contains(",'=X_mm,") && head.contains(",'+C_deg,"), "{head}");
}
