//! Every command on the page about the papers draws its figure.
//!
//! The figurine's program is cut off in its first layer here, so that the test is quick: the commands on the page are those of
//! the whole program.

use super::clsmith;
use std::path::Path;

/// The lines of the figurine's program that are taken.
const FIGURINE_LINES: usize = 430;

/// The commands of a page, in its order, but what makes files for others first.
fn list_commands(page: &str) -> Vec<String> {
    let mut commands: Vec<String> =
        page.split('`').filter(|text| text.starts_with("clsmith ")).map(str::to_owned).collect();
    commands.sort_by_key(|command| !command.starts_with("clsmith apply"));
    commands
}

fn copy_example(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten().filter(|entry| entry.path().is_file()) {
        std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}

#[test]
fn each_figure_has_a_command_that_draws_it() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(project.join("docs/papers.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("target")).unwrap();
    for name in ["ball-profile", "cradle", "dynamometer", "figurine", "five-axis-chip", "web-pocket"] {
        copy_example(&project.join("examples").join(name), &folder.path().join("examples").join(name));
    }
    let figurine = folder.path().join("examples/figurine/part.cls");
    let whole = std::fs::read_to_string(&figurine).unwrap();
    let first: Vec<&str> = whole.lines().take(FIGURINE_LINES).chain(["END-OF-PATH"]).collect();
    std::fs::write(&figurine, first.join("\n") + "\n").unwrap();
    let commands = list_commands(&page);
    assert!(commands.len() >= 16, "{commands:?}");
    for command in commands {
        let command = command.replace("--until 1200", "--until 420");
        let words: Vec<&str> = command.split_whitespace().skip(1).collect();
        let done = clsmith(folder.path()).args(&words).output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr);
        // The middle of the web's ramps is run into, which is what its figure is about.
        let is_told = command.contains("web-pocket/part.cls --setup") && said.contains("CL0540");
        assert!(done.status.success() || is_told, "{command}: {said}");
        for output in
            words.iter().filter(|word| word.starts_with("target/") && !word.ends_with("figurine.cls"))
        {
            let bytes = std::fs::read(folder.path().join(output)).unwrap_or_default();
            assert!(bytes.len() > 300, "{command} leaves {} bytes in {output}", bytes.len());
            let is_drawing = !output.ends_with(".svg") || String::from_utf8_lossy(&bytes).contains("</svg>");
            assert!(is_drawing, "{output}");
        }
    }
}
