//! `examples/hooks`: the scripts that shops start from, run without their CAM systems.

use super::hook::{PYTHON, log, post};
use super::{clsmith, example, names};
use crate::support::require_program;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn hooks() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hooks")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A command as long as NX would not be there: its variables and commands, and a CLSF handler that writes the program.
const NX: &str = r#"
encoding system utf-8
set mom_output_file_directory "[file join [pwd] exports]/"
set mom_output_file_basename "Gehäuse 7"
set mom_output_file_suffix cls
proc MOM_output_to_listing_device {text} { puts $text }
proc MOM_abort {text} { puts "ABORTED: $text"; exit 9 }
proc MOM_close_output_file {name} {
    global channel closed
    set closed $name
    close $channel
}
# As NX does: the output is open, and part of it not yet in the file.
set from [open part.cls]; set program [read $from]; close $from
file mkdir exports
set channel [open "${mom_output_file_directory}$mom_output_file_basename.$mom_output_file_suffix" w]
puts -nonewline $channel [string range $program 0 500]
proc MOM_end_of_program {} {
    global channel program
    puts -nonewline $channel [string range $program 501 end]
}
"#;

/// Runs the Tcl snippet as the last line of a handler; `None` where there is no tclsh.
fn nx(folder: &Path, hook: &[&str], post: &str, before: &str) -> Option<Output> {
    let tclsh = require_program(&["tclsh"])?;
    let clsmith = env!("CARGO_BIN_EXE_clsmith");
    let hook: Vec<String> = hook.iter().map(|word| format!("{{{word}}}")).collect();
    let script = format!(
        "{NX}\n{before}\n\
         set clsmith_hook [list {{{clsmith}}} hook {} --log log.jsonl]\n\
         set clsmith_post {post}\n\
         source {{{}}}\n\
         MOM_end_of_program\n\
         puts \"closed $closed\"\n",
        hook.join(" "),
        hooks().join("nx/clsmith_hook.tcl").display(),
    );
    fs::write(folder.join("nx.tcl"), script).unwrap();
    Some(Command::new(tclsh).current_dir(folder).env("LC_ALL", "C.UTF-8").arg("nx.tcl").output().unwrap())
}

#[test]
fn nx_posts_the_corrected_program_at_the_end_of_its_output() {
    let folder = example("pocket");
    let Some(python) = require_program(&PYTHON) else { return };
    let post = format!("[list {{{}}} {{{}}} --beside \\{{\\}}]", python.display(), post().display());
    let Some(output) = nx(folder.path(), &["--recipe", "recipe.yaml"], &post, "") else { return };
    let said = text(&output.stdout);
    assert!(output.status.success(), "{said}{}", text(&output.stderr));
    assert!(said.contains("corrected by recipe.yaml") && said.contains("Gehäuse 7.cls\n"), "{said}");
    let export = folder.path().join("exports/Gehäuse 7.cls");
    assert_eq!(fs::read(export).unwrap(), fs::read(folder.path().join("part.cls")).unwrap());
    let nc = fs::read_to_string(folder.path().join("exports/Gehäuse 7.nc")).unwrap();
    assert!(nc.contains("F600"), "{nc}");
    assert_eq!(log(folder.path())[0]["outcome"], "corrected");
}

#[test]
fn nx_aborts_when_the_program_is_refused_or_the_post_fails() {
    let folder = example("pocket");
    let post = "[list sh -c {echo out of licences; exit 4} \\{\\}]";
    let Some(output) = nx(folder.path(), &["--recipe", "recipe.yaml"], post, "") else { return };
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(9), "{said}{}", text(&output.stderr));
    assert!(
        said.contains("out of licences") && said.contains("ABORTED: clsmith hook ended with 4"),
        "{said}"
    );
    assert!(!said.contains("child process exited"), "{said}");
    let output = nx(folder.path(), &["--recipe", "missing.yaml"], post, "").unwrap();
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(9), "{said}");
    assert!(said.contains("CL0401") && said.contains("ABORTED: clsmith hook ended with 125"), "{said}");
}

#[test]
fn nx_handlers_of_post_builder_know_their_file_themselves() {
    let folder = example("pocket");
    let before = "set ptp_file_name \"${mom_output_file_directory}$mom_output_file_basename.cls\"\n\
                  set mom_output_file_basename wrong";
    let Some(output) = nx(folder.path(), &["--recipe", "recipe.yaml"], "[list true \\{\\}]", before) else {
        return;
    };
    assert!(output.status.success(), "{}{}", text(&output.stdout), text(&output.stderr));
    assert_eq!(log(folder.path()).len(), 1);
}

/// Runs a shell script on a program with a blank in its path.
#[cfg(unix)]
fn script(folder: &Path, script: &str, program: &str) -> Output {
    let mut path = OsString::from(Path::new(env!("CARGO_BIN_EXE_clsmith")).parent().unwrap());
    path.push(":");
    path.push(std::env::var_os("PATH").unwrap());
    let mut command = Command::new(hooks().join(script));
    command.current_dir(folder).env("PATH", path).env("LOG", "log.jsonl").env("RECIPES", "recipes.yaml");
    command.arg(program).output().unwrap()
}

#[cfg(unix)]
#[test]
fn the_scripts_for_catia_and_creo_post_beside_the_export() {
    if require_program(&PYTHON).is_none() {
        return;
    }
    for (hook, name, nc) in [
        ("catia/clsmith-hook.sh", "work 7/part.aptsource", "work 7/part.nc"),
        ("creo/clsmith-hook.sh", "work 7/op010.ncl.12", "work 7/op010.tap"),
    ] {
        let folder = example("pocket");
        fs::create_dir(folder.path().join("work 7")).unwrap();
        fs::rename(folder.path().join("part.cls"), folder.path().join(name)).unwrap();
        let rules = "rules:\n- when: { operation: HOLES }\n  recipe: recipe.yaml\n";
        fs::write(folder.path().join("recipes.yaml"), rules).unwrap();
        let output = script(folder.path(), hook, name);
        assert!(output.status.success(), "{hook}: {}", text(&output.stderr));
        assert!(fs::read_to_string(folder.path().join(nc)).unwrap().contains("F600"), "{hook}");
        assert_eq!(names(&folder.path().join("work 7")).len(), 2);
        assert_eq!(log(folder.path())[0]["recipe"]["chosen_by"], "rule 1");
        // No rule fits: the script ends with the hook's code.
        fs::write(folder.path().join("recipes.yaml"), rules.replace("HOLES", "OTHER")).unwrap();
        assert_eq!(script(folder.path(), hook, name).status.code(), Some(125), "{hook}");
    }
}

#[test]
fn the_shipped_selection_chooses() {
    let Some(python) = require_program(&PYTHON) else { return };
    let folder = example("pocket");
    let mut command = clsmith(folder.path());
    command.args(["hook", "--select"]).arg(hooks().join("recipes.yaml")).arg("--log").arg("log.jsonl");
    command.args(["part.cls", "--"]).arg(python).arg(post()).arg("{}").assert().code(0);
    let line = &log(folder.path())[0];
    assert_eq!((&line["recipe"]["chosen_by"], &line["outcome"]), (&"rule 1".into(), &"corrected".into()));
    // Every recipe that it names is there.
    let rules = crate::support::source(&hooks().join("recipes.yaml"));
    for choice in clsmith::recipe_rules::RecipeRules::load(&rules).unwrap().list_choices() {
        let clsmith::recipe_rules::RecipeChoice::Recipe { recipe, .. } = choice else { continue };
        assert!(hooks().join(&recipe).exists(), "{}", recipe.display());
    }
}
