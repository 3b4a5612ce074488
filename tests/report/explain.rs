//! The catalogue as text.

use crate::support::snapshots;
use clsmith::diagnostic::CATALOGUE;
use clsmith::diagnostic::codes::BAD_ARGUMENTS;
use clsmith::report::explain::{explain_code, list_codes};

#[test]
fn a_code_at_length() {
    snapshots("report").bind(|| insta::assert_snapshot!("explain", explain_code(BAD_ARGUMENTS)));
}

#[test]
fn the_list_has_every_code_once() {
    let ids: Vec<&str> = CATALOGUE.iter().flat_map(|rows| rows.iter()).map(|code| code.id()).collect();
    let list = list_codes();
    let listed: Vec<&str> = list.lines().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(listed, ids);
    assert!(list.starts_with("CL0001  error    a statement the grammar cannot read\n"), "{list}");
}

#[test]
fn every_code_is_explained() {
    for code in CATALOGUE.iter().flat_map(|rows| rows.iter()) {
        assert!(code.explanation().len() > 100, "{code} needs an explanation");
        assert!(!code.help().is_empty(), "{code} needs help");
        assert!(!code.meaning().ends_with('.'), "{code}: the meaning is no sentence");
        let text = explain_code(*code);
        let wrapped = text.lines().filter(|line| !line.starts_with(' ')).skip(1);
        assert!(wrapped.into_iter().all(|line| line.chars().count() <= 80), "{text}");
    }
}
