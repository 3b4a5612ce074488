//! What is refused before anything runs.

use super::{ALL, batch, clsmith, shop, stderr, tree, write};
use crate::support;
use std::fmt::Write;

#[test]
fn what_cannot_be_right_is_told_and_nothing_runs() {
    let shop = shop(4);
    write(shop.path(), "programs/P003.CLS", "");
    write(shop.path(), "programs/x[1].cls", "");
    write(shop.path(), "more/results.jsonl", "");
    write(shop.path(), "more/p003.cls/x.cls", "");
    write(shop.path(), "more/x/p003.cls", "");
    let before = tree(shop.path());
    let mut text = String::new();
    let mut refused = |out: &str, files: &[&str]| {
        let mut command = clsmith(shop.path());
        command.args(["batch", "--recipe", "r.yaml", "--format", "line", "--output", out]).args(files);
        let done = command.assert().code(1);
        writeln!(text, "$ -o {out} {}\n{}", files.join(" "), stderr(&done)).unwrap();
    };
    refused("done", &["programs/*.clsf"]);
    refused("done", &["nowhere/**/*.cls", "programs", "none.cls", "programs/[a.cls", "programs/*/../*.cls"]);
    refused("done", &["more/x/p003.cls", "programs/*.cls"]);
    refused("done", &["programs/p*.{cls,CLS}", "programs/P*.CLS"]);
    refused("done", &["programs/*.cls", "more/**/*.cls"]);
    refused("done", &["more/*.jsonl"]);
    refused("programs", &["programs/p*.cls"]);
    refused(".", &["programs/p003.cls", "r.yaml"]);
    support::snapshots("cli").bind(|| insta::assert_snapshot!("batch_refused", text));
    assert_eq!(tree(shop.path()), before);
    assert!(!shop.path().join("done").exists());
}

#[test]
fn places_in_jobs_files_are_shown() {
    let shop = shop(3);
    write(
        shop.path(),
        "jobs.yaml",
        "out: done\njobs:\n  - { recipe: none.yaml, files: ['nowhere/*.cls'] }\n",
    );
    let done = clsmith(shop.path()).args(["batch", "jobs.yaml", "--format", "line"]).assert().code(1);
    let text = stderr(&done);
    assert!(text.contains("none.yaml cannot be read"), "{text}");
    assert!(text.contains("jobs.yaml:3:34: CL0420: no file matches `nowhere/*.cls`"), "{text}");
    write(shop.path(), "jobs.yaml", "jobs:\n  - { recipe: r.yaml, files: ['programs/*.cls'] }\n");
    let done = clsmith(shop.path()).args(["batch", "jobs.yaml"]).assert().code(2);
    assert!(stderr(&done).contains("no output folder"));
    // The jobs file itself, a recipe and a setup are inputs like any other.
    for (file, text) in [
        ("jobs.yaml", "out: .\njobs:\n  - { recipe: r.yaml, files: [programs/p003.cls, jobs.yaml] }\n"),
        ("jobs.yaml", "out: .\njobs:\n  - { recipe: r.yaml, files: [r.yaml] }\n"),
    ] {
        write(shop.path(), file, text);
        let done = clsmith(shop.path()).args(["batch", file]).assert().code(1);
        assert!(stderr(&done).contains("CL0404"), "{}", stderr(&done));
    }
}

#[test]
fn results_may_not_overwrite_an_input() {
    let shop = shop(3);
    for input in ["r.yaml", "programs/p003.cls"] {
        let before = tree(shop.path());
        let done = batch(shop.path(), "done", &["--results", input, ALL]).code(1);
        assert!(stderr(&done).contains("CL0404"), "{}", stderr(&done));
        assert_eq!(tree(shop.path()), before);
    }
    let done = batch(shop.path(), "done", &["--results", "done/p003.cls", ALL]).code(1);
    assert!(stderr(&done).contains("CL0421"), "{}", stderr(&done));
}

#[test]
fn the_command_line_is_checked() {
    let shop = shop(1);
    let run = |args: &[&str]| clsmith(shop.path()).arg("batch").args(args).assert().code(2);
    run(&[]);
    run(&["a.yaml", "b.yaml"]);
    run(&["--recipe", "r.yaml", "programs/*.cls"]);
    run(&["jobs.yaml", "--setup", "s.yaml"]);
    run(&["--recipe", "r.yaml", "--output", "done", "programs/*.cls", "--shard", "0/4"]);
    run(&["--recipe", "r.yaml", "--output", "done", "programs/*.cls", "--memory", "much"]);
    run(&["--recipe", "r.yaml", "--output", "done", "programs/*.cls", "--threads", "0"]);
    run(&["--recipe", "r.yaml", "--output", "done", "programs/*.cls", "--results", "-"]);
    run(&["--recipe", "r.yaml", "--output", "done", "programs/*.cls", "--deny", "CL9999"]);
    run(&["--recipe", "r.yaml", "--output", "done", "programs/*.cls", "--allow", "CL0421"]);
}

#[test]
fn an_output_folder_that_is_searched_is_left_out() {
    let shop = shop(3);
    let run = || batch(shop.path(), "done", &["**/*.cls"]).success();
    run();
    let first = tree(&shop.path().join("done"));
    run();
    assert_eq!(tree(&shop.path().join("done")), first, "outputs are no inputs of the next run");
}

#[test]
fn hidden_files_count_where_they_are_named() {
    let shop = shop(1);
    write(shop.path(), "programs/.old/h.cls", "GOTO/1.0,1.0,1.0\n");
    write(shop.path(), "programs/.h.cls", "GOTO/1.0,1.0,1.0\n");
    let names = |out: &str, pattern: &str| {
        batch(shop.path(), out, &[pattern]).success();
        let names: Vec<String> = tree(&shop.path().join(out))
            .keys()
            .filter(|name| !name.ends_with("results.jsonl"))
            .map(|name| name.to_string_lossy().replace('\\', "/"))
            .collect();
        names
    };
    assert_eq!(names("one", "programs/**/*.cls"), ["a/p001.cls"]);
    assert_eq!(names("two", "programs/.*.cls"), [".h.cls"]);
    assert_eq!(names("three", "programs/.old/*.cls"), ["h.cls"]);
    assert_eq!(names("four", "programs/**/.old/**/*.cls"), [".old/h.cls"]);
    assert_eq!(names("five", "programs/?/p[0-9]*.{cls,CLS}"), ["a/p001.cls"]);
}
