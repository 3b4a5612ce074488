// The colours of other editors are made from those of this one.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { makeColors, readWords } from "../../../editors/make_colors.mjs";

const EDITORS = new URL("../../../editors/", import.meta.url);

test("the files of other editors are as they are made", () => {
  for (const [name, text] of makeColors()) {
    assert.equal(readFileSync(new URL(name, EDITORS), "utf8"), text, `${name} is older; \`node editors/make_colors.mjs\` writes it`);
  }
});

test("every word of the grammar is in each of them", () => {
  const words = [...readWords().values()].flat();
  for (const word of ["GOTO", "FEDRAT", "TOOL PATH", "RAPID", "MMPM"]) assert.ok(words.includes(word), word);
  for (const [name, text] of makeColors()) {
    for (const word of words) assert.ok(text.includes(word), `${name}: ${word}`);
  }
});
