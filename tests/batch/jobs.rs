//! Jobs files: what they mean, and what is said about broken ones.

use crate::support;
use clsmith::batch::jobs_file::{BatchJobs, jobs_schema, load_jobs};
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::report::render::line;
use std::path::Path;

fn read(text: &str) -> Result<BatchJobs, Vec<Diagnostic>> {
    load_jobs(&support::text(text), Path::new("shop/jobs.yaml")).map_err(Failure::into_findings)
}

const GOOD: &str = "\
out: done
jobs:
  - { recipe: slow.yaml, setup: vmc3.yaml, files: ['programs/**/*.cls', one.cls] }
  - recipe: inch.yaml
    files: ['us/*.ncl']
    out: us/new
";

#[test]
fn a_jobs_file_says_recipes_files_and_folders() {
    let jobs = read(GOOD).unwrap();
    assert_eq!(jobs.base, Path::new("shop"));
    assert_eq!(jobs.out.as_deref(), Some(Path::new("shop/done")));
    assert_eq!(jobs.jobs.len(), 2);
    let (first, second) = (&jobs.jobs[0], &jobs.jobs[1]);
    assert_eq!(
        (first.recipe.as_path(), second.recipe.as_path()),
        (Path::new("slow.yaml"), Path::new("inch.yaml"))
    );
    assert_eq!(first.setup.as_deref(), Some(Path::new("vmc3.yaml")));
    assert_eq!((first.below.as_path(), second.below.as_path()), (Path::new(""), Path::new("us/new")));
    let place = first.files[1].place.as_ref().unwrap();
    assert_eq!(place.source.slice(place.span), b"one.cls");
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let mut text = String::new();
    for broken in [
        "",
        "version: 1\nsteps: []\n",
        "- recipe: a.yaml\n",
        "jobs: []\n",
        "jobs:\n  - { files: [a.cls] }\n",
        "jobs:\n  - { recipe: a.yaml }\n",
        "jobs:\n  - { recipe: a.yaml, files: [] }\n",
        "jobs:\n  - { recipe: a.yaml, files: a.cls }\n",
        "jobs:\n  - { recipe: '', files: [a.cls], sheep: 3 }\n",
        "jobs:\n  - { recipe: a.yaml, files: [a.cls], out: ../elsewhere }\n  - { recipe: a.yaml, files: [a.cls], out: /tmp }\n",
        "jobs:\n  - { recipe: a.yaml, files: [a.cls], out: a/../../b }\n",
    ] {
        for shown in broken.lines() {
            text.push_str(&format!("| {shown}\n"));
        }
        let mut out = Vec::new();
        line::render_lines(&mut out, &read(broken).unwrap_err(), None).unwrap();
        text.push_str(&String::from_utf8(out).unwrap());
        text.push('\n');
    }
    support::snapshots("batch").bind(|| insta::assert_snapshot!("jobs_faults", text));
}

#[test]
fn the_schema_knows_every_key() {
    let schema = jobs_schema().to_string();
    for key in ["out", "jobs", "recipe", "setup", "files"] {
        assert!(schema.contains(&format!("\"{key}\"")), "{key}");
    }
}
