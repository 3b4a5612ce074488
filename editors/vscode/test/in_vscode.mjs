// The packed extension in a real Visual Studio Code: the one that code-server brings, in a Chromium.
//
//     node in_vscode.mjs VSCODE EXTENSION.vsix [PICTURES]
//
// VSCODE is its folder, `lib/vscode` of code-server; CLSMITH is the command. Pictures are written where a folder is given.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { Chromium, pause } from "./chromium.mjs";

const [vscode, extension, pictures] = process.argv.slice(2);
const PORT = 18_230, ENTER = ["Enter", 13], F1 = ["F1", 112];
const ROOT = new URL("../../../", import.meta.url).pathname;

const folder = mkdtempSync(join(tmpdir(), "clsmith-vscode-")), workspace = join(folder, "pocket");
const data = ["--accept-server-license-terms", "--extensions-dir", join(folder, "extensions"), "--user-data-dir", join(folder, "data")];
const main = join(vscode, "out/server-main.js");
// Tasks need the part of terminals in C++, which has a binary for some machines.
const hasTerminal = existsSync(join(vscode, `node_modules/node-pty/prebuilds/${process.platform}-${process.arch}`));

function prepare() {
  const settings = { "clsmith.path": resolve(process.env.CLSMITH), "workbench.startupEditor": "none" };
  cpSync(join(ROOT, "examples/pocket"), workspace, { recursive: true });
  mkdirSync(join(folder, "data/Machine"), { recursive: true });
  writeFileSync(join(folder, "data/Machine/settings.json"), JSON.stringify(settings));
  execFileSync("node", [main, ...data, "--install-extension", resolve(extension)], { stdio: "ignore" });
}

const statusBar = "document.querySelector('.statusbar')?.textContent ?? ''";
const lineOfCursor = `Number((${statusBar}).match(/Ln (\\d+)/)?.[1])`;

/** Opens a quick input by its key, types into it, and takes what is offered under this name. */
async function quickly(browser, key, text, offered) {
  const isOpen = "document.activeElement.matches('.quick-input-widget input')";
  // Keys are heard once the workbench has read its settings.
  for (let tries = 0; tries < 20 && !(await browser.value(isOpen)); tries++) {
    await browser.press(...key);
    await pause(1000);
  }
  await browser.wait(isOpen);
  await browser.type(text);
  if (offered) {
    const place = `[...document.querySelectorAll('.quick-input-list .monaco-list-row')].findIndex((row) =>
      row.querySelector('.label-name').textContent.trim() === ${JSON.stringify(offered)})`;
    await browser.wait(`${place} >= 0`);
    for (let left = await browser.value(place); left > 0; left--) await browser.press("ArrowDown", 40);
  }
  await browser.press(...ENTER);
}

/** Runs a command by its title. */
const run = (browser, title) => quickly(browser, F1, title, title);

async function goToLine(browser, line) {
  await quickly(browser, ["g", 71, 2], `${line}`);
  await browser.wait(`${lineOfCursor} === ${line}`);
}

async function openFile(browser, name) {
  await quickly(browser, ["p", 80, 2], name, name);
  await browser.wait(`document.querySelector('.tab.active')?.textContent.includes(${JSON.stringify(name)})`);
}

async function check(browser) {
  await browser.call("Page.navigate", { url: `http://127.0.0.1:${PORT}/?folder=${workspace}` });
  await browser.wait("[...document.querySelectorAll('.monaco-list-row')].some((row) => row.textContent.includes('part.cls'))");
  await openFile(browser, "part.cls");
  await browser.wait(`(${statusBar}).includes('CLSF')`);
  console.log("ok: the file has its language");
  await browser.wait("new Set([...document.querySelectorAll('.view-line span span')].map((part) => part.className)).size > 3");
  console.log("ok: words are coloured");
  await browser.wait("document.querySelector('.view-lines').textContent.replaceAll('\\u00a0', ' ').includes('1200 MMPM')");
  console.log("ok: the server runs, the feed stands behind its motion");

  await run(browser, "Explorer: Focus on Outline View");
  await browser.wait("['POCKET_ROUGH', 'HOLES'].every((name) => document.querySelector('.outline-tree')?.textContent.includes(name))");
  console.log("ok: the outline has the operations");
  await goToLine(browser, 20);
  await run(browser, "Show or Focus Hover");
  await browser.wait("document.querySelector('.monaco-hover:not(.hidden)')?.textContent.includes('1200 MMPM (1200 mm/min, 47.244 inch/min)')");
  console.log("ok: what holds at a line");
  await browser.press("Escape", 27);

  await run(browser, "clsmith: Show the path in 3D");
  const page = await browser.frame("!!window.clsmith?.listing?.text && clsmith.shown.count > 0");
  console.log("ok: the path is drawn beside the text");
  // The page's own policy holds there: it has loaded nothing.
  assert.deepEqual(await browser.value("performance.getEntriesByType('resource').map(({ name }) => name)", page), []);
  await goToLine(browser, 22);
  await browser.wait("clsmith.lineOfPlace() === 22", page);
  console.log("ok: the page follows the cursor");
  await browser.value("clsmith.goTo(clsmith.shown.motionOfRow(18))", page);
  await browser.wait(`${lineOfCursor} === 19`);
  console.log("ok: the cursor follows the page");
  await takePictures(browser);

  await goToLine(browser, 19);
  await browser.press("End", 35);
  await browser.press("Backspace", 8);
  await browser.type("O");
  await browser.wait("document.querySelector('.squiggly-error') !== null");
  console.log("ok: a finding while typing");
  await browser.press("Escape", 27);
  await run(browser, "Quick Fix...");
  await browser.wait("document.querySelector('.action-widget')?.textContent.includes('-4.0000')");
  await browser.press(...ENTER);
  await browser.wait("document.querySelector('.squiggly-error') === null");
  console.log("ok: its repair");
  await run(browser, "File: Revert File");

  await openFile(browser, "recipe.yaml");
  const lens = "[...document.querySelectorAll('.codelens-decoration a')].find((link) => link.textContent.includes('preview this recipe on part.cls'))";
  await browser.wait(`!!${lens}`);
  const before = readFileSync(join(workspace, "part.cls"), "utf8");
  const isShown = "!!document.querySelector('.monaco-diff-editor .line-insert, .monaco-diff-editor .char-insert')";
  // It moves to its place after it has appeared, so a click may come too early.
  for (let tries = 0; tries < 10 && !(await browser.value(isShown)); tries++) {
    await pause(2000);
    if (await browser.value(`!!${lens}`)) await browser.click(lens);
    await pause(3000);
  }
  await browser.wait(isShown);
  console.log("ok: the preview of a recipe is a diff");
  assert.equal(readFileSync(join(workspace, "part.cls"), "utf8"), before, "a preview writes nothing");
  if (hasTerminal) await applyRecipe(browser);
}

/** Applies the recipe by the command, and goes from a feed that it changed to the step. */
async function applyRecipe(browser) {
  await openFile(browser, "part.cls");
  await run(browser, "clsmith: Apply a recipe to this program");
  await browser.wait("document.querySelector('.quick-input-widget')?.textContent.includes('recipe.yaml')");
  await browser.press(...ENTER);
  await browser.wait("[...document.querySelectorAll('.quick-input-widget input')].some(({ value }) => value.endsWith('part-corrected.cls'))");
  await browser.press(...ENTER);
  await browser.wait("document.querySelector('.tab.active')?.textContent.includes('part-corrected.cls')");
  console.log("ok: a recipe is applied as a task, and the file that it made opens");
  const changed = readFileSync(join(workspace, "part-corrected.cls"), "utf8").split("\n").findIndex((line) => line.includes("600.0000")) + 1;
  await goToLine(browser, changed);
  await run(browser, "clsmith: Go to the recipe step that changed this line");
  await browser.wait("document.querySelector('.tab.active')?.textContent.includes('recipe.yaml')");
  await browser.wait(`${lineOfCursor} === 6`);
  console.log("ok: from a changed feed to the step of the recipe");
}

async function takePictures(browser) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  for (const [width, theme] of [[1280, "Light Modern"], [1280, "Dark Modern"], [1920, "Dark Modern"], [1920, "Light Modern"]]) {
    await browser.resize([width, (width * 9) / 16]);
    await run(browser, "Preferences: Color Theme");
    await browser.wait("document.querySelector('.quick-input-widget')?.textContent.includes('Dark Modern')");
    await browser.type(theme);
    await pause(500);
    await browser.press(...ENTER);
    await pause(3000);
    await browser.picture(join(pictures, `editor-vscode-${width}-${theme.split(" ")[0].toLowerCase()}.png`));
  }
}

prepare();
const server = spawn("node", [main, ...data, "--host", "127.0.0.1", "--port", `${PORT}`, "--without-connection-token", "--disable-workspace-trust"],
  { stdio: "ignore" });
const browser = await Chromium.start(process.env.CHROMIUM ?? "chromium", [1280, 720]);
try {
  for (let tries = 0; tries < 100 && !(await fetch(`http://127.0.0.1:${PORT}/`).catch(() => false)); tries++) await pause(200);
  await check(browser);
  console.log("the extension does in Visual Studio Code what it should");
} catch (error) {
  await browser.picture(join(tmpdir(), "clsmith-vscode.png"));
  console.error(`a picture of it: ${join(tmpdir(), "clsmith-vscode.png")}`);
  throw error;
} finally {
  await browser.end();
  server.kill();
  rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
}
