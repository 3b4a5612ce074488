//! Cases of feeds, spindle, tools, compensation and cycles.

use super::{Case, case, catia, nx};
use clsmith::diagnostic::codes;

pub fn cases() -> Vec<Case> {
    [feeds(), spindles(), tools(), compensation(), cycles()].into_iter().flatten().collect()
}

fn feed(feed: &str) -> String {
    nx(&format!("FEDRAT/{feed}\nGOTO/1.0,0.0,0.0\n"))
}

fn feeds() -> Vec<Case> {
    vec![
        case(
            codes::CUT_WITHOUT_FEED,
            "GOTO/0,0,0\nGOTO/1.,0,0\nFEDRAT/9.\n",
            "1.,0,0",
            "TLDATA/WEDM,0.2,25.0,0.0\nGOTO/0,0,0\nGOTO/1.,0,0\n",
        ),
        case(codes::ZERO_FEED, feed("MMPM,0.0000"), "0.0000", nx("FEDRAT/MMPM,0.0000\n")),
        case(codes::IMPLAUSIBLE_FEED, feed("MMPR,250.0000"), "250.0000", feed("MMPM,250.0000")),
        case(codes::IMPLAUSIBLE_FEED, feed("MMPM,0.1000"), "0.1000", feed("MMPR,0.1000")),
        case(codes::IMPLAUSIBLE_FEED, feed("MMPM,500000."), "500000.", feed("MMPM,50000.")),
        case(
            codes::FEED_PER_REVOLUTION_WITHOUT_SPINDLE,
            nx("SPINDL/OFF\nFEDRAT/MMPR,0.1\nGOTO/1.0,0.0,0.0\n"),
            "0.1",
            feed("MMPR,0.1"),
        ),
        case(codes::INVERSE_TIME, feed("INVERS,12.5"), "12.5", feed("MMPM,12.5")),
        case(
            codes::FEED_UNITS_MIXED,
            "UNITS/MM\nFEDRAT/10.,IPM\nGOTO/0,0,0\n",
            "10.",
            "UNITS/INCHES\nFEDRAT/10.,IPM\nFEDRAT/9.,PERMIN\nGOTO/0,0,0\n",
        ),
        case(codes::FEED_UNITS_MIXED, feed("IPM,20.0"), "20.0", feed("PERMIN,20.0")),
    ]
}

fn spindles() -> Vec<Case> {
    let start = "TLDATA/MILL,9.0,0.0,9.0\nFEDRAT/MMPM,9.0\nGOTO/0.0,0.0,0.0\n";
    let change =
        |spindle: &str| nx(&format!("RAPID\nGOTO/0.0,0.0,9.0\nLOAD/TOOL,2\n{spindle}GOTO/0.0,0.0,1.0\n"));
    let tap = |name: &str| {
        nx("").replace("END-OF-PATH\n", "").replacen("FINI\n", "", 1)
            + &format!(
                "TOOL PATH/TAP,TOOL,{name}\nTLDATA/DRILL,MILL,12.,0.,75.,118.,40.\nLOAD/TOOL,2\nSPINDL/RPM,320,CLW\n\
                 CYCLE/TAP,RAPTO,5.,FEDTO,-17.,MMPM,560.0000\nGOTO/9,0,0\nCYCLE/OFF\nEND-OF-PATH\n"
            )
    };
    let off = |word: &str| nx(&format!("COOLNT/FLOOD\nGOTO/1.0,0.0,0.0\nCOOLNT/{word}\nGOTO/2.0,0.0,0.0\n"));
    vec![
        case(
            codes::CUT_WITHOUT_SPINDLE,
            format!("{start}GOTO/1.0,0.0,0.0\nSPINDL/RPM,9,CLW\n"),
            "1.0,0.0,0.0",
            format!("{start}SPINDL/RPM,9,CLW\nGOTO/1.0,0.0,0.0\n"),
        ),
        case(
            codes::CUT_WITHOUT_SPINDLE,
            nx("SPINDL/OFF\nGOTO/1.0,0.0,0.0\nGOTO/2.0,0.0,0.0\n"),
            "1.0,0.0,0.0",
            nx("SPINDL/OFF\nRAPID\nGOTO/1.0,0.0,0.0\n"),
        ),
        case(
            codes::NO_SPINDLE,
            format!("{start}GOTO/1.0,0.0,0.0\n"),
            "1.0,0.0,0.0",
            "TLDATA/WEDM,0.2,25.0,0.0\nGOTO/0.0,0.0,0.0\nGOTO/1.0,0.0,0.0\n",
        ),
        case(codes::ZERO_SPEED, nx("SPINDL/RPM,0,CLW\n"), "0", nx("SPINDL/OFF\n")),
        case(codes::SPINDLE_NOT_RESTARTED, change(""), "0.0,0.0,1.0", change("SPINDL/RPM,900,CLW\n")),
        case(
            codes::SPINDLE_NOT_RESTARTED,
            change("COOLNT/ON\n"),
            "0.0,0.0,1.0",
            nx("LOAD/TOOL,1\nGOTO/1.0,0.0,0.0\n"),
        ),
        case(
            codes::THREAD_PITCH_DIFFERS,
            tap("TAP M12x1.5"),
            "CYCLE/TAP,RAPTO,5.,FEDTO,-17.,MMPM,560.0000",
            tap("TAP M12x1.75"),
        ),
        case(codes::NO_COOLANT, off("OFF"), "0.0000,0.0000,0.0000", nx("GOTO/1.0,0.0,0.0\n")),
    ]
}

fn tools() -> Vec<Case> {
    let described = |tool: &str| nx(&format!("RAPID\nGOTO/0.0,0.0,9.0\n{tool}GOTO/1.0,0.0,0.0\n"));
    let cuts = "FEDRAT/9.\nGOTO/0,0,0\nGOTO/1.,0,0\n";
    vec![
        case(codes::CUT_WITHOUT_TOOL, format!("{cuts}LOADTL/1\n"), "1.,0,0", format!("LOADTL/1\n{cuts}")),
        case(codes::NO_TOOL, cuts, "1.,0,0", format!("CUTTER/9.\n{cuts}")),
        case(
            codes::TOOL_SHAPE_MISSING,
            format!("LOADTL/1\n{cuts}"),
            "1.,0,0",
            format!("CUTTER/9.\nLOADTL/1\n{cuts}"),
        ),
        case(
            codes::IMPOSSIBLE_TOOL,
            described("TLDATA/MILL,0.0,0.0,50.0\n"),
            "0.0",
            nx("TLDATA/MILL,0.0,0.0,50.0\nTLDATA/MILL,10.0,1.0,50.0\n"),
        ),
        case(
            codes::IMPOSSIBLE_TOOL,
            described("TLDATA/MILL,10.0,6.0,50.0\n"),
            "6.0",
            described("TLDATA/MILL,10.0,1.0,50.0\n"),
        ),
        case(
            codes::TOOL_SHAPES_DIFFER,
            described("TLDATA/MILL,12.0,1.0,50.0\n"),
            "12.0",
            described("TLDATA/MILL,12.0,1.0,50.0\nLOAD/TOOL,2\nSPINDL/RPM,9,CLW\n"),
        ),
        case(
            codes::TOOL_SHAPES_DIFFER,
            described("TLDATA/MILL,10.0,2.0,50.0\n"),
            "10.0",
            catia("CUTTER/    0.8\nTURRET/2,OSETNO,2\nGOTO/1.0,0.0,0.0\n"),
        ),
        case(
            codes::TOOL_NUMBERS_DIFFER,
            catia("TOOLNO/2, 9.0\nLOADTL/3\n"),
            "3",
            catia("TOOLNO/2, 9.0\nLOADTL/2,1\n"),
        ),
    ]
}

fn compensation() -> Vec<Case> {
    let line = "GOTO/1.0,0.0,0.0\n";
    let arc = "CIRCLE/10.0,0.0,0.0,0.0,0.0,1.0,10.0\nGOTO/10.0,10.0,0.0\n";
    let closed = |inside: &str| nx(&format!("CUTCOM/LEFT,XYPLAN\n{inside}CUTCOM/OFF\nGOTO/5.0,5.0,5.0\n"));
    vec![
        case(codes::CUTCOM_LEFT_ON, nx("CUTCOM/LEFT\nGOTO/1.0,0.0,0.0\n"), "CUTCOM/LEFT", closed(line)),
        case(codes::CUTCOM_AT_ARC, closed(arc), "CUTCOM/LEFT,XYPLAN", closed(line)),
        case(
            codes::CUTCOM_AT_ARC,
            nx(&format!("CUTCOM/LEFT\nGOTO/0.0,0.0,-1.0\nGOTO/0.0,0.0,0.0\nCUTCOM/OFF\n{arc}")),
            "CUTCOM/OFF",
            nx(&format!("CUTCOM/LEFT\nGOTO/0.0,0.0,-1.0\nGOTO/0.0,0.0,0.0\n{arc}CUTCOM/OFF\n")),
        ),
        case(
            codes::CUTCOM_RAPID,
            closed("GOTO/1.0,0.0,0.0\nRAPID\nGOTO/9.0,0.0,0.0\n"),
            "9.0,0.0,0.0",
            closed(line),
        ),
        case(
            codes::CUTCOM_CHANGES_SIDE,
            closed("GOTO/1.0,0.0,0.0\nCUTCOM/RIGHT\n"),
            "CUTCOM/RIGHT",
            closed("CUTCOM/LEFT\n"),
        ),
    ]
}

fn cycles() -> Vec<Case> {
    let cycle = |cycle: &str| nx(&format!("CYCLE/{cycle}\nGOTO/1.0,0.0,0.0\nCYCLE/OFF\n"));
    let good = || cycle("DRILL,RAPTO,3.0000,FEDTO,-9.0000");
    vec![
        case(
            codes::CYCLE_LEFT_ON,
            nx("CYCLE/DRILL,RAPTO,3.0,FEDTO,-9.0\nGOTO/1.0,0.0,0.0\n"),
            "CYCLE/DRILL,RAPTO,3.0,FEDTO,-9.0",
            good(),
        ),
        case(
            codes::CYCLE_LEFT_ON,
            catia("CYCLE/DRILL, 3.0, 5.0\nGOTO/1.0,0.0,0.0\nLOADTL/2\nSPINDL/ 900.0,RPM,CLW\nCYCLE/OFF\n"),
            "CYCLE/DRILL, 3.0, 5.0",
            catia("CYCLE/DRILL, 3.0, 5.0\nGOTO/1.0,0.0,0.0\nLOADTL/1,1\nCYCLE/OFF\n"),
        ),
        case(
            codes::CYCLE_WITHOUT_HOLE,
            nx("CYCLE/DRILL,RAPTO,3.0,FEDTO,-9.0\nCYCLE/OFF\n"),
            "CYCLE/DRILL,RAPTO,3.0,FEDTO,-9.0",
            good(),
        ),
        case(codes::CYCLE_WITHOUT_DEPTH, cycle("DRILL,RAPTO,3.0"), "CYCLE/DRILL,RAPTO,3.0", good()),
        case(codes::CYCLE_CUTS_NOTHING, cycle("DRILL,RAPTO,3.0,FEDTO,0.0000"), "0.0000", good()),
        case(
            codes::CYCLE_CUTS_NOTHING,
            cycle("DRILL,RAPTO,3.0,FEDTO,2.5"),
            "2.5",
            catia("CYCLE/DRILL, 2.5, 3.0\nGOTO/1.0,0.0,0.0\nCYCLE/OFF\n"),
        ),
        case(codes::CYCLE_BELOW_POINT, cycle("DRILL,RAPTO,-3.0,FEDTO,-9.0"), "-3.0", good()),
    ]
}
