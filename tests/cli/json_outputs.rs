//! `--json` means the same in every command: the analysis, with the findings of the run, on standard output or
//! in a file, also when errors were found, and never over an input.

use super::{clsmith, example, names};
use crate::surface::solids::cube;
use serde_json::Value;
use std::fs;
use std::path::Path;

fn run(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let done = clsmith(folder).args(args).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (done.status.code().unwrap(), text(done.stdout), text(done.stderr))
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// The codes of a document's findings.
fn codes(document: &Value) -> Vec<String> {
    let found = document["findings"]["diagnostics"].as_array().unwrap();
    found.iter().map(|found| found["code"].as_str().unwrap().to_owned()).collect()
}

/// A binary STL of a block, and one of it without its first triangle.
fn blocks() -> [Vec<u8>; 2] {
    let stl = |triangles: &[[[f64; 3]; 3]]| {
        let mut bytes = vec![b' '; 80];
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|value| (*value as f32).to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    };
    let block = cube([0.0, 0.0, 0.0], [40.0, 20.0, 10.0]);
    [stl(&block), stl(&block[1..])]
}

#[test]
fn section_tells_its_figures() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let [whole, open] = blocks();
    fs::write(at.join("part.stl"), whole).unwrap();
    fs::write(at.join("open.stl"), open).unwrap();
    fs::write(at.join("slot.yaml"), "start: [0, 0]\npieces: [ { line: [10, 0] }, { line: [10, -5] }, { line: [12, -5] }, { line: [12, 0] }, { line: [22, 0] } ]\n").unwrap();
    let good = ["--step", "2", "--radius", "5", "--feed", "800", "--tolerance", "0.005"];
    let section = |args: &[&str]| run(at, &[&["section"], args, &good[..]].concat());
    let (exit, said, _) = section(&["part.stl", "-o", "a.cls", "--json"]);
    let told = json(&said);
    assert_eq!(exit, 0, "{said}");
    assert_eq!(
        (&told["version"], &told["written"], &told["units"]),
        (&1.into(), &"a.cls".into(), &"mm".into())
    );
    let surface = &told["surface"];
    assert_eq!(
        (&surface["planes"], &surface["passes"], &surface["spacing_mm"]),
        (&11.into(), &11.into(), &2.0.into())
    );
    assert_eq!(
        (&surface["cutting_length_mm"], &surface["is_within_tolerance"]),
        (&440.0.into(), &true.into())
    );
    // A circle of radius 5 over a chord of 2: 5 - sqrt(5^2 - 1).
    assert!((surface["scallop_height_mm"].as_f64().unwrap() - (5.0 - 24f64.sqrt())).abs() < 1e-6);
    assert_eq!(codes(&told), ["CL0608"]);
    // The same in inches, of which a model has a 25.4th as many.
    let (_, said, _) = section(&["part.stl", "-o", "b.cls", "--json", "--units", "inch", "--spindle", "900"]);
    let inch = json(&said);
    assert_eq!((&inch["surface"]["spacing_in"], codes(&inch).len()), (&2.0.into(), 0));

    // An error is in the JSON, and the figures are, too; the program is not written.
    let (exit, said, shown) = section(&["part.stl", "-o", "c.cls", "--json", "--deny", "warnings"]);
    let told = json(&said);
    assert_eq!(
        (exit, &told["written"], codes(&told)),
        (1, &Value::Null, vec!["CL0608".to_owned()]),
        "{shown}"
    );
    assert_eq!(told["surface"]["planes"], 11);
    assert!(shown.contains("no program was written"), "{shown}");
    // A part that cannot be milled has no figures.
    let (exit, said, _) = section(&["open.stl", "-o", "c.cls", "--json"]);
    let told = json(&said);
    assert_eq!((exit, &told["surface"], codes(&told).len()), (1, &Value::Null, 1));
    let (exit, said, _) = section(&[
        "--profile",
        "slot.yaml",
        "--from",
        "0",
        "--to",
        "2",
        "--spindle",
        "9",
        "--dry-run",
        "--json",
    ]);
    let told = json(&said);
    assert_eq!(
        (exit, &told["written"], told["surface"]["unreached"].as_array().unwrap().len()),
        (0, &Value::Null, 1),
        "{said}"
    );
    assert!(!at.join("c.cls").exists());
    // Two outputs never share standard output or a file.
    assert_eq!(section(&["part.stl", "-o", "-", "--json"]).0, 2);
    assert_eq!(section(&["part.stl", "-o", "d.cls", "--json=part.stl"]).0, 1);
}

#[test]
fn what_stops_a_command_is_in_its_json() {
    let folder = example("pocket");
    let at = folder.path();
    fs::write(at.join("broken.cls"), "GOTO/1,2,x.y.z\n").unwrap();
    fs::write(at.join("setup.yaml"), "machine: { rapid_feed: 5000 }\n").unwrap();
    fs::write(at.join("wrong.yaml"), "stock: [\n").unwrap();
    for (args, code) in [
        (&["init", "none.cls", "--json"][..], "CL0401"),
        (&["init", "broken.cls", "--json"], "CL0003"),
        (&["init", "part.cls", "--json"], "CL0402"),
        (&["plot", "none.cls", "-o", "a.svg", "--json"], "CL0401"),
        (&["plot", "broken.cls", "-o", "a.svg", "--json"], "CL0003"),
        (&["stats", "none.cls", "--json"], "CL0401"),
        (&["stats", "broken.cls", "--json"], "CL0003"),
        (&["diff", "part.cls", "broken.cls", "--json"], "CL0003"),
        (&["simulate", "broken.cls", "--setup", "setup.yaml", "--json"], "CL0003"),
        (&["batch", "none.yaml", "--json"], "CL0401"),
        (&["batch", "--recipe", "recipe.yaml", "-o", "done", "none-*.cls", "--json"], "CL0420"),
        (&["hook", "--recipe", "recipe.yaml", "none.cls", "--json", "--", "cat", "{}"], "CL0401"),
        (&["hook", "--recipe", "none.yaml", "part.cls", "--json", "--", "cat", "{}"], "CL0401"),
        (&["watch", "none", "--recipe", "recipe.yaml", "-o", "out", "--once", "--json"], "CL0401"),
    ] {
        let (exit, said, shown) = run(at, args);
        assert!([1, 125].contains(&exit), "{args:?}: {exit} {shown}");
        let found = codes(&json(&said));
        assert!(found.iter().any(|found| found == code), "{args:?}: {found:?}, {shown}");
    }
    // A file is written, too, but never one that may be an input.
    let before = fs::read(at.join("setup.yaml")).unwrap();
    fs::write(at.join("material.json"), "{ \"kc11\": 1 }").unwrap();
    for args in [
        &["simulate", "part.cls", "--setup", "wrong.yaml", "--json=material.json"][..],
        &["plot", "part.cls", "--setup", "wrong.yaml", "-o", "a.svg", "--json=material.json"],
        &["batch", "none.yaml", "--json=material.json"],
    ] {
        assert_eq!(run(at, args).0, 1, "{args:?}");
        assert_eq!(fs::read(at.join("material.json")).unwrap(), b"{ \"kc11\": 1 }", "{args:?}");
        let free = [&args[..args.len() - 1], &["--json=free.json"]].concat();
        for _again in 0..2 {
            assert_eq!(run(at, &free).0, 1, "{args:?}");
            assert_eq!(codes(&json(&fs::read_to_string(at.join("free.json")).unwrap())).len(), 1, "{args:?}");
        }
        fs::remove_file(at.join("free.json")).unwrap();
    }
    assert_eq!(fs::read(at.join("setup.yaml")).unwrap(), before);
}

#[test]
fn json_goes_over_no_input_and_no_other_output() {
    let folder = example("pocket");
    let at = folder.path();
    fs::copy(at.join("recipe.yaml"), at.join("recipe.json")).unwrap();
    let before = names(at);
    let kept = fs::read(at.join("recipe.json")).unwrap();
    for (args, exit) in [
        (&["plot", "part.cls", "-o", "-", "--json"][..], 2),
        (&["plot", "part.cls", "-o", "a.svg", "--json=a.csv"], 2),
        (&["hook", "--recipe", "recipe.json", "part.cls", "--json=recipe.json", "--", "cat", "{}"], 1),
        (&["batch", "--recipe", "recipe.json", "-o", "done", "part.cls", "--json=recipe.json"], 1),
        (
            &[
                "batch",
                "--recipe",
                "recipe.json",
                "-o",
                "done",
                "part.cls",
                "--results",
                "r.json",
                "--json=r.json",
            ],
            2,
        ),
    ] {
        let (code, _, shown) = run(at, args);
        assert_eq!(code, exit, "{args:?}: {shown}");
    }
    assert_eq!(fs::read(at.join("recipe.json")).unwrap(), kept);
    let left: Vec<_> = names(at).into_iter().filter(|name| !name.starts_with("done")).collect();
    assert_eq!(left, before);
    fs::create_dir(at.join("exports")).unwrap();
    fs::copy(at.join("recipe.yaml"), at.join("exports/r.json")).unwrap();
    let watch = [
        "watch",
        "exports",
        "--recipe",
        "recipe.yaml",
        "-o",
        "out",
        "--once",
        "--json=exports/r.json",
        "*.json",
    ];
    assert_eq!(run(at, &watch).0, 1);
    assert_eq!(fs::read(at.join("exports/r.json")).unwrap(), fs::read(at.join("recipe.yaml")).unwrap());
}

#[test]
fn the_post_of_a_hook_leaves_standard_output_to_the_json() {
    let folder = example("pocket");
    let at = folder.path();
    let hook = ["hook", "--recipe", "recipe.yaml", "part.cls", "--json", "--", "cat", "{}"];
    let (exit, said, shown) = run(at, &hook);
    assert_eq!(exit, 0, "{shown}");
    let told = json(&said);
    assert_eq!((&told["run"]["outcome"], &told["run"]["exit"]), (&"corrected".into(), &0.into()));
    assert!(shown.contains("GOTO/"), "{shown}");
    // Without it the post writes where it always does, and the JSON is in its file.
    let (_, said, _) =
        run(at, &["hook", "--recipe", "recipe.yaml", "part.cls", "--json=h.json", "--", "cat", "{}"]);
    assert!(said.contains("GOTO/"));
    assert_eq!(json(&fs::read_to_string(at.join("h.json")).unwrap())["run"]["post"]["code"], 0);
    // A record that was asked for and cannot be written is an error, as a log is.
    let (exit, _, shown) =
        run(at, &["hook", "--recipe", "recipe.yaml", "part.cls", "--json=none/h.json", "--", "cat", "{}"]);
    assert_eq!(exit, 125, "{shown}");
}

#[test]
fn a_watch_gives_a_line_for_each_program() {
    let folder = example("pocket");
    let at = folder.path();
    fs::create_dir(at.join("exports")).unwrap();
    for name in ["a.cls", "b.cls"] {
        fs::copy(at.join("part.cls"), at.join("exports").join(name)).unwrap();
    }
    fs::write(at.join("exports/c.cls"), "GOTO/1,2,x.y.z\n").unwrap();
    let watch =
        ["watch", "exports", "--recipe", "recipe.yaml", "-o", "out", "--once", "--settle", "0.2", "--json"];
    let (exit, said, shown) = run(at, &watch);
    assert_eq!(exit, 1, "{shown}");
    let lines: Vec<Value> = said.lines().map(json).collect();
    let outcomes: Vec<&str> = lines.iter().map(|line| line["run"]["outcome"].as_str().unwrap()).collect();
    assert_eq!(outcomes, ["corrected", "corrected", "refused"], "{said}");
    assert_eq!(codes(&lines[2]), ["CL0003"]);
    // A file of lines begins anew with every watch.
    fs::copy(at.join("part.cls"), at.join("exports/d.cls")).unwrap();
    for count in [1, 0] {
        let watch = [&watch[..watch.len() - 1], &["--json=w.json"]].concat();
        let (exit, _, shown) = run(at, &watch);
        let lines = fs::read_to_string(at.join("w.json")).unwrap();
        assert_eq!((exit, lines.lines().count()), (0, count), "{lines}{shown}");
    }
}
