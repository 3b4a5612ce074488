//! What somebody does first: `init` from a program, and `check` of a program with its setup, of recipes and setups.

use super::{clsmith, example, names};
use crate::support;
use std::fs;
use std::path::{Path, PathBuf};

fn told(folder: &Path, args: &[&str]) -> (i32, String) {
    let done = clsmith(folder).args(args).output().unwrap();
    let text = String::from_utf8_lossy(&done.stdout).into_owned() + &String::from_utf8_lossy(&done.stderr);
    (done.status.code().unwrap(), text)
}

#[test]
fn init_writes_what_is_valid_at_once() {
    for (_, path) in support::fixtures() {
        let folder = tempfile::tempdir().unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        fs::copy(&path, folder.path().join(name)).unwrap();
        let (code, said) = told(folder.path(), &["init", name, "-q", "--format", "line"]);
        if code == 1 {
            assert!(said.contains("CL0"), "{name}: {said}");
            continue;
        }
        assert_eq!(code, 0, "{name}: {said}");
        let (code, said) = told(folder.path(), &["check", "recipe.yaml", "setup.yaml"]);
        assert_eq!(code, 0, "{name}: {said}");
        let (code, said) = told(folder.path(), &["apply", "recipe.yaml", name, "--dry-run"]);
        assert_eq!(code, 0, "{name}: {said}");
        let recipe = fs::read_to_string(folder.path().join("recipe.yaml")).unwrap();
        assert!(
            recipe.starts_with("# yaml-language-server: $schema=clsmith-recipe.schema.json\n"),
            "{recipe}"
        );
    }
}

#[test]
fn init_tells_what_the_pocket_does() {
    let folder = example("pocket");
    for name in ["recipe.yaml", "setup.yaml"] {
        let _ = fs::remove_file(folder.path().join(name));
    }
    let (code, said) = told(folder.path(), &["init", "part.cls"]);
    assert_eq!(code, 0, "{said}");
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    support::snapshots("cli").bind(|| {
        insta::assert_snapshot!("init_setup", read("setup.yaml"));
        insta::assert_snapshot!("init_recipe", read("recipe.yaml"));
    });
    let before = names(folder.path());
    let (code, said) = told(folder.path(), &["init", "part.cls"]);
    assert!(code == 1 && said.contains("is there already"), "{said}");
    assert_eq!(names(folder.path()), before);
}

#[test]
fn recipes_and_setups_are_checked_without_a_program() {
    let folder = example("pocket");
    assert_eq!(told(folder.path(), &["check", "recipe.yaml"]).0, 0);
    fs::write(folder.path().join("wrong.yaml"), "version: 1\nsteps:\n  - scale_feed: { factr: 0.5 }\n")
        .unwrap();
    let (code, said) = told(folder.path(), &["check", "wrong.yaml"]);
    assert!(code == 1 && said.contains("factr"), "{said}");
    fs::write(folder.path().join("shop.yaml"), "machine: { max_feed: -3 }\n").unwrap();
    let (code, said) = told(folder.path(), &["check", "shop.yaml"]);
    assert!(code == 1 && said.contains("max_feed"), "{said}");
}

#[test]
fn a_setup_tells_ramps_that_inserts_do_not_survive() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/web-pocket");
    let folder = example("web-pocket");
    let program = names(&examples).into_iter().find(|name| name.extension().is_some_and(|end| end == "cls"));
    let program = program.unwrap_or_else(|| PathBuf::from("part.cls"));
    let name = program.to_str().unwrap();
    let shop = "tools: [{ match: {}, diameter: 50, insert: { height: 5, radius: 6 } }]\n";
    fs::write(folder.path().join("inserts.yaml"), shop).unwrap();
    let (code, without) = told(folder.path(), &["check", name]);
    assert!(code == 0 && !without.contains("CL0320"), "{without}");
    let (code, said) = told(folder.path(), &["check", "--setup", "inserts.yaml", name]);
    assert!(code == 0 && said.contains("CL0320") && said.contains("A step `correct_ramp`"), "{said}");
    fs::write(folder.path().join("slow.yaml"), "machine: { max_feed: 100 }\n").unwrap();
    let (code, said) = told(folder.path(), &["check", "--setup", "slow.yaml", name]);
    assert!(code == 0 && said.contains("CL0313"), "{said}");
}

#[test]
fn a_first_recipe_in_inches_asks_for_chips_in_inches() {
    let folder = tempfile::tempdir().unwrap();
    let program = "UNITS/INCHES\nCUTTER/0.5\nLOAD/TOOL,1\nSPINDL/3000,RPM,CLW\nFEDRAT/20,IPM\nRAPID\nGOTO/0,0,1\nGOTO/2,0,0\nFINI\n";
    fs::write(folder.path().join("part.apt"), program).unwrap();
    assert_eq!(told(folder.path(), &["init", "part.apt"]).0, 0);
    let recipe = fs::read_to_string(folder.path().join("recipe.yaml")).unwrap();
    // 0.05 in, or 1.3 mm, is no chip that any cutter makes.
    assert!(recipe.contains("optimize_feed: { target: 0.002 }"), "{recipe}");
}

#[test]
fn an_allowed_error_keeps_no_setup_from_being_asked() {
    let folder = tempfile::tempdir().unwrap();
    let program = "UNITS/MM\nCUTTER/10\nLOAD/TOOL,1\nSPINDL/900,RPM,CLW\nFEDRAT/500,MMPM\nRAPID\nGOTO/0,0,50\nCIRCLE/10,0,50,0,0,1,10\nGOTO/29.5,0,50\nFINI\n";
    fs::write(folder.path().join("part.apt"), program).unwrap();
    fs::write(folder.path().join("shop.yaml"), "machine: { max_feed: 300 }\n").unwrap();
    for more in [&[][..], &["--allow", "CL0102"]] {
        let args = ["check", "part.apt", "--setup", "shop.yaml", "--format", "line"];
        let (code, said) = told(folder.path(), &[&args, more].concat());
        assert!(said.contains("CL0102") && said.contains("CL0313"), "{said}");
        assert_eq!(code, i32::from(more.is_empty()), "{said}");
    }
}
