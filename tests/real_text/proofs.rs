//! The proofs of a corrected program: what depends on neighbours, on the first lines and on the marks of a system.

use crate::support::text;
use clsmith::diagnostic::Failure;
use clsmith::job::CorrectionJob;
use clsmith::program::Dialect;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::setup::Setup;
use clsmith::transform::Recipe;

const HEAD: &str = "LOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nFEDRAT/MMPM,100.\n";

/// Rewrites a program by rules of what is matched and what replaces it. Returns the new text, or the codes of what
/// refused it, and the codes of warnings.
fn rewrite(
    program: impl AsRef<[u8]>,
    rules: &[(&str, &str)],
    allow: &[&str],
    dialect: Option<Dialect>,
) -> (Result<String, Vec<String>>, Vec<String>) {
    let rules: Vec<_> = rules
        .iter()
        .map(|(from, to)| match to.is_empty() {
            true => format!("{{ match: '{from}', delete: true }}"),
            false => format!("{{ match: '{from}', replace: '{to}' }}"),
        })
        .collect();
    let recipe =
        format!("version: 1\nunits: mm\nsteps:\n  - rewrite: {{ rules: [ {} ] }}\n", rules.join(", "));
    let recipe = Recipe::load(&text(recipe)).map_err(Failure::into_findings).unwrap();
    let policy = FindingPolicy::from_code_lists([], allow.iter().copied(), false).unwrap();
    let setup = Setup::default();
    let job = CorrectionJob::new(&recipe, &setup, &policy).with_dialect(dialect);
    match job.try_source(&text(program)) {
        Ok(outcome) => {
            let errors: Vec<_> = outcome
                .findings
                .iter()
                .filter(|found| found.is_error())
                .map(|found| found.code.to_string())
                .collect();
            let others = outcome.findings.iter().filter(|found| !found.is_error() && !found.is_allowed);
            let others = others.map(|found| found.code.to_string()).collect();
            let out = String::from_utf8(outcome.program.to_bytes()).unwrap();
            (if errors.is_empty() { Ok(out) } else { Err(errors) }, others)
        }
        Err(failure) => {
            (Err(failure.findings().iter().map(|found| found.code.to_string()).collect()), Vec::new())
        }
    }
}

/// The line of bare numbers had no point before it, so it was nothing. Then it is the second point of a GOTO.
#[test]
fn a_line_that_becomes_a_point_is_no_proven_program() {
    let program =
        format!("TOOL PATH/A,TOOL,T1\n{HEAD}FROM/0.,0.,50.\n10.,20.,30.\nGOTO/1.,2.,3.\nEND-OF-PATH\n");
    let (written, _) = rewrite(&program, &[("FROM/$X,$Y,$Z", "GOTO/$X,$Y,$Z")], &["CL0002"], None);
    assert_eq!(written, Err(vec!["CL0301".to_owned()]));
    // Where nothing becomes a point the line stays as it is.
    let (written, _) = rewrite(&program, &[("FEDRAT/MMPM,$F", "FEDRAT/MMPM,90.")], &["CL0002"], None);
    assert_eq!(written, Ok(program.replace("100.", "90.")));
}

/// Without a GOTO, lines of a letter and a number are G-code.
#[test]
fn a_program_whose_head_becomes_that_of_another_file_is_no_proven_program() {
    let coolant = "COOLNT/ON\n".repeat(9);
    let program = format!("M8\n{HEAD}FROM/0.,0.,0.\n{coolant}GODLTA/1.,2.,3.\n");
    let (written, _) = rewrite(&program, &[("COOLNT/ON", "M8")], &["CL0150"], None);
    assert_eq!(written, Err(vec!["CL0301".to_owned()]));
    let (written, _) = rewrite(&program, &[("COOLNT/ON", "COOLNT/OFF")], &["CL0150"], None);
    assert_eq!(written, Ok(program.replace("COOLNT/ON", "COOLNT/OFF")));
}

const ARC: &str =
    "GOTO/0.,0.,50.\nGOTO/10.,0.,0.\nCIRCLE/0.,0.,0.,0.,0.,1.,10.\nGOTO/0.,10.,0.\nGOTO/0.,20.,0.\n";
const LINES: &str = "GOTO/0.,0.,50.\nGOTO/10.,0.,0.\nGOTO/0.,10.,0.\n";

#[test]
fn a_program_whose_arcs_turn_otherwise_for_the_next_reader_is_refused() {
    let program = format!("PAINT/COLOR,31\n{HEAD}{ARC}");
    let to_gpost = ("PAINT/$...R", "PPWORD/$...R");
    assert_eq!(rewrite(&program, &[to_gpost], &[], None).0, Err(vec!["CL0317".to_owned()]));
    // The last mark is gone, or another one comes before it.
    assert_eq!(rewrite(&program, &[("PAINT/$...R", "")], &[], None).0, Err(vec!["CL0317".to_owned()]));
    let later = program.replace("PAINT/COLOR,31", "DELAY/1\nPAINT/COLOR,31");
    assert_eq!(
        rewrite(&later, &[("DELAY/1", "PPWORD/1")], &["CL0151"], None).0,
        Err(vec!["CL0317".to_owned()])
    );
    // Who says what the file is, or allows it, gets it.
    let expected = program.replace("PAINT", "PPWORD");
    assert_eq!(rewrite(&program, &[to_gpost], &["CL0151"], Some(Dialect::Nx)).0, Ok(expected.clone()));
    assert_eq!(rewrite(&program, &[to_gpost], &["CL0317", "CL0151"], None).0, Ok(expected));
}

#[test]
fn a_program_that_reads_as_one_of_another_system_is_told_of() {
    let program = format!("PAINT/COLOR,31\n{HEAD}{LINES}");
    let (written, found) = rewrite(&program, &[("PAINT/$...R", "PPWORD/$...R")], &["CL0151"], None);
    assert_eq!(written, Ok(program.replace("PAINT", "PPWORD")));
    assert!(found.contains(&"CL0316".to_owned()), "{found:?}");
    // A mark that changes nothing but its numbers, or that another one stands before, tells nothing new.
    let twice = format!("TOOL PATH/A,TOOL,B\n{HEAD}PAINT/COLOR,31\n{ARC}END-OF-PATH\n");
    for rule in [("PAINT/$...R", "PPWORD/$...R"), ("PAINT/COLOR,$N", "PAINT/COLOR,30"), ("PAINT/$...R", "")] {
        let (written, found) = rewrite(&twice, &[rule], &["CL0151"], None);
        assert!(written.is_ok(), "{written:?}");
        assert!(!found.iter().any(|code| code == "CL0316"), "{found:?}");
    }
}
