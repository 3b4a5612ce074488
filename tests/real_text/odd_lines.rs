//! One odd line is a finding on that line, and files of another kind are named in one sentence.

use super::{alarms, findings, read, totals};

const NX: &str = "TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,600.\nGOTO/0,0,0\nODD\nGOTO/10,0,0\nEND-OF-PATH\n";

#[test]
fn a_line_of_another_language_is_a_finding_on_that_line() {
    for odd in ["R1=5", "L10)", "#101=25.4", "X = 3 * 4", "TP(3)=POINT/1,2,3", "A5) CHECK HERE"] {
        let text = NX.replace("ODD", odd);
        let found = alarms(&text);
        assert!(found.contains(&("CL0001".to_owned(), 4)), "{odd}: {found:?}");
        assert_eq!(totals(&read(&text)), (10.0, 0.0, 1.0), "{odd}");
        assert!(!found.iter().any(|(code, _)| code == "CL0010"), "{odd}");
    }
}

#[test]
fn a_file_without_marks_may_have_odd_lines_too() {
    let text = "FEDRAT/MMPM,600.\nGOTO/0,0,0\nR1=5\nGOTO/10,0,0\nGOTO/20,0,0\n";
    assert!(alarms(text).contains(&("CL0001".to_owned(), 3)));
    assert_eq!(totals(&read(text)), (20.0, 0.0, 2.0));
}

#[test]
fn a_file_of_another_kind_is_one_finding() {
    for text in [
        "%\nO1\nG21 G90\nG0 X1 Y2\nG1 Z-5. F800\nM30\n%\n",
        "0 BEGIN PGM PLATE MM\n1 L X-15 Y+0 R0 FMAX M3\n2 END PGM PLATE MM\n",
        "&ACCESS RVP\nDEF MILL( )\nPTP HOME\nEND\n",
        "<?xml version=\"1.0\"?>\n<path/>\n",
    ] {
        let found = findings(text, true);
        assert_eq!(found, [("CL0012".to_owned(), 1)], "{text}");
    }
}
