-- What a newcomer to Neovim gets: run in examples/pocket by `scripts/check-editors`.

local function fail(text)
  io.stderr:write("neovim: ", text, "\n")
  vim.cmd("cquit")
end

local function wait(what, is_there)
  if not vim.wait(20000, is_there, 50) then fail("no " .. what) end
end

--- Asks the server, which knows nothing of a program before it has read it.
local function ask(method, more)
  local asked = vim.tbl_extend("error", { textDocument = { uri = vim.uri_from_bufnr(0) } }, more or {})
  local found
  wait("answer to " .. method, function()
    local answers = vim.lsp.buf_request_sync(0, method, asked, 20000) or {}
    for _, answer in pairs(answers) do found = answer.result end
    return type(found) == "table" and next(found) ~= nil
  end)
  return found
end

local function has_finding(code)
  return function()
    return vim.iter(vim.diagnostic.get(0)):any(function(found) return found.code == code end)
  end
end

local function run()
  vim.cmd.edit("part.cls")
  if vim.bo.filetype ~= "clsf" then fail("part.cls is " .. vim.bo.filetype) end
  local color = vim.fn.synIDattr(vim.fn.synID(vim.fn.search("^GOTO"), 1, 1), "name")
  if color ~= "clMotion" then fail("GOTO has the colour " .. color) end
  wait("server", function() return #vim.lsp.get_clients({ bufnr = 0, name = "clsmith" }) == 1 end)
  if #vim.diagnostic.get(0) > 0 then fail("findings in a good program: " .. vim.inspect(vim.diagnostic.get(0))) end

  local hover = ask("textDocument/hover", { position = { line = 19, character = 2 } })
  if not hover.contents.value:find("1200 MMPM", 1, true) then fail("hover says " .. hover.contents.value) end
  local outline = vim.tbl_map(function(one) return one.name end, ask("textDocument/documentSymbol"))
  if not vim.deep_equal(outline, { "POCKET_ROUGH", "HOLES" }) then fail("outline " .. vim.inspect(outline)) end
  if vim.lsp.inlay_hint.is_enabled() then wait("hints", function() return #vim.lsp.inlay_hint.get({ bufnr = 0 }) > 0 end) end
  vim.api.nvim_win_set_cursor(0, { 1, 11 })
  vim.lsp.buf.rename("POCKET_1")
  wait("new name", function() return vim.fn.getline(1) == "TOOL PATH/POCKET_1,TOOL,EM12" end)

  vim.cmd("17substitute/1200/12O0/")
  wait("finding while typing", has_finding("CL0003"))
  vim.cmd("silent write")
  vim.cmd("silent make")
  local first = vim.fn.getqflist()[1]
  if not (first and first.lnum == 17 and first.col == 13) then fail("quickfix " .. vim.inspect(first)) end

  -- The preview of a recipe opens as a file of differences.
  vim.cmd("silent edit! part.cls | silent undo 0 | silent write | silent edit recipe.yaml")
  wait("server for the recipe", function() return #vim.lsp.get_clients({ bufnr = 0, name = "clsmith" }) == 1 end)
  vim.fn.search("^steps:")
  local function is_offered()
    return vim.iter(vim.lsp.codelens.get(0)):any(function(lens) return lens.command ~= nil end)
  end
  for _ = 1, 10 do
    vim.lsp.codelens.refresh({ bufnr = 0 })
    if vim.wait(2000, is_offered, 50) then break end
  end
  if not is_offered() then fail("no offer of a preview") end
  vim.lsp.codelens.run()
  wait("preview", function() return vim.api.nvim_buf_get_name(0):find("%.diff$") ~= nil end)
  vim.cmd("qall!")
end

local is_done, reason = xpcall(run, debug.traceback)
if not is_done then fail(reason) end
