//! Pages in Markdown: what they link to and the images that they show are there.

use std::path::{Path, PathBuf};

/// All pages of the project, without what is built.
fn pages() -> Vec<PathBuf> {
    let is_ours = |entry: &walkdir::DirEntry| {
        entry.depth() == 0 || !["target", ".git", "corpus"].iter().any(|name| entry.file_name() == *name)
    };
    let walk = walkdir::WalkDir::new(env!("CARGO_MANIFEST_DIR")).sort_by_file_name().into_iter();
    let files = walk.filter_entry(is_ours).map(|entry| entry.unwrap().into_path());
    files.filter(|path| path.extension().is_some_and(|end| end == "md")).collect()
}

/// The text without blocks of code, in which nothing is a link or a heading.
fn prose(text: &str) -> String {
    text.split("\n```").step_by(2).collect::<Vec<_>>().join("\n")
}

/// Targets of `[text](target)` and `![text](target)`.
fn targets(prose: &str) -> impl Iterator<Item = &str> {
    // Every second part stands between backticks.
    let plain = prose.split('`').step_by(2);
    plain.flat_map(|part| part.split("](").skip(1)).filter_map(|rest| rest.split([')', ' ']).next())
}

/// The name under which a heading is linked to: as GitHub and GitLab make it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

#[test]
fn links_and_images_lead_somewhere() {
    let mut missing = Vec::new();
    let mut images = 0;
    for page in pages() {
        let text = prose(&std::fs::read_to_string(&page).unwrap());
        // A link that holds code is cut by it in two: its target follows the closing backtick.
        for target in targets(&text).filter(|target| !target.contains("://") && !target.is_empty()) {
            let (file, name) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            images += usize::from([".png", ".svg"].iter().any(|end| file.ends_with(end)));
            let is_there = path.exists()
                && (name.is_empty() || {
                    let linked = prose(&std::fs::read_to_string(&path).unwrap());
                    linked
                        .lines()
                        .filter(|line| line.starts_with('#'))
                        .any(|line| anchor(line.trim_start_matches('#')) == name)
                });
            if !is_there {
                missing.push(format!("{}: {target}", page.display()));
            }
        }
    }
    assert!(images >= 8, "{images} images");
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn what_lands_has_passed_the_commands_of_the_readme() {
    let read =
        |name: &str| std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).unwrap();
    let (readme, checks) = (read("README.md"), read(".ci/run"));
    let commands: Vec<&str> =
        readme.split("```sh\ncargo ").skip(1).map(|rest| rest.split('\n').next().unwrap()).collect();
    assert!(commands.len() >= 2 && commands[1].starts_with("test"), "{commands:?}");
    for command in commands {
        assert!(checks.lines().any(|line| line.ends_with(&format!(" cargo {command}"))), "{command}");
    }
}
