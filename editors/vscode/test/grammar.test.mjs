// The colours of programs, by the engine that the editor uses.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";

const require = createRequire(import.meta.url);
const oniguruma = require("vscode-oniguruma");
const { Registry, parseRawGrammar } = require("vscode-textmate");

const ROOT = new URL("../", import.meta.url);
const GRAMMAR = new URL("syntaxes/cl.tmLanguage.json", ROOT);

async function loadGrammar() {
  await oniguruma.loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
  const onigLib = Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  });
  const loadGrammar = async () => parseRawGrammar(readFileSync(GRAMMAR, "utf8"), GRAMMAR.pathname);
  return new Registry({ onigLib, loadGrammar }).loadGrammar("source.cl");
}

const grammar = await loadGrammar();

/** The tokens of a line that have a scope of their own: text and the first part of the scope. */
function colors(line) {
  const { tokens } = grammar.tokenizeLine(line);
  return tokens
    .filter(({ scopes }) => scopes.length > 1)
    .map(({ startIndex, endIndex, scopes }) => [line.slice(startIndex, endIndex).trim(), scopes.at(-1)])
    .filter(([text]) => text);
}

const NUMBER = "constant.numeric.cl", MINOR = "variable.parameter.minor.cl";

test("words of each kind have their scopes", () => {
  for (const [line, wanted] of [
    ["GOTO/1.5,-2.,.25", [["GOTO", "keyword.control.motion.cl"], ["1.5", NUMBER], ["-2.", NUMBER], [".25", NUMBER]]],
    ["FEDRAT/MMPM,1200.0000", [["FEDRAT", "storage.type.feed.cl"], ["MMPM", MINOR], ["1200.0000", NUMBER]]],
    ["fedrat/  300.5, mmpm", [["fedrat", "storage.type.feed.cl"], ["300.5", NUMBER], ["mmpm", MINOR]]],
    ["RAPID", [["RAPID", "keyword.other.unit.rapid.cl"]]],
    ["TOOL PATH/POCKET 3,TOOL,EM12",
      [["TOOL PATH", "keyword.other.structure.cl"], ["POCKET 3", "entity.name.section.cl"], ["TOOL", MINOR]]],
    ["$$ GOTO/1,2,3", [["$$ GOTO/1,2,3", "comment.line.cl"]]],
    ["N0010 GOTO/1", [["N0010", "constant.numeric.sequence.cl"], ["GOTO", "keyword.control.motion.cl"], ["1", NUMBER]]],
    ["END-OF-PATH", [["END-OF-PATH", "keyword.other.structure.cl"]]],
    ["SPINDL/RPM,5000,CLW", [["SPINDL", "storage.type.feed.cl"], ["RPM", MINOR], ["5000", NUMBER], ["CLW", MINOR]]],
    ["GOTOX/1", [["1", NUMBER]]],
  ]) {
    assert.deepEqual(colors(line), wanted, line);
  }
});

test("every line of the fixtures is coloured, and no line takes long", () => {
  for (const [name, least] of [["nx/contour-crlf.cls", 0.9], ["catia/web-ramps.aptsource", 0.9], ["creo/web-ramps.ncl", 0.9]]) {
    const text = readFileSync(new URL(`../../tests/fixtures/${name}`, ROOT), "latin1");
    const lines = text.split(/\r?\n/).filter((line) => line.trim());
    const colored = lines.filter((line) => colors(line).length > 0);
    assert.ok(colored.length >= least * lines.length, `${name}: ${colored.length} of ${lines.length}`);
  }
  const begun = performance.now();
  colors(`GOTO/${"1.0000,".repeat(20_000)}`);
  colors("A".repeat(100_000));
  assert.ok(performance.now() - begun < 5000);
});
