//! The other commands.

use super::{clsmith, example};

#[test]
fn check_exits_by_what_it_finds() {
    let folder = example("pocket");
    clsmith(folder.path()).args(["check", "part.cls"]).assert().success();
    std::fs::write(folder.path().join("bad.cls"), "RAPID\nGOTO/1,2,3\nGOTO/1,2,x\n").unwrap();
    let done = clsmith(folder.path()).args(["check", "--format", "line", "bad.cls"]).assert().code(1);
    let text = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    assert!(text.contains("bad.cls:3:10: CL0003: `x` is not a number"), "{text}");
    let done =
        clsmith(folder.path()).args(["check", "--format", "sarif", "bad.cls", "part.cls"]).assert().code(1);
    let sarif: serde_json::Value = serde_json::from_slice(&done.get_output().stdout).unwrap();
    assert_eq!(sarif["version"], "2.1.0");
    clsmith(folder.path()).args(["check", "--allow", "CL0003", "bad.cls"]).assert().success();
    clsmith(folder.path()).args(["check", "missing.cls"]).assert().code(1);
}

#[test]
fn stats_name_the_dialect() {
    let folder = example("pocket");
    let done = clsmith(folder.path()).args(["stats", "--json", "part.cls"]).assert().success();
    let stats: serde_json::Value = serde_json::from_slice(&done.get_output().stdout).unwrap();
    assert_eq!(stats["dialect"]["name"], "nx");
    assert_eq!(stats["operations"].as_array().unwrap().len(), 2);
    let done = clsmith(folder.path()).args(["stats", "part.cls"]).assert().success();
    assert!(String::from_utf8_lossy(&done.get_output().stdout).contains("POCKET_ROUGH"));
}

#[test]
fn diff_exits_by_meaning() {
    let folder = example("pocket");
    let part = std::fs::read_to_string(folder.path().join("part.cls")).unwrap();
    std::fs::write(folder.path().join("spaced.cls"), part.replace("RAPID\n", "RAPID \n")).unwrap();
    std::fs::write(folder.path().join("other.cls"), part.replace("-4.0000", "-5.0000")).unwrap();
    clsmith(folder.path()).args(["diff", "part.cls", "spaced.cls"]).assert().success();
    clsmith(folder.path()).args(["diff", "part.cls", "other.cls"]).assert().code(3);
    clsmith(folder.path()).args(["diff", "part.cls", "missing.cls"]).assert().code(1);
}

#[test]
fn clsmith_describes_itself() {
    let folder = example("pocket");
    let text = |args: &[&str]| {
        let done = clsmith(folder.path()).args(args).assert().success();
        String::from_utf8_lossy(&done.get_output().stdout).into_owned()
    };
    for name in clsmith::transform::NAMES {
        assert!(text(&["transforms"]).contains(name));
        assert!(text(&["transforms", name]).contains("Parameters:"), "{name}");
        assert!(text(&["schema"]).contains(name), "{name}");
    }
    assert!(text(&["explain", "cl0003"]).contains("CL0003"));
    assert!(text(&["completions", "bash"]).contains("clsmith"));
    assert!(text(&["man"]).contains("clsmith"));
    assert!(text(&["schema", "--setup"]).contains("max_feed"));
    clsmith(folder.path()).args(["transforms", "nonsense"]).assert().code(2);
    clsmith(folder.path()).args(["explain", "CL9999"]).assert().code(2);
}
