//! Every dialect's own spelling.

use super::{by, rules};
use crate::transform::apply;

const CATIA: &str = "$$     CATIA APT VERSION 1.0\n$$*CATIA0\nMULTAX\nINTOL /    0.01000\nFEDRAT/ 1200.0000,MMPM\n\
    GOTO  /   10.00000,   20.00000,  -30.00000\n";
const CREO: &str = "$$*          Pro/CLfile  Version 9.0 - 9.0.3.0\n$$-> CUTTER / 6.000000\nUNITS / INCHES\n\
    FEDRAT / 10.000000,  IPM\nGOTO / 1.7389525618, 71.2503418896, 133.5817460029,  $\n0.9992386202, -0.0000004711, 0.0390151234\n";

#[test]
fn catia_keeps_columns_and_padding() {
    let clamp = "match: 'FEDRAT/$F,MMPM', if: '$F > 900', replace: 'FEDRAT/900,MMPM'";
    assert_eq!(by(clamp, CATIA), CATIA.replace("FEDRAT/ 1200.0000", "FEDRAT/  900.0000"));
    let lift = "match: 'GOTO/$X,$Y,$Z', replace: 'GOTO/$X,$Y,${$Z + 25}'";
    assert_eq!(by(lift, CATIA), CATIA.replace(" -30.00000", "  -5.00000"));
    let insert = "match: MULTAX, insert_after: ['GOTO/1,2,3', 'INTOL/0.05', 'CYCLE/OFF', 'FROM/0,0,9']";
    assert_eq!(
        by(insert, CATIA),
        CATIA.replace("MULTAX\n", "MULTAX\nGOTO  /1,2,3\nINTOL /0.05\nCYCLE/OFF\nFROM  /0,0,9\n")
    );
}

#[test]
fn creo_is_spaced_and_continued() {
    let insert = "match: 'UNITS/INCHES', insert_after: ['COOLNT/ON,FLOOD', 'RAPID', 'GOTO/1,2,3']";
    assert_eq!(
        by(insert, CREO),
        CREO.replace("INCHES\n", "INCHES\nCOOLNT / ON, FLOOD\nRAPID\nGOTO / 1, 2, 3\n")
    );
    let shift = "match: 'GOTO/$X,$Y,$Z,$...A', replace: 'GOTO/${X + 1},$Y,$Z,$...A'";
    assert_eq!(by(shift, CREO), CREO.replace("GOTO / 1.7389525618", "GOTO / 2.7389525618"));
    let drop = "match: 'GOTO/$X,$Y,$Z,$...A', replace: 'GOTO/$X,$Y,$Z'";
    assert!(by(drop, CREO).ends_with("GOTO / 1.7389525618, 71.2503418896, 133.5817460029\n"));
    assert_eq!(
        by("match: '$$-> CUTTER/$D', replace: '$$-> CUTTER/${D * 2}'", CREO),
        CREO.replace("/ 6.000000", "/ 12.000000")
    );
}

#[test]
fn nx_is_tight() {
    let nx = "TOOL PATH/A,TOOL,T\nLOAD/TOOL,2,ADJUST,2 \nGOTO/1.0000,2.0000,3.0000\n";
    assert_eq!(
        by("match: 'LOAD/TOOL,$N,$...', insert_after: 'COOLNT / ON, FLOOD'", nx),
        nx.replace("2 \n", "2 \nCOOLNT/ON,FLOOD\n")
    );
    assert_eq!(
        by("match: 'LOAD/TOOL,$N,$...', replace: 'LOADTL/$N'", nx),
        nx.replace("LOAD/TOOL,2,ADJUST,2", "LOADTL/2")
    );
}

#[test]
fn solidworks_cuts_zeros_and_camworks_puts_a_blank() {
    let solidworks = "UNIT/MM\nCSI_SET_FLUTE_LENGTH/20.\nFEDRAT/125.,MMPM\nGOTO/120.,.5,-0.1\n";
    assert_eq!(
        by("match: 'FEDRAT/$F,MMPM', replace: 'FEDRAT/${F * 0.5},MMPM'", solidworks),
        solidworks.replace("125.", "62.5")
    );
    assert_eq!(
        by("match: 'GOTO/$X,$Y,$Z', replace: 'GOTO/$X,${Y * 0},${Z * 100}'", solidworks),
        solidworks.replace(".5,-0.1", "0,-10.")
    );
    let camworks =
        "UNITS/ MM \nBOX/ 1,2,3,4,5,6,\nCUTTER/ 6.000000,3.000000,\nGOTO/ 1.000000,2.000000,3.000000 \n";
    assert_eq!(
        by("match: 'UNITS/MM', insert_after: 'COOLNT/ON,FLOOD'", camworks),
        camworks.replace("MM \n", "MM \nCOOLNT/ ON,FLOOD\n")
    );
    assert_eq!(
        by("match: 'CUTTER/$D,$R', replace: 'CUTTER/8,$R'", camworks),
        camworks.replace("CUTTER/ 6", "CUTTER/ 8")
    );
}

#[test]
fn line_ends_are_those_of_the_file() {
    let step = rules(&["match: 'A/$X', replace: 'B/$X,$X'", "match: C, insert_after: [D, 'E/1']"]);
    let text = "GOTO/1,2,3\r\nGOTO/1,2,4\r\nA/1 \r\nC\r\nGOTO/1,2,5\r\n";
    assert_eq!(apply(&step, text).0, "GOTO/1,2,3\r\nGOTO/1,2,4\r\nB/1,1 \r\nC\r\nD\r\nE/1\r\nGOTO/1,2,5\r\n");
}

/// The bytes that a step makes of bytes.
fn bytes(rule: &str, text: &[u8]) -> Result<Vec<u8>, Vec<clsmith::diagnostic::Diagnostic>> {
    use clsmith::{setup::Setup, source::Source, transform};
    let recipe = format!("version: 1\nsteps:\n{}", rules(&[rule]));
    let recipe = transform::Recipe::load(&Source::new("recipe.yaml", recipe.into_bytes()).unwrap()).unwrap();
    let done = transform::run_recipe(&recipe, &Setup::default(), crate::support::program(text))
        .map_err(clsmith::diagnostic::Failure::into_findings)?;
    Ok(done.program.to_bytes())
}

#[test]
fn letters_beyond_ascii_are_written_as_the_file_writes_them() {
    let rule = "match: '$$ Généré $...REST', insert_after: 'PPRINT é $...REST'";
    let latin = bytes(rule, b"$$  G\xE9n\xE9r\xE9 le d\xE9but\n").unwrap();
    assert_eq!(latin, b"$$  G\xE9n\xE9r\xE9 le d\xE9but\nPPRINT \xE9 le d\xE9but\n");
    let utf8 = bytes(rule, "$$  Généré le début\n".as_bytes()).unwrap();
    assert_eq!(utf8, "$$  Généré le début\nPPRINT é le début\n".as_bytes());
    let untouched = bytes("match: 'X', replace: 'PPRINT $$ é'", b"\xE9\xFF\nX\n").unwrap();
    assert_eq!(untouched, b"\xE9\xFF\nPPRINT $$ \xE9\n");
    let stopped = bytes("match: 'X', replace: 'PPRINT 5 €'", b"$$ \xE9\nX\n").unwrap_err();
    assert!(stopped[0].message.contains("`€` does not exist"), "{}", stopped[0].message);
}
