//! This module recognizes files that are no CL data but are given by mistake: programs behind the post, robot
//! programs, models, archives.
//!
//! It only has to know files that the reader would otherwise take for CL data with very many errors, so it looks
//! at the first lines and decides by what no CL file has.

mod exchange_formats;

/// How many bytes of a file are looked at.
pub(super) const LOOKED_AT: usize = 16 * 1024;

/// Returns a sentence that says what a file is, or `None` if it may be CL data.
pub(super) fn detect_foreign_file(bytes: &[u8]) -> Option<&'static str> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let head = bytes.get(..LOOKED_AT).unwrap_or(bytes);
    if let Some(found) = exchange_formats::detect_binary_format(head) {
        return Some(found);
    }
    let start = head.trim_ascii_start();
    if let Some(found) = detect_by_start(bytes, start) {
        return Some(found);
    }
    let lines: Vec<&[u8]> = head
        .split(|byte| matches!(byte, b'\n' | b'\r'))
        .map(<[u8]>::trim_ascii)
        .filter(|line| !line.is_empty())
        .collect();
    if lines.iter().take(20).any(|line| is_goto(line)) {
        return None;
    }
    if let Some(found) = exchange_formats::detect_exchange_format(start, &lines) {
        return Some(found);
    }
    let inked = || lines.iter().filter(|line| !line.starts_with(b";"));
    if inked().take(5).any(|line| is_heidenhain_start(line))
        || inked().filter(|line| is_heidenhain_block(line)).count() >= 2
    {
        return Some("this is an NC program behind the post (Heidenhain), not CL data");
    }
    if is_heidenhain_iso(&lines) {
        return Some("this is an NC program behind the post (Heidenhain DIN/ISO), not CL data");
    }
    if is_robot_program(&lines) {
        return Some("this is a robot program behind the post (KUKA KRL), not CL data");
    }
    if lines.first().is_some_and(|line| line.starts_with(b"/PROG ") || line.starts_with(b"/JOB")) {
        return Some("this is a robot program behind the post (Fanuc TP or Yaskawa), not CL data");
    }
    if lines.iter().find(|line| !line.starts_with(b"!")).is_some_and(|line| is_rapid_module(line)) {
        return Some("this is a robot program behind the post (ABB RAPID), not CL data");
    }
    if is_mastercam_nci(&lines) {
        return Some("this is an NCI file (Mastercam), not CL data");
    }
    is_gcode(&lines).then_some("this is an NC program behind the post (G-code), not CL data")
}

/// Returns what a file is by the bytes that it starts with.
fn detect_by_start(bytes: &[u8], start: &[u8]) -> Option<&'static str> {
    if start.starts_with(b"<?xml") || start.starts_with(b"<!--") {
        return Some("this is an XML file, not CL data");
    }
    // A comment may stand before it.
    let behind = match start
        .strip_prefix(b"/*")
        .map(|rest| memchr::memmem::find(rest, b"*/").map(|end| (rest, end)))
    {
        Some(Some((rest, end))) => rest.get(end + 2..).unwrap_or_default().trim_ascii_start(),
        _ => start,
    };
    if behind.starts_with(b"ISO-10303-21") {
        return Some("this is a STEP or STEP-NC file (ISO 10303-21), not CL data");
    }
    if start.starts_with(b"%PDF-") {
        return Some("this is a PDF document, not CL data");
    }
    is_binary_stl(bytes).then_some("this is a mesh (STL), not CL data")
}

/// Returns whether a whole file is as long as the count of its triangles says.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|four| <[u8; 4]>::try_from(four).ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count))
}

/// Returns whether the first lines end in `*`, as blocks of Heidenhain's DIN/ISO programs do: `%PLATE G71 *`.
fn is_heidenhain_iso(lines: &[&[u8]]) -> bool {
    let first = lines.first().is_some_and(|line| line.starts_with(b"%"));
    let blocks = lines.iter().take(20);
    first
        && blocks.clone().count() >= 2
        && blocks.filter(|line| line.ends_with(b"*")).count() * 2 > lines.len().min(20)
}

/// Returns whether a line is `0 BEGIN PGM NAME MM`.
fn is_heidenhain_start(line: &[u8]) -> bool {
    let number = line.iter().take_while(|byte| byte.is_ascii_digit()).count();
    line.get(number..).unwrap_or_default().trim_ascii_start().starts_with(b"BEGIN PGM")
}

/// Returns whether a line is a block with words that only Heidenhain has: `2 TOOL CALL 9 Z S3000`, `L X+10 Y-16 R0 FMAX`.
fn is_heidenhain_block(line: &[u8]) -> bool {
    let number = line.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let block = line.get(number..).unwrap_or_default().trim_ascii_start();
    let ends = |end: &[u8]| block.ends_with(end);
    block.starts_with(b"TOOL CALL ")
        || block.starts_with(b"BLK FORM ")
        || (block.starts_with(b"L ")
            && (ends(b" FMAX") || ends(b" R0") || memchr::memmem::find(block, b" R0 F").is_some()))
}

/// Returns whether the first line that is no comment opens a KRL module: `&ACCESS RVP`, `DEF NAME()`.
fn is_robot_program(lines: &[&[u8]]) -> bool {
    let first = lines.iter().find(|line| !line.starts_with(b";"));
    first.is_some_and(|line| {
        let upper = line.to_ascii_uppercase();
        let module = upper.strip_prefix(b"GLOBAL ").unwrap_or(&upper);
        upper.starts_with(b"&ACCESS")
            || upper.starts_with(b"&REL")
            || module.starts_with(b"DEFDAT ")
            || (module.starts_with(b"DEF ") && module.contains(&b'('))
    })
}

/// Returns whether a line opens a module of ABB's RAPID: `MODULE Mill`, `%%%` before it.
fn is_rapid_module(line: &[u8]) -> bool {
    let word = line.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
    line.get(..word).is_some_and(|word| word.eq_ignore_ascii_case(b"MODULE")) && line.get(word) == Some(&b' ')
}

/// Returns whether lines alternate between a code and the numbers of its record, as in Mastercam's NCI.
fn is_mastercam_nci(lines: &[&[u8]]) -> bool {
    // Older files have a version line in front.
    let records = lines.iter().position(|line| is_code(line)).map(|first| (first, lines.get(first..)));
    let Some((0..=2, Some(records))) = records else { return false };
    let pairs = records.chunks_exact(2).take(20);
    let count = pairs.len();
    // Behind the codes of names and comments stand texts.
    let is_record = |code: &[u8], values: &[u8]| is_code(code) && (is_number_list(values) || code.len() >= 4);
    let alike = pairs.filter(|pair| matches!(pair, [code, values] if is_record(code, values)));
    let alike = alike.count();
    count >= 2 && alike * 10 >= count * 7
}

fn is_code(line: &[u8]) -> bool {
    (1..=5).contains(&line.len()) && line.iter().all(u8::is_ascii_digit)
}

/// Returns whether a line holds numbers with blanks between them, and no comma.
fn is_number_list(line: &[u8]) -> bool {
    line.iter().all(|byte| byte.is_ascii_digit() || b" \t.-+eE".contains(byte))
}

/// Returns whether most lines are blocks of G-code, and none is a GOTO of CL data.
fn is_gcode(lines: &[&[u8]]) -> bool {
    let (mut blocks, mut others) = (0, 0);
    for line in lines {
        if is_goto(line) {
            return false;
        }
        match line {
            // The mark of a tape's start and end, the name of an Okuma program, comments.
            [b'$', .., b'%'] | [b'%', ..] | [b'(', ..] | [b';', ..] => {}
            _ if is_block(line) => blocks += 1,
            _ => others += 1,
        }
    }
    // A few blocks may be what somebody typed into CL data.
    (blocks >= 3 && others == 0) || (blocks >= 5 && blocks > others)
}

fn is_goto(line: &[u8]) -> bool {
    let rest = line.get(..4).filter(|word| word.eq_ignore_ascii_case(b"GOTO")).and_then(|_| line.get(4..));
    rest.is_some_and(|rest| rest.trim_ascii_start().starts_with(b"/"))
}

/// Returns whether a line is a block such as `N10 G1 X-15. F800 (CUT)`: addresses of one letter with numbers.
fn is_block(line: &[u8]) -> bool {
    let mut rest = line.strip_prefix(b"/").unwrap_or(line);
    let mut words = 0;
    loop {
        rest = rest.trim_ascii_start();
        let [first, after @ ..] = rest else { break };
        match first {
            b'(' | b';' => break,
            letter if letter.is_ascii_alphabetic() => {
                let after = after.trim_ascii_start();
                let after = after.strip_prefix(b"=").unwrap_or(after);
                let number = after.iter().take_while(|&byte| b"+-.0123456789".contains(byte)).count();
                if !after.get(..number).is_some_and(|text| text.iter().any(u8::is_ascii_digit)) {
                    return false;
                }
                words += 1;
                rest = after.get(number..).unwrap_or_default();
            }
            _ => return false,
        }
    }
    words > 0
}

#[cfg(test)]
mod tests {
    use super::detect_foreign_file;

    #[test]
    fn files_behind_the_post_are_named() {
        for (text, named) in [
            ("%\nO0042 (PLATE)\nG21 G90\nT3 M6\nG0X-15.Y0.\nG1 Z-5. F800\nM30\n%\n", "G-code"),
            ("N10 G90\nN20 T=3 M6\nN30 G0 X1 Y2 ; home\nN40 M30\n", "G-code"),
            ("0 BEGIN PGM PLATE MM\n1 TOOL CALL 3 Z S2600\n", "Heidenhain"),
            ("BEGIN PGM A INCH\n", "Heidenhain"),
            ("; a\n; b\n; c\n; d\n; e\n; f\n0 BEGIN PGM A MM\n1 STOP M6\n", "Heidenhain"),
            ("1 TOOL CALL 9 Z S13000\n2 L X10 Y-16 R0 FMAX M3\n3 CC X0 Y0\n", "Heidenhain"),
            ("! MILL\nMODULE Mill\n  PROC main()\n    MoveL p1,v100,fine,tool0;\n", "ABB"),
            ("$PLATE.MIN%\nG15 H1\nG0 X0 Y0\nG1 X5 F200\nM02\n", "G-code"),
            ("1050\n2 1 0 0\n1051\nMILL\n1053\nPART\n1000\n1 1 1 10. 0\n0\n0 1. 2. 3. 500. 0\n", "NCI"),
            ("/* by hand */\nISO-10303-21;\nHEADER;\n", "STEP-NC"),
            ("<!DOCTYPE html>\n<html>\n", "XML"),
            ("&ACCESS RVP\n&REL 1\nDEF MILL( )\nLIN {X 1,Y 2}\nEND\n", "KRL"),
            ("1050\n9 1 2 0.5\n1000\n0 1 0 2. 0 0\n0\n0 1. 2. 3. 500. 0\n", "NCI"),
            ("<?xml version=\"1.0\"?>\n<a/>\n", "XML"),
            ("<toolpath>\n</toolpath>\n", "XML"),
            (
                "%PLATE G71 *\nN10 G30 G17 X+0 Y+0 Z-20*\nN20 T3 G17 S2600*\nN30 G00 X-15*\nN99 %PLATE G71 *\n",
                "DIN/ISO",
            ),
            ("/PROG  MILL\n/ATTR\nOWNER = MNEDITOR;\n/MN\n   1:L P[1] 20mm/sec FINE ;\n/END\n", "Fanuc TP"),
            ("/JOB\n//NAME MILL\n//POS\n", "Yaskawa"),
            ("solid part\n facet normal 0 0 1\n  outer loop\n", "STL"),
            ("%PDF-1.4\n1 0 obj\n", "PDF"),
            ("x,y,z\n1,2,3\n4,5,6\n", "CSV"),
            ("X;Y;Z\n1,5;2;3\n4;5;6\n", "CSV"),
            ("1;2;3\n4;5;6\n", "CSV"),
            ("  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n", "DXF"),
            ("999\nmade by hand\n0\nSECTION\n2\nHEADER\n", "DXF"),
            ("{\n  \"version\": 1\n}\n", "JSON"),
            ("# half\nversion: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n", "YAML"),
            ("ISO-10303-21;\nHEADER;\n", "STEP-NC"),
            ("PK\x03\x04rest", "archive"),
        ] {
            let found = detect_foreign_file(text.as_bytes());
            assert!(found.is_some_and(|found| found.contains(named)), "{text:?}: {found:?}");
        }
    }

    #[test]
    fn binary_files_are_named_by_their_first_bytes() {
        for (bytes, named) in [
            (b"PK\x03\x04" as &[u8], "archive"),
            (b"7z\xBC\xAF\x27\x1C", "archive"),
            (b"Rar!\x1A\x07\x00", "archive"),
            (b"BZh91AY&SY", "archive"),
            (b"\xFD7zXZ\x00", "archive"),
            (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", "Office"),
            (b"\x89PNG\r\n\x1A\n", "picture"),
            (b"\xFF\xD8\xFF\xE0", "picture"),
            (b"MZ\x90\x00", "program"),
            (b"{\\rtf1 hello}", "document"),
        ] {
            let found = detect_foreign_file(bytes);
            assert!(found.is_some_and(|found| found.contains(named)), "{bytes:?}: {found:?}");
        }
    }

    #[test]
    fn cl_data_are_not_taken_for_something_else() {
        for text in [
            "",
            "RAPID\nGOTO/1,2,3\n",
            "T1\nT2\nT3\nGOTO / 1,2,3\n",
            "GOTO/1,2,3\n4,5,6\n7,8,9\n",
            "1,2,3\n4,5,6\n7,8,9\n4,5,6\n",
            "$$ <A>\nFINI\n",
            "<PROGRAM>\nGOTO/1,2,3\nGOTO/2,2,3\n</PROGRAM>\n",
            "<PROGRAM>\nRAPID\nFINI\n",
            "%\nGOTO/1,2,3\n",
            "PPRINT X; Y\nPPRINT A; B\nGOTO/1,2,3\n",
            "CHANNEL,1\nLOCAL_ORIGIN,1,2,3\n1,2,3\n",
            "PARTNO A1\nUNITS/MM\n",
            "MODULE/3\nRAPID\nFINI\n",
            "L 1\nTOOL PATH/A,TOOL,B\nRAPID\n",
            "MZ\nRAPID\nFINI\n",
        ] {
            assert_eq!(detect_foreign_file(text.as_bytes()), None, "{text:?}");
        }
    }
}
