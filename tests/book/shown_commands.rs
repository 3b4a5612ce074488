//! Every command in a box of the pages is run, and printed what stands below it.
//!
//! A page says where it runs: `<!-- in: FOLDER -->` begins with the files of a folder of the project, `<!-- also: FILE -->` adds
//! one, and a line "`NAME`:" before a box writes the box into a file. In a `console` box a line `$ COMMAND` is run by the
//! shell. With `INSTA_UPDATE=always` a page gets what its commands print.

use super::{pages, project};
use crate::support::require_program;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs a page and returns it as its commands make it; counts them.
fn run_page(page: &Path, commands: &mut usize) -> String {
    let text = std::fs::read_to_string(page).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let mut folder: Option<tempfile::TempDir> = None;
    let mut out = String::new();
    let mut at = 0;
    while at < lines.len() {
        let line = lines[at];
        out += &format!("{line}\n");
        at += 1;
        if let Some(from) = line.strip_prefix("<!-- in: ").and_then(|rest| rest.strip_suffix(" -->")) {
            let new = tempfile::tempdir().unwrap();
            copy_files(&project().join(from), new.path());
            folder = Some(new);
        } else if let Some(file) = line.strip_prefix("<!-- also: ").and_then(|rest| rest.strip_suffix(" -->"))
        {
            let file = project().join(file);
            std::fs::copy(&file, inside(&folder, page).join(file.file_name().unwrap())).unwrap();
        } else if let Some(name) = line.strip_prefix('`').and_then(|rest| rest.strip_suffix("`:")) {
            let is_box = lines.get(at + 1).is_some_and(|line| line.starts_with("```"));
            assert!(is_box, "{}: no box follows {name}", page.display());
            let body: Vec<&str> =
                lines[at + 2..].iter().take_while(|line| !line.starts_with("```")).copied().collect();
            std::fs::write(inside(&folder, page).join(name), body.join("\n") + "\n").unwrap();
        } else if line == "```console" {
            while at < lines.len() && !lines[at].starts_with("```") {
                if let Some(command) = lines[at].strip_prefix("$ ") {
                    out += &format!("$ {command}\n{}", run(command, &inside(&folder, page)));
                    *commands += 1;
                }
                at += 1;
            }
        }
    }
    out
}

fn inside(folder: &Option<tempfile::TempDir>, page: &Path) -> PathBuf {
    let folder = folder.as_ref().unwrap_or_else(|| panic!("{} does not say where it runs", page.display()));
    folder.path().to_path_buf()
}

fn copy_files(from: &Path, to: &Path) {
    for entry in std::fs::read_dir(from).unwrap().flatten().filter(|entry| entry.path().is_file()) {
        std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}

/// What a command prints, on either output; it must succeed.
fn run(command: &str, folder: &Path) -> String {
    let mut path = std::ffi::OsString::from(Path::new(env!("CARGO_BIN_EXE_clsmith")).parent().unwrap());
    path.push(":");
    path.push(std::env::var_os("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("{{ {command}\n}} 2>&1")]).current_dir(folder).env("PATH", path);
    shell.env("NO_COLOR", "1").env("COLUMNS", "100").env("LC_ALL", "C.UTF-8");
    let done = shell.output().unwrap();
    let printed = String::from_utf8(done.stdout).unwrap();
    assert!(done.status.success(), "{command}: {:?}\n{printed}", done.status);
    let lines = printed.trim_end().lines().map(|line| format!("{}\n", line.trim_end()));
    lines.collect()
}

#[test]
fn pages_show_what_their_commands_print() {
    // The post of the page about NX.
    if require_program(&["python3"]).is_none() {
        return;
    }
    let mut commands = 0;
    let mut changed = Vec::new();
    for page in pages(&project().join("docs")) {
        let shown = std::fs::read_to_string(&page).unwrap();
        let made = run_page(&page, &mut commands);
        if shown != made {
            if std::env::var("INSTA_UPDATE").is_ok_and(|how| how == "always") {
                std::fs::write(&page, &made).unwrap();
            }
            let differ = shown.lines().zip(made.lines()).find(|(shown, made)| shown != made);
            changed.push(format!("{}: {differ:?}", page.display()));
        }
    }
    assert!(commands >= 50, "{commands}");
    assert!(changed.is_empty(), "INSTA_UPDATE=always makes them again: {changed:#?}");
}

#[test]
fn the_cookbook_has_twenty_recipes_that_change_something() {
    let page = std::fs::read_to_string(project().join("docs/cookbook.md")).unwrap();
    let recipes: Vec<&str> = page.split("\n## ").skip(1).collect();
    assert!(recipes.len() >= 20, "{}", recipes.len());
    for (number, recipe) in recipes.iter().enumerate() {
        assert!(recipe.starts_with(&format!("{}. ", number + 1)), "{recipe}");
        assert!(recipe.contains("`recipe.yaml`:\n\n```yaml\nversion: 1\n"), "{recipe}");
        let shown = recipe.split("```console\n").nth(1).unwrap();
        assert!(shown.lines().any(|line| !line.starts_with('$') && !line.starts_with("```")), "{recipe}");
    }
}
