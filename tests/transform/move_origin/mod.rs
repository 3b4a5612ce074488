//! move_origin.

mod corpus;
mod dialects;
mod frame;
mod refusals;
mod scope;
mod stale;

use super::moved::{Place, assert_moved};
use super::{apply, try_apply};
use crate::support;
use clsmith::diagnostic::Diagnostic;

/// Moves a text, checks that every motion moved, and gives the new text with the findings.
pub fn moved(settings: &str, text: &str, place: &Place) -> (String, Vec<Diagnostic>) {
    let (after, findings) = apply(&format!("  - move_origin: {settings}"), text);
    assert_moved("text", &support::program(text), &support::program(&after), place, 2e-4);
    (after, findings)
}

/// Why a text cannot be moved.
pub fn refused(settings: &str, text: &str) -> String {
    let recipe = format!("version: 1\nsteps:\n  - move_origin: {settings}");
    let found = try_apply(&recipe, text).unwrap_err();
    let last = found.last().unwrap();
    assert_eq!(last.code.id(), "CL0302", "{last:?}");
    last.message.clone()
}

/// Messages of findings with their codes.
pub fn shown(findings: &[Diagnostic]) -> Vec<String> {
    findings.iter().map(|finding| format!("{} {}", finding.code.id(), finding.message)).collect()
}

/// The lines that differ, as a diff for people.
pub fn diff(before: &str, after: &str) -> String {
    similar::TextDiff::from_lines(before, after)
        .iter_all_changes()
        .filter(|change| change.tag() != similar::ChangeTag::Equal)
        .map(|change| format!("{}{}", change.tag(), change.value()))
        .collect()
}

pub const NX: &str = "TOOL PATH/POCKET,TOOL,D10
TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000
MSYS/10.0000,20.0000,30.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000
PAINT/COLOR,186
RAPID
GOTO/0.0000,0.0000,20.0000
FEDRAT/MMPM,250.0000
GOTO/0.0000,0.0000,-2.0000
CUTCOM/LEFT
GOTO/30.0000,0.0000,-2.0000
CIRCLE/30.0000,10.0000,-2.0000,0.0000000,0.0000000,-1.0000000,10.0000,0.0600,0.5000,10.0000,0.0000
GOTO/40.0000,10.0000,-2.0000
CUTCOM/OFF
NURBS/
KNOT/1.0000000
CNTRL/40.0000,15.0000,-2.0000
CNTRL/35.0000,20.0000,-2.0000
CNTRL/30.0000,20.0000,-2.0000
CYCLE/DRILL,RAPTO,3.0000,FEDTO,-12.0000,MMPM,100.0000
GOTO/10.0000,10.0000,-2.0000
CYCLE/OFF
GOTO/10.0000,10.0000,20.0000,0.6000000,0.0000000,0.8000000
GOTO/12.0000,10.0000,20.0000
END-OF-PATH
TOOL PATH/FACE,TOOL,D10
MSYS/0.0000,0.0000,0.0000,0,1,0,1,0,0
GOTO/0.0000,0.0000,0.0000
GOTO/5.0000,0.0000,0.0000
END-OF-PATH
";

pub const CATIA: &str = "$$     CATIA APT VERSION 1.0
$$*CATIA0
$$ Part
$$     1.00000     0.00000     0.00000  -220.00000
$$     0.00000     1.00000     0.00000  -170.00000
$$     0.00000     0.00000     1.00000    20.00000
PARTNO PART
$$ OPERATION NAME : Contour.1
SPINDL/ 2387.3240,RPM,CLW
RAPID
GOTO  /   98.00000,  100.00000,  120.00000
FEDRAT/  300.0000,MMPM
GOTO  /   10.00000,    0.00000,    0.00000
AUTOPS
INDIRV/ 0.000000, 1.000000, 0.000000
TLON,GOFWD/      (CIRCLE/    0.00000,    0.00000,    0.00000,$
   10.00000),ON,(LINE/    0.00000,    0.00000,    0.00000,$
    0.00000,   10.00000,    0.00000)
INDIRV/-1.000000, 0.000000, 0.000000
TLON,GOFWD/      (CIRCLE/    0.00000,    0.00000,    0.00000,$
   10.00000),ON,2,INTOF,$
                 (LINE/    0.00000,    0.00000,    0.00000,$
   10.00000,    0.00000,    0.00000)
GOTO  /   98.00000,  170.00000,   40.00000
TLAXIS/ 0.000000, 1.000000, 0.000000
GOTO  /   98.00000,  180.00000,   40.00000
FINI
";

pub const CREO: &str = "$$*          Pro/CLfile  Version 11.0 - 11.0.0.0
$$-> FEATNO / 512
UNITS / INCHES
LOADTL / 1
$$-> CSYS / 1.0000000000, 0.0000000000, 0.0000000000, 0.0000000000,  $
            0.0000000000, 1.0000000000, 0.0000000000, 0.0000000000,  $
            0.0000000000, 0.0000000000, 1.0000000000, 0.0000000000
SPINDL / RPM, 1000.000000,  CLW
RAPID 
GOTO / -0.3500000000, 4.2871428571, 1.2250000000
FEDRAT / 10.000000,  IPM
GOTO / -0.3500000000, 4.2871428571, 1.1000000000
GOTO / 3.3500000000, 4.2871428571, 1.1000000000
$$-> END / 
FINI 
";

pub const SOLIDWORKS: &str = "PARTNO/1
UNIT/MM
TRNTYP/WORLD,0,0,0
CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0
SPINDL/3500,RPM,CLW
RAPID/
GOTO/0,0,25.
FEDRAT/125.,MMPM
GOTO/10.,0,0
CIRCLE/0,0,0,0,0,1.
GOTO/0,10.,0
CIRCLE/0,0,0,0,0,1.
GOTO/0,10.,0
FINI
";

pub const CAMWORKS: &str = "UNITS/ MM 
CUTTER/ 6.000000,0.000000,3.000000,1.802582,31.000000,0.000000,118.000000,
TLAXIS/ 0.000000,-1.000000,0.000000 
OPFEATSTART/Contour
ROTABL/ 1.570796,AAXIS,TABLE,CCLW 
RAPID/ 
GOTO/ 67.500000,67.500000,25.000000 
CUTCOM/ ON 
CUTCOM/ LEFT 
GOTO/ 10.000000,0.000000,-19.500000 
CIRCLE/ 0.000000,0.000000,-19.500000,0.000000,0.000000,1.000000,10.000000,COUNTERCLOCKWISE 
GOTO/ 0.000000,10.000000,-19.500000 
CUTCOM/ OFF 
OPFEATEND/Contour
FINI 
";

pub const MAKINO: &str = "PPRINT/APTCL-SPEC,MAKINO-FF,1
UNITS/MM
FROM/0.0000000,0.0000000,50.0000000,0.0000000,0.0000000,1.0000000
PPRINT/ESCAPE-HEIGHT,50.0000000
RAPID
GOTO/5.0000000,-2.0000000,28.0000000
CIRCLE/5.0000000,3.0000000,28.0000000,-0.0000000,-0.0000000,-1.0000000,5.0000000,0.0020000,0.5000000,10.0000000,0.0000000
GOTO/10.0000000,3.0000000,28.0000000
";

pub const ISO: &str = "PARTNO/'P'
UNITS/MM
MULTAX/ON
FROM/0.0, 0.0, 50.0
GOTO/0.000000, 0.000000, 10.000000, 0.000000000, 0.000000000, 1.000000000
GODLTA/0.0, 0.0, -10.0
GODLTA/2.0
MOVARC/0.000000, 5.000000, 2.000000, 0.000000000, 0.000000000, 1.000000000, 5.000000, ANGLE, 90.0
GOTO/5.000000, 5.000000, 2.000000
GOTO/6.0,5.0,2.0,0.0,0.6,0.8,0.0,0.8,-0.6
GOTO/1.0,1.0,1.0,0.0,0.0,1.0,2.0,1.0,1.0,0.0,0.0,1.0
GOHOME/0.0,0.0,90.0
FINI
";

pub const ALL: [(&str, &str); 7] = [
    ("nx", NX),
    ("catia", CATIA),
    ("creo", CREO),
    ("solidworks", SOLIDWORKS),
    ("camworks", CAMWORKS),
    ("makino", MAKINO),
    ("iso", ISO),
];
