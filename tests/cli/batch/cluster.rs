//! What `examples/cluster` shows, without the clusters.

use super::{clsmith, lines, shop, tree, write};
use std::path::{Path, PathBuf};
use std::process::Command;

fn cluster() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/cluster")
}

const JOBS: &str = "out: done\njobs:\n  - { recipe: r.yaml, files: ['programs/**/*.cls'] }\n";

/// A command of a shell that finds clsmith, in a folder.
fn shell(folder: &Path) -> Command {
    let own = Path::new(env!("CARGO_BIN_EXE_clsmith")).parent().unwrap();
    let path = format!("{}:{}", own.display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("bash");
    command.current_dir(folder).env("PATH", path);
    command
}

#[test]
fn the_jobs_file_is_good() {
    let out = tempfile::tempdir().unwrap();
    let jobs = cluster().join("jobs.yaml");
    clsmith(out.path()).arg("batch").arg(jobs).args(["-q", "--output", "done"]).assert().success();
    assert!(lines(&out.path().join("done/results.jsonl")).len() >= 5);
    assert!(out.path().join("done/inch/part.aptsource").exists());
}

#[cfg(unix)]
#[test]
fn the_slurm_scripts_do_a_shard_and_merge() {
    let shop = shop(5);
    write(shop.path(), "jobs.yaml", JOBS);
    let run = |script: &str, settings: &[(&str, &str)]| {
        let mut command = shell(shop.path());
        command.arg(cluster().join("slurm").join(script)).envs(settings.iter().copied());
        let done = command.output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    };
    let jobs = ("JOBS", "jobs.yaml");
    run(
        "batch.sbatch",
        &[jobs, ("SLURM_ARRAY_TASK_ID", "1"), ("SLURM_ARRAY_TASK_COUNT", "2"), ("SLURM_MEM_PER_NODE", "500")],
    );
    // One task of two alone.
    let one = [jobs, ("SLURM_ARRAY_TASK_ID", "2"), ("SLURM_ARRAY_TASK_COUNT", "1"), ("SHARDS", "2")];
    run("batch.sbatch", &[&one[..], &[("SLURM_MEM_PER_CPU", "100"), ("SLURM_CPUS_PER_TASK", "2")]].concat());
    run("merge.sbatch", &[("OUT", "done"), ("SHARDS", "2")]);
    assert_eq!(lines(&shop.path().join("done/results.jsonl")).len(), 5);
}

#[cfg(unix)]
#[test]
fn the_kubernetes_job_does_every_shard() {
    let shop = shop(9);
    write(shop.path(), "jobs.yaml", JOBS);
    let text = std::fs::read_to_string(cluster().join("kubernetes/job.yaml")).unwrap();
    let job: serde_yaml::Value = serde_yaml::from_str(&text).unwrap();
    let spec = &job["spec"];
    let container = &spec["template"]["spec"]["containers"][0];
    let shards = container["env"][0]["value"].as_str().unwrap();
    let completions = spec["completions"].as_u64().unwrap();
    assert_eq!(shards, completions.to_string());
    let script = container["args"][0].as_str().unwrap().replace("/shop/", "");
    for index in 0..completions {
        let mut command = shell(shop.path());
        command.args(["-c", &script]).env("JOB_COMPLETION_INDEX", index.to_string());
        let done = command.envs([("SHARDS", shards), ("CPUS", "4"), ("MEMORY_MI", "100")]).output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    }
    assert_eq!(tree(&shop.path().join("done")).len(), 9 + 8, "programs, and a result each");
}

#[test]
fn the_condor_file_names_options_that_exist() {
    let shop = shop(3);
    write(shop.path(), "jobs.yaml", JOBS);
    let text = std::fs::read_to_string(cluster().join("htcondor/batch.sub")).unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix("arguments")).unwrap();
    let arguments = line.trim_start_matches([' ', '=']).trim_matches('"');
    let arguments =
        arguments.replace("$(jobs)", "jobs.yaml").replace("$INT(shard)", "8").replace("$(shards)", "8");
    clsmith(shop.path()).args(arguments.split(' ')).assert().success();
    assert!(shop.path().join("done/results-8-of-8.jsonl").exists());
}
