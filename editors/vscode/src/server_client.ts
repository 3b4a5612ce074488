// The client of `clsmith lsp`.

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";
import { showPreview } from "./preview";

/** The languages of programs. */
export const PROGRAMS = ["clsf", "apt", "ncl"];

export function isProgram(document: vscode.TextDocument): boolean {
  return PROGRAMS.includes(document.languageId);
}

/** The command as it is set. */
export function commandPath(): string {
  return vscode.workspace.getConfiguration("clsmith").get<string>("path") || "clsmith";
}

/** The settings as the server takes them; the path of the setup is that of a file. */
export function serverSettings(): { setup: string; documentation: string; clientShowsPreviews: boolean } {
  const settings = vscode.workspace.getConfiguration("clsmith");
  const setup = settings.get<string>("setup") ?? "";
  return {
    setup: setup && resolveInWorkspace(setup),
    documentation: settings.get<string>("documentation") ?? "",
    clientShowsPreviews: true,
  };
}

function resolveInWorkspace(path: string): string {
  const folder = vscode.workspace.workspaceFolders?.[0];
  const isWhole = path.startsWith("/") || path.startsWith("\\") || /^[A-Za-z]:/.test(path);
  return folder && !isWhole ? vscode.Uri.joinPath(folder.uri, path).fsPath : path;
}

export function makeClient(): LanguageClient {
  const server: ServerOptions = { command: commandPath(), args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [...PROGRAMS.map((language) => ({ language })), { language: "yaml" }],
    initializationOptions: serverSettings(),
    middleware: {
      // The server's previews are shown as the editor shows differences.
      executeCommand: async (command, args, next) => {
        const done = await next(command, args);
        if (command === "clsmith.previewRecipe") await showPreview(String(args[1]), done);
        return done;
      },
      workspace: {
        didChangeConfiguration: async (_sections, _next) => {
          await client.sendNotification("workspace/didChangeConfiguration", { settings: { clsmith: serverSettings() } });
        },
      },
    },
    synchronize: { configurationSection: "clsmith" },
  };
  const client = new LanguageClient("clsmith", "clsmith", server, options);
  return client;
}
