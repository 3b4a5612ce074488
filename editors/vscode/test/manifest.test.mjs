// What the manifest promises is there: files, commands, settings, and findings as the command writes them.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

const ROOT = new URL("../", import.meta.url);
const read = (name) => readFileSync(new URL(name, ROOT), "utf8");
const manifest = JSON.parse(read("package.json"));
const sources = readdirSync(new URL("src/", ROOT)).map((name) => read(`src/${name}`)).join("\n");

test("files that the manifest names are there", () => {
  const { languages, grammars } = manifest.contributes;
  const files = [...languages.map((one) => one.configuration), ...grammars.map((one) => one.path), manifest.main];
  for (const file of files) assert.ok(existsSync(new URL(file, ROOT)), file);
  for (const { language } of grammars) assert.ok(languages.some(({ id }) => id === language), language);
  assert.equal(manifest.version, /^version = "(.*)"$/m.exec(readFileSync(new URL("../../Cargo.toml", ROOT), "utf8"))[1]);
});

test("every command and every setting of the manifest is one of the extension, and the other way round", () => {
  const promised = manifest.contributes.commands.map(({ command }) => command).sort();
  const registered = [...sources.matchAll(/^ {2}command\("(\w+)"/gm)].map(([, name]) => `clsmith.${name}`).sort();
  assert.deepEqual(registered, promised);
  const settings = Object.keys(manifest.contributes.configuration.properties).map((name) => name.split(".")[1]);
  const asked = [...sources.matchAll(/\.get<string>\("(\w+)"\)/g)].map(([, name]) => name);
  assert.deepEqual([...new Set(asked)].sort(), settings.sort());
});

test("the problem matcher reads what the command writes", () => {
  const { regexp, file, line, column, code, message } = manifest.contributes.problemMatchers[0].pattern;
  const folder = mkdtempSync(join(tmpdir(), "clsmith-"));
  try {
    writeFileSync(join(folder, "part 1.cls"), "FEDRAT/MMPM,12O0\nGOTO/1,2,3\n");
    const checked = [process.env.CLSMITH, ["check", "--format", "line", "part 1.cls"], { cwd: folder, stdio: "pipe", encoding: "utf8" }];
    let text;
    assert.throws(() => execFileSync(...checked), (error) => ((text = error.stdout + error.stderr), error.status === 1));
    const found = text.split("\n").map((one) => new RegExp(regexp).exec(one)).filter(Boolean);
    const bad = found.find((one) => one[code] === "CL0003");
    assert.deepEqual([bad[file], bad[line], bad[column]], ["part 1.cls", "1", "13"], text);
    assert.match(bad[message], /12O0/);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
