// The extension: starts the server, and adds what the protocol does not know: the path in 3D, and the command's own runs.

import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { applyRecipe, checkProgram } from "./command_tasks";
import { goToFeed, goToRecipeStep } from "./line_commands";
import { PathViews } from "./path_views";
import { makeClient } from "./server_client";

let client: LanguageClient | undefined;

/** Called by the editor when a program or a YAML file is opened. Returns what tests look at. */
export async function activate(context: vscode.ExtensionContext): Promise<{ client: () => LanguageClient | undefined }> {
  const views = new PathViews(() => client);
  const command = (name: string, run: () => unknown) =>
    context.subscriptions.push(vscode.commands.registerCommand(`clsmith.${name}`, run));
  command("showPath", () => views.open("path"));
  command("simulate", () => views.open("simulation"));
  command("check", checkProgram);
  command("apply", applyRecipe);
  command("goToNextFeed", () => goToFeed(client, "next"));
  command("goToLastFeed", () => goToFeed(client, "last"));
  command("goToRecipeStep", () => goToRecipeStep(client));
  command("restart", restart);
  context.subscriptions.push(
    views,
    vscode.workspace.onDidChangeConfiguration((changed) => {
      if (changed.affectsConfiguration("clsmith.path")) void restart();
    }),
  );
  await start();
  return { client: () => client };
}

export async function deactivate(): Promise<void> {
  await client?.stop();
}

async function start(): Promise<void> {
  client = makeClient();
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    const settings = "Open the settings";
    const text = `clsmith cannot be started: ${error instanceof Error ? error.message : error}. Is it installed?`;
    const chosen = await vscode.window.showErrorMessage(text, settings);
    if (chosen === settings) await vscode.commands.executeCommand("workbench.action.openSettings", "clsmith.path");
  }
}

async function restart(): Promise<void> {
  await client?.stop();
  await start();
}
