//! Cutting coefficients, in the setup or in a file of their own.

use super::{close, draw, good, load, seen, source};
use clsmith::diagnostic::Failure;
use clsmith::engagement::{CuttingCoefficients, CuttingLaw, KienzleTerm};
use clsmith::setup::{Setup, WorkMaterial};
use clsmith::source::SourceReadError;
use std::path::Path;

/// The coefficients of a linear law.
pub fn linear(material: &WorkMaterial) -> CuttingCoefficients {
    match material.law {
        CuttingLaw::Linear(coefficients) => coefficients,
        other => panic!("{other:?} is not linear"),
    }
}

#[test]
fn a_law_of_kienzle() {
    let setup =
        good("material: { kienzle: { tangential: { k11: 1700, m: 0.25 }, axial: { k11: -300, m: 0.3 } } }");
    let term = |k11, m| KienzleTerm { k11, m };
    let wanted = CuttingLaw::Kienzle {
        tangential: term(1700.0, 0.25),
        radial: term(0.0, 0.0),
        axial: term(-300.0, 0.3),
    };
    assert_eq!(setup.require_material().unwrap().law, wanted);
    for text in [
        "material: { k_tc: 1, kienzle: { tangential: { k11: 1700, m: 0.25 } } }",
        "material: { kienzle: { tangential: { k11: 0, m: 0.25 } } }",
        "material: { kienzle: { tangential: { k11: 1700, m: 0.2 }, radial: { k11: 100, m: 1 } } }",
        "material: { name: nothing }",
    ] {
        assert!(load(text).is_err(), "{text}");
    }
}

#[test]
fn where_numbers_come_from() {
    let text = "name: C45\nk_tc: 1900\nsource: a book\nsources: { k_tc: own cuts }\ndate: 2026-11-02\ntool: D10, 4 teeth\n\
                ranges: { chip: [0.03, 0.1], cutting_speed: [80, 120], axial_depth: [1, 6] }\n\
                errors: { k_tc: 60 }\nresidual: 0.02\n";
    let origin = WorkMaterial::load(&source(text)).unwrap().origin;
    assert_eq!((origin.source_of("k_tc"), origin.source_of("k_re")), (Some("own cuts"), Some("a book")));
    assert_eq!((origin.error_of("k_tc"), origin.error_of("k_re")), (Some(60.0), None));
    assert_eq!((origin.chip_range_mm, origin.residual_part), (Some([0.03, 0.1]), Some(0.02)));
    assert!(WorkMaterial::load(&source("k_tc: 1\nranges: { chip: [0.2, 0.1] }\n")).is_err());
}

#[test]
fn only_the_tangential_coefficient_is_required() {
    let setup = good("units: inch\nmaterial: { k_tc: 1000, k_te: 20 }");
    let found = linear(setup.require_material().unwrap());
    close(found.k_tc, 1000.0);
    close(found.k_rc, 300.0);
    close(found.k_ac, 200.0);
    assert_eq!((found.k_te, found.k_re, found.k_ae), (20.0, 20.0, 0.0));
}

#[test]
fn a_file_has_the_same_keys() {
    let setup = good("material: { file: materials/c45.yaml }");
    assert_eq!(setup.require_material().unwrap_err().findings()[0].code.id(), "CL0507");
    let read = |path: &Path| {
        assert_eq!(path, Path::new("shop/materials/c45.yaml"));
        Ok(source("name: C45\nk_tc: 1900\nk_te: 30\nk_rc: 600\nk_re: 50\nk_ac: 400\nk_ae: -3\n"))
    };
    let setup = setup.read_material_file(read).unwrap();
    let material = setup.require_material().unwrap();
    assert_eq!((material.name.as_deref(), linear(material).k_ae), (Some("C45"), -3.0));
    let given =
        good("material: { k_tc: 1 }").read_material_file(|_| panic!("there is no file to read")).unwrap();
    assert_eq!(linear(given.require_material().unwrap()).k_tc, 1.0);
}

fn unreadable(path: &Path) -> SourceReadError {
    let error = std::io::Error::other("no such file");
    SourceReadError::Unreadable { name: path.to_string_lossy().into_owned(), error }
}

#[test]
fn what_is_said_when_there_is_none() {
    let setup = good("material: { file: c45.yaml }");
    let unreadable = setup.clone().read_material_file(|path| Err(unreadable(path))).unwrap_err();
    let broken = setup.read_material_file(|_| Ok(source("k_te: 5\n"))).unwrap_err();
    let missing = Setup::default().require_material().unwrap_err();
    let no_stock = Setup::default().require_stock().unwrap_err();
    seen("nothing_said", &[unreadable, broken, missing, no_stock].map(Failure::into_findings).concat());
    assert!(draw(WorkMaterial::load(&source("")).unwrap_err().findings()).contains("CL0203"));
}
