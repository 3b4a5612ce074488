// What a recipe makes of a program, beside the program as it is.

import * as vscode from "vscode";

/** What `clsmith.previewRecipe` returns. */
interface Preview {
  diff: string;
  text: string | null;
  refused: boolean;
  findings: { message: string }[];
}

const SCHEME = "clsmith-preview";

/** Texts of previews by their addresses; they are shown and never saved. */
const texts = new Map<string, string>();
let provider: vscode.Disposable | undefined;

export async function showPreview(program: string, preview: Preview | null): Promise<void> {
  if (!preview) return;
  const first = preview.findings[0]?.message;
  if (!preview.text || !preview.diff) {
    void vscode.window.showInformationMessage(first ?? "The recipe changes nothing in this program.");
    return;
  }
  if (preview.refused) void vscode.window.showWarningMessage(`clsmith apply would write nothing: ${first}`);
  provider ??= vscode.workspace.registerTextDocumentContentProvider(SCHEME, {
    provideTextDocumentContent: (uri) => texts.get(uri.toString()) ?? "",
  });
  const now = vscode.Uri.parse(program);
  const name = now.path.split("/").pop() ?? "program";
  const after = now.with({ scheme: SCHEME, query: String(texts.size) });
  texts.set(after.toString(), preview.text);
  await vscode.commands.executeCommand("vscode.diff", now, after, `${name}: by the recipe`);
}
