//! `examples/services`: the commands that a service starts are commands of clsmith, and do what they say.

use super::read;
use crate::cli::{clsmith, example};
use std::fs;
use std::path::Path;

/// The text between two marks, each once.
fn between<'t>(text: &'t str, begin: &str, end: &str) -> &'t str {
    text.split_once(begin).unwrap().1.split_once(end).unwrap().0
}

/// Runs a service's watch once over a folder with one program; the words name folders as the service does.
fn watch(words: &[String], folder: &Path, output: &str) {
    fs::create_dir_all(folder.join("export/hall 2")).unwrap();
    fs::create_dir_all(folder.join("rules")).unwrap();
    fs::copy(folder.join("part.cls"), folder.join("export/hall 2/part 7.cls")).unwrap();
    fs::copy(folder.join("recipe.yaml"), folder.join("rules/recipe.yaml")).unwrap();
    fs::write(
        folder.join("rules/recipes.yaml"),
        "rules:\n- when: { file: \"*.cls\" }\n  recipe: recipe.yaml\n",
    )
    .unwrap();
    clsmith(folder).args(words).args(["--once", "--settle", "0.2"]).assert().success();
    assert!(fs::read_to_string(folder.join(output).join("hall 2/part 7.cls")).unwrap().contains("600.0000"));
}

#[test]
fn the_unit_of_systemd_starts_a_watch() {
    let (unit, settings) =
        (read("examples/services/clsmith-watch@.service"), read("examples/services/hall-2.conf"));
    let command = between(&unit, "ExecStart=/usr/bin/clsmith ", "\n");
    let setting = |name: &str| between(&settings, &format!("\n{name}="), "\n").trim_matches('"').to_owned();
    // As systemd does: `${NAME}` is one word, `$NAME` as many as it holds.
    let mut words = Vec::new();
    for word in command.split(' ') {
        if let Some(name) = word.strip_prefix('$').filter(|name| !name.starts_with('{')) {
            words.extend(setting(name).split(' ').map(str::to_owned));
        } else if word.starts_with("${") {
            let name = between(word, "${", "}");
            words.push(word.replace(&format!("${{{name}}}"), &setting(name)));
        } else {
            words.push(word.to_owned());
        }
    }
    let here = |word: String| {
        let word = word
            .replace("/srv/cam/hall 2/export", "export")
            .replace("/srv/cam/hall 2/corrected", "corrected");
        word.replace("/srv/cam/clsmith/", "rules/")
    };
    let folder = example("pocket");
    watch(&words.into_iter().map(here).collect::<Vec<_>>(), folder.path(), "corrected");
    assert!(folder.path().join("corrected/watch.jsonl").exists());
}

#[test]
fn the_task_of_windows_starts_a_watch() {
    let task = read("examples/services/clsmith-watch.xml");
    let command = between(&task, "<Arguments>", "</Arguments>");
    let here = command.replace(r"\\server\cam\clsmith\", "rules/").replace(r"\\server\cam\", "");
    let words: Vec<String> = here.split(' ').map(|word| word.trim_matches('"').to_owned()).collect();
    let folder = example("pocket");
    watch(&words, folder.path(), "corrected");
    assert!(folder.path().join("rules/watch.jsonl").exists());
}
