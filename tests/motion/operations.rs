//! How a program is divided, in each dialect.

use crate::support::{clean_motions, fixture, program};
use clsmith::program::Program;
use clsmith::program::operation::{Operation, find_operations};

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
        assert_eq!(found[0].statements.start, 0);
        assert!(found.windows(2).all(|pair| pair[0].statements.end == pair[1].statements.start));
        assert_eq!(found.last().unwrap().statements.end, program.statements().len());
        // Every motion is counted to the operation that holds its last statement.
        for motion in clean_motions(&program) {
            assert!(
                found[motion.operation].statements.contains(&motion.last_statement()),
                "{}",
                path.display()
            );
        }
    }
}

#[test]
fn a_path_that_was_cut_off_is_not_closed() {
    let text = "$$ head\nTOOL PATH/A,TOOL,T\nGOTO/0,0,0\nEND-OF-PATH\nTOOL PATH/B,TOOL,T\nGOTO/1,0,0\n";
    let found = find_operations(&program(text));
    let operation = |name: &str, start, statements, closed| Operation {
        name: name.to_owned(),
        start,
        statements,
        closed,
    };
    assert_eq!(found, [operation("A", 1, 0..4, true), operation("B", 4, 4..6, false)]);
}

#[test]
fn an_empty_program_is_one_operation() {
    assert_eq!(find_operations(&program("")).len(), 1);
}
