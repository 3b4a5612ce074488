//! Which system wrote a file: told by marks that only one system writes.

use crate::support::{fixtures, require_corpus, source, text};
use clsmith::parse::parse;
use clsmith::program::Dialect;

#[test]
fn every_fixture_is_of_the_dialect_of_its_folder_and_free_of_diagnostics() {
    for (dialect, path) in fixtures() {
        let source = source(&path);
        let parsed = parse(&source, None);
        assert_eq!(parsed.program.dialect(), dialect, "{}", path.display());
        assert!(parsed.diagnostics.is_empty(), "{}: {:?}", path.display(), parsed.diagnostics);
        assert_eq!(parsed.program.to_bytes(), source.bytes(), "{}", path.display());
    }
}

#[test]
fn every_dialect_has_a_fixture() {
    let found: Vec<_> = fixtures().into_iter().map(|(dialect, _)| dialect).collect();
    assert!(Dialect::ALL.iter().all(|dialect| found.contains(dialect)));
}

#[test]
fn every_real_file_is_of_the_system_that_wrote_it() {
    let Some(corpus) = require_corpus() else { return };
    for path in corpus {
        let shown = path.to_string_lossy();
        let found = parse(&source(&path), None).program.dialect();
        let expected = match () {
            // Nothing but GOTO lines: no mark of any system.
            () if shown.ends_with("fragment-5axis.txt") => Dialect::Iso,
            () if shown.contains("/nx-clsf/") => Dialect::Nx,
            () if shown.ends_with("DEMO3.aptsource") => Dialect::CatiaIcam,
            () if shown.contains("/catia-apt/") => Dialect::Catia,
            () if shown.contains("/creo-ncl/") => Dialect::Creo,
            () if shown.contains("/solidworks-apt/") => Dialect::SolidWorks,
            () if shown.contains("/camworks-clt/") => Dialect::CamWorks,
            () => Dialect::MakinoFf,
        };
        assert_eq!(found, expected, "{shown}");
    }
}

#[test]
fn one_mark_is_enough() {
    for (mark, dialect) in [
        ("TOOL PATH/A,TOOL,B", Dialect::Nx),
        ("PAINT/PATH", Dialect::Nx),
        ("MSYS/0,0,0,1,0,0,0,1,0", Dialect::Nx),
        ("$$     CATIA APT VERSION 1.0", Dialect::Catia),
        ("$$*CATIA0", Dialect::Catia),
        ("$$     CATIA APT VERSION 1.0\n$$ ICAM - MM PPTABLE / ICAM_MM.pptable", Dialect::CatiaIcam),
        ("$$*          Pro/CLfile  Version 11.0", Dialect::Creo),
        ("$$-> MFGNO / X", Dialect::Creo),
        ("REMARK -> MFGNO / X", Dialect::CreoGpost),
        ("PPWORD/3DCOMP,1101", Dialect::CreoGpost),
        ("TRNTYP/WORLD,0,0,0", Dialect::SolidWorks),
        ("CSI_SET_FLUTE_LENGTH/4.", Dialect::SolidWorks),
        ("OPFEATSTART/A", Dialect::CamWorks),
        ("CIRCLE/ 0,0,0,0,0,1,5,CLOCKWISE ", Dialect::CamWorks),
        ("PPRINT/APTCL-SPEC,MAKINO-FF,1", Dialect::MakinoFf),
        ("PARTNO X\nGOTO/1,2,3", Dialect::Iso),
        ("", Dialect::Iso),
    ] {
        assert_eq!(parse(&text(format!("{mark}\n")), None).program.dialect(), dialect, "{mark}");
    }
}

#[test]
fn the_first_mark_decides() {
    let both = "TOOL PATH/A,TOOL,B\n$$-> MFGNO / X\n";
    assert_eq!(parse(&text(both), None).program.dialect(), Dialect::Nx);
}

#[test]
fn a_forced_dialect_is_taken_whatever_the_file_says() {
    for dialect in Dialect::ALL {
        let parsed = parse(&text("TOOL PATH/A,TOOL,B\nGOTO/1,2,3\n"), Some(dialect));
        assert_eq!(parsed.program.dialect(), dialect);
    }
}

#[test]
fn names_lead_back_to_their_dialects() {
    for dialect in Dialect::ALL {
        assert_eq!(Dialect::from_name(&dialect.name().to_uppercase()), Some(dialect));
    }
    assert_eq!(Dialect::from_name("heidenhain"), None);
}
