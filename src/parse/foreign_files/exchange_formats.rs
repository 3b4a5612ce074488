//! This module recognizes models, drawings, tables and documents that are given in place of CL data.

/// What binary files and documents begin with, and what they are.
const FIRST_BYTES: &[(&[u8], &str)] = &[
    (b"PK\x03\x04", "this is an archive (zip or gzip), not CL data"),
    (b"\x1F\x8B", "this is an archive (zip or gzip), not CL data"),
    (b"7z\xBC\xAF\x27\x1C", "this is an archive (7z), not CL data"),
    (b"Rar!\x1A\x07", "this is an archive (rar), not CL data"),
    (b"BZh91AY&SY", "this is an archive (bzip2), not CL data"),
    (b"\xFD7zXZ\x00", "this is an archive (xz), not CL data"),
    (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", "this is an Office document or CAD file, not CL data"),
    (b"\x89PNG\r\n\x1A\n", "this is a picture (PNG), not CL data"),
    (b"\xFF\xD8\xFF", "this is a picture (JPEG), not CL data"),
    (b"MZ\x90\x00", "this is a program for Windows, not CL data"),
    (b"{\\rtf", "this is a document (RTF), not CL data"),
];

/// Returns a sentence that says what a file is by its first bytes.
pub(super) fn detect_binary_format(head: &[u8]) -> Option<&'static str> {
    FIRST_BYTES.iter().find(|(first, _)| head.starts_with(first)).map(|(_, found)| *found)
}

/// Returns a sentence that says what a file is. `start` is its text without the blanks before it, and `lines` are its
/// first lines that hold anything.
pub(super) fn detect_exchange_format(start: &[u8], lines: &[&[u8]]) -> Option<&'static str> {
    let doctype = start.get(..9).is_some_and(|mark| mark.eq_ignore_ascii_case(b"<!DOCTYPE"));
    if doctype || is_xml(start, lines) {
        return Some("this is an XML file, not CL data");
    }
    if start.starts_with(b"solid") && lines.iter().take(5).any(|line| line.starts_with(b"facet")) {
        return Some("this is a mesh (STL), not CL data");
    }
    if is_iges(start) {
        return Some("this is a model (IGES), not CL data");
    }
    if is_dxf(lines) {
        return Some("this is a drawing (DXF), not CL data");
    }
    if is_json(start, lines) {
        return Some("this is a JSON file, not CL data");
    }
    let is_key = |line: &&[u8]| {
        line.starts_with(b"version:") || line.starts_with(b"steps:") || line.starts_with(b"rules:")
    };
    if lines.iter().find(|line| !line.starts_with(b"#")).is_some_and(is_key) {
        return Some("this is a YAML file, a recipe or a setup, not CL data");
    }
    is_table(lines).then_some("this is a table (CSV), not CL data")
}

/// Returns whether a text starts with the tag of an element, and another tag closes it or stands on the next line. A line
/// in angle brackets alone may be somebody's mark in CL data.
fn is_xml(start: &[u8], lines: &[&[u8]]) -> bool {
    let [b'<', rest @ ..] = start else { return false };
    let name = rest.iter().take_while(|byte| byte.is_ascii_alphanumeric() || b"_-:.".contains(byte)).count();
    let named = rest.first().is_some_and(u8::is_ascii_alphabetic);
    let closing = [b"</", rest.get(..name).unwrap_or_default()].concat();
    named
        && (memchr::memmem::find(start, &closing).is_some()
            || lines.get(1).is_some_and(|line| line.starts_with(b"<")))
}

/// Returns whether lines alternate between group codes and values, with a section first.
fn is_dxf(lines: &[&[u8]]) -> bool {
    let comment = if lines.first() == Some(&b"999".as_slice()) { 2 } else { 0 };
    matches!(lines.get(comment..comment + 2), Some([b"0", b"SECTION"]))
        || lines.first().is_some_and(|line| line.starts_with(b"AutoCAD Binary DXF"))
}

/// Returns whether the first line has `S` in column 73 and its number behind that, as the start section of IGES.
fn is_iges(start: &[u8]) -> bool {
    let line = start.split(|byte| matches!(byte, b'\r' | b'\n')).next().unwrap_or_default();
    let columns = [line.len().checked_sub(8).and_then(|at| line.get(at..)), line.get(72..80)];
    let is_mark = |mark: &[u8]| matches!(mark, [b'S', number @ ..] if number.trim_ascii() == b"1" || number == b"0000001");
    columns.into_iter().flatten().any(is_mark)
}

fn is_json(start: &[u8], lines: &[&[u8]]) -> bool {
    let opens = matches!(start, [b'{', ..] | [b'[', ..]);
    opens && lines.iter().take(3).any(|line| line.contains(&b'"'))
}

/// Returns whether lines are the rows of a table: a head of names over numbers with as many fields, or rows with semicolons,
/// which CL data do not have.
fn is_table(lines: &[&[u8]]) -> bool {
    let [head, rows @ ..] = lines.get(..lines.len().min(4)).unwrap_or_default() else { return false };
    for separator in [b';', b'\t', b','] {
        let count = |line: &[u8]| line.iter().filter(|byte| **byte == separator).count();
        let columns = count(head);
        if columns == 0 || rows.is_empty() {
            continue;
        }
        let is_row =
            |line: &&[u8]| count(line) == columns && line.split(|byte| *byte == separator).all(is_value);
        let is_head = head.split(|byte| *byte == separator).all(is_name);
        if rows.iter().all(is_row) && (is_head || (separator == b';' && is_row(head))) {
            return true;
        }
    }
    false
}

/// Returns whether a cell holds a number, with either sign of decimals, or nothing.
fn is_value(cell: &[u8]) -> bool {
    cell.trim_ascii().iter().all(|byte| byte.is_ascii_digit() || b"+-.,eE\"".contains(byte))
}

/// Returns whether a cell is the name of a column.
fn is_name(cell: &[u8]) -> bool {
    let cell = cell.trim_ascii();
    let is_letter = |byte: &u8| byte.is_ascii_alphanumeric() || b" _-()[]\"%.".contains(byte);
    cell.iter().any(u8::is_ascii_alphabetic) && cell.iter().all(is_letter)
}
