// The path of a program in 3D, in a view beside its text. The page is that of reports, made by the server; it follows the
// cursor, and a click on the path moves the cursor.

import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { isProgram } from "./server_client";

/** What the page shows: the path, or the simulation with stock, chips and loads. */
export type PageContent = "path" | "simulation";

/** What the page says: that it can be told lines, or the line (from 1) that the reader chose. */
type FromPage = { ready: true } | { line: number };

interface View {
  panel: vscode.WebviewPanel;
  content: PageContent;
  /** The line (from 1) at which both are. */
  line?: number;
}

export class PathViews implements vscode.Disposable {
  /** The views by the addresses of their programs. */
  private readonly views = new Map<string, View>();
  private readonly listeners: vscode.Disposable[];

  constructor(private readonly client: () => LanguageClient | undefined) {
    this.listeners = [
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.tellLine(textEditor)),
      vscode.workspace.onDidSaveTextDocument((document) => void this.fill(document.uri)),
    ];
  }

  dispose(): void {
    this.listeners.forEach((listener) => listener.dispose());
    this.views.forEach(({ panel }) => panel.dispose());
  }

  /** Opens the view of the active program, or fills it anew. */
  async open(content: PageContent): Promise<void> {
    const document = vscode.window.activeTextEditor?.document;
    if (!document || !isProgram(document)) return;
    const key = document.uri.toString();
    let view = this.views.get(key);
    if (!view) {
      const name = document.uri.path.split("/").pop();
      const beside = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      // The page brings its own policy, by which no script runs but its own and nothing is loaded.
      const options = { enableScripts: true, localResourceRoots: [], retainContextWhenHidden: true };
      const panel = vscode.window.createWebviewPanel("clsmith.path", `Path of ${name}`, beside, options);
      view = { panel, content };
      this.views.set(key, view);
      panel.onDidDispose(() => this.views.delete(key));
      panel.webview.onDidReceiveMessage((message: FromPage) => void this.hear(document.uri, message));
    }
    view.content = content;
    await this.fill(document.uri);
  }

  /** Asks the server for the page of a program and shows it. */
  private async fill(uri: vscode.Uri): Promise<void> {
    const view = this.views.get(uri.toString()), client = this.client();
    if (!view || !client) return;
    const title = view.content === "path" ? "Drawing the path" : "Simulating";
    const place = { location: vscode.ProgressLocation.Notification, title, cancellable: true };
    try {
      await vscode.window.withProgress(place, async (_, cancel) => {
        const wanted = { command: "clsmith.pathPage", arguments: [client.code2ProtocolConverter.asUri(uri), view.content] };
        const page = await client.sendRequest<{ html: string }>("workspace/executeCommand", wanted, cancel);
        view.panel.webview.html = page.html;
      });
    } catch (error) {
      if (!(error instanceof vscode.CancellationError)) {
        void vscode.window.showErrorMessage(error instanceof Error ? error.message : String(error));
      }
    }
  }

  private tellLine(editor: vscode.TextEditor): void {
    const view = this.views.get(editor.document.uri.toString()), line = editor.selection.active.line + 1;
    // Where the page itself has moved the cursor, it knows the line.
    if (!view || view.line === line) return;
    view.line = line;
    void view.panel.webview.postMessage({ line });
  }

  private async hear(uri: vscode.Uri, message: FromPage): Promise<void> {
    const shown = vscode.window.visibleTextEditors.find(({ document }) => document.uri.toString() === uri.toString());
    const view = this.views.get(uri.toString());
    if (!view) return;
    if ("ready" in message) {
      if (shown) view.line = shown.selection.active.line + 1;
      if (view.line) void view.panel.webview.postMessage({ line: view.line });
      return;
    }
    view.line = message.line;
    const editor = shown ?? (await vscode.window.showTextDocument(uri, { viewColumn: vscode.ViewColumn.One, preserveFocus: true }));
    const line = Math.min(Math.max(message.line - 1, 0), editor.document.lineCount - 1);
    const whole = editor.document.lineAt(line).range;
    editor.selection = new vscode.Selection(whole.start, whole.start);
    editor.revealRange(whole, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  }
}
