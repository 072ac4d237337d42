"""Time from a change in an editor to its diagnostics, over many changes. Prints; judges nothing.

usage: lsp_latency.py ZWANG SPECS [TASK...]
"""
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "lsp"))
from client import Client  # noqa: E402

program, specs = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
tasks = sys.argv[3:] or ["wall_align.yaml", "hospital.yaml", "docking.yaml"]
changes = 300

print(f"{'file':28} {'median':>8} {'p99':>8} {'most':>8}  [ms], of {changes} changes that make and mend a mistake")
for name in tasks:
    path = specs / name
    text = path.read_text()
    client = Client(program)
    client.ask("initialize", {})
    client.open(path, text)
    client.hear()
    took = []
    for i in range(changes):
        begin = time.perf_counter()
        client.change(path, text if i % 2 else text + "colour: red\n")
        client.hear()
        took.append(1e3 * (time.perf_counter() - begin))
    client.end()
    took.sort()
    print(f"{name:28} {took[changes // 2]:8.2f} {took[int(0.99 * changes)]:8.2f} {took[-1]:8.2f}")
