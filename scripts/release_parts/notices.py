"""What the binary is made of: the list of parts as CycloneDX, and the licences of all of them as text."""

import hashlib
import json
import re
import subprocess
from datetime import datetime, timezone
from pathlib import Path

LICENCE_NAMES = re.compile(r"^(licen[cs]e|copying|notice|unlicense|copyright)", re.I)
# Parts that are no crates: name, licence, its text, where the version stands (a file and a pattern).
VENDORED = [
    ("three", "MIT", "src/report/html/vendor/three.LICENSE", "src/report/html/vendor/README.md", r"`three` ([0-9.]+)"),
    ("DejaVu Sans", "Bitstream-Vera", "src/report/plot/font/LICENSE", "src/report/plot/font/README.md",
     r"DejaVu Sans ([0-9.]+[0-9])"),
]


def write(root: Path, staged: Path, target: str, version: str, seconds: int) -> None:
    crates, needs = linked_crates(root, target)
    sums = lock_checksums(root)
    (staged / "sbom.cdx.json").write_text(bill(root, crates, needs, sums, version, seconds), "utf-8", newline="\n")
    (staged / "THIRD-PARTY.txt").write_text(licence_texts(root, crates), "utf-8", newline="\n")


def linked_crates(root: Path, target: str) -> tuple[list[dict], dict[str, list[str]]]:
    """Crates that clsmith is built of on the target, without itself, and what each needs. Build and test crates are left out."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", target]
    told = json.loads(subprocess.run(command, cwd=root, check=True, capture_output=True).stdout)
    packages = {package["id"]: package for package in told["packages"]}
    nodes = {node["id"]: node for node in told["resolve"]["nodes"]}
    start = next(key for key, package in packages.items()
                 if package["name"] == "clsmith" and Path(package["manifest_path"]) == root / "Cargo.toml")
    needs, waiting = {}, [start]
    while waiting:
        key = waiting.pop()
        if key in needs:
            continue
        normal = [dep["pkg"] for dep in nodes[key]["deps"] if any(kind["kind"] is None for kind in dep["dep_kinds"])]
        needs[key] = normal
        waiting += normal
    name = lambda key: f"pkg:cargo/{packages[key]['name']}@{packages[key]['version']}"  # noqa: E731
    crates = sorted((packages[key] for key in needs if key != start), key=lambda crate: (crate["name"], crate["version"]))
    return crates, {name(key): sorted(name(dep) for dep in deps) for key, deps in needs.items()}


def lock_checksums(root: Path) -> dict[tuple[str, str], str]:
    text = (root / "Cargo.lock").read_text("utf-8")
    found = re.findall(r'name = "([^"]+)"\nversion = "([^"]+)"\nsource = "[^"]+"\nchecksum = "([0-9a-f]{64})"', text)
    return {(name, version): digest for name, version, digest in found}


def expression(crate: dict) -> str | None:
    """Its licence as SPDX writes it today; older crates have a slash for OR."""
    return crate["license"].replace("/", " OR ").replace("  ", " ") if crate["license"] else None


def bill(root: Path, crates: list, needs: dict, sums: dict, version: str, seconds: int) -> str:
    parts = []
    for crate in crates:
        reference = f"pkg:cargo/{crate['name']}@{crate['version']}"
        part = {"type": "library", "bom-ref": reference, "name": crate["name"], "version": crate["version"]}
        if (digest := sums.get((crate["name"], crate["version"]))) is not None:
            part["hashes"] = [{"alg": "SHA-256", "content": digest}]
        if expression(crate):
            part["licenses"] = [{"expression": expression(crate)}]
        parts.append({**part, "purl": reference})
    for name, licence, _, file, pattern in VENDORED:
        number = re.search(pattern, (root / file).read_text("utf-8")).group(1)
        parts.append({"type": "library", "bom-ref": f"vendored:{name}", "name": name, "version": number,
                      "licenses": [{"license": {"id": licence}}]})
    compiler = subprocess.run(["rustc", "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    parts.append({"type": "library", "bom-ref": "rust-std", "name": "std", "version": compiler,
                  "description": "Rust's standard library, of the compiler that built this",
                  "licenses": [{"expression": "MIT OR Apache-2.0"}]})
    own = f"pkg:cargo/clsmith@{version}"
    needs[own] = sorted(needs[own] + [part["bom-ref"] for part in parts if not part["bom-ref"].startswith("pkg:")])
    document = {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
        "metadata": {
            "timestamp": datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "component": {"type": "application", "bom-ref": own, "name": "clsmith", "version": version, "purl": own,
                          "licenses": [{"expression": "MIT OR Apache-2.0"}]},
        },
        "components": parts,
        "dependencies": [{"ref": key, "dependsOn": deps} for key, deps in sorted(needs.items())],
    }
    return json.dumps(document, indent=1) + "\n"


def licence_texts(root: Path, crates: list) -> str:
    """All licence files of all crates, each text once with the crates that it belongs to."""
    owners: dict[str, list[str]] = {}
    texts: dict[str, str] = {}
    without = []

    def add(owner: str, text: str) -> None:
        digest = hashlib.sha256(" ".join(text.split()).encode()).hexdigest()
        texts.setdefault(digest, text)
        owners.setdefault(digest, []).append(owner)

    for crate in crates:
        owner = f"{crate['name']} {crate['version']} ({expression(crate) or 'see its text'})"
        folder = Path(crate["manifest_path"]).parent
        found = sorted(path for path in folder.iterdir() if path.is_file() and LICENCE_NAMES.match(path.name))
        for path in found:
            add(owner, path.read_text("utf-8", errors="replace"))
        if not found:
            without.append(owner)
    for name, licence, file, _, _ in VENDORED:
        add(f"{name} ({licence})", (root / file).read_text("utf-8"))

    out = ["clsmith contains the following, each under its own licence.\n"]
    for digest, named in sorted(owners.items(), key=lambda item: item[1][0].lower()):
        out.append("\n" + "=" * 100 + "\n" + "\n".join(named) + "\n" + "-" * 100 + "\n\n" + texts[digest].strip() + "\n")
    if without:
        out.append("\n" + "=" * 100 + "\nThese publish no text of their licence; it is the one that they name:\n")
        out += [f"{owner}\n" for owner in without]
    return "".join(out).replace("\r\n", "\n")
