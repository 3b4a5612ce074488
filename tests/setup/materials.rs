//! Cutting coefficients, in the setup or in a file of their own.

use super::{close, draw, good, seen, source};
use clsmith::diagnostic::Failure;
use clsmith::setup::{Setup, WorkMaterial};
use clsmith::source::SourceReadError;
use std::path::Path;

#[test]
fn only_the_tangential_coefficient_is_required() {
    let setup = good("units: inch\nmaterial: { k_tc: 1000, k_te: 20 }");
    let found = setup.require_material().unwrap().coefficients;
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
    assert_eq!((material.name.as_deref(), material.coefficients.k_ae), (Some("C45"), -3.0));
    let given =
        good("material: { k_tc: 1 }").read_material_file(|_| panic!("there is no file to read")).unwrap();
    assert_eq!(given.require_material().unwrap().coefficients.k_tc, 1.0);
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
