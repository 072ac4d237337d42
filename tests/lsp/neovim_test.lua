-- Neovim as a judge: it opens a task, breaks it, takes the fix that is offered, and is left without an error.
local function check(what, is_so)
  if not is_so then
    io.stderr:write("failed: " .. what .. "\n")
    vim.cmd("cquit 1")
  end
end
local function errors()
  return vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR })
end

vim.cmd("edit " .. os.getenv("TASK"))
local id = vim.lsp.start_client({ name = "zwang", cmd = { os.getenv("ZWANG"), "lsp" } })
vim.lsp.buf_attach_client(0, id)
check("the server starts", vim.wait(8000, function() return vim.lsp.buf_get_clients(0)[id] ~= nil end, 5))
check("the file is good", #errors() == 0)
vim.cmd([[%s/20 N,/20 Nm,/]])
check("a mistake is told", vim.wait(8000, function() return #errors() == 1 end, 5))
check("by its code", errors()[1].code == "E203")

local d = errors()[1]
local place = vim.lsp.util.make_text_document_params()
local answer = vim.lsp.buf_request_sync(0, "textDocument/codeAction", {
  textDocument = place,
  range = { start = { line = d.lnum, character = d.col }, ["end"] = { line = d.end_lnum, character = d.end_col } },
  context = { diagnostics = {} },
}, 4000)
local action = answer[id].result[1]
check("a fix is offered", action ~= nil)
vim.lsp.util.apply_workspace_edit(action.edit, "utf-16")
check("the file is good again", vim.wait(8000, function() return #errors() == 0 end, 5))
local hover = vim.lsp.buf_request_sync(0, "textDocument/hover", {
  textDocument = place, position = { line = vim.fn.search("x:  {force") - 1, character = 8 },
}, 4000)
check("hover tells the mass", hover[id].result.contents.value:find("effective mass") ~= nil)
io.stderr:write("all good\n")
vim.cmd("qall!")
