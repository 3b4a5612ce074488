//! Each dialect's form: where header and comments stand, and what they look like.

use super::{text, with_comments};
use crate::support::snapshots;

const NX: &str = "\
TOOL PATH/SLOT,TOOL,EM10\n\
TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\n\
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n\
$$ centerline data\n\
PAINT/PATH\n\
SPINDL/RPM,2000,CLW\n\
RAPID\n\
GOTO/0.0000,0.0000,10.0000,0.0000000,0.0000000,1.0000000\n\
FEDRAT/MMPM,250.0000\n\
GOTO/0.0000,0.0000,-2.0000\n\
CIRCLE/0.0000,10.0000,-2.0000,0.0000000,0.0000000,-1.0000000,10.0000,0.0600,0.5000,10.0000,0.0000\n\
GOTO/10.0000,10.0000,-2.0000\n\
NURBS/\n\
KNOT/1.0000000\n\
CNTRL/12.0000,12.0000,-2.0000\n\
CNTRL/14.0000,12.0000,-2.0000\n\
CNTRL/16.0000,10.0000,-2.0000\n\
END-OF-PATH\n";

const CATIA: &str = "\
$$ -----------------------------------------------------------------\r\n\
$$     CATIA APT VERSION 1.0\r\n\
$$ -----------------------------------------------------------------\r\n\
$$ Program.1\r\n\
$$  Operation.1\r\n\
$$*CATIA0\r\n\
$$ Program.1\r\n\
$$     1.00000     0.00000     0.00000     0.00000\r\n\
$$     0.00000     1.00000     0.00000     0.00000\r\n\
$$     0.00000     0.00000     1.00000     0.00000\r\n\
PARTNO PLATE\r\n\
CUTTER/ 12.000000,  1.000000,  5.000000,  1.000000,  0.000000,$\r\n\
\x20        0.000000, 60.000000\r\n\
LOADTL/3\r\n\
SPINDL/ 3000.0000,RPM,CLW\r\n\
RAPID\r\n\
GOTO  /   20.00000,    0.00000,    5.00000\r\n\
FEDRAT/  300.0000,MMPM\r\n\
GOTO  /   20.00000,    0.00000,   -5.00000\r\n\
INTOL /    0.00100\r\n\
OUTTOL/    0.00000\r\n\
AUTOPS\r\n\
INDIRV/    0.00000,    1.00000,    0.00000\r\n\
TLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -5.00000,$\r\n\
\x20     20.00000),ON,(LINE/      0.00000,      0.00000,     -5.00000,$\r\n\
\x20                            0.00000,     20.00000,     -5.00000)\r\n\
INDIRV/   -1.00000,    0.00000,    0.00000\r\n\
TLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -5.00000,$\r\n\
\x20     20.00000),ON,(LINE/      0.00000,      0.00000,     -5.00000,$\r\n\
\x20                          -20.00000,      0.00000,     -5.00000)\r\n\
FINI\r\n";

const CREO: &str = "\
$$*          Pro/CLfile  Version 11.0 - 11.0.0.0\n\
$$-> MFGNO / MFG0001\n\
PARTNO / MFG0001\n\
$$-> FEATNO / 12\n\
UNITS / MM\n\
LOADTL / 1\n\
$$-> CUTTER / 10.000000\n\
$$-> CSYS / 1.0000000000, 0.0000000000, 0.0000000000, 0.0000000000,  $\n\
\x20           0.0000000000, 1.0000000000, 0.0000000000, 0.0000000000,  $\n\
\x20           0.0000000000, 0.0000000000, 1.0000000000, 0.0000000000\n\
SPINDL / RPM, 1000.000000,  CLW\n\
RAPID \n\
GOTO / 0.0000000000, 0.0000000000, 5.0000000000\n\
FEDRAT / 250.000000,  MMPM\n\
MULTAX / ON\n\
GOTO / 0.0000000000, 0.0000000000, -1.0000000000,  $\n\
0.0000000000, 0.0000000000, 1.0000000000\n\
$$-> END / \n\
FINI \n";

const GPOST: &str = "\
REMARK          Pro/CLfile  Version 9.0 - 9.0.3.0\n\
REMARK -> MFGNO / MFG0001\n\
PARTNO / MFG0001\n\
REMARK -> FEATNO / 12\n\
PPWORD/COOLNT,1030\n\
UNITS / MM\n\
LOADTL / 1\n\
SPINDL / RPM, 1000.000000,  CLW\n\
RAPID\n\
GOTO / 0.0000000000, 0.0000000000, 5.0000000000\n\
FEDRAT / 250.000000,  MMPM\n\
GOTO / 0.0000000000, 0.0000000000, -1.0000000000\n\
FINI\n";

const SOLIDWORKS: &str = "\
PARTNO/1\n\
UNIT/MM\n\
INSERT/12MM END MILL\n\
CUTTER/12.,0,6.,0,0,0,63.\n\
LOAD/TOOL,12\n\
CSI_SET_FLUTE_LENGTH/40.\n\
SPINDL/3500,RPM,CLW\n\
TRNTYP/WORLD,0,0,0\n\
RAPID/\n\
GOTO/0,0,5.\n\
FEDRAT/125.,MMPM\n\
GOTO/0,0,-2.\n\
CIRCLE/0,5.,-2.,0,0,1.\n\
GOTO/5.,5.,-2.\n\
FINI\n";

const CAMWORKS: &str = "\
UNITS/ MM \n\
CUTTER/ 6.000000,0.000000,3.000000,0.000000,31.000000,0.000000,118.000000,\n\
TLAXIS/ 0.000000,0.000000,1.000000 \n\
OPFEATSTART/Contour1\n\
RAPID/ \n\
GOTO/ 0.000000,0.000000,5.000000 \n\
MOVE_ATTRIB/ LEADIN,END_ATTRIB \n\
FEDRAT/ MMPM,185.687240\n\
GOTO/ 0.000000,0.000000,-2.000000 \n\
CYCLE/ ON \n\
CYCLE/ DRILL,G98,12.000000,MMPM,187.165839,3.000000,40.000000 \n\
GOTO/ 20.000000,20.000000,-10.000000 \n\
CYCLE/ OFF \n\
OPFEATEND/Contour1\n\
FINI \n";

const MAKINO: &str = "\
PPRINT/APTCL-SPEC,MAKINO-FF,1\n\
PPRINT/BEGIN-SECTION,DEFINE\n\
UNITS/MM\n\
PPRINT/END-SECTION,DEFINE\n\
LOAD/TOOL,45\n\
SPINDL/RPM,1310,CLW\n\
PPRINT/MOTION,RAPID,TYPE,RETRACT\n\
RAPID\n\
GOTO/0.0000000,0.0000000,50.0000000\n\
PPRINT/MOTION,CUTIN,TYPE,VERTICAL-INFEED\n\
PPRINT/MOTION,CUTIN,FEDRAT,VERTICAL-INFEED\n\
FEDRAT/PERMIN,141\n\
GOTO/0.0000000,0.0000000,28.0000000\n";

const ISO: &str = "\
PARTNO BRACKET\n\
UNITS/MM\n\
$$ points on lines of their own\n\
SPINDL/1200,RPM,CLW\n\
FROM/0,0,20\n\
FEDRAT/250,MMPM $$ as ordered\n\
GOTO/0,0,1\n\
\x20    5,0,1\n\
\x20    10,0,1, 15,0,1\n\
FINI\n";

/// Feeds are halved, points lifted, a record is changed by a rule, one is put in and one goes.
const ALL: &str = "\
\x20 - scale_feed: { factor: 0.5 }
  - rewrite:
      rules:
        - { match: 'SPINDL/$...A', insert_before: 'COOLNT/ON' }
        - { match: 'LOADTL/1', replace: 'LOADTL/1,1' }
        - { match: 'END-OF-PATH', delete: true }
";

const MOVE: &str = "  - move_origin: { translate: [0, 0, 10] }\n";

fn shown(name: &str, part: &str, moves: bool) {
    let steps = if moves { format!("{MOVE}{ALL}") } else { ALL.to_owned() };
    let text = text(&with_comments(&steps), part);
    let ends = part.contains("\r\n");
    assert!(text.split_inclusive('\n').all(|line| line.ends_with("\r\n") == ends), "{name}");
    // Both digests stand there in full.
    let halves = text
        .lines()
        .filter_map(|line| line.split_once("clsmith ")?.1.split_once("sha256 "))
        .map(|(_, half)| half);
    assert_eq!(halves.filter(|half| half.trim_end().len() == 32).count(), 4, "{text}");
    snapshots("provenance").bind(|| insta::assert_snapshot!(name, text));
}

#[test]
fn nx_has_its_header_beside_its_own_comment_and_groups_in_one_piece() {
    shown("nx", NX, true);
}

#[test]
fn catia_keeps_its_matrix_and_its_arcs_together() {
    shown("catia", CATIA, true);
}

#[test]
fn creo_keeps_records_in_comments_apart_from_comments() {
    shown("creo", CREO, true);
}

#[test]
fn gpost_has_remarks() {
    shown("creo-gpost", GPOST, true);
}

#[test]
fn solidworks_has_the_standards_comment_and_no_insert() {
    shown("solidworks", SOLIDWORKS, true);
}

#[test]
fn camworks_begins_with_its_units() {
    shown("camworks", CAMWORKS, false);
}

#[test]
fn makino_begins_with_its_specification_and_labels_stay_with_their_records() {
    shown("makino-ff", MAKINO, true);
}

#[test]
fn iso_points_go_on_with_their_goto() {
    shown("iso", ISO, true);
}
