//! `clsmith plot`.

use super::{clsmith, names};
use crate::report::simulation::{SHOP, SLOT};
use std::path::PathBuf;
use tempfile::TempDir;

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.cls"), SLOT).unwrap();
    std::fs::write(folder.path().join("slow.cls"), SLOT.replace("MMPM,800", "MMPM,400")).unwrap();
    std::fs::write(folder.path().join("shop.yaml"), SHOP).unwrap();
    folder
}

#[test]
fn svg_and_png() {
    let folder = job();
    clsmith(folder.path()).args(["plot", "part.cls", "-o", "a.svg"]).assert().success().stdout("").stderr("");
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("feed, mm/min") && svg.contains("z, mm") && svg.contains("time, s"));
    let args = ["plot", "part.cls", "--after", "slow.cls", "--setup", "shop.yaml", "--along", "path"];
    clsmith(folder.path()).args(args).args(["--of", "chip,load", "-o", "b.PNG", "-q"]).assert().success();
    assert!(std::fs::read(folder.path().join("b.PNG")).unwrap().starts_with(b"\x89PNG"));
    let piped = clsmith(folder.path()).args(["plot", "part.cls", "-o", "-"]).assert().success();
    assert_eq!(String::from_utf8_lossy(&piped.get_output().stdout), svg);
    // Other drawings are pictures as well.
    clsmith(folder.path())
        .args(["simulate", "part.cls", "--setup", "shop.yaml", "-q", "--plot", "c.png"])
        .assert()
        .success();
    assert!(std::fs::read(folder.path().join("c.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn empty_panels_are_told() {
    let folder = job();
    let part = SLOT.replace("FEDRAT/MMPM,800.0000\n", "");
    std::fs::write(folder.path().join("unfed.cls"), part).unwrap();
    let run =
        |args: &[&str]| clsmith(folder.path()).args(["plot", "unfed.cls", "-o", "a.svg"]).args(args).assert();
    let told =
        |done: assert_cmd::assert::Assert| String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    let said = told(run(&[]).code(1));
    assert!(
        said.contains("the panel of z is empty, because no value is known over time; try --along path"),
        "{said}"
    );
    assert!(said.contains("there is nothing to draw"), "{said}");
    assert!(!folder.path().join("a.svg").exists());
    let said = told(run(&["--along", "path"]).success());
    assert!(said.contains("the panel of feed is empty") && !said.contains("panel of z"), "{said}");
    assert!(folder.path().join("a.svg").exists());
}

#[test]
fn what_cannot_be_drawn_is_told() {
    let folder = job();
    for (args, said) in [
        (&["part.cls", "-o", "a.pdf"][..], "give it .svg or .png"),
        (&["part.cls", "-o", "a.svg", "--of", "chip"], "add --setup"),
        (&["-", "--after", "-", "-o", "a.svg"], "read only once"),
        (&["part.cls", "-o", "a.svg", "--of", "speed"], "possible values"),
    ] {
        let done = clsmith(folder.path()).arg("plot").args(args).assert().code(2);
        let told = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
        assert!(told.contains(said), "{told}");
    }
    std::fs::write(folder.path().join("broken.cls"), "GOTO/1,2,x.y.z\nGOTO/1..2,2,3\n").unwrap();
    std::fs::copy(folder.path().join("part.cls"), folder.path().join("part.svg")).unwrap();
    for args in
        [&["broken.cls", "-o", "a.svg"][..], &["part.svg", "-o", "part.svg"], &["none.cls", "-o", "a.svg"]]
    {
        clsmith(folder.path()).arg("plot").args(args).assert().code(1);
    }
    assert_eq!(std::fs::read_to_string(folder.path().join("part.svg")).unwrap(), SLOT);
    let left = ["broken.cls", "part.cls", "part.svg", "shop.yaml", "slow.cls"].map(PathBuf::from);
    assert_eq!(names(folder.path()), left);
}
