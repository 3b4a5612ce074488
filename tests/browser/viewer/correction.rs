//! Recipes in the viewer: what is saved is what the command writes, and what is missing is said.

use super::{OpenedViewer, example, open_viewer};
use crate::cli::clsmith;
use crate::report::simulation::{SHOP, SLOT};
use std::path::PathBuf;

/// Runs the command in the folder of the files, and returns what it writes.
fn apply(viewer: &OpenedViewer, recipe: &str, part: &str, setup: Option<&str>) -> Vec<u8> {
    let mut command = clsmith(viewer.folder.path());
    command.args(["apply", recipe, part, "-o", "by-command", "-q"]);
    if let Some(setup) = setup {
        command.args(["--setup", setup]);
    }
    command.assert().success();
    std::fs::read(viewer.folder.path().join("by-command")).unwrap()
}

fn copy_example(viewer: &OpenedViewer, name: &str) -> PathBuf {
    viewer.write(name.rsplit('/').next().unwrap(), std::fs::read(example(name)).unwrap())
}

#[test]
fn what_is_saved_is_what_the_command_writes() {
    let Some(mut viewer) = open_viewer() else { return };
    for folder in ["web-pocket", "pocket"] {
        let files =
            ["part.cls", "recipe.yaml"].map(|name| copy_example(&viewer, &format!("{folder}/{name}")));
        viewer.show(&files);
        let wanted = apply(&viewer, "recipe.yaml", "part.cls", None);
        assert_ne!(wanted, std::fs::read(&files[0]).unwrap());
        let saved = viewer.save("part-corrected.cls");
        assert!(saved == wanted, "{folder}: {} bytes saved, {} written", saved.len(), wanted.len());
        std::fs::remove_file(viewer.folder.path().join("saved/part-corrected.cls")).unwrap();
        // Both programs are shown.
        assert_eq!(viewer.in_frame("clsmith.programs.map((program) => program.name).join()"), "before,after");
        assert_eq!(viewer.in_frame("clsmith.listing.kinds.includes(2)"), true);
    }
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn a_recipe_gets_its_setup_and_its_header_tells_the_same_fingerprint() {
    let Some(mut viewer) = open_viewer() else { return };
    let recipe = "version: 1\nprovenance: comments\nsetup_file: shop.yaml\nsteps:\n  \
        - optimize_feed: { target: 0.04, max_feed: 2000, air_feed: 2000, cell: 0.5 }\n";
    let part = viewer.write("slot.cls", SLOT);
    let recipe = viewer.write("recipe.yaml", recipe);
    // Without the setup, the recipe says what it lacks and where it names it.
    viewer.show(&[part, recipe]);
    let failure = viewer.seen_text("failure");
    assert!(failure.contains("shop.yaml") && failure.contains("no file `shop.yaml` was given"), "{failure}");
    assert!(failure.contains("recipe.yaml:3"), "{failure}");
    assert_eq!(viewer.browser.value("document.getElementById('save').disabled"), true);
    // Once it is there, all goes on by itself.
    let shop = viewer.write("shop.yaml", SHOP);
    viewer.show(&[shop]);
    assert_eq!(viewer.seen_text("failure"), "");
    let wanted = apply(&viewer, "recipe.yaml", "slot.cls", None);
    let saved = viewer.save("slot-corrected.cls");
    assert_eq!(String::from_utf8_lossy(&saved), String::from_utf8_lossy(&wanted));
    assert!(
        String::from_utf8_lossy(&saved).contains("sha256") || String::from_utf8_lossy(&saved).contains("SHA")
    );
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn a_refused_program_is_not_saved_and_its_page_says_why() {
    let Some(mut viewer) = open_viewer() else { return };
    let part =
        viewer.write("bad.cls", SLOT.replace("GOTO/70.0000,15.0000,-2.0000", "GOTO/70.0000,15.0O00,-2.0000"));
    let recipe = viewer.write("recipe.yaml", "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n");
    viewer.show(&[part, recipe]);
    assert_eq!(viewer.browser.value("document.getElementById('save').disabled"), true);
    assert!(viewer.seen_text("failure").contains("nothing to save"));
    let verdict = viewer.in_frame("document.querySelector('#verdict b').textContent");
    let verdict = verdict.as_str().unwrap();
    assert!(
        verdict.starts_with("Do not post: ") && verdict.ends_with("No program was written."),
        "{verdict}"
    );
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}
