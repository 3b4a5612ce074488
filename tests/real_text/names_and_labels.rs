//! Names with commas, and statements with a number in front.

use super::{HALF, alarms, apply, read, totals};
use clsmith::program::operation::{find_operations, tool_name};

#[test]
fn names_end_before_the_tool_and_with_the_line() {
    for (line, operation, tool) in [
        ("TOOL PATH/SLOT 3,5 DEEP,TOOL,EM 3,5 LONG", "SLOT 3,5 DEEP", Some("EM 3,5 LONG")),
        ("TOOL PATH/A,B,C", "A,B,C", None),
        ("TOOL PATH/TOOL,TOOL,TOOL", "TOOL", Some("TOOL")),
        ("TOOL PATH/A,TOOL,B,TOOL,C", "A", Some("B,TOOL,C")),
    ] {
        let program = read(format!("{line}\nGOTO/1,2,3\n"));
        assert_eq!(find_operations(&program)[0].name, operation, "{line}");
        assert_eq!(tool_name(&program, &program.statements()[0]).as_deref(), tool, "{line}");
    }
}

#[test]
fn numbers_in_front_of_statements_are_kept_and_mean_nothing() {
    let plain = "TOOL PATH/A,TOOL,B\nLOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nFEDRAT/MMPM,400.\nRAPID\nGOTO/0,0,0\n\
                 CIRCLE/0,10,0,0,0,-1,10.\nGOTO/10,10,0\nPPRINT TEXT\nEND-OF-PATH\n";
    for label in ["N0010 ", "N5 ", "0010 ", "  n7  "] {
        let numbered: String = plain.lines().map(|line| format!("{label}{line}\n")).collect();
        assert_eq!(alarms(&numbered), [], "{label}");
        assert_eq!(totals(&read(&numbered)), totals(&read(plain)), "{label}");
        let halved: String = apply(HALF, plain).lines().map(|line| format!("{label}{line}\n")).collect();
        assert_eq!(apply(HALF, &numbered), halved);
    }
}
