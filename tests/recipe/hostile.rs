//! Files that nobody writes by hand must not crash, hang or fill the memory.

use super::{bad, load};
use crate::support::within_seconds;
use clsmith::diagnostic::Failure;
use clsmith::recipe::YamlPathSegment;
use clsmith::setup::Setup;
use proptest::prelude::*;

fn code(text: impl AsRef<[u8]>) -> &'static str {
    within_seconds(20.0, || bad(text))[0].code.id()
}

#[test]
fn deep_nesting_is_refused() {
    assert_eq!(code(format!("a: {}", "[".repeat(100_000))), "CL0205");
    assert_eq!(code(format!("a: {}{}", "[".repeat(100_000), "]".repeat(100_000))), "CL0205");
    assert_eq!(code("- ".repeat(50_000)), "CL0205");
    assert_eq!(code(format!("a: {}", "{a: ".repeat(20_000))), "CL0205");
    assert_eq!(code("? ".repeat(50_000)), "CL0207");
}

#[test]
fn alias_bombs_are_refused() {
    let mut laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n".to_owned();
    for level in 1..12 {
        let before = format!("*a{}, ", level - 1).repeat(9);
        laughs += &format!("a{level}: &a{level} [{}]\n", before.trim_end_matches(", "));
    }
    assert_eq!(code(&laughs), "CL0205");
    // Few jumps, each over much text.
    let wide = format!("a: &a {}\nb: [{}]\n", "x".repeat(400_000), "*a, ".repeat(100_000));
    assert_eq!(code(wide), "CL0205");
    assert_eq!(code("a: &a [*a]\n"), "CL0205");
    assert_eq!(code("&a *a : 1\n"), "CL0201");
    assert_eq!(code("&a\n*a : 1\n"), "CL0207");
}

#[test]
fn large_files_are_refused_and_nearly_large_ones_are_read() {
    assert_eq!(code("#".repeat((1 << 20) + 1)), "CL0205");
    let steps = "  - scale_feed: { factor: 0.5 }\n".repeat(30_000);
    let recipe = load(format!("version: 1\nsteps:\n{steps}")).unwrap();
    assert_eq!(recipe.steps.len(), 30_000);
    assert!(recipe.step_span(29_999).start > 900_000);
    assert_eq!(code(format!("version: 1\nsteps:\n{steps}  - polish\n")), "CL0211");
    assert_eq!(code(format!("version: 1\nsteps:\n{}", "  - polish: { a: 1 }\n".repeat(40_000))), "CL0211");
    let keys: String = (0..60_000).map(|key| format!("k{key}: {key}\n")).collect();
    assert_eq!(code(keys), "CL0210");
}

const PIECES: &[&str] = &[
    "version: 1\n",
    "steps:\n",
    "steps: [",
    "  - ",
    "- ",
    "scale_feed",
    "shift",
    "reverse",
    "rewrite",
    ": ",
    ":",
    "\n",
    " ",
    "  ",
    "{ ",
    " }",
    "[",
    "]",
    ", ",
    "factor: ",
    "by: ",
    "where: ",
    "tools: ",
    "operations: ",
    "feed: ",
    "min: ",
    "0.5",
    "-1",
    ".nan",
    "true",
    "~",
    "\"",
    "'",
    "#",
    " # c\n",
    "&a ",
    "*a",
    "!t ",
    "? ",
    "|\n",
    ">-\n",
    "---\n",
    "...\n",
    "<<: ",
    "ä",
    "🛠",
    "\u{85}",
    "\u{2028}",
    "\u{feff}",
    "\t",
    "\r\n",
    "\\",
    "%",
    "@",
    "units: inch\n",
    "setup: ",
    "machine: ",
    "max_feed: ",
    "rules: ",
    "find: ",
];

proptest! {
    #![proptest_config(crate::support::property(2000))]

    #[test]
    fn any_bytes_are_read_or_refused_with_places_in_the_file(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        survive(&bytes)?;
    }

    #[test]
    fn any_text_is_read_or_refused_with_places_in_the_file(text in "\\PC{0,80}") {
        survive(text.as_bytes())?;
    }

    #[test]
    fn anything_like_a_recipe_is_read_or_refused_with_places_in_the_file(
        head in any::<bool>(),
        pieces in proptest::collection::vec(proptest::sample::select(PIECES), 0..40),
    ) {
        let text = format!("{}{}", if head { "version: 1\nsteps:\n  - " } else { "" }, pieces.concat());
        survive(text.as_bytes())?;
    }
}

fn survive(bytes: &[u8]) -> Result<(), TestCaseError> {
    let source = super::source(bytes);
    let found = Setup::load(&source).err().map_or_else(Vec::new, Failure::into_findings);
    match load(bytes) {
        Ok(recipe) => {
            for index in 0..=recipe.steps.len() {
                prop_assert!(recipe.step_span(index).to_range().end <= bytes.len());
                recipe.step_value_span(index, &["factor", "0"]);
                recipe.value_span(&[YamlPathSegment::Key("steps"), YamlPathSegment::Index(index)]);
            }
        }
        Err(errors) => {
            prop_assert!(!errors.is_empty());
            for diagnostic in errors.iter().chain(&found) {
                prop_assert!(diagnostic.is_error());
                prop_assert!(!diagnostic.labels.is_empty());
                for label in &diagnostic.labels {
                    let range = label.span.to_range();
                    prop_assert!(range.end <= bytes.len(), "{:?} of {}", range, bytes.len());
                }
            }
        }
    }
    Ok(())
}
