//! Which statements a pattern fits, and what it binds.

use super::{by, fits};

#[test]
fn spelling_does_not_matter() {
    for statement in [
        "FEDRAT/MMPM,1000",
        "FEDRAT/MMPM,1000.0000",
        "FEDRAT / MMPM, 1000.",
        "  fedrat/mmpm ,1000.0  ",
        "FEDRAT/MMPM,$\n   1000.0",
        "FEDRAT/MMPM,1000 $$ as always",
        "FEDRAT/MMPM,1.E3",
        "FEDRAT/MMPM,1000,",
    ] {
        assert!(fits("FEDRAT/MMPM,1000", statement), "{statement}");
        assert!(fits("fedrat / mmpm , $F", statement), "{statement}");
        assert!(fits("FEDRAT/MMPM,$\n 1000.", statement), "{statement}");
    }
}

#[test]
fn words_numbers_and_their_count_do() {
    for statement in [
        "FEDRAT/MMPM,1000,X",
        "FEDRAT/MMPM,1000.5",
        "FEDRAT/IPM,1000",
        "FEDRAT/1000,MMPM",
        "SPINDL/MMPM,1000",
    ] {
        assert!(!fits("FEDRAT/MMPM,1000", statement), "{statement}");
    }
    assert!(!fits("COOLNT/ON", "COOLNT/ON,FLOOD"));
    assert!(!fits("COOLNT", "COOLNT/ON"));
    assert!(!fits("GOTO/$X,$Y,$Z", "GOTO/1,2,3,0,0,1"));
    assert!(!fits("COOLNT/$X", "COOLNT/"));
    assert!(!fits("COOL/ON", "COOLNT/ON"));
}

#[test]
fn an_empty_list_is_no_list() {
    assert!(fits("RAPID", "RAPID/"));
    assert!(fits("COOLNT/", "COOLNT"));
    assert!(fits("ROTABL/$A,,TABLE,CLW", "ROTABL/    0.000000,,TABLE,CLW"));
    assert!(!fits("ROTABL/$A,$B,TABLE,CLW", "ROTABL/    0.000000,,TABLE,CLW"));
}

#[test]
fn a_name_binds_any_one_argument() {
    assert_eq!(
        by("match: 'SYN/$A,$B', replace: 'SYN/$B,$A'", "SYN/'TLAXIS','$$*TLAXIS'\n"),
        "SYN/'$$*TLAXIS','TLAXIS'\n"
    );
    let arc = "TLON,GOFWD/(CIRCLE/1.0,2.0,3.0,$\n4.5),ON,(LINE/1,2,3,4,5,6)\n";
    assert_eq!(by("match: 'TLON,GOFWD/$ARC,$...', replace: 'PPRINT R'", arc), "PPRINT R\n");
    assert_eq!(
        by("match: 'TLON,$W/(CIRCLE/$X,$Y,$Z,$R),ON,$L', replace: 'PPRINT $W $R'", arc),
        "PPRINT GOFWD 4.5\n"
    );
    assert!(!fits("TLON,GOFWD/(CIRCLE/$X,$Y,$Z),$...", arc.trim()));
    assert!(!fits("TLON,GOFWD/(LINE/$...),$...", arc.trim()));
}

#[test]
fn the_rest_may_be_nothing() {
    for statement in ["LOAD/TOOL,1", "LOAD/TOOL,1,ADJUST,1 ", "LOAD/TOOL,1,,X"] {
        assert!(fits("LOAD/TOOL,$N,$...REST", statement), "{statement}");
        assert!(fits("LOAD/TOOL,$...", statement), "{statement}");
        assert!(fits("LOAD/$...", statement), "{statement}");
    }
    assert!(fits("COOLNT/$...", "COOLNT"));
    assert!(fits("$$ $...", "$$"));
    assert!(fits("PPRINT $...", "PPRINT"));
}

#[test]
fn the_same_name_twice_wants_equal_values() {
    assert!(fits("LOAD/TOOL,$N,ADJUST,$N", "LOAD/TOOL,2,ADJUST,2.0"));
    assert!(!fits("LOAD/TOOL,$N,ADJUST,$N", "LOAD/TOOL,2,ADJUST,3"));
    assert!(fits("LOAD/TOOL,$_,ADJUST,$_", "LOAD/TOOL,2,ADJUST,3"));
    assert!(fits("SELECT/$A,$A", "SELECT/tool,TOOL"));
}

#[test]
fn words_may_be_bound() {
    assert_eq!(by("match: '$W/ON,$...A', replace: '$W/OFF'", "COOLNT/ON\n"), "COOLNT/OFF\n");
    assert!(fits("$W", "STOP"));
    assert!(!fits("$W", "COOLNT/ON"));
    assert!(!fits("$W", "$$ text"));
    assert!(fits("PAINT/$WHAT,$...", "PAINT/COLOR,42"));
    assert!(fits("CSI_$...X/$L".replace("$...X", "$X").as_str(), "CSI_SET_FLUTE_LENGTH/3"));
}

#[test]
fn text_has_wildcards() {
    assert!(fits("PPRINT $TEXT", "PPRINT -prva strana"));
    assert!(fits("PPRINT/$TEXT", "PPRINT  anything, at: all"));
    assert!(!fits("PPRINT/$TEXT", "PPRINT"));
    assert!(fits("PPRINT Tool  $N of $M", "PPRINT TOOL 3 of  10"));
    assert!(!fits("PPRINT Tool $N", "PPRINT TOOL"));
    assert!(fits("PPRINT Tool $...", "PPRINT TOOL"));
    assert!(!fits("PPRINT Tool $...", "PPRINT TOOLS"));
    assert!(fits("PPRINT $A $...B", "PPRINT ONE"));
    assert!(fits("LOADTL/T$N", "LOADTL/T12"));
    assert!(!fits("LOADTL/T$N", "LOADTL/T"));
    assert_eq!(
        by("match: 'PPRINT $A:$B', replace: 'PPRINT $B;$A'", "PPRINT OP 1: face: it\n"),
        "PPRINT face: it;OP 1\n"
    );
    assert_eq!(
        by("match: 'TPRINT/$A,$...', replace: 'PPRINT [$A]'", "TPRINT/SVJBL 2020 K16,B\n"),
        "PPRINT [SVJBL 2020 K16]\n"
    );
}

#[test]
fn comments_match_as_text() {
    assert!(fits("$$ centerline data", "$$  Centerline   DATA"));
    assert!(fits("$$ Start of $...REST", "$$ Start of : x"));
    assert!(!fits("$$ Start of $...REST", "$$ Starts"));
    assert!(fits("$$*CATIA0", "$$*CATIA0"));
    assert!(fits("$$ $A $B $C $D", "$$     1.00000     0.00000     0.00000     0.00000"));
    assert!(!fits("$$ $...", "COOLNT/ON $$ flood"));
    assert_eq!(by("match: '$$ OP $N', insert_after: 'PPRINT $N'", "$$ OP 7\n"), "$$ OP 7\nPPRINT 7\n");
}

#[test]
fn structured_records_are_their_own_kind() {
    assert!(fits("$$-> CUTTER / $D", "$$-> CUTTER / 6.000000"));
    assert!(fits("$$-> CUTTER / $D", "REMARK -> CUTTER / 6.0"));
    assert!(!fits("CUTTER / $D", "$$-> CUTTER / 6.000000"));
    assert!(!fits("$$ $...", "$$-> CUTTER / 6.000000"));
    assert!(fits(
        "$$-> $W / $...",
        "$$-> CSYS / 1.0, 0.0, 0.0, 0.0,  $\n  0.0, 1.0, 0.0, 0.0,  $\n  0.0, 0.0, 1.0, 0.0"
    ));
}

#[test]
fn tool_paths_show_their_tool_word() {
    let statement = "TOOL PATH/BOK 7,TOOL,R390-25A25L-17L";
    for pattern in
        ["TOOL PATH/$OP,TOOL,$T", "tool  path/$OP,$...REST", "TOOL PATH/bok $N,TOOL,$T", "TOOL PATH/$A,$B,$C"]
    {
        assert!(fits(pattern, statement), "{pattern}");
    }
    assert!(!fits("TOOL PATH/$OP", statement));
    assert!(fits("TOOL PATH/100,$...", "TOOL PATH/100,TOOL,T"));
}
