//! The page as text: what stands in it, that nothing from a file becomes markup, and that its arrays say what the program says.

use super::simulation::{SHOP, SLOT, setup};
use crate::support;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use clsmith::check::read_and_check;
use clsmith::job::{CorrectionJob, JobOutcome};
use clsmith::parse::parse;
use clsmith::report::comparison::{Comparison, ComparisonRuns, ComparisonSubject, VerdictLevel};
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::html;
use clsmith::setup::Setup;
use clsmith::simulation_run::{SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use clsmith::transform::Recipe;
use flate2::read::DeflateDecoder;
use sha2::{Digest, Sha256};
use std::io::Read;
use std::path::Path;

/// Tells of a program that a recipe changes.
pub fn told<T>(
    name: &str,
    part: &[u8],
    steps: &str,
    shop: &str,
    tell: impl FnOnce(&Comparison<'_>) -> T,
) -> T {
    let text = format!("version: 1\nsteps:\n{steps}");
    let recipe = Recipe::load(&Source::new("recipe.yaml", text.into_bytes()).unwrap()).unwrap();
    let setup = if shop.is_empty() { Setup::default() } else { setup(shop) };
    let source = Source::new(name, part.to_vec()).unwrap();
    let policy = FindingPolicy::default();
    let job = CorrectionJob::new(&recipe, &setup, &policy);
    let JobOutcome { program, findings, reports, simulation } = job.correct_source(&source).unwrap();
    let before = parse(&source, Some(program.dialect())).program;
    let subject = ComparisonSubject {
        before: Some(&before),
        program: &program,
        recipe: Some(&recipe),
        setup: &setup,
        setup_files: &[],
        units: Some(recipe.units),
        shown_in: None,
        findings: &findings,
        reports: &reports,
        print: None,
    };
    let runs = ComparisonRuns::simulate_subject(
        &subject,
        simulation,
        &SimulationRunOptions::default(),
        &SilentWatcher,
    )
    .unwrap();
    tell(&Comparison::from_runs(subject, &runs))
}

fn page(name: &str, part: &[u8], steps: &str, shop: &str) -> String {
    told(name, part, steps, shop, |comparison| {
        let mut page = Vec::new();
        html::write_page(comparison, &mut page).unwrap();
        String::from_utf8(page).unwrap()
    })
}

/// The bytes of an array, numbers put together again.
fn array(page: &str, name: &str, size: usize) -> Vec<u8> {
    let start = page.find(&format!("data-array=\"{name}\"")).unwrap_or_else(|| panic!("no array {name}"));
    let element = page[start..].split_once('>').unwrap().1.split_once('<').unwrap().0;
    let mut planes = Vec::new();
    DeflateDecoder::new(&STANDARD.decode(element).unwrap()[..]).read_to_end(&mut planes).unwrap();
    let count = planes.len() / size;
    (0..count)
        .flat_map(|index| (0..size).map(move |plane| (plane, index)))
        .map(|(plane, index)| planes[plane * count + index])
        .collect()
}

fn floats(page: &str, name: &str) -> Vec<f32> {
    let mut bytes = array(page, name, 4);
    // An array of bits that differ from another one.
    let tag = page.split_once(&format!("data-array=\"{name}\"")).unwrap().1.split_once('>').unwrap().0;
    if let Some((_, base)) = tag.split_once("data-over=\"") {
        let base = array(page, base.strip_suffix('"').unwrap(), 4);
        assert_eq!(bytes.len(), base.len());
        bytes.iter_mut().zip(base).for_each(|(bits, base)| *bits ^= base);
    }
    bytes.chunks(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap())).collect()
}

fn growing(page: &str, name: &str) -> Vec<u32> {
    let steps = array(page, name, 4);
    let steps = steps.chunks(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap()));
    steps
        .scan(0u32, |sum, step| {
            *sum = sum.wrapping_add(step);
            Some(*sum)
        })
        .collect()
}

fn rows(page: &str) -> Vec<String> {
    let text = array(page, "text", 1);
    let kinds = array(page, "kinds", 1);
    let lines = text.strip_suffix(b"\n").unwrap().split(|byte| *byte == b'\n');
    lines
        .zip(kinds)
        .map(|(line, kind)| {
            format!("{}{}", [' ', '-', '+'][usize::from(kind)], String::from_utf8_lossy(line))
        })
        .collect()
}

#[test]
fn numbers_that_a_step_leaves_alone_are_stored_once() {
    let page = page("part.cls", SLOT.as_bytes(), SLOWER, "");
    let over = |name: &str| {
        page.contains(&format!("data-array=\"after.{name}\" data-kind=\"f32\" data-over=\"before.{name}\""))
    };
    assert!(over("x") && over("z") && !over("feed"), "feeds change, places do not");
    assert_eq!(floats(&page, "after.x"), floats(&page, "before.x"));
}

const SLOWER: &str = "  - scale_feed: { factor: 0.5 }\n";

#[test]
fn arrays_say_what_the_programs_say() {
    let page = page("part.cls", SLOT.as_bytes(), SLOWER, SHOP);
    let listing = rows(&page);
    assert_eq!(
        listing[10..13],
        ["-FEDRAT/MMPM,800.0000", "+FEDRAT/MMPM,400.0000", " GOTO/20.0000,20.0000,-2.0000"]
    );
    assert_eq!(listing.len(), SLOT.lines().count() + 1);
    // Two rapids (the first point comes from nowhere), five cuts, one rapid.
    let feed = |name| {
        floats(&page, name).iter().map(|feed| if feed.is_nan() { 0.0 } else { *feed }).collect::<Vec<_>>()
    };
    assert_eq!(feed("before.feed"), [0.0, 800.0, 800.0, 800.0, 800.0, 800.0, 0.0]);
    assert_eq!(feed("after.feed"), [0.0, 400.0, 400.0, 400.0, 400.0, 400.0, 0.0]);
    assert_eq!(array(&page, "after.change", 1), [0, 1, 1, 1, 1, 1, 0]);
    assert_eq!(growing(&page, "after.pair"), [0, 1, 2, 3, 4, 5, 6]);
    // Each motion's row is the one of its GOTO, in both programs.
    for name in ["before.row", "after.row"] {
        let rows: Vec<&str> = growing(&page, name).iter().map(|row| &*listing[*row as usize]).collect();
        assert!(rows.iter().all(|row| row.starts_with(" GOTO/")), "{rows:?}");
        assert_eq!(rows[1], " GOTO/20.0000,20.0000,-2.0000");
    }
    // Where the path goes, from the first point, which stands at 20 over the stock.
    assert_eq!(
        floats(&page, "after.z"),
        [0.0, -22.0, -22.0, -22.0, -22.0, -22.0, -22.0, 0.0].map(|z: f32| z + 22.0)
    );
    let chips = floats(&page, "after.chip");
    assert!((chips[2] - 0.025).abs() < 1e-5, "{chips:?}");
    // The slot lies 2 mm deep in a block of 10.
    let heights = floats(&page, "after.stock");
    let facts = page.split_once("id=\"facts\">").unwrap().1.split_once("</script>").unwrap().0;
    let facts: serde_json::Value = serde_json::from_str(facts).unwrap();
    let kept = facts["sides"][1]["kept"].as_array().unwrap();
    let cells = facts["stock"]["columns"].as_u64().unwrap() * facts["stock"]["rows"].as_u64().unwrap();
    // Raw stock, stock on the way, and what is left after the last motion; heights that stay are not told again.
    assert_eq!((kept.first().unwrap().as_u64(), kept.last().unwrap().as_u64()), (Some(0), Some(7)));
    assert_eq!(heights.len() as u64, cells * kept.len() as u64);
    let told = |state: usize| {
        heights.chunks(cells as usize).nth(state).unwrap().iter().filter(|height| **height >= 0.0).count()
    };
    assert_eq!(told(0) as u64, cells);
    assert!((1..kept.len()).all(|state| (told(state) as u64) < cells / 2) && told(kept.len() - 1) == 0);
    let heights: Vec<f32> = heights.into_iter().filter(|height| *height >= 0.0).collect();
    let [low, high] = heights.iter().fold([f32::MAX, f32::MIN], |[low, high], z| [low.min(*z), high.max(*z)]);
    assert!((low - 8.0).abs() < 1e-3 && (high - 10.0).abs() < 1e-3, "{low} {high}");
}

#[test]
fn points_that_are_put_in_belong_to_the_motion_they_are_of() {
    let split = "  - optimize_feed: { target: 0.02, split: { above: 1.0, shortest: 5, at_most: 8 }, cell: 0.5, max_feed: 3000, air_feed: 3000 }\n";
    let page = page("part.cls", SLOT.as_bytes(), split, SHOP);
    let pairs = growing(&page, "after.pair");
    assert!(pairs.len() > 7, "{pairs:?}");
    assert!(pairs.is_sorted() && pairs.iter().all(|pair| *pair < 7), "{pairs:?}");
    let change = array(&page, "after.change", 1);
    assert!(!change.contains(&3), "nothing goes elsewhere: {change:?}");
    assert!(change.contains(&1) && change.contains(&2), "{change:?}");
    // And back: the motion before is paired with the first that was made of it.
    let back = growing(&page, "before.pair");
    assert_eq!(back.len(), 7);
    assert!(
        back.iter().enumerate().all(|(motion, pair)| pairs[*pair as usize] as usize == motion),
        "{back:?}"
    );
}

#[test]
fn what_moves_is_elsewhere() {
    let page = page("part.cls", SLOT.as_bytes(), "  - move_origin: { translate: [5, 0, 0] }\n", "");
    assert!(array(&page, "after.change", 1).iter().all(|change| *change == 3));
    assert!(array(&page, "before.change", 1).iter().all(|change| *change == 3));
}

#[test]
fn the_same_comparison_makes_the_same_bytes() {
    let once = || page("part.cls", SLOT.as_bytes(), SLOWER, SHOP);
    assert!(once() == once());
}

/// The page without its scripts and styles, which are the page's own.
fn markup(page: &str) -> String {
    let mut out = String::new();
    let mut rest = page;
    while let Some((before, script)) = rest.split_once("<script") {
        out.push_str(before);
        rest = script.split_once("</script>").unwrap().1;
    }
    out + rest
}

#[test]
fn nothing_of_a_file_becomes_markup() {
    let evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'&amp;{{title}}";
    let mut part = SLOT
        .replace("PAINT/COLOR,31\n", &format!("PAINT/COLOR,31\n$$ {evil}\n"))
        .replace("TOOL PATH/SLOT", "TOOL PATH/<b>SLOT</b>")
        .into_bytes();
    part.splice(0..0, b"$$ \xff\xfe\x00\x1b[31m \xe2\x80\xae\r\n".iter().copied());
    let rewrite = format!("  # {evil}\n{SLOWER}");
    let page = page(&format!("{evil}.cls"), &part, &rewrite, "");
    let markup = markup(&page);
    for tag in ["<img", "<b>SLOT", "alert(1)<", "\u{1b}", "\u{202e}", "\0"] {
        assert!(!markup.contains(tag), "{tag}");
    }
    assert!(markup.contains("&lt;img src=x onerror=alert(2)&gt;&quot;&#39;&amp;amp;{{title}}"));
    // Only the page's scripts, each of which ends where it should.
    let own = page.matches("<script>").count();
    assert_eq!(own, 2);
    assert_eq!(page.matches("<script").count(), page.matches("</script>").count());
    let facts = page.split_once("id=\"facts\">").unwrap().1.split_once("</script>").unwrap().0;
    assert!(serde_json::from_str::<serde_json::Value>(facts).unwrap().to_string().contains("<b>SLOT</b>"));
    // In the listing the bytes are as they were.
    assert!(array(&page, "text", 1).starts_with(b"$$ \xff\xfe\x00\x1b[31m"));
}

#[test]
fn the_policy_knows_every_script_and_lets_nothing_else_run() {
    let page = page("part.cls", SLOT.as_bytes(), SLOWER, "");
    let policy =
        page.split_once("Content-Security-Policy\" content=\"").unwrap().1.split_once('"').unwrap().0;
    assert!(policy.starts_with("default-src 'none';"), "{policy}");
    assert!(!policy.contains("unsafe") && !policy.contains("http") && !policy.contains("connect-src"));
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text.as_bytes())));
    let scripts: Vec<&str> =
        page.split("<script>").skip(1).map(|rest| rest.split_once("</script>").unwrap().0).collect();
    assert!(scripts.iter().all(|script| policy.contains(&hash(script))));
    let style = page.split_once("<style>").unwrap().1.split_once("</style>").unwrap().0;
    assert!(policy.contains(&hash(style)));
    assert!(!markup(&page).contains(" style=") && !markup(&page).contains(" onclick="));
}

#[test]
fn what_is_not_known_is_said() {
    let page = page("part.cls", SLOT.as_bytes(), SLOWER, "");
    assert!(page.contains("a simulation needs the stock, and the setup has none"));
    assert!(page.contains("rapids take no time"));
    assert!(!page.contains("data-array=\"after.chip\"") && !page.contains("data-array=\"after.stock\""));
    // No tool that the simulation could take: said as well, and no reason to fail.
    let nameless = SLOT.replace("TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\n", "");
    let page = self::page(
        "part.cls",
        nameless.as_bytes(),
        SLOWER,
        "stock: { block: { from: [0, 0, -10], to: [60, 40, 0] } }\n",
    );
    assert!(page.contains("Not shown"));
}

#[test]
fn a_program_that_nothing_changed() {
    let page = page("part.cls", SLOT.as_bytes(), "  - clamp_feed: { max: 5000 }\n", SHOP);
    assert!(page.contains("Nothing was changed"));
    assert!(array(&page, "after.change", 1).iter().all(|change| *change == 0));
    assert!(!page.contains("data-array=\"before.chip\""), "it was not simulated twice");
}

#[test]
fn a_program_without_motions_makes_a_page() {
    let page = page("empty.cls", b"PARTNO EMPTY\nFROM/0.0,0.0,5.0\nFINI\n", SLOWER, "");
    assert_eq!(rows(&page), [" PARTNO EMPTY", " FROM/0.0,0.0,5.0", " FINI"]);
    assert!(floats(&page, "after.feed").is_empty());
}

#[test]
fn every_fixture_makes_a_page() {
    for (_, path) in support::fixtures() {
        let source = support::source(&path);
        if read_and_check(&source, None).1.iter().any(clsmith::diagnostic::Diagnostic::is_error) {
            continue;
        }
        let page = page(source.name(), source.bytes(), SLOWER, "");
        // What is kept or new is the program as it stands, what is kept or old the one that was read.
        let old: Vec<u8> = rows(&page)
            .iter()
            .filter(|row| !row.starts_with('+'))
            .flat_map(|row| row.bytes().skip(1).chain([b'\n']))
            .collect();
        let read = String::from_utf8_lossy(source.bytes()).replace("\r\n", "\n").replace('\r', "\n");
        assert_eq!(String::from_utf8_lossy(&old).trim_end(), read.trim_end(), "{}", path.display());
    }
}

#[test]
fn the_libraries_are_those_that_the_readme_names() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/report/html/vendor");
    let readme = std::fs::read_to_string(folder.join("README.md")).unwrap();
    let mut seen = 0;
    for entry in std::fs::read_dir(&folder).unwrap().flatten() {
        let name = entry.file_name().into_string().unwrap();
        if !name.contains(".min.") {
            continue;
        }
        let sum: String = Sha256::digest(std::fs::read(entry.path()).unwrap())
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let line = readme.lines().find(|line| line.starts_with(&format!("| `{name}`"))).unwrap();
        assert!(line.contains(&sum), "{name}: {sum}");
        seen += 1;
    }
    assert_eq!(seen, 1);
}

#[test]
fn the_verdict_says_what_was_looked_at() {
    let said = |shop: &str, steps: &str| {
        told("part.cls", SLOT.as_bytes(), steps, shop, |comparison| {
            let verdict = comparison.verdict();
            (verdict.level, verdict.sentence, verdict.details)
        })
    };
    let (level, sentence, details) = said(SHOP, SLOWER);
    assert_eq!(
        (level, &*sentence),
        (VerdictLevel::Go, "Ready to post: the simulation on the stock found no fault.")
    );
    assert!(
        details.starts_with("No problems found. No chip is thicker than 0.0250 mm. 1 statement changed"),
        "{details}"
    );
    // Nobody is told that a program is ready that was not simulated.
    let (level, sentence, _) = said("", SLOWER);
    assert_eq!(
        (level, &*sentence),
        (VerdictLevel::Look, "No fault was found, but nothing was simulated on the stock.")
    );
}

#[test]
fn targets_and_limits_are_those_of_steps_and_machine_in_the_readers_unit() {
    let shop = SHOP.replace("rapid_feed: 10000", "rapid_feed: 10000, max_feed: 2540");
    let steps =
        "  - clamp_feed: { max: 1270 }\n  - optimize_feed: { target: 0.04, max_feed: 2000, cell: 0.5 }\n";
    let page = page("part.cls", SLOT.as_bytes(), steps, &shop);
    let facts = page.split_once("id=\"facts\">").unwrap().1.split_once("</script>").unwrap().0;
    let facts: serde_json::Value = serde_json::from_str(facts).unwrap();
    let limits: Vec<(String, f64)> = facts["limits"]
        .as_array()
        .unwrap()
        .iter()
        .map(|limit| {
            let said = format!("{} {}", limit["quantity"].as_str().unwrap(), limit["name"].as_str().unwrap());
            (said, limit["value"].as_f64().unwrap())
        })
        .collect();
    let wanted = [
        ("feed max_feed of the machine", 2540.0),
        ("feed max of clamp_feed", 1270.0),
        ("chip target of optimize_feed", 0.04),
        ("feed max_feed of optimize_feed", 2000.0),
    ];
    assert_eq!(limits, wanted.map(|(name, value)| (name.to_owned(), value)));
}
