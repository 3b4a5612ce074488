//! Whatever the bytes: they come back as they were, spans tile them, and nothing panics, motions included.

use crate::support::{fixtures, motions, text};
use clsmith::parse::{parse, read_record, syntax};
use clsmith::program::Dialect;
use proptest::prelude::*;
use std::sync::LazyLock;

/// Reads, writes back, takes motions, operations and roles.
fn check(bytes: &[u8], dialect: Option<Dialect>) -> Result<(), TestCaseError> {
    let parsed = parse(&text(bytes), dialect);
    let program = &parsed.program;
    prop_assert_eq!(program.to_bytes(), bytes);
    let mut end = 0;
    for statement in program.statements() {
        prop_assert_eq!(statement.origin().start, end);
        prop_assert!(!statement.origin().is_empty());
        end = statement.origin().end;
        let syntax = syntax(program.statement_text(statement));
        prop_assert!(syntax.text.len() <= program.statement_text(statement).len());
        // A transform asks every number for its role.
        prop_assert_eq!(statement.record().number_roles(&syntax).len(), syntax.numbers().len());
    }
    prop_assert_eq!(end as usize, bytes.len());
    for found in &parsed.diagnostics {
        for label in &found.labels {
            prop_assert!(label.span.start <= label.span.end && label.span.end as usize <= bytes.len());
        }
    }
    let (found, _) = motions(program);
    for motion in &found {
        prop_assert!(motion.statements.ids().all(|id| program.contains(id)));
        prop_assert!(motion.statements.first() <= motion.statements.last());
        prop_assert!(program.statement(motion.last_statement()).is_live());
        prop_assert!(motion.feed_from.is_none_or(|id| program.statement(id).is_live()));
        let _ = (motion.length(), motion.path.sample_points(motion.from.point, motion.to.point).len());
        let _ = motion.path.end_tangent(motion.from.point, motion.to.point);
    }
    let operations = clsmith::program::operation::find_operations(program);
    prop_assert!(found.iter().all(|motion| motion.operation < operations.len()));
    Ok(())
}

static FIXTURES: LazyLock<Vec<Vec<u8>>> =
    LazyLock::new(|| fixtures().into_iter().map(|(_, path)| std::fs::read(path).unwrap()).collect());

/// Lines of all fixtures, with their line ends.
static LINES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    FIXTURES.iter().flat_map(|text| text.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec)).collect()
});

#[derive(Debug, Clone)]
enum Harm {
    Delete(usize),
    Duplicate(usize),
    Swap(usize, usize),
    Foreign(usize, usize),
    Byte(usize, u8),
    Insert(usize, Vec<u8>),
    Cut(usize),
}

fn harm() -> impl Strategy<Value = Harm> {
    // Bytes that mean something to the grammar are tried more often than others.
    let byte = prop_oneof![3 => prop::sample::select(b"$,/()'. -+\r\n0159AEGOT=\0\x7F\xC4".to_vec()), 1 => any::<u8>()];
    let piece = prop::sample::select(
        [
            "$\n",
            "$$ ",
            "1E308",
            "-1E308",
            "0",
            "NURBS/\n",
            "RAPID\n",
            "CYCLE/DRILL,5\n",
            "(A/",
            ",TIMES,9999",
            "$",
        ]
        .to_vec(),
    );
    let at = any::<usize>();
    prop_oneof![
        at.prop_map(Harm::Delete),
        at.prop_map(Harm::Duplicate),
        (at, at).prop_map(|(a, b)| Harm::Swap(a, b)),
        (at, at).prop_map(|(a, b)| Harm::Foreign(a, b)),
        (at, byte).prop_map(|(at, byte)| Harm::Byte(at, byte)),
        (at, piece).prop_map(|(at, piece)| Harm::Insert(at, piece.as_bytes().to_vec())),
        at.prop_map(Harm::Cut),
    ]
}

fn harmed(text: &[u8], harms: &[Harm]) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> = text.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
    for harm in harms {
        let count = lines.len().max(1);
        match harm {
            Harm::Delete(at) if !lines.is_empty() => drop(lines.remove(at % count)),
            Harm::Duplicate(at) if !lines.is_empty() => lines.insert(at % count, lines[at % count].clone()),
            Harm::Swap(a, b) if !lines.is_empty() => lines.swap(a % count, b % count),
            Harm::Foreign(at, line) => {
                lines.insert(at % count % (lines.len() + 1), LINES[line % LINES.len()].clone())
            }
            _ => {}
        }
    }
    let mut bytes = lines.concat();
    for harm in harms {
        let length = bytes.len().max(1);
        match harm {
            Harm::Byte(at, byte) if !bytes.is_empty() => bytes[at % length] = *byte,
            Harm::Insert(at, piece) if !bytes.is_empty() => {
                drop(bytes.splice(at % length..at % length, piece.iter().copied()))
            }
            Harm::Cut(at) if *at % 4 == 0 => bytes.truncate(at / 4 % length),
            _ => {}
        }
    }
    bytes
}

proptest! {
    #![proptest_config(crate::support::property(600))]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        check(&bytes, None)?;
    }

    #[test]
    fn bytes_of_the_alphabet_of_cl_text(text in "[GOTCYLEDRI/,.$' ()0-9=\\-\n\r\t+*A]{0,200}") {
        check(text.as_bytes(), None)?;
    }

    #[test]
    fn lines_of_all_dialects_in_any_order(
        order in prop::collection::vec(any::<usize>(), 0..60),
        dialect in prop::option::of(prop::sample::select(Dialect::ALL.to_vec())),
    ) {
        let text: Vec<u8> = order.iter().flat_map(|at| LINES[at % LINES.len()].clone()).collect();
        check(&text, dialect)?;
    }

    #[test]
    fn fixtures_with_lines_and_bytes_changed(
        fixture in any::<usize>(),
        harms in prop::collection::vec(harm(), 1..12),
        dialect in prop::option::of(prop::sample::select(Dialect::ALL.to_vec())),
    ) {
        check(&harmed(&FIXTURES[fixture % FIXTURES.len()], &harms), dialect)?;
    }

    #[test]
    fn a_record_of_one_statement_is_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..80)) {
        match read_record(&bytes) {
            Ok((_, syntax)) => prop_assert!(syntax.text.len() <= bytes.len()),
            Err(bad) => prop_assert!(bad.at.end <= bytes.len()),
        }
    }
}

#[test]
fn every_prefix_of_a_fixture_is_read() {
    // A download that broke off: at any byte.
    for text in FIXTURES.iter() {
        for end in (0..text.len()).step_by(31) {
            check(&text[..end], None).unwrap();
        }
    }
}
