//! Cases of structure, frames, units and text.

use super::{Case, case, catia, nx};
use clsmith::diagnostic::codes;

pub fn cases() -> Vec<Case> {
    [structure(), frames(), units(), text()].into_iter().flatten().collect()
}

fn structure() -> Vec<Case> {
    let two = |end: &str| format!("{}TOOL PATH/C,TOOL,D\nGOTO/9.0,0.0,0.0\n{end}", nx(""));
    vec![
        case(codes::UNKNOWN_WORD, nx("NONSENSE/1\n"), "NONSENSE", nx("COOLNT/ON\n")),
        case(
            codes::POINTS_MISSING,
            nx("SPLPNT/1.0,2.0,3.0\n"),
            "SPLPNT/1.0,2.0,3.0",
            nx("SPLPNT/1.0,A,3.0\n"),
        ),
        case(codes::MISSPELT_WORD, nx("FEDRATE/100.0\n"), "FEDRATE", nx("NONSENSE/1\n")),
        case(codes::MISSPELT_WORD, nx("GO TO/1.0,2.0,3.0\n"), "GO TO", nx("GOTO/1.0,2.0,3.0\n")),
        case(codes::OPERATION_OPEN, two(""), "TOOL PATH/C,TOOL,D", two("END-OF-PATH\n")),
        case(
            codes::EMPTY_OPERATION,
            format!("TOOL PATH/C,TOOL,D\nEND-OF-PATH\n{}", nx("")),
            "TOOL PATH/C,TOOL,D",
            two("END-OF-PATH\n"),
        ),
        case(
            codes::AFTER_END,
            format!("{}GOTO/1.0,1.0,1.0\n", catia("")),
            "GOTO/1.0,1.0,1.0",
            format!("{}\n$$ x\n", catia("")),
        ),
        case(codes::AFTER_END, format!("{}ghjk\n", catia("")), "ghjk", format!("{}FINI\n", catia(""))),
        case(
            codes::MISSING_END,
            "$$ CATIA APT VERSION 1.0\nGOTO  / 1.0, 2.0, 3.0\n\n",
            "GOTO  / 1.0, 2.0, 3.0",
            nx(""),
        ),
    ]
}

fn frames() -> Vec<Case> {
    let msys = |axes: &str| nx(&format!("MSYS/0.0,0.0,0.0,{axes}\n"));
    let catia0 = |third: &str| {
        catia(&format!(
            "$$*CATIA0\n$$ NAME\n$$ 1.00000 0.00000 0.00000 5.00000\n$$ 0.00000 1.00000 0.00000 5.00000\n$$ {third}\n"
        ))
    };
    vec![
        case(
            codes::FRAME_SKEWED,
            msys("1.0000,0.0000,0.0000,0.0100,1.0000,0.0000"),
            "MSYS/0.0,0.0,0.0,1.0000,0.0000,0.0000,0.0100,1.0000,0.0000",
            msys("0.9975352,-0.0701679,0.0000000,-0.0701679,-0.9975352,0.0000000"),
        ),
        case(
            codes::FRAME_SKEWED,
            catia0("0.00000 0.00000 0.99000 5.00000"),
            "$$ 1.00000 0.00000 0.00000 5.00000\n$$ 0.00000 1.00000 0.00000 5.00000\n$$ 0.00000 0.00000 0.99000 5.00000",
            catia0("0.00000 0.00000 1.00000 5.00000"),
        ),
        case(
            codes::FRAME_LEFT_HANDED,
            "CSYS/1.,0,0,0,0,1.,0,0,0,0,-1.,0\nGOTO/0,0,0\n",
            "CSYS/1.,0,0,0,0,1.,0,0,0,0,-1.,0",
            "CSYS/1.,0,0,0,0,-1.,0,0,0,0,-1.,0\nGOTO/0,0,0\n",
        ),
    ]
}

fn units() -> Vec<Case> {
    vec![
        case(
            codes::UNITS_DIFFER,
            "UNITS/MM\nGOTO/0,0,0\nUNITS/INCHES\nGOTO/1.,0,0\n",
            "UNITS/INCHES",
            "UNITS/MM\nGOTO/0,0,0\nUNITS/MM\nGOTO/1.,0,0\n",
        ),
        case(codes::UNITS_LATE, "GOTO/0,0,0\nUNITS/MM\n", "UNITS/MM", "UNITS/MM\nGOTO/0,0,0\nUNITS/MM\n"),
    ]
}

fn text() -> Vec<Case> {
    let long = "GOTO  /    0.000000000000000,    0.000000000000000,    1.000000000000000\n";
    let longer = "GOTO  /    0.000000000000000,    0.000000000000000,    1.0000000000000001\n";
    vec![
        case(codes::MISSING_COMMA, nx("GOTO/1.0 2.0,3.0\n"), "1.0 2.0", nx("GOTO/1.0 , 2.0, 3.0 \n")),
        case(
            codes::MISSING_COMMA,
            nx("CYCLE/DRILL,RAPTO,3.0 FEDTO,-1.0\nGOTO/1.0,0.0,0.0\nCYCLE/OFF\n"),
            "3.0 FEDTO",
            catia("FEDRAT/ 100.0, $ a comment\n  MMPM\nTPRINT/T1 Tap D 10\n"),
        ),
        case(
            codes::UNUSUAL_NUMBER,
            nx("GOTO/1.0E1,2.0,3.0\n"),
            "1.0E1",
            nx("GOTO/1.0,2.0,3.0\nSELECT/TOOL,2E\n"),
        ),
        case(codes::UNUSUAL_NUMBER, nx("GOTO/1.0,+2.0,3.0\n"), "+2.0", nx("$$ 1+1\n")),
        case(codes::LONG_LINE, catia(longer), "1", catia(long)),
        case(codes::LONG_LINE, catia(longer), "1", nx(longer)),
        case(
            codes::MIXED_LINE_ENDS,
            nx("GOTO/1.0,2.0,3.0\r\n"),
            "GOTO/1.0,2.0,3.0",
            nx("").replace('\n', "\r\n"),
        ),
        case(codes::NO_LAST_LINE_END, nx("").trim_end().to_owned(), "END-OF-PATH", format!("{}  ", nx(""))),
        case(codes::BYTE_ORDER_MARK, format!("\u{FEFF}{}", nx("")), "\u{FEFF}", nx("")),
    ]
}
