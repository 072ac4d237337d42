"""A client of `zwang lsp` as a process."""
import json
import pathlib
import subprocess


class Client:
    def __init__(self, program):
        self.process = subprocess.Popen([program, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.asked = 0
        self.version = 1
        self.told = {}  # diagnostics by address

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        content = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n%s" % (len(content), content))

    def hear(self):
        length = 0
        while line := self.process.stdout.readline().strip():
            name, value = line.split(b":", 1)
            if name.lower() == b"content-length":
                length = int(value)
        if not length:
            raise EOFError("the server is gone")
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.told[message["params"]["uri"]] = message["params"]["diagnostics"]
        return message

    def ask(self, method, parameters):
        self.asked += 1
        self.send({"id": self.asked, "method": method, "params": parameters})
        while (message := self.hear()).get("id") != self.asked:
            pass
        return message.get("result", message.get("error"))

    def tell(self, method, parameters):
        self.send({"method": method, "params": parameters})

    def open(self, path, text):
        self.tell("textDocument/didOpen", {"textDocument": {
            "uri": pathlib.Path(path).as_uri(), "languageId": "yaml", "version": 1, "text": text}})

    def change(self, path, text):
        self.version += 1
        self.tell("textDocument/didChange", {
            "textDocument": {"uri": pathlib.Path(path).as_uri(), "version": self.version},
            "contentChanges": [{"text": text}]})

    def end(self):
        self.ask("shutdown", None)
        self.tell("exit", None)
        return self.process.wait(timeout=20)
