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
fn a_file_means_what_it_means_whatever_is_in_it() {
    let folder = tempfile::tempdir().unwrap();
    let broken = "FEDRAT/MMPM,800.\nGOTO/1,2,O\nGOTO/1e999,2,3\nR1=5\n";
    std::fs::write(folder.path().join("a.cls"), broken).unwrap();
    std::fs::write(folder.path().join("b.cls"), broken.replace("R1=5", "R1=6")).unwrap();
    clsmith(folder.path()).args(["diff", "a.cls", "a.cls"]).assert().success();
    // What cannot be read has no meaning that could be compared.
    clsmith(folder.path()).args(["diff", "a.cls", "b.cls"]).assert().code(1);
}

#[test]
fn commands_that_only_read_take_threads_and_memory() {
    let folder = example("pocket");
    let text = |args: &[&str]| {
        let done = clsmith(folder.path()).args(args).output().unwrap();
        (done.status.code(), done.stdout)
    };
    for command in [&["check", "part.cls"][..], &["stats", "part.cls"], &["diff", "part.cls", "part.cls"]] {
        let told = text(command);
        assert_eq!(told.0, Some(0), "{command:?}");
        assert_eq!(text(&[command, &["--threads", "1", "--memory", "1GB"]].concat()), told, "{command:?}");
        let (code, _) = text(&[command, &["--memory", "1kB"]].concat());
        assert_eq!(code, Some(1), "{command:?}");
        let (code, _) = text(&[command, &["--memory", "99999999TB"]].concat());
        assert_eq!(code, Some(2), "{command:?}");
    }
    // A pipe without an end is read no further than memory allows.
    let done = clsmith(folder.path())
        .args(["check", "-", "--memory", "1MB"])
        .write_stdin(vec![b'x'; 3_000_000])
        .output()
        .unwrap();
    let told = String::from_utf8(done.stdout).unwrap();
    assert!(done.status.code() == Some(1) && told.contains("no end"), "{told}");
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
