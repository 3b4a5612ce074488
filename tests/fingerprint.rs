//! Digests of what goes into a run.

use clsmith::fingerprint::{Digest, RecipeFingerprint};
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::Recipe;
use std::path::Path;

#[test]
fn a_digest_is_the_one_that_sha256sum_prints() {
    let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(Digest::from_bytes(b"abc").to_string(), abc);
    assert_eq!(Digest::from_reader(&b"abc"[..]).unwrap().to_string(), abc);
    assert_eq!(abc.parse(), Ok(Digest::from_bytes(b"abc")));
    let json = serde_json::to_string(&Digest::from_bytes(b"abc")).unwrap();
    assert_eq!(serde_json::from_str::<Digest>(&json).unwrap(), Digest::from_bytes(b"abc"));
    for bad in ["", "xyz", &abc[1..], &format!("{abc}0"), &abc.replace('b', "g")] {
        assert!(bad.parse::<Digest>().is_err(), "{bad}");
    }
}

#[test]
fn parts_do_not_run_together() {
    assert_ne!(Digest::from_parts([&b"ab"[..], b"c"]), Digest::from_parts([&b"a"[..], b"bc"]));
    assert_ne!(Digest::from_parts([&b"ab"[..]]), Digest::from_parts([&b"ab"[..], b""]));
}

/// The print of a recipe that names a stock, read from a folder.
fn print(folder: &Path, recipe: &str) -> RecipeFingerprint {
    let path = folder.join("recipe.yaml");
    std::fs::write(&path, recipe).unwrap();
    let source = Source::new(path.to_string_lossy(), recipe.as_bytes().to_vec()).unwrap();
    let recipe = Recipe::load(&source).unwrap();
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    RecipeFingerprint::read_files(&[source], &recipe, &setup).unwrap()
}

#[test]
fn a_recipe_counts_with_every_file_it_depends_on() {
    const RECIPE: &str = "version: 1\nsetup: { stock: { stl: block.stl } }\nsteps:\n  - compensate_z: { radius: 5, against: { mesh: part.stl } }\n";
    let (here, there) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for folder in [&here, &there] {
        std::fs::write(folder.path().join("block.stl"), "block").unwrap();
        std::fs::write(folder.path().join("part.stl"), "part").unwrap();
    }
    let first = print(here.path(), RECIPE);
    assert_eq!(first.files.len(), 3, "{first:?}");
    assert_eq!(first.sha256, print(there.path(), RECIPE).sha256, "names do not count");
    for name in ["block.stl", "part.stl"] {
        std::fs::write(there.path().join(name), "another").unwrap();
        let changed = print(there.path(), RECIPE);
        assert_ne!(first.sha256, changed.sha256, "{name}");
        std::fs::copy(here.path().join(name), there.path().join(name)).unwrap();
    }
    assert_ne!(first.sha256, print(here.path(), &RECIPE.replace("radius: 5", "radius: 6")).sha256);
    let input = Digest::from_bytes(b"part");
    assert_ne!(first.result_key(input, ""), first.result_key(Digest::from_bytes(b"other"), ""));
    assert_ne!(first.result_key(input, ""), first.result_key(input, "--dialect nx"));
}

#[test]
fn a_model_that_is_missing_is_told() {
    let recipe = "version: 1\nsetup: { stock: { stl: nowhere.stl } }\nsteps: []\n";
    let source = Source::new("recipe.yaml", recipe.as_bytes().to_vec()).unwrap();
    let recipe = Recipe::load(&source).unwrap();
    let found = RecipeFingerprint::read_files(&[source], &recipe, &recipe.setup).unwrap_err();
    let found = &found.findings()[0];
    assert_eq!(found.code.id(), "CL0401");
    assert!(found.message.contains("nowhere.stl"), "{}", found.message);
}
