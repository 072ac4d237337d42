// Starts `zwang lsp` and lets VS Code speak with it. All that it knows of zwang is the program's name.
const { workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function activate() {
  const command = workspace.getConfiguration("zwang").get("program");
  client = new LanguageClient(
    "zwang",
    "zwang",
    { command, args: ["lsp"] },
    {
      // The server passes over YAML and XML that is none of zwang's.
      documentSelector: [
        { scheme: "file", language: "yaml" },
        { scheme: "file", pattern: "**/*.urdf" },
      ],
      synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.{yaml,yml,urdf}") },
    },
  );
  return client.start();
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
