//! Real, good programs: what is found in them is what is odd about them.

use crate::support;
use clsmith::check::check_program;
use clsmith::diagnostic::{Severity, codes};
use clsmith::parse::parse;

/// Every warning and error in the corpus: the end of the file's name, the code, and the line.
const EXPECTED: &[(&str, &str, usize)] = &[
    // A line of random letters after END.
    ("DEMO4.aptsource", "CL0154", 85),
    // The last operation ends in the middle of its last cut, with no retract.
    ("coremill.cls", "CL0117", 4490),
    // An excerpt from the middle of an operation: no FEDRAT in it.
    ("fragment-5axis.txt", "CL0120", 2),
    // An excerpt: CUTCOM/LEFT is never switched off.
    ("wire-edm-excerpt.cls", "CL0140", 25),
];

#[test]
fn real_programs_have_no_finding_but_their_oddities() {
    let mut found = Vec::new();
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        for one in check_program(&parse(&source, None).program) {
            if one.severity > Severity::Note {
                let line = one.labels.first().map_or(0, |label| source.line_column(label.span.start).0);
                found.push((source.name().to_owned(), one.code.id(), line));
            }
        }
    }
    assert_eq!(found.len(), EXPECTED.len(), "{found:?}");
    for (name, code, line) in EXPECTED {
        assert!(found.contains(&((*name).to_owned(), code, *line)), "{name} {code} {line} not in {found:?}");
    }
}

#[test]
fn the_camworks_oddity_of_missing_commas_is_known() {
    let Some(path) = support::require_corpus_file("Interface-glue.clt") else { return };
    let source = support::source(&path);
    let found = check_program(&parse(&source, None).program);
    let commas: Vec<_> = found
        .iter()
        .filter(|found| found.code == codes::MISSING_COMMA)
        .map(|found| String::from_utf8_lossy(source.slice(found.labels[0].span)).into_owned())
        .collect();
    // Every cycle lacks some, so the first one is enough.
    assert_eq!(commas, ["46.927686 46.927686"]);
}
