//! Names from files that would be run by a spreadsheet or reverse the line of a terminal, and texts without an end.

use super::clsmith;
use std::fs;

/// Operations with names that spreadsheets take for formulas, and one with a bidi override.
fn names_of_all_kinds() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let names = ["=1+2", "+CHAMFER", "-2+3 FACE", "@SUM(A1)", "CUT\u{202e}SREVER"];
    let operation = |(index, name): (usize, &&str)| {
        let y = index as f64 * 10.0;
        format!(
            "TOOL PATH/{name},TOOL,EM6\nTLDATA/MILL,6.0000,0.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,3000,CLW\nRAPID\n\
             GOTO/-10.0000,{y:.4},5.0000\nFEDRAT/MMPM,300.0000\nGOTO/-10.0000,{y:.4},-1.0000\nGOTO/10.0000,{y:.4},-1.0000\n\
             RAPID\nGOTO/10.0000,{y:.4},5.0000\nEND-OF-PATH\n"
        )
    };
    let text: String = names.iter().enumerate().map(operation).collect();
    fs::write(folder.path().join("part.cls"), text).unwrap();
    let shop =
        "stock: { block: { from: [-20, -20, -10], to: [20, 60, 0] } }\ntools: [ { match: {}, teeth: 2 } ]\n";
    fs::write(folder.path().join("shop.yaml"), shop).unwrap();
    folder
}

#[test]
fn no_cell_of_a_table_is_a_formula_and_no_output_holds_a_hidden_character() {
    let folder = names_of_all_kinds();
    let outputs = ["--csv", "c.csv", "--json", "c.json", "--report", "c.html", "--summary", "c.md"];
    let done = clsmith(folder.path())
        .args(["simulate", "part.cls", "--setup", "shop.yaml"])
        .args(outputs)
        .assert()
        .success();
    let table = fs::read_to_string(folder.path().join("c.csv")).unwrap();
    let cells = table.lines().flat_map(|line| line.split(','));
    for cell in cells.map(|cell| cell.trim_matches('"')) {
        let is_formula = cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
        assert!(!is_formula, "{cell}");
    }
    assert!(table.contains("'=1+2") && table.contains("'@SUM(A1)"), "{table}");
    for name in ["c.csv", "c.json", "c.html", "c.md"] {
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(!text.contains('\u{202e}'), "{name}");
    }
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("c.json")).unwrap()).unwrap();
    assert!(json.to_string().contains("CUT\u{202e}SREVER"), "read back, it is the name that the file has");
    assert!(!String::from_utf8_lossy(&done.get_output().stdout).contains('\u{202e}'));
    let stats = clsmith(folder.path()).args(["stats", "part.cls", "--json", "s.json"]).assert();
    for text in [&stats.get_output().stdout, &stats.get_output().stderr] {
        assert!(!String::from_utf8_lossy(text).contains('\u{202e}'));
    }
}

#[test]
fn a_finding_is_short_whatever_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let word = "X".repeat(70_000);
    fs::write(folder.path().join("part.cls"), format!("RAPID\nGOTO/1.0,2.0,{word}\n{word}/1,2\n")).unwrap();
    for format in ["human", "line", "json", "sarif"] {
        let done = clsmith(folder.path()).args(["check", "part.cls", "--notes", "--format", format]).assert();
        let output = done.get_output();
        let bytes = output.stdout.len() + output.stderr.len();
        // SARIF has the catalogue's explanations of the codes as well.
        assert!(bytes < 16_000, "{format}: {bytes} bytes");
    }
}
