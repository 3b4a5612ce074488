//! Records that a move makes untrue, and statements that it cannot change.

use super::*;

#[test]
fn stale_records_are_reported_once_for_each_kind() {
    let (_, findings) =
        moved("{ translate: [0, 0, 5] }", MAKINO, &Place::identity().translated([0.0, 0.0, 5.0]));
    assert_eq!(shown(&findings), ["CL0304 this escape height was set for the path before the points moved"]);
    let (_, findings) =
        moved("{ translate: [1, 0, 0] }", MAKINO, &Place::identity().translated([1.0, 0.0, 0.0]));
    assert!(findings.is_empty());
    let (_, findings) =
        moved("{ translate: [1, 0, 0] }", CATIA, &Place::identity().translated([1.0, 0.0, 0.0]));
    assert!(shown(&findings)[0].contains("the matrix in these comments"), "{:?}", shown(&findings));
    let (_, findings) = moved("{ translate: [1, 0, 0] }", NX, &Place::identity().translated([1.0, 0.0, 0.0]));
    assert!(findings.is_empty(), "{:?}", shown(&findings));
    let text = CAMWORKS
        .replace("TLAXIS", "BOX/ 0.000000,81.250000,0.000000,115.000000,20.000000,115.000000 \nTLAXIS");
    let (_, findings) =
        moved("{ translate: [1, 0, 0] }", &text, &Place::identity().translated([1.0, 0.0, 0.0]));
    assert_eq!(findings.len(), 2, "{:?}", shown(&findings));
}

#[test]
fn unknown_words_with_numbers_are_reported_once_for_each_word() {
    let text = ISO.replace("FINI", "WIDGET/1.5\nWIDGET/2.5\nGADGET/3\nGIZMO/0\nFINI");
    let (_, findings) =
        moved("{ translate: [1, 0, 0] }", &text, &Place::identity().translated([1.0, 0.0, 0.0]));
    // A length may be a whole number.
    assert_eq!(findings.len(), 2, "{findings:?}");
    assert!(
        findings[0].message.contains("`WIDGET`") && findings[1].message.contains("`GADGET`"),
        "{findings:?}"
    );
}
