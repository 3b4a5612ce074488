//! Any bytes: read, written back as they were, motions and roles taken, without a panic and without delay. A long statement
//! reads alike when it is broken at column 72, as CATIA breaks it. The parser's shortcuts read every statement as the grammar
//! does, also from the middle of lines that belong together.

#![no_main]

use clsmith::internals::parse::compare_with_grammar;
use clsmith::parse::{parse, read_record, syntax};
use clsmith::program::operation::find_operations;
use clsmith::source::Source;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(source) = Source::new("fuzz.cls", bytes.to_vec()) else { return };
    let parsed = parse(&source, None);
    assert!(parsed.program.to_bytes() == bytes, "the bytes changed");
    let mut end = 0;
    for statement in parsed.program.statements() {
        assert_eq!(statement.origin().start, end, "the spans do not tile the file");
        end = statement.origin().end;
        if let Err(difference) = compare_with_grammar(bytes.get(statement.origin().start as usize..).unwrap_or_default()) {
            panic!("{difference}");
        }
        let syntax = syntax(parsed.program.statement_text(statement));
        assert_eq!(statement.record().number_roles(&syntax).len(), syntax.numbers().len());
        assert_reads_alike_when_broken(parsed.program.statement_text(statement));
    }
    assert_eq!(end as usize, bytes.len());
    let operations = find_operations(&parsed.program).len();
    for motion in parsed.program.motions() {
        assert!(motion.operation < operations);
        let _ = (motion.length(), motion.path.sample_points(motion.from.point, motion.to.point).len());
    }
});

/// Breaks a plain statement of one line at column 72, inside numbers and words too, and compares what both mean.
fn assert_reads_alike_when_broken(text: &[u8]) {
    let line = text.trim_ascii_end();
    let plain = |byte: &u8| byte.is_ascii_uppercase() || byte.is_ascii_digit() || b"/,.-".contains(byte);
    // Up to 80 columns the end may be an identification, and blanks mean something where a comma is missing.
    if line.len() <= 80 || !line.iter().all(plain) {
        return;
    }
    let mut broken = Vec::new();
    let mut rest = line;
    while rest.len() > 72 {
        let (first, tail) = rest.split_at(71);
        broken.extend_from_slice(first);
        broken.extend_from_slice(b"$\r\n");
        rest = tail;
    }
    broken.extend_from_slice(rest);
    if let Err(difference) = compare_with_grammar(&broken) {
        panic!("{difference}");
    }
    match (read_record(line), read_record(&broken)) {
        (Ok((whole, _)), Ok((joined, syntax))) => {
            assert_eq!(whole, joined);
            assert_eq!(syntax.text.len(), broken.len());
        }
        (Err(_), Err(_)) => {}
        (whole, joined) => panic!("{whole:?} {joined:?}"),
    }
}
