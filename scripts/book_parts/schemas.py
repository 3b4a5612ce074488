"""The keys of recipes' surroundings, from their JSON Schemas: setups with machines, selections, jobs files."""

import json
from pathlib import Path

from .commands import say
from .findings import plain

FILES = [
    ("setup", "Setup and machine", "What a simulation has to know and CL data does not say: machine, stock, tools, material. "
     "The same keys stand under `setup:` of a recipe and in a file of their own (`--setup`)."),
    ("select", "Selections", "Which recipe a program gets, for `hook --select` and `watch --select`."),
    ("jobs", "Jobs files", "What `clsmith batch jobs.yaml` does."),
    ("material", "Materials", "What an edge needs in a material, for `material: { file: ... }` of a setup."),
    ("profile", "Profiles", "A profile in a plane, for `clsmith section --profile`."),
]


def write(clsmith: Path, pages: Path) -> list[tuple[str, str]]:
    (pages / "files").mkdir()
    for name, title, intro in FILES:
        schema = json.loads(say(clsmith, "schema", f"--{name}"))
        lines = [f"# {title}\n\n{intro} Made from `clsmith schema --{name}`, with which editors complete and check.\n"]
        describe(schema, schema, 0, [], lines)
        (pages / "files" / f"{name}.md").write_text("\n".join(lines) + "\n", "utf-8")
    return [(title, f"files/{name}.md") for name, title, _ in FILES]


def resolve(node: dict, root: dict) -> dict:
    """The node with what its reference or its only alternative beside null says; words of its own come first."""
    while True:
        choices = [choice for choice in node.get("anyOf", node.get("allOf", [])) if choice.get("type") != "null"]
        if "$ref" in node:
            name = node["$ref"].rsplit("/", 1)[1]
            node = {**root["$defs"][name], **{key: value for key, value in node.items() if key != "$ref"}, "x-of": name}
        elif len(choices) == 1:
            rest = {key: value for key, value in node.items() if key not in ("anyOf", "allOf")}
            node = {**choices[0], **rest}
        else:
            return node


def kind(node: dict, root: dict) -> str:
    """What may stand there, in a word or two."""
    node = resolve(node, root)
    if "enum" in node:
        return " or ".join(f"`{value}`" for value in node["enum"] if value is not None)
    if "const" in node:
        return f"`{node['const']}`"
    choices = node.get("oneOf") or node.get("anyOf")
    if choices:
        named = dict.fromkeys(kind(choice, root) for choice in choices if choice.get("type") != "null")
        return " or ".join(named)
    types = node.get("type", "anything")
    types = [types] if isinstance(types, str) else types
    words = []
    for word in types:
        if word == "array":
            inner = kind(node["items"], root) if isinstance(node.get("items"), dict) else "values"
            count = node.get("minItems")
            word = f"list of {count} x {inner}" if count and count == node.get("maxItems") else f"list of {inner}"
        elif word == "object":
            single = list(node.get("properties", {}))
            word = f"`{single[0]}:`" if len(single) == 1 and node.get("required") == single else "map"
        if word != "null":
            words.append(word)
    return " or ".join(words)


def parts(node: dict, root: dict) -> list[dict]:
    """The maps whose keys may stand inside: of a map itself, of a list's items, of alternatives."""
    node = resolve(node, root)
    if "properties" in node:
        return [node]
    inside = [node["items"]] if isinstance(node.get("items"), dict) else node.get("oneOf") or node.get("anyOf") or []
    return [part for choice in inside for part in parts(choice, root)]


def describe(node: dict, root: dict, depth: int, above: list[str], lines: list[str]) -> None:
    for part in parts(node, root):
        for key, value in part["properties"].items():
            found = resolve(value, root)
            required = ", required" if key in part.get("required", []) else ""
            facts = [f"Unit: {found['x-unit']}."] if "x-unit" in found else []
            facts += [f"Range: {words}." for words in limits(found)]
            default = found.get("x-default", found.get("default"))
            if default not in (None, [], {}):
                facts.append(f"Default: `{json.dumps(default) if not isinstance(default, str) else default}`.")
            text = plain(" ".join(" ".join([found.get("description", ""), *facts]).split()))
            # A key at the top is a chapter, so that search and links find it.
            head = f"\n## {key}\n\n*{kind(value, root)}{required}*. " if depth == 0 else (
                f"{'  ' * (depth - 1)}- **{key}**: {kind(value, root)}{required}. ")
            lines.append(head + text + ("\n" if depth == 0 else ""))
            name = found.get("x-of", "")
            if name not in above or not name:
                describe(value, root, depth + 1, [*above, name], lines)


def limits(node: dict) -> list[str]:
    words = {"exclusiveMinimum": "above {}", "minimum": "{} or more", "exclusiveMaximum": "below {}", "maximum": "{} or less"}
    said = [word.format(node[key]) for key, word in words.items() if node.get(key) is not None]
    return [", ".join(said)] if said else []
