//! How a program is divided, in each dialect.

use crate::support::{clean_motions, fixture, program};
use clsmith::program::operation::{Operation, find_operations};
use clsmith::program::{Program, StatementId};

fn names(program: &Program) -> Vec<String> {
    find_operations(program).into_iter().map(|operation| operation.name).collect()
}

#[test]
fn every_dialect_marks_its_operations() {
    for (path, expected) in [
        ("nx/drilling.cls", &["SPOT_DRILL", "DEEP_FROM_BELOW"][..]),
        ("nx/contour-crlf.cls", &["CONTOUR-OUT R2"]),
        ("catia/turning-junk-after-end.aptsource", &["Turning Tool Change.1", "Contour"]),
        ("catia/balayage-multax-latin1.aptsource", &["Changement outil.1", "Balayage.1"]),
        ("catia-icam/spot-drilling.aptsource", &["Tool Change.5", "zabusivanje"]),
        ("creo/volume-mill-3axis.ncl", &["512", "411"]),
        ("creo-gpost/surface-5axis.ncl", &["2021"]),
        ("solidworks/plate-3axis.apt", &[""]),
        ("makino-ff/scan-cut.cldata", &[""]),
        ("iso/bracket-bom.apt", &[""]),
    ] {
        assert_eq!(names(&fixture(path)), expected, "{path}");
    }
}

#[test]
fn operations_leave_no_gap() {
    for (_, path) in crate::support::fixtures() {
        let program = program(std::fs::read(&path).unwrap());
        let found = find_operations(&program);
        let ids = found.iter().flat_map(|operation| operation.statements.unwrap().ids());
        assert!(ids.eq(program.statement_ids()), "{}", path.display());
        // Every motion is counted to the operation that holds its last statement.
        for motion in clean_motions(&program) {
            assert!(found[motion.operation].contains(motion.last_statement()), "{}", path.display());
        }
    }
}

#[test]
fn a_path_that_was_cut_off_is_not_closed() {
    let text = "$$ head\nTOOL PATH/A,TOOL,T\nGOTO/0,0,0\nEND-OF-PATH\nTOOL PATH/B,TOOL,T\nGOTO/1,0,0\n";
    let found = find_operations(&program(text));
    let facts = |found: &Operation| {
        let statements = found.statements.unwrap();
        let places = [found.start.unwrap(), statements.first(), statements.last()].map(StatementId::index);
        (found.name.clone(), places, found.closed)
    };
    let found: Vec<_> = found.iter().map(facts).collect();
    assert_eq!(found, [("A".to_owned(), [1, 0, 3], true), ("B".to_owned(), [4, 4, 5], false)]);
}

#[test]
fn an_empty_program_is_one_operation() {
    let found = find_operations(&program(""));
    assert_eq!((found.len(), found[0].start, found[0].statements), (1, None, None));
}
