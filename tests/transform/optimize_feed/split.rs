//! Motions split in the text: what exactly is written, form by form.

use crate::support;
use clsmith::internals::transform::optimize_feed::{SplitProgram, UnsplitReason, split_motions};
use clsmith::program::{Dialect, StepId};

/// Splits one motion and gives the text and the result.
fn split_one(dialect: Dialect, text: &str, motion: usize, shares: &[f64]) -> (String, SplitProgram) {
    let program = support::program_of(dialect, text);
    let mut findings = Vec::new();
    let result = split_motions(program, StepId(0), &[(motion, shares.to_vec())], &mut findings).unwrap();
    let surprises = result.kept.iter().filter(|(_, why)| {
        use UnsplitReason::{GoBack, Helix, NotReadBack, OppositeAxis, UnsaidAxis};
        matches!(why, UnsaidAxis | OppositeAxis | Helix | GoBack | NotReadBack)
    });
    assert_eq!(findings.len(), surprises.count());
    (String::from_utf8_lossy(&result.program.to_bytes()).into_owned(), result)
}

fn text_of(dialect: Dialect, text: &str, motion: usize, shares: &[f64]) -> String {
    let (text, result) = split_one(dialect, text, motion, shares);
    assert!(result.kept.is_empty(), "{:?}", result.kept);
    text
}

fn kept(dialect: Dialect, text: &str, motion: usize) -> UnsplitReason {
    let (after, result) = split_one(dialect, text, motion, &[0.5]);
    assert_eq!(after, text);
    result.kept[0].1
}

#[test]
fn a_line_gets_points_in_its_own_form() {
    let start = "GOTO/0.0000,0.0000,-1.0000\nFEDRAT/MMPM,100.0000\n";
    let (text, result) =
        split_one(Dialect::Nx, &format!("{start}GOTO/10.0000,1.0000,-1.0000 $$ end"), 1, &[0.25, 0.6666666]);
    let expected =
        "GOTO/2.5000,0.2500,-1.0000\nGOTO/6.6667,0.6667,-1.0000\nGOTO/10.0000,1.0000,-1.0000 $$ end";
    assert_eq!(text, format!("{start}{expected}"));
    assert_eq!(result.parts, [0..1, 1..4]);
    let crlf = "GOTO / 0.0000000000, 0.0000000000, 0.0000000000,  $\r\n0.0000000000, 0.0000000000, 1.0000000000\r\n\
                GOTO / 1.0000000000, 0.0000000000, 0.0000000000,  $\r\n0.0000000000, 0.6000000000, 0.8000000000\r\n";
    let text = text_of(Dialect::Creo, crlf, 1, &[0.5]);
    let half =
        "GOTO / 0.5000000000, 0.0000000000, 0.0000000000,  $\r\n0.0000000000, 0.3162277660, 0.9486832981\r\n";
    let at = crlf.find("GOTO / 1.0").unwrap();
    assert_eq!(text, format!("{}{half}{}", &crlf[..at], &crlf[at..]));
    let columns = "GOTO  /   20.00000,  -10.00000,   -5.00000\nGOTO  /   20.00000,    0.50000,   -5.00000\n";
    let text = text_of(Dialect::Catia, columns, 1, &[0.5]);
    assert_eq!(text.lines().nth(1), Some("GOTO  /   20.00000,   -4.75000,   -5.00000"));
    let cut = "GOTO/0,0,5.\nGOTO/1.,0,5.\n";
    assert_eq!(text_of(Dialect::SolidWorks, cut, 1, &[0.25]), "GOTO/0,0,5.\nGOTO/.25,0,5.\nGOTO/1.,0,5.\n");
}

#[test]
fn an_arc_announces_each_of_its_parts() {
    let start = "GOTO/6.0000,0.0000,-1.0000\n";
    let circle =
        "CIRCLE/0.0000,0.0000,-1.0000,0.0000000,0.0000000,-1.0000000,6.0000,0.0600,0.5000,12.0000,2.0000\n";
    let end = "GOTO/0.0000,6.0000,-1.0000\n";
    let text = text_of(Dialect::Nx, &format!("{start}{circle}{end}"), 1, &[0.5]);
    assert_eq!(text, format!("{start}{circle}GOTO/4.2426,4.2426,-1.0000\n{circle}{end}"));
}

#[test]
fn a_full_circle_is_split_in_its_sense() {
    for (axis, y) in [("1.", "4."), ("-1.", "-4.")] {
        let text = format!("GOTO/4.,0,0\nCIRCLE/0,0,0,0,0,{axis}\nGOTO/4.,0,0\n");
        let after = text_of(Dialect::SolidWorks, &text, 1, &[0.25]);
        let circle = format!("CIRCLE/0,0,0,0,0,{axis}\n");
        assert_eq!(after, format!("GOTO/4.,0,0\n{circle}GOTO/0,{y},0\n{circle}GOTO/4.,0,0\n"));
    }
}

const CATIA: &str = "GOTO  /   20.00000,    0.00000,   -5.00000
AUTOPS
INDIRV/    0.00000,    1.00000,    0.00000
TLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -5.00000,$
      20.00000),ON,2,INTOF,$
                   (LINE/      0.00000,      0.00000,     -5.00000,$
                             0.00000,    -20.00000,     -5.00000)
";

#[test]
fn a_catia_arc_counts_its_intersections_anew() {
    let text = text_of(Dialect::Catia, CATIA, 1, &[1.0 / 3.0]);
    let expected = "GOTO  /   20.00000,    0.00000,   -5.00000
AUTOPS
INDIRV/    0.00000,    1.00000,    0.00000
TLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -5.00000,$
      20.00000),ON,(LINE/      0.00000,      0.00000,     -5.00000,$
                             0.00000,     20.00000,     -5.00000)
INDIRV/   -1.00000,    0.00000,    0.00000
TLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -5.00000,$
      20.00000),ON,(LINE/      0.00000,      0.00000,     -5.00000,$
                             0.00000,    -20.00000,     -5.00000)
";
    assert_eq!(text, expected);
    // The last part has more than half a turn still, and its statement stays as it is.
    let text = text_of(Dialect::Catia, CATIA, 1, &[1.0 / 9.0]);
    assert_eq!(text.matches("INTOF").count(), 1);
    assert!(text.ends_with(&CATIA[CATIA.find("TLON").unwrap()..]));
}

#[test]
fn the_angle_of_movarc_is_shared_out() {
    let text = "GOTO/10.000000, 0.000000, 0.000000
MOVARC/0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 1.000000, 10.000000, ANGLE, 270.000
GOTO/0.000000, -10.000000, 0.000000
";
    let after = text_of(Dialect::Iso, text, 1, &[1.0 / 3.0]);
    let first = text.replace("270.000\nGOTO/0.000000, -10", "90.000\nGOTO/0.000000, 10");
    let rest = &text[text.find("MOVARC").unwrap()..];
    assert_eq!(after, format!("{first}{}", rest.replace("270.000", "180.0000")));
}

#[test]
fn what_has_no_form_for_its_parts_stays_whole() {
    let goto = "GOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000\n";
    let with = |rest: &str| format!("{goto}{rest}");
    assert_eq!(kept(Dialect::Nx, &with("RAPID\nGOTO/1.0000,0.0000,0.0000\n"), 1), UnsplitReason::Rapid);
    assert_eq!(kept(Dialect::Nx, goto, 0), UnsplitReason::OtherStatement);
    assert_eq!(kept(Dialect::Nx, &with("GODLTA/1.0000,0.0000,0.0000\n"), 1), UnsplitReason::OtherStatement);
    assert_eq!(kept(Dialect::Nx, &with("GOTO/1,0,0,2,0,0,3,0,0\n"), 1), UnsplitReason::SharedStatement);
    assert_eq!(kept(Dialect::Nx, &with("GOTO/1,0,0,0,0,1,0,1,0\n"), 1), UnsplitReason::ContactNormal);
    assert_eq!(
        kept(Dialect::Nx, &with("TLAXIS/1,0,0\nGOTO/1.0000,0.0000,0.0000\n"), 1),
        UnsplitReason::UnsaidAxis
    );
    assert_eq!(
        kept(Dialect::Nx, &with("GOTO/1.0000,0.0000,0.0000,0,0,-1\n"), 1),
        UnsplitReason::OppositeAxis
    );
    let helix = "CIRCLE/4.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000,4.0000,0.06,0.5,1.0,0.0,TIMES,2\nGOTO/8.0000,0.0000,-1.0000\n";
    assert_eq!(kept(Dialect::Nx, &with(helix), 1), UnsplitReason::Helix);
    let hole = "CYCLE/DRILL,RAPTO,3.0000,FEDTO,-5.0000,MMPM,250.0000\nGOTO/1.0000,0.0000,0.0000\n";
    assert_eq!(kept(Dialect::Nx, &with(hole), 1), UnsplitReason::Hole);
    assert_eq!(kept(Dialect::Catia, &CATIA.replace("GOFWD", "GOBACK"), 1), UnsplitReason::GoBack);
}

#[test]
fn parts_too_short_for_their_decimals_are_not_written() {
    let text = "GOTO/0.0000,0.0000,0.0000\nGOTO/0.0001,0.0000,0.0000\nGOTO/9.0000,0.0000,0.0000\n";
    assert_eq!(kept(Dialect::Nx, text, 1), UnsplitReason::NotReadBack);
    // The other motion is split all the same.
    let program = support::program_of(Dialect::Nx, text);
    let mut findings = Vec::new();
    let wanted = [(2, vec![0.5]), (1, vec![0.5])];
    let result = split_motions(program, StepId(0), &wanted, &mut findings).unwrap();
    assert_eq!((result.kept, findings.len()), (vec![(1, UnsplitReason::NotReadBack)], 1));
    assert_eq!(result.parts, [0..1, 1..2, 2..4]);
}
