//! A program in inches is shown in inches by every command, and `--display-units` changes it.

use super::clsmith;
use std::path::Path;
use tempfile::TempDir;

const SLOT: &str = "TOOL PATH/SLOT,TOOL,EM10
TLDATA/MILL,0.5000,0.0000,2.0000,0.0000,0.0000
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000
LOAD/TOOL,3,ADJUST,3
SPINDL/RPM,1000.0000,CLW
RAPID
GOTO/-1.5000,1.0000,-0.1000,0.0000000,0.0000000,1.0000000
FEDRAT/IPM,10.0000
GOTO/0.5000,1.0000,-0.1000
GOTO/2.0000,1.0000,-0.1000
END-OF-PATH
";

const SHOP: &str = "units: inch
machine: { rapid_feed: 400, max_feed: 300, max_acceleration: 2000 }
stock: { block: { from: [-1, 0, -0.5], to: [3, 2, 0] } }
tools: [{ match: {}, diameter: 0.5, flute_length: 1, teeth: 2 }]
";

const RECIPE: &str = "version: 1
units: inch
setup_file: shop.yaml
steps:
  - optimize_feed: { target: 0.003 }
";

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("part.cls", SLOT), ("shop.yaml", SHOP), ("recipe.yaml", RECIPE)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// What a command prints, summary and table, and the named files that it writes.
fn run(folder: &Path, line: &str, more: &[&str], files: &[&str]) -> Vec<String> {
    let done = clsmith(folder).args(line.split(' ')).args(more).assert().success();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let mut all = vec![text(&done.get_output().stdout) + &text(&done.get_output().stderr)];
    all.extend(files.iter().map(|file| std::fs::read_to_string(folder.join(file)).unwrap()));
    all
}

/// Each command, with its options and the files that it writes.
const COMMANDS: [(&str, &[&str]); 6] = [
    ("stats part.cls --json", &[]),
    ("stats part.cls", &[]),
    (
        "apply recipe.yaml part.cls --dry-run --report a.html --summary a.md --json a.json",
        &["a.html", "a.md", "a.json"],
    ),
    (
        "simulate part.cls --setup shop.yaml --csv s.csv --json s.json --plot s.svg --report s.html --summary s.md",
        &["s.csv", "s.json", "s.svg", "s.html", "s.md"],
    ),
    (
        "chips part.cls --setup shop.yaml --layer 0.5 --csv c.csv --json c.json --plot c.svg",
        &["c.csv", "c.json", "c.svg"],
    ),
    ("plot part.cls --setup shop.yaml --of feed,chip,removal,z -o p.svg", &["p.svg"]),
];

/// The lines with words of a unit: in names for machines, and behind values and titles. Scripts of the page are not looked at, nor are
/// notes about tools, whose numbers are those of the setup.
fn find_words(text: &str, unit: &str) -> Vec<String> {
    let outside =
        |part: &str| part.split_once("</script>").map_or(part.to_owned(), |(_, rest)| rest.to_owned());
    let text: String = text
        .split("<script")
        .enumerate()
        .map(|(index, part)| match index {
            0 => part.to_owned(),
            _ => outside(part),
        })
        .collect();
    let lines = text.lines().filter(|line| !line.contains(" is taken with a shank of "));
    let is_word = |line: &&str| {
        let words = line.split(|letter: char| !letter.is_alphanumeric() && letter != '_' && letter != '³');
        let cubed = format!("{unit}³");
        words.into_iter().any(|word| {
            word == unit
                || word == format!("{unit}3")
                || word == cubed
                || [format!("_{unit}"), format!("_{unit}3"), format!("_{unit}_min"), format!("_{unit}3_min")]
                    .iter()
                    .any(|end| word.ends_with(end.as_str()))
        })
    };
    lines.filter(is_word).map(str::to_owned).collect()
}

#[test]
fn inch_programs_are_shown_in_inches_by_every_command() {
    let folder = job();
    for (line, files) in COMMANDS {
        for output in run(folder.path(), line, &[], files) {
            let found = find_words(&output, "mm");
            assert!(found.is_empty(), "{line}: {found:#?}");
        }
    }
    let [_, csv, json, plot, page, summary] = &run(folder.path(), COMMANDS[3].0, &[], COMMANDS[3].1)[..]
    else {
        panic!("five files")
    };
    assert!(csv.starts_with("line,operation,tool,length_in,feed_in_min,"), "{csv}");
    // The chip that is proved to be cut, and the bound of all.
    assert!(csv.contains("\n10,SLOT,3,1.5,10.0,0.005,0.005,"), "{csv}");
    assert!(json.contains("\"units\": \"inch\"") && json.contains("\"length_in\": 1.5"), "{json}");
    assert!(plot.contains("thickest chip, in") && plot.contains("feed, in/min"));
    assert!(page.contains("Lengths in in, feeds in in/min.") && page.contains("\"name\":\"in/min\""));
    assert!(summary.contains("| length at feed, in | 3.50 |"), "{summary}");
}

#[test]
fn the_unit_that_is_shown_can_be_chosen() {
    let folder = job();
    for (line, files) in COMMANDS {
        let shown = run(folder.path(), line, &["--display-units", "mm"], files);
        // The page holds recipe and setup as they are, and JSON of a run the program's own words.
        for output in shown.iter().filter(|output| !output.contains("<!doctype html>")) {
            let found = find_words(output, "in");
            let found: Vec<_> =
                found.iter().filter(|line| line.contains("_in") || line.contains(", in")).collect();
            assert!(found.is_empty(), "{line}: {found:#?}");
        }
    }
    let simulated = run(folder.path(), COMMANDS[3].0, &["--display-units", "mm"], COMMANDS[3].1);
    let csv = &simulated[1];
    assert!(csv.contains("\n10,SLOT,3,38.1,254.0,0.12699,0.127,"), "{csv}");
    assert!(simulated[2].contains("\"units\": \"mm\"") && simulated[2].contains("\"length_mm\": 38.1"));
    let stats = run(folder.path(), "stats part.cls", &["--display-units", "mm"], &[]);
    assert!(stats[0].contains("lengths in mm (as asked for; those of the file are in inch"), "{}", stats[0]);
    let same = run(folder.path(), "stats part.cls", &["--display-units", "inch"], &[]);
    assert_eq!(same, run(folder.path(), "stats part.cls", &[], &[]));
}

#[test]
fn a_program_in_mm_is_shown_in_mm_and_can_be_shown_in_inches() {
    let folder = job();
    let metric = SLOT.replace("IPM,10.0000", "MMPM,254.0000");
    std::fs::write(folder.path().join("part.cls"), metric).unwrap();
    let line = "plot part.cls --of feed,z -o p.svg";
    let plain = run(folder.path(), line, &[], &["p.svg"]);
    assert_eq!(plain, run(folder.path(), line, &["--display-units", "mm"], &["p.svg"]));
    assert!(plain[1].contains("feed, mm/min"));
    assert!(run(folder.path(), line, &["--display-units", "inch"], &["p.svg"])[1].contains("feed, in/min"));
}

/// The words of a table's line: the times before and after, and the change.
fn time_line<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    let line = text.lines().find(|line| line.contains(name)).unwrap_or_else(|| panic!("{name}: {text}"));
    let rest = line.split_once(name).unwrap().1;
    rest.split(['|', ' ']).filter(|word| !word.is_empty()).collect()
}

#[test]
fn one_time_is_told_everywhere() {
    let folder = job();
    let time = "time at feed, with acceleration";
    let line = "apply recipe.yaml part.cls -o out.cls --summary a.md --report a.html";
    let [shown, summary, page] = &run(folder.path(), line, &[], &["a.md", "a.html"])[..] else { panic!() };
    let told = time_line(shown, time);
    assert_eq!(told, time_line(summary, time), "{shown}\n{summary}");
    assert!(page.contains(time));
    // `optimize_feed` tells the same before and after.
    let all = time_line(shown, "  all");
    assert_eq!(told[..4], all[..4], "{shown}");
    for (program, times) in [("part.cls", &told[..2]), ("out.cls", &told[2..4])] {
        let stats = &run(folder.path(), &format!("stats {program} --setup shop.yaml"), &[], &[])[0];
        assert!(stats.contains("times at feed with the machine's acceleration"), "{stats}");
        assert!(stats.contains(&times.join(" ")), "{times:?}: {stats}");
        let simulated = &run(folder.path(), &format!("simulate {program} --setup shop.yaml"), &[], &[])[0];
        let words = format!("time: {} at feed with the machine's acceleration", times.join(" "));
        assert!(simulated.contains(&words), "{words}: {simulated}");
    }
    let stats = &run(folder.path(), "stats part.cls", &[], &[])[0];
    assert!(stats.contains("times at feed without acceleration"), "{stats}");
}

#[test]
fn a_thickest_chip_says_how_exact_it_is() {
    let folder = job();
    let outputs = run(folder.path(), COMMANDS[3].0, &[], COMMANDS[3].1);
    assert!(outputs[0].contains("thickest chip at most: 0.00"), "{}", outputs[0]);
    assert!(
        outputs[0].contains(
            "(chips are proved from the motions: a point cuts with the first figure, none with more"
        ),
        "{}",
        outputs[0]
    );
    assert!(
        outputs[1].contains(",chip_thickness_bound_in,removal_rate_mean_in3_min,removal_rate_peak_in3_min,")
    );
    assert!(
        outputs[2].contains("\"chip_thickness_bound_in\": {") && outputs[2].contains("\"removal_window_in\"")
    );
    assert!(
        outputs[4].contains("thickest chip at most, in")
            && outputs[5].contains("| thickest chip at most, in |")
    );
}

#[test]
fn findings_of_a_program_in_inches_are_in_inches() {
    let folder = job();
    let crash = SLOT.replace("FEDRAT/IPM,10.0000\n", "FEDRAT/IPM,0.0001\nGOTO/-1.5,1.,-0.1\nRAPID\n");
    std::fs::write(folder.path().join("part.cls"), crash).unwrap();
    let setup = SHOP.replace("teeth: 2", "teeth: 2, shank: { diameter: 0.6, length: 2 }");
    let setup = setup.replace("flute_length: 1,", "flute_length: 0.05,");
    std::fs::write(folder.path().join("shop.yaml"), setup).unwrap();
    let args = [
        "simulate",
        "part.cls",
        "--setup",
        "shop.yaml",
        "--notes",
        "--max-per-code",
        "0",
        "--format",
        "line",
    ];
    let done = clsmith(folder.path()).args(args).output().unwrap();
    let told = String::from_utf8(done.stderr).unwrap();
    for code in ["CL0510", "CL0511"] {
        let line =
            told.lines().find(|line| line.contains(code)).unwrap_or_else(|| panic!("no {code}: {told}"));
        assert!(line.contains(" in deep") || line.contains(" in3 "), "{line}");
    }
    assert!(!told.contains(" mm"), "{told}");
}
