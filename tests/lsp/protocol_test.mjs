// Microsoft's own client of the protocol judges `zwang lsp`: its reader takes the messages, its types the answers.
//
//     node protocol_test.mjs PROGRAM ROOT FOLDER_OF_MODULES
import {spawn} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

const [program, root, modules] = process.argv.slice(2);
const lsp = createRequire(modules + '/')('vscode-languageserver-protocol/node');

function expect(condition, what, ...told) {
  if (condition) return;
  console.error(`FAILED: ${what}`, ...told.map((one) => JSON.stringify(one)));
  process.exit(1);
}

const server = spawn(program, ['lsp'], {stdio: ['pipe', 'pipe', 'inherit']});
const connection =
    lsp.createProtocolConnection(new lsp.StreamMessageReader(server.stdout), new lsp.StreamMessageWriter(server.stdin));
const told = [];
let wake = () => {};
connection.onError(([error]) => expect(false, 'a message cannot be read', error.message));
connection.onNotification(lsp.PublishDiagnosticsNotification.type, (parameters) => {
  told.push(parameters);
  wake();
});
connection.listen();

const begun = await connection.sendRequest(
    lsp.InitializeRequest.type, {processId: process.pid, rootUri: null, capabilities: {}});
expect(begun.capabilities.hoverProvider && begun.capabilities.completionProvider, 'no capabilities', begun);
await connection.sendNotification(lsp.InitializedNotification.type, {});

const path = `${root}/specs/wall_align.yaml`;
const uri = pathToFileURL(path).href;
const text = readFileSync(path, 'utf8').replace('moved(base)', 'moved(bse)');
await connection.sendNotification(
    lsp.DidOpenTextDocumentNotification.type, {textDocument: {uri, languageId: 'yaml', version: 1, text}});
while (!told.some((one) => one.uri === uri)) await new Promise((resolve) => { wake = resolve; });
const diagnostics = told.filter((one) => one.uri === uri).at(-1).diagnostics;
expect(diagnostics.every(lsp.Diagnostic.is), 'no diagnostics', diagnostics);
const unknown = diagnostics.find((one) => one.code === 'E301');
expect(unknown, 'the unknown frame is not told', diagnostics);

const document = {textDocument: {uri}};
function place(words, into = 0) {
  const before = text.slice(0, text.indexOf(words) + into);
  return {line: before.split('\n').length - 1, character: before.length - before.lastIndexOf('\n') - 1};
}
function ask(type, parameters) {
  return connection.sendRequest(type, {...document, ...parameters});
}

const actions =
    await ask(lsp.CodeActionRequest.type, {range: unknown.range, context: {diagnostics: [unknown]}});
expect(actions.length === 1 && lsp.CodeAction.is(actions[0]), 'no quick fix', actions);
expect(lsp.WorkspaceEdit.is(actions[0].edit), 'no edit', actions);
expect(actions[0].edit.changes[uri][0].newText === 'base', 'another edit', actions);

const hover = await ask(lsp.HoverRequest.type, {position: place('5 mm/s', 2)});
expect(lsp.Hover.is(hover), 'no hover', hover);
const list = await ask(lsp.CompletionRequest.type, {position: place('scenes/wall.yaml', 3)});
expect(lsp.TextEdit.is(list.items[0].textEdit), 'no completion', list);
const symbols = await ask(lsp.DocumentSymbolRequest.type, {});
expect(symbols.length > 0 && symbols.every((one) => lsp.Location.is(one.location)), 'no symbols', symbols);
const given = await ask(lsp.DefinitionRequest.type, {position: place('$push', 2)});
expect([given].flat().every(lsp.Location.is), 'no definition', given);
const meant = await ask(lsp.ReferencesRequest.type, {position: place('$push', 2), context: {includeDeclaration: true}});
expect(meant.length >= 3 && meant.every(lsp.Location.is), 'no references', meant);
const edits = await ask(lsp.DocumentFormattingRequest.type, {options: {tabSize: 2, insertSpaces: true}});
expect((edits ?? []).every(lsp.TextEdit.is), 'no format', edits);
await connection.sendRequest('zwang/nothing', {}).then(
    () => expect(false, 'an unknown request is answered'),
    (error) => expect(error.code === lsp.ErrorCodes.MethodNotFound, 'another error', error.code));

await connection.sendRequest(lsp.ShutdownRequest.type);
const ended = new Promise((resolve) => server.on('exit', resolve));
await connection.sendNotification(lsp.ExitNotification.type);
const code = await ended;
expect(code === 0, 'another exit code', code);
connection.dispose();
console.log(`vscode-languageserver-protocol takes ${diagnostics.length} diagnostics and every answer`);
