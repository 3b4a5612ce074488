//! `grammar/RECORDS.md`: what becomes of each record that the dialects have. It is made of the reader's own answers, and
//! `INSTA_UPDATE=always` writes it anew.

use crate::support::text;
use clsmith::parse::{parse, syntax};
use clsmith::program::record::known_words;
use clsmith::program::{Dialect, NumberRole, Record, RecordKind};
use std::fmt::Write;
use std::path::Path;

/// One statement of each kind that a dialect has, as its files write it.
pub const RECORDS: &[(Dialect, &[&str])] = &[
    (
        Dialect::Nx,
        &[
            "TOOL PATH/POCKET 3,5 DEEP,TOOL,EM 12",
            "TLDATA/MILL,12.0000,0.0000,75.0000,0.0000,0.0000",
            "TLDATA/MILL,12.0000,1.0000,75.0000,0.0000,0.0000,5.0000,1.0000",
            "TLDATA/MILL,20.0000,1.0000,60.0000,0.0000,0.0000,9.0000,1.0000,1.0000,9.0000,5.0000",
            "TLDATA/DRILL,MILL,8.5000,0.0000,120.0000,118.0000,60.0000",
            "TLDATA/TURN,1,0,0,0.8000,20.0000,5.0000,5.0000,20.0000,0.0000",
            "TLDATA/GROOVE,1,0,0,0,3.0000,0.2000,0.2000,12.0000,0.0000,0.0000,20.0000,20.0000",
            "TLDATA/THREAD,1,0,1,4.0000,20.0000,60.0000,15.0000,25.0000",
            "TLDATA/TCUTTER,50.0000,10.0000,1.0000,1.0000,8.0000",
            "MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000",
            "PAINT/COLOR,31",
            "PAINT/PATH",
            "LOAD/TOOL,3,ADJUST,3",
            "SPINDL/RPM,2600,CLW",
            "SPINDL/SMM,150.0000,CLW,MAXRPM,3000",
            "SPINDL/MAXRPM,3000",
            "SPINDL/SMM,150.0000,CLW,RADIUS,40.0000",
            "FEDRAT/MMPM,800.0000",
            "RAPID",
            "FROM/0.0000,0.0000,100.0000",
            "GOTO/1.0000,2.0000,3.0000",
            "GOTO/1.0000,2.0000,3.0000,0.0000000,0.6000000,0.8000000",
            "N0010 GOTO/1.0000,2.0000,3.0000",
            "CIRCLE/5.0000,0.0000,0.0000,0.0000000,0.0000000,-1.0000000,5.0000,0.0600,0.5000,12.0000,0.0000",
            "CIRCLE/5.0000,0.0000,0.0000,0.0000000,0.0000000,-1.0000000,5.0000,0.0600,0.5000,12.0000,0.0000,TIMES,2",
            "NURBS/",
            "KNOT/0.5000000,1.0000000",
            "CNTRL/1.0000,2.0000,3.0000",
            "CUTCOM/LEFT,XYPLAN",
            "CYCLE/DRILL,RAPTO,3.0000,FEDTO,-24.0000,MMPM,310.0000",
            "CYCLE/TAP,RAPTO,5.0000,FEDTO,-17.0000,MMPR,1.5000",
            "CYCLE/OFF",
            "CYCLE/TAP,RAPTO,5.0000,FEDTO,-17.0000,PITCH,1.5000",
            "CYCLE/DEEP,TAP,RAPTO,5.0000,FEDTO,-17.0000,MMPM,560.0000",
            "PITCH/2.0000",
            "PITCH/LEAD,2.0000",
            "PITCH/TPI,16",
            "PITCH/0.5000,INCR,0.1000",
            "THREAD/TURN",
            "THREAD/TURN,LEAD,2.0000",
            "THREAD/TURN,2.0000",
            "THREAD/OFF",
            "GOHOME/0.0000,0.0000,100.0000",
            "DELAY/2.0000",
            "END-OF-PATH",
            "$$ centerline data",
        ],
    ),
    (
        Dialect::Catia,
        &[
            "$$*CATIA0",
            "$$     1.00000     0.00000     0.00000     0.00000",
            "$$ OPERATION NAME : Pocketing.1",
            "PARTNO PART TO BE MACHINED",
            "PPRINT CLAMP THE PART",
            "CUTTER/ 10.000000,  0.000000,  5.000000,  0.000000,  0.000000,  0.000000, 60.000000",
            "TOOLNO/2,   10.000000",
            "TOOLNO/1,MILL,1,0,   10.000000,  100.000000,   80.000000,,  118.750000,,   90.000000",
            "TPRINT/T2 End Mill D 10",
            "LOADTL/2",
            "LOADTL/2,1,1",
            "TURRET/1,OSETNO,1,SETOOL,   10.00000,   20.00000,    0.00000",
            "SWITCH/3",
            "TLAXIS/ 0.000000, 0.000000, 1.000000",
            "MULTAX",
            "SPINDL/ 2000.0000,RPM,CLW",
            "SPINDL/  150.0000,SMM,CLW",
            "FEDRAT/  700.0000,MMPM",
            "FEDRAT/    0.2000,MMPR",
            "FROM  /    0.00000,    0.00000,  100.00000",
            "GOTO  /    5.00000,    5.00000,   30.00000",
            "GOTO  / 1.00000, 2.00000, 3.00000, 0.000000, 0.600000, 0.800000",
            "INTOL /    0.00500",
            "AUTOPS",
            "INDIRV/    1.00000,    0.00000,    0.00000",
            "TLON,GOFWD/ (CIRCLE/ 0.00000, 5.00000, 0.00000, 5.00000),ON,(LINE/ 0.00000, 5.00000, 0.00000, 5.00000, 5.00000, 0.00000)",
            "TLON,GOFWD/ (CIRCLE/ 0.0, 5.0, 0.0, 0.0, 0.0, 1.0, 5.0),ON,(LINE/ 0.0, 5.0, 0.0, 5.0, 5.0, 0.0)",
            "PSIS/(PLANE/(POINT/ 0.00000, 0.00000, 0.00000),PERPTO,(VECTOR/ 1.000000, 0.000000, 0.000000))",
            "TLON,GOFWD/ (CYLNDR/ 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 12.0),ON,(PLANE/PERPTO,(PLANE/(POINT/ 0.0, 0.0, 0.0),PERPTO,(VECTOR/ 1.0, 0.0, 0.0)),(POINT/ 0.0, 0.0, 0.0),(POINT/ 0.0, -6.0, -10.3923))",
            "TLON,GOFWD/ (CONE/ 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5),PAST,(PLANE/ 0.0, 1.0, 0.0, 5.0)",
            "HELICAL/CENTER, 25.0, 10.0, -12.0,INDIRV, 0.0, 1.0, 0.0,AXIS, 0.0, 0.0, 1.0,PITCH, 2.4,RADIUS, 8.0,ANGLE, 900.0,HEIGHT, 6.0,ROUND, 2.5,END, 17.0, 10.0, -6.0",
            "CYCLE/DRILL,    3.000000,    5.000000",
            "CYCLE/TAP,   50.786017,    1.000000",
            "CYCLE/OFF",
            "COOLNT/ON",
            "DELAY/   50.000000",
            "STOP/(TURN PART OVER, SEE SHEET 4)",
            "STOP (TURN)",
            "STOP/'IT''S DONE'",
            "OPSTOP/(TURN",
            "CHANNEL,2",
            "HEAD/2",
            "TURRET/FRONT",
            "TURRET/3,REAR",
            "LOCAL_ORIGIN,   40.00000,    85.50000,   0.000000",
            "REWIND/0",
            "END",
            "FINI",
        ],
    ),
    (
        Dialect::CatiaIcam,
        &[
            "SYN/'TLAXIS','$$*TLAXIS'",
            "ROTABL/    0.000000,,TABLE,CLW",
            "COOLNT/",
            "CYCLE/DRILL,DEPTH, 4.600000,MMPR, 0.080000,CLEAR, 2.000000,RETURN, 0.000000",
        ],
    ),
    (
        Dialect::Creo,
        &[
            "$$-> MFGNO / SLOT",
            "$$-> FEATNO / 61",
            "$$-> CUTTER / 12.000000",
            "$$-> CSYS / 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0",
            "$$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_CENTER",
            "$$-> END / ",
            "PARTNO / SLOT",
            "MACHIN / UNCX01, 1",
            "UNITS / MM",
            "LOADTL / 1",
            "SPINDL / RPM, 1400.000000,  CLW",
            "FEDRAT / 360.000000,  MMPM",
            "COOLNT / ON",
            "MULTAX / ON",
            "RAPID ",
            "GOTO / -20.0000000000, 8.0000000000, 25.0000000000",
            "CIRCLE / 40.0000000000, 20.0000000000, -3.0000000000, 0.0, 0.0, 1.0, 15.0000000000",
            "FINI ",
        ],
    ),
    (
        Dialect::CreoGpost,
        &[
            "REMARK -> FEATNO / 1014",
            "REMARK MACHID=MACHIN / UNCX01, 1",
            "PPWORD/COOLNT,1",
            "CAMERA/ 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0",
        ],
    ),
    (
        Dialect::SolidWorks,
        &[
            "PARTNO/1",
            "UNIT/MM",
            "INSERT/[HOLDER=C40-ER16] 5MM X 118DEG HSS DRILL",
            "CUTTER/5.,0,2.5,1.5,31.,0,86.",
            "LOAD/TOOL,11",
            "LOAD/TOOL,11,LENGTH,120.",
            "CSI_SET_FLUTE_LENGTH/22.",
            "CSI_SET_EXTENSION_LENGTH/45.",
            "SELECT/TOOL,7",
            "COOLNT/FLOOD",
            "SPINDL/2550,RPM,CLW",
            "TRNTYP/WORLD,0,0,0",
            "CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0",
            "RAPID/",
            "GOTO/8.,8.,20.",
            "CIRCLE/5.,0,0,0,0,1.",
            "CYCLE/INIT",
            "CYCLE/CLEAR",
            "CYCLE/DRILL,FEDTO,9.5,MMPM,240.,RAPTO,2.5,RTRCTO,20.,DWELL,0",
            "CYCLE/DEEP2,FEDTO,28.6,1STPECK,5.,SUBPECK,2.,MMPM,200.,RAPTO,2.5,RTRCTO,20.",
            "SETUP/START,1",
        ],
    ),
    (
        Dialect::CamWorks,
        &[
            "UNITS/ MM ",
            "BOX/ 0.000000,80.000000,0.000000,50.000000,-15.000000,0.000000 ",
            "CUTTER/ 5.000000,0.000000,2.500000,1.502152,31.000000,0.000000,86.000000,",
            "TLAXIS/ 0.000000,0.000000,1.000000 ",
            "ROTABL/ 1.570796,AAXIS,TABLE,CCLW ",
            "OPFEATSTART/Drill3-Hole Group2 [Drill]",
            "MOVE_ATTRIB/ LEADIN,END_ATTRIB ",
            "CIRCLE/ 5.0,0.0,0.0,0.0,0.0,1.0,5.0,CLOCKWISE ",
            "CYCLE/ ON ",
            "CYCLE/ DRILL,G99,12.0,MMPM,150.0,2.0,40.0 40.0 DWELL,0.0 ",
            "OPFEATEND/Drill3-Hole Group2 [Drill]",
        ],
    ),
    (
        Dialect::MakinoFf,
        &[
            "PPRINT/APTCL-SPEC,MAKINO-FF,1",
            "PPRINT/MOTION,CUTIN,TYPE,VERTICAL-INFEED",
            "PPRINT/ESCAPE-HEIGHT,50.0000000",
            "SET/MODE,ABSOL",
            "FEDRAT/PERMIN,141",
            "SELECT/TOOL,45",
        ],
    ),
    (
        Dialect::Iso,
        &[
            "MODE/MILL",
            "PARTNO/'PLATE'",
            "GODLTA/0,0,5",
            "GODLTA/0,0,5,0,0,1",
            "GOHOME/",
            "GOHOME/'TOOL CHANGE'",
            "GOHOME/2",
            "MOVARC/0,0,0,0,0,1,5,ANGLE,90",
            "MOVARC/0,0,0,0,0,1,5,ANGLE,-90",
            "MOVARC/ CENTER, 0, 0, 0, AXIS, 0, 0, 1, RADIUS, 8, TOLER, 0.01",
            "ARCSLP/ 3",
            "TRANS/0,0,5",
            "ORIGIN/0,0,0",
            "ORIGIN/0,0,0,1,0,0,0,1,0",
            "CLRSRF/0,0,1,40",
            "CLEARP/XYPLAN,60",
            "RETRCT/30",
            "SAFETY/15",
            "CUTCOM/LEFT,OFFSET,8",
            "CUTCOM/ADJUST,3",
            "CHECK/5,XAXIS,10",
            "SET/HOLDER,50",
            "LOADTL/2, 2, 60.0, 2",
            "COUPLE/25",
            "OPSTOP/'MEASURE THE STEP'",
            "SPLPNT/15,4,-2",
            "HELIX/CENTER,0,10,0,RADIUS,10",
            "GOTO/1,2",
            "R1=5",
        ],
    ),
];

/// What becomes of a record.
fn outcome(dialect: Dialect, sample: &str) -> String {
    let parsed = parse(&text(format!("{sample}\n")), Some(dialect));
    if let Some(found) = parsed.diagnostics.first() {
        return format!("refused ({})", found.code);
    }
    let record = parsed.program.statements()[0].record().clone();
    match record {
        Record::Known => "passed on: known, without effect on the path".to_owned(),
        Record::Other => "passed on: not known (CL0150)".to_owned(),
        Record::Text => "passed on: text for people".to_owned(),
        Record::Comment => "passed on: comment".to_owned(),
        _ => format!("understood: {}", RecordKind::from_record(&record).display_name(1)),
    }
}

/// Which of its numbers move with the path, and which are converted to another unit.
fn changes(sample: &str) -> (&'static str, &'static str) {
    let line = format!("{sample}\n");
    let Ok((record, syntax)) = clsmith::parse::read_record(line.as_bytes()) else { return ("", "") };
    debug_assert_eq!(syntax.text.len(), line.len());
    let roles = record.number_roles(&syntax);
    let any = |fits: fn(&NumberRole) -> bool| if roles.iter().any(fits) { "yes" } else { "" };
    let moved = any(|role| {
        matches!(
            role,
            NumberRole::Point(_) | NumberRole::Step(_) | NumberRole::Direction(_) | NumberRole::ArcAxis(_)
        )
    });
    let converted = any(|role| {
        !matches!(
            role,
            NumberRole::Plain | NumberRole::Direction(_) | NumberRole::ArcAxis(_) | NumberRole::FrameAxis(..)
        )
    });
    (moved, converted)
}

fn table() -> String {
    let mut out = String::from(
        "# What becomes of each record\n\nMade by a test from the reader's own answers; do not edit (`INSTA_UPDATE=always cargo test \
         record_table`).\n\nEvery record is written back byte for byte unless a step changes it. *Moved* are the points, steps and \
         directions of `move_origin`, *converted* the lengths, feeds and surface speeds of `convert_units`; what a step ought to \
         change and does not know is named by CL0305.\n",
    );
    for (dialect, samples) in RECORDS {
        write!(out, "\n## {dialect}\n\n| record | | moved | converted |\n|---|---|---|---|\n").unwrap();
        for sample in *samples {
            let (moved, converted) = changes(sample);
            let shown = sample.trim_end().replace('|', "\\|");
            let shown: String = match shown.char_indices().nth(90) {
                Some((end, _)) => format!("{}...", &shown[..end]),
                None => shown,
            };
            writeln!(out, "| `{shown}` | {} | {moved} | {converted} |", outcome(*dialect, sample)).unwrap();
        }
    }
    out += "\n## Words without effect on the path, in every dialect\n\n";
    let words: Vec<String> = known_words().iter().map(|word| format!("`{word}`")).collect();
    out += &words.join(", ");
    out + "\n"
}

#[test]
fn the_table_of_records_says_what_the_reader_does() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar/RECORDS.md");
    let table = table();
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(&path, &table).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == table,
        "grammar/RECORDS.md is not what the reader does; INSTA_UPDATE=always writes it anew"
    );
}

#[test]
fn every_sample_is_one_statement() {
    for (_, samples) in RECORDS {
        for sample in *samples {
            let line = format!("{sample}\n");
            assert_eq!(syntax(line.as_bytes()).text.len(), line.len(), "{sample}");
        }
    }
}
