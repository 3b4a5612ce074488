//! Every real file is read whole, and written back byte for byte.

use crate::support;
use clsmith::diagnostic::codes;
use clsmith::internals::parse::compare_with_grammar;
use clsmith::parse::parse;

#[test]
fn real_files_are_read_without_an_error_and_written_back_byte_for_byte() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let source = support::source(&path);
        let parsed = parse(&source, None);
        let mut end = 0;
        for statement in parsed.program.statements() {
            assert_eq!(statement.origin().start, end, "{}", path.display());
            end = statement.origin().end;
        }
        assert_eq!(end as usize, source.bytes().len());
        assert_eq!(parsed.program.to_bytes(), source.bytes(), "{}", path.display());
        let found: Vec<_> = parsed
            .diagnostics
            .iter()
            .map(|found| (found.code, found.message.clone(), source.line_column(found.labels[0].span.start)))
            .collect();
        assert!(found.is_empty(), "{}: {:?}", path.display(), found.first());
        let mut motions = parsed.program.motions();
        while motions.next().is_some() {}
        let problems = motions.take_problems();
        assert!(problems.is_empty(), "{}: {} {:?}", path.display(), problems.len(), problems.first());
    }
}

#[test]
fn part_programs_are_refused_with_one_diagnostic() {
    let Some(corpus) = support::require_corpus_with_part_programs() else { return };
    for path in corpus.iter().filter(|path| path.to_string_lossy().contains("apt360")) {
        let source = support::source(path);
        let parsed = parse(&source, None);
        let found: Vec<_> = parsed.diagnostics.iter().map(|found| found.code).collect();
        assert_eq!(found, [codes::APT_PART_PROGRAM], "{}", path.display());
        assert_eq!(parsed.program.to_bytes(), source.bytes());
    }
}

#[test]
fn cases_of_oddities_are_written_back_byte_for_byte() {
    let Some(folder) = support::require_shared_folder("cases") else { return };
    let mut programs = 0;
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        // Recipes, setups and the page that tells about them lie beside the programs.
        if path.extension().is_none_or(|end| end == "yaml" || end == "md" || end == "py") || path.is_dir() {
            continue;
        }
        let source = support::source(&path);
        assert_eq!(parse(&source, None).program.to_bytes(), source.bytes(), "{}", path.display());
        programs += 1;
    }
    assert!(programs > 40, "{programs}");
}

/// The shortcuts must give what the grammar gives, statement by statement, in every real file and every odd one.
#[test]
fn shortcuts_agree_with_the_grammar_on_real_files() {
    let Some(mut files) = support::require_corpus_with_part_programs() else { return };
    let Some(cases) = support::require_shared_folder("cases") else { return };
    files.extend(
        std::fs::read_dir(cases).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file()),
    );
    let (mut statements, mut by_shortcut) = (0, 0);
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        let mut at = 0;
        while at < bytes.len() {
            let compared = compare_with_grammar(&bytes[at..]);
            let (length, taken) = compared.unwrap_or_else(|found| panic!("{}: {found}", path.display()));
            at += length;
            statements += 1;
            by_shortcut += usize::from(taken);
        }
    }
    // Real text is nearly all plain.
    assert!(by_shortcut * 10 > statements * 8, "{by_shortcut} of {statements}");
}
