// Commands that lead from the line of the cursor to another place.

import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { isProgram } from "./server_client";

/** Asks the server for a command at the cursor. It shows the place by itself. */
async function askAtCursor(client: LanguageClient | undefined, command: string): Promise<unknown> {
  const editor = vscode.window.activeTextEditor;
  if (!client || !editor || !isProgram(editor.document)) return undefined;
  const { line, character } = editor.selection.active;
  const uri = client.code2ProtocolConverter.asUri(editor.document.uri);
  return client.sendRequest("workspace/executeCommand", { command, arguments: [uri, { line, character }] });
}

export async function goToFeed(client: LanguageClient | undefined, which: "next" | "last"): Promise<void> {
  const found = await askAtCursor(client, which === "next" ? "clsmith.nextFeed" : "clsmith.lastFeed");
  if (found === null) void vscode.window.showInformationMessage(`There is no ${which} feed.`);
}

export async function goToRecipeStep(client: LanguageClient | undefined): Promise<void> {
  try {
    await askAtCursor(client, "clsmith.recipeStep");
  } catch (error) {
    // The server says why there is no step.
    void vscode.window.showInformationMessage(error instanceof Error ? error.message : String(error));
  }
}
