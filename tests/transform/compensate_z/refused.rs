//! What `compensate_z` refuses, and where it points.

use super::{compensate, in_plane, operation};

fn refused(parameters: &str, text: &str) -> (String, Vec<String>) {
    let Err(mut found) = compensate(parameters, text) else { panic!("not refused: {parameters}") };
    let last = found.pop().unwrap();
    assert!(last.code.id().starts_with("CL03") || last.code.id().starts_with("CL02"), "{}", last.code);
    let texts = last
        .labels
        .iter()
        .map(|label| String::from_utf8_lossy(label.source.slice(label.span)).trim().to_owned());
    (last.message.clone(), texts.collect())
}

fn ridge() -> String {
    operation(&[in_plane(&[(0.0, 0.0), (20.0, 15.0), (40.0, 0.0)], [0.0, 0.0], 0.0)])
}

#[test]
fn radii_must_fit_together() {
    let (message, texts) = refused("radius: 5, was_radius: 4", &ridge());
    assert!(message.contains("`was_radius` needs"), "{message}");
    assert_eq!(texts[0], "4");
    let (message, texts) = refused("radius: 5, input: tip", &ridge());
    assert!(message.contains("ball of unknown radius"), "{message}");
    assert_eq!(texts[0], "tip");
    let flat = ridge().replace("10.0000,5.0000,60", "10.0000,1.0000,60");
    let (message, texts) = refused("tolerance: 0.01", &flat);
    assert!(message.contains("is no ball"), "{message}");
    assert!(texts[0].starts_with("GOTO"));
    let unknown = ridge()
        .lines()
        .filter(|line| !line.starts_with("TLDATA"))
        .map(|line| format!("{line}\n"))
        .collect::<String>();
    let (message, _) = refused("tolerance: 0.01", &unknown);
    assert!(message.contains("is not known"), "{message}");
}

#[test]
fn a_path_that_keeps_to_no_plane_is_refused_where_it_leaves() {
    let curve: Vec<[f64; 3]> =
        (0..40).map(|i| f64::from(i) * 0.15).map(|a| [20.0 * a.cos(), 20.0 * a.sin(), a]).collect();
    let (message, texts) = refused("radius: 5", &operation(&[curve]));
    assert!(message.contains("leaves the plane"), "{message}");
    assert!(texts[0].starts_with("GOTO"), "{texts:?}");
}

#[test]
fn a_turning_axis_has_no_plane() {
    let text = ridge().replace(
        "GOTO/40.0000,0.0000,0.0000\n",
        "GOTO/40.0000,0.0000,0.0000,0.0000000,0.1000000,0.9949874\n",
    );
    let (message, _) = refused("radius: 5", &text);
    assert!(message.contains("axis turns"), "{message}");
}

#[test]
fn statements_of_several_points_are_not_moved() {
    let text = ridge().replace(
        "GOTO/20.0000,0.0000,15.0000\nGOTO/40.0000,0.0000,0.0000",
        "GOTO/20.0,0.0,15.0,30.0,0.0,7.5,40.0,0.0,0.0,40.0,0.0,0.0",
    );
    let (message, _) = refused("radius: 5", &text);
    assert!(message.contains("shares a statement"), "{message}");
}

#[test]
fn misspelt_values_point_at_themselves() {
    let (_, texts) = refused("radius: 5, against: profil", &ridge());
    assert_eq!(texts[0], "profil");
    let (_, texts) = refused("radius: 0", &ridge());
    assert_eq!(texts[0], "0");
}
