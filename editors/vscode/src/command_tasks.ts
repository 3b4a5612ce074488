// Runs of the command as tasks, whose findings the problem matcher reads.

import * as vscode from "vscode";
import { commandPath, isProgram, serverSettings } from "./server_client";

/** Checks the saved program by `clsmith check`. */
export async function checkProgram(): Promise<void> {
  const program = await savedProgram();
  if (program) await runTask("check", ["check", "--format", "line", program.fsPath, ...setupWords()]);
}

/** Corrects the saved program by a recipe that is chosen, into a file that is chosen. */
export async function applyRecipe(): Promise<void> {
  const program = await savedProgram();
  const recipe = program && (await chooseRecipe());
  if (!program || !recipe) return;
  const end = program.path.lastIndexOf(".");
  const proposed = program.with({ path: `${program.path.slice(0, end)}-corrected${program.path.slice(end)}` });
  const output = await vscode.window.showSaveDialog({ defaultUri: proposed, title: "The corrected program" });
  if (!output) return;
  // The report of the run, by which `undo` and `goToRecipeStep` find what was changed.
  const report = `${output.fsPath}.json`;
  const words = ["apply", recipe.fsPath, program.fsPath, "-o", output.fsPath, "--json", report, "--format", "line"];
  const code = await runTask("apply", [...words, ...setupWords()]);
  if (code === 0) await vscode.window.showTextDocument(output);
}

function setupWords(): string[] {
  const { setup } = serverSettings();
  return setup ? ["--setup", setup] : [];
}

/** The program of the active editor, saved. */
async function savedProgram(): Promise<vscode.Uri | undefined> {
  const document = vscode.window.activeTextEditor?.document;
  if (!document || !isProgram(document)) return undefined;
  const isSaved = !document.isDirty || (await document.save());
  return isSaved && document.uri.scheme === "file" ? document.uri : undefined;
}

/** A recipe of the workspace: a YAML file with `steps:`. */
async function chooseRecipe(): Promise<vscode.Uri | undefined> {
  const files = await vscode.workspace.findFiles("**/*.{yaml,yml}", "**/node_modules/**", 500);
  const isRecipe = await Promise.all(
    files.map(async (file) => /^steps:/m.test(Buffer.from(await vscode.workspace.fs.readFile(file)).toString("utf8"))),
  );
  const items = files
    .filter((_, at) => isRecipe[at])
    .map((uri) => ({ label: vscode.workspace.asRelativePath(uri), uri }))
    .sort((a, b) => a.label.localeCompare(b.label));
  if (items.length === 0) {
    void vscode.window.showInformationMessage("There is no recipe in this workspace; `clsmith init` writes a first one.");
    return undefined;
  }
  return (await vscode.window.showQuickPick(items, { title: "The recipe" }))?.uri;
}

/** Runs the command and returns its exit code. */
async function runTask(name: string, words: string[]): Promise<number | undefined> {
  const run = new vscode.ProcessExecution(commandPath(), words);
  const scope = vscode.workspace.workspaceFolders?.[0] ?? vscode.TaskScope.Workspace;
  const task = new vscode.Task({ type: "clsmith", task: name }, scope, name, "clsmith", run, "$clsmith");
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Silent, clear: true };
  const ended = new Promise<number | undefined>((resolve) => {
    const listener = vscode.tasks.onDidEndTaskProcess((event) => {
      if (event.execution.task.name !== name || event.execution.task.source !== "clsmith") return;
      listener.dispose();
      resolve(event.exitCode);
    });
  });
  await vscode.tasks.executeTask(task);
  return ended;
}
