//! Any bytes: read, written back as they were, motions and roles taken, without a panic and without delay.

#![no_main]

use clsmith::parse::{parse, syntax};
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
        let syntax = syntax(parsed.program.statement_text(statement));
        assert_eq!(statement.record().number_roles(&syntax).len(), syntax.numbers().len());
    }
    assert_eq!(end as usize, bytes.len());
    let operations = find_operations(&parsed.program).len();
    for motion in parsed.program.motions() {
        assert!(motion.operation < operations);
        let _ = (motion.length(), motion.path.sample_points(motion.from.point, motion.to.point).len());
    }
});
