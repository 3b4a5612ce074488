//! Any rule on any program: nothing panics, and what no rule takes stays as it is.

use super::rules;
use crate::support;
use clsmith::program::{Program, StatementChange};
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};
use proptest::prelude::*;

const PROGRAMS: &[&str] = &[
    "TOOL PATH/A,TOOL,T\nLOAD/TOOL,2,ADJUST,2 \nFEDRAT/MMPM,1000.0000\nGOTO/1.0000,-0.0000,3.0000\nCOOLNT/ON\nEND-OF-PATH\n",
    "$$*CATIA0\r\n$$ MSYS\r\nFEDRAT/  300.0000,MMPM\r\nINDIRV/    1.00000,    0.00000,    0.00000\r\n\
     TLON,GOFWD/      (CIRCLE/    0.00000,    5.00000,    0.00000,$\r\n    5.00000),ON,(LINE/    0.00000,    5.00000,    0.00000,$\r\n\
     \x20   5.00000,    5.00000,    0.00000)\r\nPPRINT TOOL: A, B\r\nFINI",
    "$$-> CUTTER / 6.000000\nLOADTL / 2\nGOTO / 1.0, 2.0, 3.0,  $\n0.0, 0.0, 1.0\nFEDRAT / 10.000000,  IPM $$ slow\n\n  STOP",
    "GOTO/1,2,3\n4,5,6\nSYN/'A','$$*B'\nCOOLNT/\nROTABL/0.0,,TABLE\nwhat (is this\nTPRINT/A b,,C\n",
];

/// Texts of rules: statements with wildcards, and some that are none.
fn text() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "FEDRAT",
        "GOTO",
        "COOLNT",
        "LOAD",
        "TOOL PATH",
        "$W",
        "PPRINT",
        "$$",
        "$$->",
        "TLON,GOFWD",
        "$$-> CUTTER",
        "FINI",
        "SYN",
        "LOADTL",
    ]);
    let argument = prop::sample::select(vec![
        "$X",
        "$Y",
        "MMPM",
        "1",
        "1000.0",
        "ON",
        "TOOL",
        "$_",
        "(CIRCLE/$X,$Y,$...R)",
        "'A'",
        "",
        "$...REST",
        "${X}",
        "${X * 2}",
        "${Y + 0.125}",
        "T$X",
        "$X $Y",
        "é",
    ]);
    let slash = prop::sample::select(vec!["/", " / ", " ", "", "/$\n "]);
    let tail = prop::sample::select(vec!["", "", "", " $$ x", " $", "$...REST"]);
    (word, slash, prop::collection::vec(argument, 0..5), tail)
        .prop_map(|(word, slash, arguments, tail)| format!("{word}{slash}{}{tail}", arguments.join(",")))
}

fn condition() -> impl Strategy<Value = Option<&'static str>> {
    prop::sample::select(vec![
        None,
        None,
        Some("$X > 1"),
        Some("$X == 'ON' or $Y != 2"),
        Some("1 / $X < 5"),
        Some("true"),
    ])
}

/// The pieces of a program that no step touched, in order.
fn untouched(program: &Program) -> Vec<(usize, Vec<u8>)> {
    let kept =
        program.statements().iter().filter(|statement| statement.change() == StatementChange::Untouched);
    kept.map(|statement| (statement.origin().start as usize, program.statement_text(statement).to_vec()))
        .collect()
}

proptest! {
    #![proptest_config(crate::support::property(800))]

    #[test]
    fn any_rule_leaves_the_rest_alone(
        pattern in text(),
        condition in condition(),
        replace in prop::option::of(text()),
        before in prop::option::of(text()),
        after in prop::collection::vec(text(), 0..3),
        program in prop::sample::select(PROGRAMS),
    ) {
        let json = |text: &str| serde_json::to_string(text).unwrap();
        let mut rule = format!("match: {}", json(&pattern));
        if let Some(condition) = condition {
            rule += &format!(", if: {}", json(condition));
        }
        match &replace {
            Some(text) => rule += &format!(", replace: {}", json(text)),
            None => rule += ", delete: true",
        }
        if let Some(text) = &before {
            rule += &format!(", insert_before: {}", json(text));
        }
        if !after.is_empty() {
            rule += &format!(", insert_after: {}", serde_json::to_string(&after).unwrap());
        }
        let recipe = format!("version: 1\nsteps:\n{}", rules(&[&rule]));
        let Ok(recipe) = Recipe::load(&Source::new("recipe.yaml", recipe.into_bytes()).unwrap()) else { return Ok(()) };
        let parsed = clsmith::parse::parse(&support::text(program), None).program;
        let Ok(done) = run_recipe(&recipe, &Setup::default(), parsed) else { return Ok(()) };
        for (start, text) in untouched(&done.program) {
            prop_assert_eq!(&program.as_bytes()[start..start + text.len()], text.as_slice());
        }
        // What is written is read back as the same statements.
        let bytes = done.program.to_bytes();
        let again = clsmith::parse::parse(&support::text(&bytes), None).program;
        let live: Vec<&[u8]> = done.program.live_statements().map(|(_, statement)| done.program.statement_text(statement)).collect();
        let read: Vec<&[u8]> = again.statements().iter().map(|statement| again.statement_text(statement)).collect();
        prop_assert_eq!(live, read);
    }

    #[test]
    fn any_text_is_a_rule_or_a_fault(text in "[A-Z/$.{}()',0-9 <>=*+-]{0,40}") {
        let json = serde_json::to_string(&text).unwrap();
        for rule in [
            format!("match: {json}, delete: true"),
            format!("match: 'A/$X', replace: {json}"),
            format!("match: 'A/$X', if: {json}, delete: true"),
        ] {
            let recipe = format!("version: 1\nsteps:\n{}", rules(&[&rule]));
            if let Ok(recipe) = Recipe::load(&support::text(recipe)) {
                let _ = run_recipe(&recipe, &Setup::default(), support::program("A/1\nB/2,3\nA/ON\n"));
            }
        }
    }
}

#[test]
fn a_rule_for_one_word_leaves_every_other_byte_of_the_corpus() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        let parsed = clsmith::parse::parse(&source, None);
        let recipe = format!(
            "version: 1\nsteps:\n{}",
            rules(&[
                "match: 'COOLNT/$...', delete: true",
                "match: 'FEDRAT/$...A', replace: 'FEDRAT/$...A'",
                "match: '$W/$...A', replace: '$W/$...A'"
            ])
        );
        let recipe = Recipe::load(&support::text(recipe)).unwrap();
        let done = run_recipe(&recipe, &Setup::default(), parsed.program).unwrap();
        for (_, statement) in done.program.live_statements() {
            assert_eq!(
                statement.change(),
                StatementChange::Untouched,
                "{path:?}: {:?}",
                String::from_utf8_lossy(done.program.statement_text(statement))
            );
        }
    }
}
