"""The server as a client of others sees it: each answer is read into the types of the protocol, so one of another form fails."""

import asyncio
import os
import subprocess
from pathlib import Path

import pytest_lsp
from lsprotocol import types as lsp
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities

COMMAND = os.environ["CLSMITH"]
PROGRAMS = Path(__file__).parents[2] / "fixtures"
RECIPE = "version: 1\nunits: mm\nsteps:\n  - scale_feed: { factor: 0.5, where: { operations: [ROUGH] } }\n"
PART = (
    "TOOL PATH/ROUGH,TOOL,MILL_10\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,3\nSPINDL/RPM,5000,CLW\n"
    "RAPID\nGOTO/0.0000,0.0000,10.0000\nFEDRAT/MMPM,600.0000\nGOTO/0.0000,0.0000,-2.0000\nFEDRAT/1200.0000\n"
    "GOTO/60.0000,0.0000,-2.0000\nEND-OF-PATH\n"
)


@pytest_lsp.fixture(config=ClientServerConfig(server_command=[COMMAND, "lsp", "--stdio"]))
async def client(lsp_client: LanguageClient):
    parameters = lsp.InitializeParams(capabilities=client_capabilities("visual-studio-code"))
    told = await lsp_client.initialize_session(parameters)
    assert told.capabilities.document_formatting_provider is None
    yield
    await lsp_client.shutdown_session()


async def open_document(client: LanguageClient, uri: str, language: str, text: str, version: int = 1) -> list[lsp.Diagnostic]:
    item = lsp.TextDocumentItem(uri=uri, language_id=language, version=version, text=text)
    client.diagnostics.pop(uri, None)
    client.text_document_did_open(lsp.DidOpenTextDocumentParams(text_document=item))
    # Findings of other documents, as of one that was closed, may come first.
    while uri not in client.diagnostics:
        await client.wait_for_notification("textDocument/publishDiagnostics")
    return list(client.diagnostics[uri])


def change(client: LanguageClient, uri: str, version: int, start: tuple, end: tuple, text: str) -> None:
    where = lsp.Range(start=lsp.Position(*start), end=lsp.Position(*end))
    client.text_document_did_change(lsp.DidChangeTextDocumentParams(
        text_document=lsp.VersionedTextDocumentIdentifier(uri=uri, version=version),
        content_changes=[lsp.TextDocumentContentChangePartial(range=where, text=text)]))


async def test_a_program(client: LanguageClient, tmp_path: Path):
    uri = (tmp_path / "part.cls").as_uri()
    this = lsp.TextDocumentIdentifier(uri=uri)
    wrong = await open_document(client, uri, "clsf", PART.replace("1200.0000", "12O0.0000"))
    finding = next(one for one in wrong if one.code == "CL0003")
    assert finding.severity == lsp.DiagnosticSeverity.Error and finding.range.start == lsp.Position(8, 7)
    context = lsp.CodeActionContext(diagnostics=[finding])
    actions = await client.text_document_code_action_async(
        lsp.CodeActionParams(text_document=this, range=finding.range, context=context))
    edit = next(one for one in actions if one.is_preferred).edit.changes[uri][0]
    change(client, uri, 2, (8, edit.range.start.character), (8, edit.range.end.character), edit.new_text)
    await client.wait_for_notification("textDocument/publishDiagnostics")
    assert all(one.code != "CL0003" for one in client.diagnostics[uri])

    at = lsp.Position(9, 0)
    hover = await client.text_document_hover_async(lsp.HoverParams(text_document=this, position=at))
    assert "1200 MMPM (1200 mm/min, 47.244 inch/min)" in hover.contents.value
    symbols = await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(text_document=this))
    assert [(one.name, [child.name for child in one.children]) for one in symbols] == [("ROUGH", ["tool 3"])]
    load = await client.text_document_definition_async(lsp.DefinitionParams(text_document=this, position=at))
    assert load.range.start.line == 2
    folded = await client.text_document_folding_range_async(lsp.FoldingRangeParams(text_document=this))
    assert (folded[0].start_line, folded[0].end_line) == (0, 10)
    whole = lsp.Range(start=lsp.Position(0, 0), end=lsp.Position(99, 0))
    hints = await client.text_document_inlay_hint_async(lsp.InlayHintParams(text_document=this, range=whole))
    assert {"rapid", "600 MMPM", "1200 MMPM"} <= {one.label for one in hints}
    words = await client.text_document_completion_async(lsp.CompletionParams(text_document=this, position=lsp.Position(3, 7)))
    assert "RPM" in [one.label for one in words]
    feed = await client.workspace_execute_command_async(
        lsp.ExecuteCommandParams(command="clsmith.nextFeed", arguments=[uri, {"line": 6, "character": 0}]))
    assert feed["range"]["start"]["line"] == 8
    renamed = await client.text_document_rename_async(
        lsp.RenameParams(text_document=this, position=lsp.Position(0, 12), new_name="ROUGH_2"))
    assert [one.new_text for one in renamed.changes[uri]] == ["ROUGH_2"]
    page = await client.workspace_execute_command_async(
        lsp.ExecuteCommandParams(command="clsmith.pathPage", arguments=[uri, "path"]))
    assert page["version"] == 2 and page["html"].startswith("<!doctype html>") and "part.cls" in page["html"]


async def test_a_recipe_on_a_program(client: LanguageClient, tmp_path: Path):
    part, recipe = (tmp_path / "part.cls").as_uri(), (tmp_path / "recipe.yaml").as_uri()
    await open_document(client, part, "clsf", PART)
    assert await open_document(client, recipe, "yaml", RECIPE) == []
    this = lsp.TextDocumentIdentifier(uri=recipe)
    words = await client.text_document_completion_async(lsp.CompletionParams(text_document=this, position=lsp.Position(3, 55)))
    assert [one.label for one in words] == ["ROUGH"]
    [lens] = await client.text_document_code_lens_async(lsp.CodeLensParams(text_document=this))
    preview = await client.workspace_execute_command_async(
        lsp.ExecuteCommandParams(command=lens.command.command, arguments=lens.command.arguments))
    assert "-FEDRAT/1200.0000\n+FEDRAT/600.0000\n" in preview["diff"] and not preview["refused"]


async def test_the_step_that_changed_a_line(client: LanguageClient, tmp_path: Path):
    (tmp_path / "part.cls").write_text(PART)
    (tmp_path / "recipe.yaml").write_text(RECIPE)
    subprocess.run([COMMAND, "apply", "recipe.yaml", "part.cls", "-o", "out.cls", "--json", "out.json", "-q"],
                   cwd=tmp_path, check=True)
    corrected = (tmp_path / "out.cls").read_text()
    uri = (tmp_path / "out.cls").as_uri()
    await open_document(client, uri, "clsf", corrected)
    this = lsp.TextDocumentIdentifier(uri=uri)
    line = corrected.splitlines().index("FEDRAT/600.0000")
    [step] = await client.text_document_declaration_async(
        lsp.DeclarationParams(text_document=this, position=lsp.Position(line, 0)))
    assert step.uri == (tmp_path / "recipe.yaml").as_uri()
    assert (step.range.start, step.range.end) == (lsp.Position(3, 4), lsp.Position(3, 14))
    assert await client.text_document_declaration_async(
        lsp.DeclarationParams(text_document=this, position=lsp.Position(0, 0))) is None


async def test_a_file_as_it_is_typed(client: LanguageClient, tmp_path: Path):
    """Letter by letter, asked at each of them, with places that are not there."""
    uri = (tmp_path / "new.cls").as_uri()
    this = lsp.TextDocumentIdentifier(uri=uri)
    await open_document(client, uri, "clsf", "")
    line = column = 0
    for version, letter in enumerate("LOAD/TOOL,1\nFEDRAT/MMPM,9\nGOTO/1,2,3\n", 2):
        change(client, uri, version, (line, column), (line, column), letter)
        line, column = (line + 1, 0) if letter == "\n" else (line, column + 1)
        for at in (lsp.Position(line, column), lsp.Position(line + 99, 99999)):
            await client.text_document_hover_async(lsp.HoverParams(text_document=this, position=at))
            await client.text_document_completion_async(lsp.CompletionParams(text_document=this, position=at))
            await client.text_document_definition_async(lsp.DefinitionParams(text_document=this, position=at))
        await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(text_document=this))
    await client.wait_for_notification("textDocument/publishDiagnostics")
    hover = await client.text_document_hover_async(lsp.HoverParams(text_document=this, position=lsp.Position(2, 0)))
    assert "position: 1, 2, 3 mm" in hover.contents.value


async def test_programs_of_every_system(client: LanguageClient):
    """All fixtures give answers that the client can read."""
    paths = sorted(path for path in PROGRAMS.rglob("*") if path.suffix in (".cls", ".apt", ".aptsource", ".ncl"))
    assert len(paths) > 5, paths
    for path in paths:
        uri = path.as_uri()
        this = lsp.TextDocumentIdentifier(uri=uri)
        text = path.read_bytes().decode("utf-8", errors="replace")
        await open_document(client, uri, "clsf", text)
        await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(text_document=this))
        await client.text_document_folding_range_async(lsp.FoldingRangeParams(text_document=this))
        whole = lsp.Range(start=lsp.Position(0, 0), end=lsp.Position(10**6, 0))
        await client.text_document_inlay_hint_async(lsp.InlayHintParams(text_document=this, range=whole))
        middle = lsp.Position(text.count("\n") // 2, 0)
        await client.text_document_hover_async(lsp.HoverParams(text_document=this, position=middle))
        client.text_document_did_close(lsp.DidCloseTextDocumentParams(text_document=this))


async def test_a_cancelled_request_stops(client: LanguageClient, tmp_path: Path):
    """A simulation of an hour's program is cancelled at once."""
    shop = tmp_path / "shop.yaml"
    shop.write_text("units: mm\nmachine: { rapid_feed: 20000 }\nstock: { block: { from: [-20, -20, -10], to: [220, 220, 0] } }\n"
                    "tools: [ { match: { number: 1 }, diameter: 10, teeth: 4, flute_length: 20 } ]\n")
    client.workspace_did_change_configuration(lsp.DidChangeConfigurationParams(settings={"clsmith": {"setup": str(shop)}}))
    lines = [f"GOTO/{200 * (row % 2)}.,{row % 200}.,-{1 + row % 9}.\n" for row in range(20_000)]
    uri = (tmp_path / "long.cls").as_uri()
    await open_document(client, uri, "clsf", "UNITS/MM\nLOAD/TOOL,1\nSPINDL/RPM,5000,CLW\nFEDRAT/MMPM,1200\n" + "".join(lines))
    wanted = lsp.ExecuteCommandParams(command="clsmith.pathPage", arguments=[uri, "simulation"])
    asked = client.protocol.send_request_async("workspace/executeCommand", wanted)
    task = asyncio.ensure_future(asked)
    await asyncio.sleep(1)
    assert not task.done()
    task.cancel()
    begun = asyncio.get_running_loop().time()
    here = lsp.HoverParams(text_document=lsp.TextDocumentIdentifier(uri=uri), position=lsp.Position(9, 0))
    await client.text_document_hover_async(here)
    assert asyncio.get_running_loop().time() - begun < 5
