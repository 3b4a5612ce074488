//! Names in any encoding, links, and disks that are full or write-protected.

use super::{
    ALL, RECIPE, batch, clsmith, everything, lines, long_part, part, shop, stderr, stdout, tree, write,
};
use crate::cli::as_anybody;
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::Command;

#[test]
fn names_in_any_encoding_come_out_as_they_went_in() {
    let shop = tempfile::tempdir().unwrap();
    write(shop.path(), "r.yaml", RECIPE);
    let names: [&[u8]; 6] = [
        b"\xff\xfe.cls",
        b"two\nlines.cls",
        b" blank .cls",
        "ü\u{202e}.cls".as_bytes(),
        b"-x.cls",
        b"q\"'*[.cls",
    ];
    fs::create_dir_all(shop.path().join(OsStr::from_bytes(b"programs/\xe4/"))).unwrap();
    let path = |folder: &str, name: &[u8]| shop.path().join(folder).join(OsStr::from_bytes(name));
    for (number, name) in names.iter().enumerate() {
        fs::write(path("programs", name), part(number + 1)).unwrap();
        fs::write(path("programs", &[b"\xe4/", *name].concat()), part(number + 1)).unwrap();
    }
    batch(shop.path(), "done", &[]).success();
    let done = tree(&shop.path().join("done"));
    assert_eq!(done.len(), 13);
    for name in names {
        assert!(done.contains_key(Path::new(OsStr::from_bytes(name))), "{name:?}");
        assert!(done.contains_key(Path::new(OsStr::from_bytes(&[b"\xe4/", name].concat()))), "{name:?}");
    }
    let results = lines(&shop.path().join("done/results.jsonl"));
    let hex = results.iter().filter(|line| line["output"]["hex"].is_string()).count();
    assert_eq!((results.len(), hex), (12, 7), "a line each, bytes where there is no text");
    assert!(results.iter().any(|line| line["output"]["hex"] == "fffe2e636c73"));
    let again = batch(shop.path(), "done", &["--resume"]).success();
    assert!(stdout(&again).contains("12 done before"));
    // Named, and not by a pattern.
    let mut one = clsmith(shop.path());
    one.args(["batch", "--recipe", "r.yaml", "--output", "one", "--"]).arg(path("programs", names[0]));
    one.arg(path("programs", names[5])).assert().success();
    assert_eq!(tree(&shop.path().join("one")).len(), 3);
}

#[test]
fn links_are_followed_but_not_in_circles() {
    let shop = shop(3);
    let link = |to: &str, name: &str| symlink(to, shop.path().join(name)).unwrap();
    write(shop.path(), "elsewhere/far.cls", &part(8));
    link("..", "programs/a/up");
    link(".", "programs/self");
    link("../elsewhere", "programs/far");
    link("p003.cls", "programs/same.cls");
    link("round.cls", "programs/round.cls");
    link("nowhere", "programs/dangling.cls");
    let done = batch(shop.path(), "done", &["--format", "line"]).code(1);
    let text = stderr(&done);
    assert!(text.contains("CL0426: programs/self leads back to programs;"), "{text}");
    assert!(text.contains("CL0426: programs/a/up leads back to programs;"), "{text}");
    assert!(text.contains("programs/round.cls: CL0401"), "{text}");
    assert!(text.contains("programs/dangling.cls: CL0401"), "{text}");
    let names: Vec<String> =
        tree(&shop.path().join("done")).keys().map(|name| name.to_string_lossy().into_owned()).collect();
    assert_eq!(names, ["a/b/p002.cls", "a/p001.cls", "far/far.cls", "p003.cls", "results.jsonl", "same.cls"]);
    batch(shop.path(), "none", &["--deny", "CL0426"]).code(1);
    assert!(tree(&shop.path().join("none")).is_empty());
}

#[test]
fn nothing_is_written_through_a_link_in_the_output_folder() {
    let shop = shop(3);
    let make = |name: &str| fs::create_dir_all(shop.path().join(name)).unwrap();
    make("released");
    make("done");
    write(shop.path(), "released/p003.cls", "released");
    for (link, to) in
        [("done/a", "../released"), ("done/p003.cls", "../released/p003.cls"), ("done/p003.cls", "nowhere")]
    {
        symlink(to, shop.path().join(link)).unwrap();
        let run = batch(shop.path(), "done", &["--format", "line"]).code(1);
        assert!(stderr(&run).contains("CL0422"), "{}", stderr(&run));
        assert_eq!(fs::read_to_string(shop.path().join("released/p003.cls")).unwrap(), "released");
        assert_eq!(everything(&shop.path().join("released")).len(), 1);
        fs::remove_file(shop.path().join(link)).unwrap();
    }
    // The output folder itself may be one.
    make("real");
    symlink("real", shop.path().join("link")).unwrap();
    batch(shop.path(), "link", &[]).success();
    assert_eq!(tree(&shop.path().join("real")).len(), 4);
    // A link to an input is an input.
    fs::hard_link(shop.path().join("programs/p003.cls"), shop.path().join("done/p003.cls")).unwrap();
    let run = batch(shop.path(), "done", &["--format", "line"]).code(1);
    assert!(stderr(&run).contains("CL0404"), "{}", stderr(&run));
}

#[test]
fn what_is_no_file_is_not_read() {
    let shop = shop(1);
    let pipe = shop.path().join("programs/pipe.cls");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let run = batch(shop.path(), "done", &["--format", "line"]).code(1);
    assert!(
        stderr(&run)
            .contains("programs/pipe.cls: CL0401: programs/pipe.cls cannot be read: it is not a file")
    );
}

#[test]
fn a_write_protected_folder_is_told_and_keeps_what_it_has() {
    let shop = shop(3);
    let set = |name: &str, mode| {
        fs::set_permissions(shop.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    fs::create_dir_all(shop.path().join("done/a/b")).unwrap();
    set("", 0o755);
    set("done", 0o777);
    set("done/a", 0o555);
    set("done/a/b", 0o777);
    let run = |args: &[&str]| {
        let mut command = as_anybody(shop.path());
        command.args(["batch", "--recipe", "r.yaml", "--format", "line", ALL, "--output"]).args(args);
        let run = command.output().unwrap();
        (run.status.code(), String::from_utf8_lossy(&run.stderr).into_owned())
    };
    let (code, text) = run(&["done"]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("CL0402: a/p001.cls cannot be written: Permission denied"), "{text}");
    let done: Vec<_> = tree(&shop.path().join("done")).into_keys().collect();
    assert_eq!(done, ["a/b/p002.cls", "p003.cls", "results.jsonl"].map(Path::new), "the others are there");
    // The whole folder: told before anything runs.
    set("done", 0o555);
    let before = everything(&shop.path().join("done"));
    let (code, text) = run(&["done", "--results", "/dev/null/x"]);
    assert!(code == Some(1) && text.contains("CL0402"), "{text}");
    let (code, text) = run(&["done/new"]);
    assert!(code == Some(1) && text.contains("CL0402"), "{text}");
    assert_eq!(everything(&shop.path().join("done")), before);
    set("done/a", 0o777);
    set("done", 0o777);
}

#[test]
fn a_full_disk_costs_what_does_not_fit_and_leaves_nothing_half_written() {
    let shop = shop(3);
    write(shop.path(), "programs/long.cls", &long_part(20_000));
    // A limit for the size of a file: writing more fails as it does on a full disk.
    let script = format!(
        "trap '' XFSZ; ulimit -f 64; exec '{}' batch --recipe r.yaml --format line -o done '{ALL}'",
        env!("CARGO_BIN_EXE_clsmith")
    );
    let run = Command::new("sh").current_dir(shop.path()).args(["-c", &script]).output().unwrap();
    let text = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(1), "{text}");
    assert!(text.contains("CL0402: long.cls cannot be written: File too large"), "{text}");
    let left = everything(&shop.path().join("done"));
    let names: Vec<String> = left.keys().map(|name| name.to_string_lossy().into_owned()).collect();
    assert_eq!(
        names,
        [
            ".clsmith-batch.journal",
            ".clsmith-batch.lock",
            "a/b/p002.cls",
            "a/p001.cls",
            "p003.cls",
            "results.jsonl"
        ]
    );
    batch(shop.path(), "done", &["--resume"]).success();
    assert!(shop.path().join("done/long.cls").exists());
}

#[test]
fn a_disk_too_full_for_the_journal_is_told() {
    let shop = shop(12);
    // Room for every program and not for a dozen lines about them.
    let script = format!(
        "trap '' XFSZ; ulimit -f 4; exec '{}' batch --recipe r.yaml --format line -o done '{ALL}'",
        env!("CARGO_BIN_EXE_clsmith")
    );
    let run = Command::new("sh").current_dir(shop.path()).args(["-c", &script]).output().unwrap();
    let text = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(1), "{text}");
    assert!(text.contains("CL0402: the journal cannot be written"), "{text}");
    assert!(text.contains("results.jsonl cannot be written"), "{text}");
    let done = tree(&shop.path().join("done"));
    assert_eq!(done.len(), 12, "all programs, no results: {:?}", done.keys());
    batch(shop.path(), "done", &["--resume"]).success();
    batch(shop.path(), "fresh", &[]).success();
    assert_eq!(tree(&shop.path().join("done")), tree(&shop.path().join("fresh")));
}
