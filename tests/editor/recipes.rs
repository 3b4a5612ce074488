//! Recipes, setups and machines in the editor.

use super::PART;
use super::client::Client;
use clsmith::editor::{RecipeWords, YamlFileKind, find_file_names, find_quick_fix, list_step_words};
use clsmith::source::Source;
use serde_json::{Value, json};
use std::path::Path;

const PART_URI: &str = "file:///programs/part.cls";
const RECIPE_URI: &str = "file:///programs/recipe.yaml";
const RECIPE: &str =
    "version: 1\nunits: mm\nsteps:\n  - scale_feed: { factor: 0.5, where: { operations: [ROUGH] } }\n";

#[test]
fn kinds_of_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (path, kind) in [
        ("configs/recipes/slow-entry.yaml", YamlFileKind::Recipe),
        ("configs/machines/cradle.yaml", YamlFileKind::Setup),
        ("configs/tools/endmills.yaml", YamlFileKind::Setup),
        ("configs/materials/steel-c45.yaml", YamlFileKind::Material),
        ("examples/hooks/recipes.yaml", YamlFileKind::Selection),
        ("examples/ball-profile/profile.yaml", YamlFileKind::Profile),
    ] {
        let text = std::fs::read_to_string(root.join(path)).unwrap();
        assert_eq!(YamlFileKind::from_text(text.as_bytes()), Some(kind), "{path}");
        // By its keys as well as by the schema that it names.
        let keys: String =
            text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("{line}\n")).collect();
        assert_eq!(YamlFileKind::from_text(keys.as_bytes()), Some(kind), "{path}");
        let source = Source::new(path, text.into_bytes()).unwrap();
        assert!(clsmith::editor::check_yaml_text(&source, kind).is_empty(), "{path}");
    }
}

#[test]
fn names_of_files_and_places_of_words() {
    let text =
        b"setup_file: ../shop.yaml # a setup\nmaterial: { file: 'my steel' }\n# file: none\nprofile: x\n";
    let source = Source::new("recipe.yaml", text.to_vec()).unwrap();
    let names = find_file_names(&source);
    let told: Vec<_> = names.iter().map(|(span, name)| (source.slice(*span), name.as_str())).collect();
    assert_eq!(told, [(&b"../shop.yaml"[..], "../shop.yaml"), (&b"my steel"[..], "my steel")]);
    assert_eq!(RecipeWords::wanted("  - sca"), Some(RecipeWords::Steps));
    assert_eq!(
        RecipeWords::wanted("  - scale_feed: { where: { operations: [A, "),
        Some(RecipeWords::Operations)
    );
    assert_eq!(RecipeWords::wanted("      tools: ["), Some(RecipeWords::Tools));
    assert_eq!(RecipeWords::wanted("  - scale_feed: { where: { operations: [A] }, "), None);
    assert!(list_step_words().iter().all(|(name, text)| !text.is_empty() && !name.is_empty()));
}

#[test]
fn a_misspelt_step_is_proposed() {
    let source =
        Source::new("recipe.yaml", b"version: 1\nsteps:\n  - scale_fed: { factor: 0.5 }\n".to_vec()).unwrap();
    let found = clsmith::editor::check_yaml_text(&source, YamlFileKind::Recipe);
    let fix = find_quick_fix(&found[0]).unwrap();
    assert_eq!(
        (source.slice(fix.span), fix.text.as_str(), fix.is_certain),
        (&b"scale_fed"[..], "scale_feed", false)
    );
}

#[test]
fn a_recipe_is_checked_completed_and_previewed() {
    let mut client = Client::initialized(&[], Value::Null);
    client.open(PART_URI, "clsf", PART);
    let wrong = client.open(RECIPE_URI, "yaml", &RECIPE.replace("factor", "facto"));
    let place = json!({ "line": 3, "character": 18 });
    assert!(wrong.as_array().unwrap().iter().any(|found| found["range"]["start"] == place), "{wrong}");
    client.change(RECIPE_URI, 2, &[([3, 23, 3, 23], "r")]);
    assert_eq!(client.findings(RECIPE_URI, 2), json!([]));
    let words = client.ask_at("textDocument/completion", RECIPE_URI, 3, 55);
    let labels: Vec<_> = words.as_array().unwrap().iter().map(|word| word["label"].clone()).collect();
    assert_eq!(labels, ["FINISH", "ROUGH"]);

    let lenses = client.ask_about("textDocument/codeLens", RECIPE_URI);
    assert_eq!(lenses[0]["command"]["title"], "preview this recipe on part.cls");
    assert_eq!(lenses[0]["range"]["start"]["line"], 2);
    let preview = client.ask("workspace/executeCommand", lenses[0]["command"].clone());
    assert_eq!(preview["refused"], false, "{preview}");
    let diff = preview["diff"].as_str().unwrap();
    assert!(diff.contains("-FEDRAT/1200.0000\n+FEDRAT/600.0000\n"), "{diff}");
    assert!(preview["text"].as_str().unwrap().contains("FEDRAT/600.0000"));
    let shown = client.wait_for(|message| message["method"] == "window/showDocument");
    let path = shown["params"]["uri"].as_str().unwrap().trim_start_matches("file://").to_owned();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), diff);
    client.end();
    assert!(!Path::new(&path).exists(), "what was shown goes with the server");
}

#[test]
fn chips_are_told_with_a_setup() {
    let folder = tempfile::tempdir().unwrap();
    let shop = folder.path().join("shop.yaml");
    let setup = "units: mm\nmachine: { rapid_feed: 20000 }\nstock: { block: { from: [-20, -20, -10], to: [80, 40, 0] } }\n\
        tools: [ { match: { number: 3 }, diameter: 10, teeth: 4, flute_length: 20 }, { match: { number: 4 }, diameter: 6, teeth: 3, flute_length: 20 } ]\n";
    std::fs::write(&shop, setup).unwrap();
    let mut client = Client::initialized(&["--setup", shop.to_str().unwrap()], Value::Null);
    client.open(PART_URI, "clsf", PART);
    let begun = std::time::Instant::now();
    let text = loop {
        let text = client.hover(PART_URI, 10);
        if text.contains("thickest chip") {
            break text;
        }
        assert!(begun.elapsed().as_secs() < 60, "{text}");
        std::thread::sleep(std::time::Duration::from_millis(20));
    };
    // A slot with four teeth at 1200 mm/min and 5000 rev/min: 1200 / 5000 / 4 mm.
    assert!(text.contains("thickest chip: 0.06 mm"), "{text}");
    client.end();
}
