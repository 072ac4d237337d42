"""The language server as a process, judged by a client that shares no code with it, and by Neovim where it is there.

usage: process_test.py ZWANG SOURCE
"""
import pathlib
import shutil
import subprocess
import sys

from client import Client

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
task = source / "specs" / "wall_align.yaml"
good = task.read_text()
bad = good.replace("20 N,", "20 Nm,")


def codes(client):
    return [d["code"] for d in client.told.get(task.as_uri(), []) if d["severity"] < 3]


def session():
    client = Client(program)
    # Bytes of no message, a length that lies, and bytes that are no UTF-8: each is passed over or answered.
    client.send_bytes(b"rubbish\r\n\r\nContent-Length: x\r\n\r\nContent-Length: 4\r\n\r\n\xff\xfe{}")
    assert client.hear()["error"]["code"] == -32700
    assert client.ask("textDocument/hover", {})["code"] == -32002
    assert client.ask("initialize", {})["capabilities"]["textDocumentSync"]["change"] == 1
    client.tell("initialized", {})
    client.open(task, bad)
    while not codes(client):
        client.hear()
    assert codes(client) == ["E203"], client.told
    fix = client.ask("textDocument/codeAction", {
        "textDocument": {"uri": task.as_uri()}, "range": client.told[task.as_uri()][0]["range"], "context": {}})[0]
    assert fix["edit"]["changes"][task.as_uri()][0]["newText"] == "20 N", fix
    client.change(task, good)
    while codes(client):
        client.hear()
    assert client.end() == 0


def ends():
    silent = Client(program)
    silent.process.stdin.close()
    assert silent.process.wait(timeout=20) == 1  # gone without a `shutdown`
    rude = Client(program)
    rude.tell("exit", None)
    assert rude.process.wait(timeout=20) == 1


def stdin():
    got = subprocess.run([program, "validate", "-", "--stdin-path", str(task), "--format", "short"], input=bad,
                         capture_output=True, text=True, check=False)
    assert got.returncode == 1 and f"{task}:" in got.stdout and "E203" in got.stdout, got


def neovim():
    if shutil.which("nvim") is None:
        print("no nvim: not judged by it")
        return
    script = pathlib.Path(__file__).with_name("neovim_test.lua")
    got = subprocess.run(["nvim", "--headless", "-u", "NONE", "-c", f"luafile {script}"],
                         env={"ZWANG": program, "TASK": str(task), "HOME": "/nonexistent", "PATH": "/usr/bin:/bin"},
                         capture_output=True, text=True, timeout=60, check=False)
    assert "all good" in got.stderr + got.stdout, got


for part in (session, ends, stdin, neovim):
    part()
