// Colours for the editors that read no TextMate grammar, made from that of Visual Studio Code, which is made from the
// records that the reader knows. A test of `scripts/vscode-extension` compares the files.
//
//     node editors/make_colors.mjs
//
// writes them anew.

import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const GRAMMAR = new URL("vscode/syntaxes/cl.tmLanguage.json", import.meta.url);
const NOTE = "Made from the colours of editors/vscode; do not edit (`node editors/make_colors.mjs`).";

/** What a scope of the grammar is called in Vim, in Emacs, and which list of words it is in Notepad++. */
const GROUPS = {
  "keyword.control.motion": ["Statement", "font-lock-keyword-face", 1],
  "entity.name.function.cycle": ["Function", "font-lock-function-name-face", 1],
  "keyword.other.unit.rapid": ["Special", "font-lock-warning-face", 2],
  "storage.type.feed": ["Type", "font-lock-type-face", 3],
  "entity.name.type.tool": ["Identifier", "font-lock-variable-name-face", 4],
  "entity.name.tag.frame": ["PreProc", "font-lock-preprocessor-face", 5],
  "keyword.other.structure": ["Title", "font-lock-doc-face", 6],
  "comment.line.text": ["Comment", "font-lock-comment-face", 7],
  "support.function.word": ["Macro", "font-lock-builtin-face", 7],
  "variable.parameter.minor": ["Constant", "font-lock-constant-face", 8],
};

/** Foreground colours that can be read on light and on dark ground, by list of words in Notepad++. */
const INKS = ["2F74D0", "C2410C", "8A55C8", "0E8A7D", "A8660B", "C03A86", "5B7A99", "3F8F3F"];

/** The words by scope; minor words are those behind a major one. */
export function readWords() {
  const { patterns } = JSON.parse(readFileSync(GRAMMAR, "utf8"));
  const found = new Map();
  for (const { name, match, captures } of patterns) {
    const scope = (captures?.["2"]?.name ?? name).replace(/\.cl$/, "");
    const alternatives = /\(\?:N\?|\(N\?\\d\+\)\\s\+\)\?\((.+)\)\(\?=/.exec(match)?.[1] ?? (name?.includes("minor") && /\(\?:(.+)\)\(\?=/.exec(match)[1]);
    if (alternatives) found.set(scope, alternatives.replaceAll("\\*", "*").split("|"));
  }
  for (const scope of found.keys()) if (!GROUPS[scope]) throw new Error(`no colour for ${scope}`);
  return found;
}

const isMinor = (scope) => scope.includes("minor");

function vimSyntax(words) {
  const groupOf = (scope) => `cl${scope.split(".").at(-1).replace(/^./, (first) => first.toUpperCase())}`;
  const oneOf = (list) => `\\%(${list.map((word) => word.replaceAll("*", "\\*")).join("\\|")}\\)`;
  const matches = [...words].map(([scope, list]) => isMinor(scope)
    ? `syntax match ${groupOf(scope)} ~[/,]\\s*\\zs${oneOf(list)}\\ze\\s*\\%(,\\|\\$\\|$\\)~`
    : `syntax match ${groupOf(scope)} ~\\%(^\\s*\\%(N\\=\\d\\+\\s\\+\\)\\=\\)\\@40<=${oneOf(list)}\\ze\\s*\\%(/\\|\\$\\|$\\)~`);
  return [
    `" ${NOTE}`,
    'if exists("b:current_syntax") | finish | endif',
    "syntax case ignore",
    "syntax match clNumber ~\\%(\\k\\|\\.\\)\\@1<![-+]\\=\\%(\\d\\+\\.\\=\\d*\\|\\.\\d\\+\\)\\%([ed][-+]\\=\\d\\+\\)\\=\\k\\@!~",
    "syntax match clString ~'[^']*'~",
    "syntax match clOperation ~\\%(^\\s*TOOL PATH\\s*/\\)\\@40<=[^,]*~",
    ...matches,
    "syntax match clSequence ~^\\s*\\zsN\\=\\d\\+\\ze\\s\\+\\a~",
    "syntax match clContinuation ~\\$\\s*$~",
    "syntax match clRemark ~^\\s*\\%(REMARK\\|PPRINT\\)\\>.*$~",
    "syntax match clRemark ~\\$\\$.*$~",
    ...[...words.keys()].map((scope) => `highlight default link ${groupOf(scope)} ${GROUPS[scope][0]}`),
    ...["Number Number", "String String", "Operation Function", "Sequence LineNr", "Continuation SpecialChar", "Remark Comment"].map((link) => `highlight default link cl${link}`),
    'let b:current_syntax = "clsf"',
    "",
  ].join("\n");
}

function emacsWords(words) {
  const quoted = (list) => list.map((word) => JSON.stringify(word)).join(" ");
  const lists = [...words].filter(([scope]) => !isMinor(scope)).map(([scope, list]) => `    (${GROUPS[scope][1]} ${quoted(list)})`);
  const minor = [...words].filter(([scope]) => isMinor(scope)).map(([, list]) => quoted(list)).join(" ");
  return `;;; clsf-words.el --- the words of CL programs -*- lexical-binding: t -*-
;; ${NOTE}

(defconst clsf-major-words
  '(
${lists.join("\n")})
  "Major words by the face that they are shown in.")

(defconst clsf-minor-words
  '(${minor})
  "Words behind a major one.")

(provide 'clsf-words)
`;
}

function notepadLanguage(words) {
  const lists = INKS.map((_, at) => [...words].filter(([scope]) => GROUPS[scope][2] === at + 1).flatMap(([, list]) => list));
  const quoted = (word) => (/\s/.test(word) ? `&quot;${word}&quot;` : word);
  const keywords = [
    ["Comments", "00$$ 01 02((EOL)) 03 04"], ["Numbers, prefix1", "-"], ["Numbers, extras1", "."], ["Operators1", "/ ,"],
    ...lists.map((list, at) => [`Keywords${at + 1}`, list.map(quoted).join(" ")]),
    ["Delimiters", "00&apos; 01 02&apos; 03 04 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19 20 21 22 23"],
  ];
  const styles = [
    ["DEFAULT", "808080", 0], ["LINE COMMENTS", "6A8759", 0], ["NUMBERS", "A05A2C", 0], ["OPERATORS", "808080", 0],
    ...INKS.map((ink, at) => [`KEYWORDS${at + 1}`, ink, at === 7 ? 0 : 1]), ["DELIMITERS1", "A05A2C", 0],
  ];
  const prefixes = INKS.map((_, at) => `Keywords${at + 1}="no"`).join(" ");
  return `<?xml version="1.0" encoding="UTF-8" ?>
<!-- ${NOTE} -->
<NotepadPlus>
  <UserLang name="CLSF" ext="cls clsf ncl apt aptsource" udlVersion="2.1">
    <Settings>
      <Global caseIgnored="yes" allowFoldOfComments="no" foldCompact="no" forcePureLC="0" decimalSeparator="0" />
      <Prefix ${prefixes} />
    </Settings>
    <KeywordLists>
${keywords.map(([name, list]) => `      <Keywords name="${name}">${list}</Keywords>`).join("\n")}
    </KeywordLists>
    <Styles>
${styles.map(([name, ink, bold]) => `      <WordsStyle name="${name}" fgColor="${ink}" bgColor="FFFFFF" colorStyle="1" fontStyle="${bold}" nesting="0" />`).join("\n")}
    </Styles>
  </UserLang>
</NotepadPlus>
`;
}

/** The files by their place under `editors`. */
export function makeColors() {
  const words = readWords();
  return new Map([
    ["vim/syntax/clsf.vim", vimSyntax(words)],
    ["emacs/clsf-words.el", emacsWords(words)],
    ["notepad++/clsf.xml", notepadLanguage(words)],
  ]);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  for (const [name, text] of makeColors()) writeFileSync(new URL(name, import.meta.url), text);
}
