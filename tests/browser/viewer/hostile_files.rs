//! Files that are no programs, or broken ones: each is answered in words, and the viewer goes on.

use super::open_viewer;
use crate::report::simulation::SLOT;

/// Bytes that look like nothing: a generator of 32 bits (Numerical Recipes), the high byte of each number.
fn noise(count: usize) -> Vec<u8> {
    let mut state = 12_345_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    (0..count).map(|_| next()).collect()
}

#[test]
fn hostile_programs_are_answered_in_words() {
    let Some(mut viewer) = open_viewer() else { return };
    let latin = [b"PPRINT/B\xe4rbel \xff\xfe \xf0\x9f\n".as_slice(), SLOT.as_bytes()].concat();
    let long = [b"$$ ".as_slice(), &vec![b'x'; 5_000_000], b"\nGOTO/0,0,0\nGOTO/1,0,0\n"].concat();
    let endless = [b"GOTO/".as_slice(), b"1,".repeat(2_000_000).as_slice()].concat();
    let evil = format!(
        "PPRINT/</script><script>parent.hurt = 1</script><img src=x onerror='parent.hurt = 2'>\n{SLOT}"
    );
    let cases: [(&str, Vec<u8>, &str); 7] = [
        ("empty.cls", Vec::new(), ""),
        ("noise.bin", noise(300_000), "Do not post"),
        ("latin1.cls", latin, ""),
        ("long.cls", long, ""),
        ("endless.cls", endless, "Do not post"),
        ("nul.cls", vec![0; 100_000], "Do not post"),
        ("<b>evil'\"&.cls", evil.into_bytes(), ""),
    ];
    for (name, bytes, verdict) in cases {
        let path = viewer.write(name, bytes);
        viewer.show(&[path]);
        assert_eq!(viewer.seen_text("failure"), "", "{name}");
        assert_eq!(viewer.in_frame("document.title"), name);
        let said = viewer.in_frame("document.querySelector('#verdict b').textContent");
        assert!(said.as_str().unwrap().contains(verdict), "{name}: {said}");
    }
    assert_eq!(viewer.browser.value("window.hurt === undefined"), true);
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn wrong_recipes_and_setups_are_answered_with_their_place() {
    let Some(mut viewer) = open_viewer() else { return };
    let part = viewer.write("slot.cls", SLOT);
    viewer.show(&[part]);
    for (name, text, said) in [
        ("a.yaml", "version: 1\nsteps:\n  - scale_fed: { factor: 0.5 }\n", "scale_feed"),
        ("b.yaml", "version: 1\nsteps: [\n", "b.yaml"),
        ("c.yaml", "version: 1\nsteps:\n  - scale_feed: { factor: -2 }\n", "c.yaml:3"),
        ("d.yaml", "tools: 5\n", "d.yaml"),
        ("e.yaml", "stock: { file: gone.stl }\ntools: [ { match: {}, diameter: 10 } ]\n", "gone.stl"),
    ] {
        let path = viewer.write(name, text);
        viewer.show(&[path]);
        let failure =
            viewer.seen_text("failure") + viewer.in_frame("document.body.textContent").as_str().unwrap();
        assert!(failure.contains(said), "{name}: {failure}");
        viewer.browser.value("Object.assign(clsmithViewer.chosen, { setup: '', recipe: '' })");
    }
    // The program is shown all the while.
    assert_eq!(viewer.in_frame("document.title"), "slot.cls");
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn a_file_that_is_gone_and_a_folder_are_told() {
    let Some(mut viewer) = open_viewer() else { return };
    let folder = viewer.folder.path().join("a folder");
    std::fs::create_dir(&folder).unwrap();
    viewer.show(&[folder]);
    let failure = viewer.seen_text("failure");
    assert!(failure.contains("a folder cannot be read"), "{failure}");
    let gone = viewer.write("gone.cls", SLOT);
    viewer.show(std::slice::from_ref(&gone));
    std::fs::write(&gone, "other\n").unwrap();
    std::fs::remove_file(&gone).unwrap();
    viewer.browser.value("clsmithViewer.seconds = 0; clsmithViewer.choose({})");
    viewer.wait_for_end();
    let failure = viewer.seen_text("failure");
    assert!(failure.contains("gone.cls cannot be read"), "{failure}");
}
