"""`zwang sweep` as its users have it, on a task that takes 0.1 s.

    sweep_test.py PROGRAM SPECS

The results do not depend on the number of processes, on a kill -9 under way, or on being computed in parts. A
cell runs again alone, bit for bit. Ends with 1 and says why when anything is otherwise.
"""

import json
import pathlib
import re
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

TASK = """zwang: 1
robot: robots/mecanum_base.yaml
scene: scene.yaml
params: {pace: {value: 5 cm/s, range: [1 cm/s, 20 cm/s]}}
start: go
tasks:
  go:
    constraints: {go: {move: base_link, in: base_link, x: {velocity: $pace}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    timeout: {after: 0.1 s, goto: done}
"""
SCENE = """zwang_scene: 1
state: {position: 1 mm, velocity: 1 mm/s}
objects: {crate: {box: [1 m, 1 m, 1 m], at: [3 m, 0 m], mass: 20 kg}}
"""
STUDY = """zwang_study: 1
task: task.yaml
runs: 8
draw:
  params.pace: {uniform: [2 cm/s, 10 cm/s]}
  start.yaw: {normal: [0 deg, 10 deg]}
  robot.mass: {normal: [1, 0.05], times: true}
  robot.friction: {log_uniform: [0.5, 2], times: true}
  robot.wheel_radius: {uniform: [0.98, 1.02], times: true}
  robot.encoder_step: {choice: [0 rad, 0.05 mrad]}
  robot.encoder_noise: {choice: [1e-10 rad]}
  scene.crate.stiffness: {log_uniform: [10 kN/m, 1 MN/m]}
  state.delay: {choice: [0 ms, 5 ms]}
  faults: {choice: [none, slip]}
  faults.slip.at: {uniform: [0 s, 50 ms]}
faults: {slip: [{at: 0 s, of: run.entered.go, floor_friction: 0.3}]}
expect:
  - {outcome: done, probability: 99.9 %}
  - {at: end, that: truth.base.speed < 6 cm/s, probability: 1 %}
  - {at: end, that: truth.base.x < 10 m}
"""

failures = []


def expect(holds, what):
    if not holds:
        failures.append(what)


def rows(path):
    """All but the real time."""
    with sqlite3.connect(path) as database:
        cursor = database.execute("SELECT * FROM cells ORDER BY cell")
        wall = [column[0] for column in cursor.description].index("wall")
        return [row[:wall] + row[wall + 1:] for row in cursor]


def check_places(program, folder, zwang, reference):
    """What is at the places that are read and written is kept, and told before any cell runs."""
    def refuses(what, *arguments):
        ended = zwang("sweep", "study.yaml", *arguments)
        expect(ended.returncode == 2 and what in ended.stderr and "cells;" not in ended.stdout,
               f"{arguments}: {ended.stdout}{ended.stderr}")

    with sqlite3.connect(folder / "other.db") as database:
        database.execute("CREATE TABLE cells (a)")
    for other in ("study.yaml", "other.db"):
        before = (folder / other).read_bytes()
        refuses("no file of results", "--out", other)
        refuses("no file of results", "--out", other, "--fresh")
        expect((folder / other).read_bytes() == before, f"{other} was written to")
    refuses("deletes it before", "--fresh", "--out", "alone.db", "--merge", "./alone.db")
    expect(rows(folder / "alone.db") == reference, "results that are merged into themselves are lost")
    refuses("no such file", "--out", "joined.db", "--merge", "missing.db")
    expect(not (folder / "joined.db").exists(), "a merge of a missing file leaves an empty one")
    refuses("No such file", "--out", "absent/study.db")
    refuses("there is no folder absent", "--out", "junit.db", "--junit", "absent/junit.xml")
    refuses("would be written over", "--out", "alone.db", "--junit", "./alone.db")
    refuses("would be written over", "--junit", str(folder / "study.yaml"))
    refuses("the page has this name", "--out", "alone.html", "--report")
    refuses("write the number of the part", "--shard", "-1/-1")
    for number in ("99999999999999999999999", "-1", ""):
        ended = zwang("run", "study.yaml", "--cell", number)
        expect(ended.returncode == 2 and "choose one by its number" in ended.stderr, f"--cell {number}: {ended}")
    half = zwang("sweep", "study.yaml", "--out", "alone.db", "--shard", "1/2")
    expect("4 of 4 cells" in half.stdout, f"a half of cells that are there: {half.stdout}")

    shutil.copy(folder / "study.yaml", folder / "namesake.yaml")
    with open(folder / "namesake.yaml", "a") as study:
        study.write("seed: 5\n")
    other = zwang("sweep", "namesake.yaml", "--out", "alone.db", "--fresh")
    expect(other.returncode == 2 and "study.yaml; delete it yourself" in other.stderr and
           rows(folder / "alone.db") == reference, f"results of another study: {other}")
    strange = zwang("sweep", "namesake.yaml", "--out", "of_namesake.db", "--merge", "alone.db")
    expect(strange.returncode == 2 and "leave it out of --merge" in strange.stderr, f"merged: {strange}")

    part = zwang("sweep", "study.yaml", "--out", "part.db", "--merge", "study.1-of-2.db")
    expect(part.returncode == 2 and "4 of 8 cells are missing" in part.stdout, f"a part is missing: {part.stdout}")
    limited = subprocess.run([program, "sweep", "study.yaml", "-j", "1", "--out", "limited.db"], cwd=folder,
                             capture_output=True, text=True,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000)))
    expect(limited.returncode == 2 and "limited.db" in limited.stderr, f"a file that may not grow: {limited}")
    again = zwang("sweep", "study.yaml", "-j", "1", "--out", "limited.db")
    expect(again.returncode == 0 and rows(folder / "limited.db") == reference, f"after that: {again.stderr}")


def check_one_writer(program, folder, zwang):
    """Two sweeps at once: the second one neither runs the cells again nor deletes what the first one writes."""
    first = subprocess.Popen([program, "sweep", "study.yaml", "-j", "1", "--runs", "10000", "--out", "shared.db"],
                             cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for _ in range(2000):
        time.sleep(0.01)
        if (folder / "shared.db").exists() and cells(folder / "shared.db") >= 1:
            break
    second = zwang("sweep", "study.yaml", "--out", "shared.db", "--fresh")
    expect(second.returncode == 2 and "another `zwang sweep`" in second.stderr, f"two at once: {second}")
    kept = cells(folder / "shared.db")
    first.send_signal(signal.SIGINT)
    expect(first.wait() == 2 and cells(folder / "shared.db") >= kept >= 1, "the first of two sweeps lost its cells")


def main(program, specs):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="zwang_sweep_"))
    shutil.copytree(pathlib.Path(specs) / "robots", folder / "robots")
    for name, text in [("task.yaml", TASK), ("scene.yaml", SCENE), ("study.yaml", STUDY)]:
        (folder / name).write_text(text)

    def zwang(*arguments):
        return subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)

    alone = zwang("sweep", "study.yaml", "-j", "1", "--out", "alone.db", "--format", "json")
    expect(alone.returncode == 0, f"sweep ends with {alone.returncode}: {alone.stderr}{alone.stdout}")
    report = json.loads(alone.stdout)
    expect(report["cells"] == 8 and report["passed"], f"the report says {alone.stdout}")
    expect([e["verdict"] for e in report["expectations"]] == ["too few runs", "held", "held"], f"verdicts: {alone.stdout}")
    pace = {c["draw"]: c.get("margin") for c in report["expectations"][1]["correlations"]}["params.pace"]
    expect(pace is not None and pace < -0.7, f"the margin of the speed goes with the pace by {pace}")
    reference = rows(folder / "alone.db")

    three = zwang("sweep", "study.yaml", "-j", "3", "--out", "three.db")
    # The base comes 1 cm far, of 10 m: a margin of 99.9 % or more, told to a tenth.
    expect(re.search(r"margin (99\.9|100\.0) % at least", three.stdout), f"margins: {three.stdout}")
    expect(rows(folder / "three.db") == reference, "three processes have other results than one")

    killed = subprocess.Popen([program, "sweep", "study.yaml", "-j", "2", "--out", "killed.db"], cwd=folder,
                              stdout=subprocess.DEVNULL)
    for _ in range(2000):
        time.sleep(0.01)
        if killed.poll() is not None or ((folder / "killed.db").exists() and cells(folder / "killed.db") >= 3):
            break
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    before = cells(folder / "killed.db")
    again = zwang("sweep", "study.yaml", "-j", "2", "--out", "killed.db")
    expect(again.returncode == 0, f"a killed sweep does not go on: {again.stderr}")
    expect(before >= 3 and rows(folder / "killed.db") == reference, "a killed sweep has other results")

    for part in ("1/2", "2/2"):
        zwang("sweep", "study.yaml", "--shard", part)
    merged = zwang("sweep", "study.yaml", "--out", "merged.db", "--merge", "study.1-of-2.db", "study.2-of-2.db")
    expect(merged.returncode == 0 and rows(folder / "merged.db") == reference, f"parts: {merged.stderr}")

    page = (pathlib.Path(specs).parent / "docs/studies.md").read_text()
    snippet = re.search(r"```python\n(.*?)```", page, re.DOTALL).group(1)
    of_this_study = snippet.replace("study.db", "alone.db").replace("params.push", "params.pace")
    python = subprocess.run([sys.executable, "-c", of_this_study], cwd=folder, capture_output=True, text=True)
    lines = [float(line.split()[2]) for line in python.stdout.splitlines()]
    expect(len(lines) == 5 and lines == sorted(lines), f"docs/studies.md: {python.stdout}{python.stderr}")

    check_places(program, folder, zwang, reference)
    check_one_writer(program, folder, zwang)

    if shutil.which("mpirun") and (pathlib.Path(program).parent / "zwang_mpi.so").exists():
        def in_a_job(*arguments):
            return subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "3", program, "sweep",
                                   "study.yaml", *arguments], cwd=folder, capture_output=True, text=True)

        ranks = in_a_job("--out", "ranks.db")
        expect(ranks.returncode == 0, f"under mpirun: {ranks.stderr}{ranks.stdout}")
        expect(rows(folder / "ranks.db") == reference, "three ranks have other results than one process")
        expect(ranks.stdout.count("8 of 8 cells") == 1, f"each rank reports: {ranks.stdout}")
        expect("\x1b" not in ranks.stdout, f"a pipe gets what a terminal would: {ranks.stdout!r}")
        (folder / "bad.yaml").write_text(STUDY.replace("runs: 8", "runs: 0"))
        bad = subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "3", program, "sweep", "bad.yaml"],
                             cwd=folder, capture_output=True, text=True, timeout=60)
        expect(bad.returncode == 1 and bad.stderr.count("error E105") == 1, f"a bad study in a job: {bad}")
        lost = in_a_job("--out", "absent/ranks.db")
        expect(lost.returncode != 0 and "absent/ranks.db: cannot be written" in lost.stderr,
               f"rank 0 does not say why it ends: {lost.stderr}")

    for log in ("first", "second"):
        one = zwang("run", "study.yaml", "--cell", "5", "--log", log, "--format", "json")
        expect(one.returncode == 0, f"a cell alone ends with {one.returncode}: {one.stderr}")
    csv = [zwang("log", log).stdout for log in ("first", "second")]
    expect(csv[0] == csv[1] and len(csv[0]) > 1000, "a cell that runs again has another log")
    told = json.loads(one.stdout)
    # What is drawn of the robot is no fault; the set `slip` is.
    for faults in ("none", "slip"):
        cell = next(row[0] for row in reference if row[1] == f"faults {faults}")
        truth = zwang("run", "study.yaml", "--cell", str(cell), "--log", f"faults_{faults}").stdout
        expect(("of the cell, from" in truth) == (faults == "slip"), f"faults of cell {cell}: {truth}")
    expect(abs(told["elapsed"] - reference[5][5]) < 2e-3, f"{told['elapsed']} s alone, {reference[5][5]} s in the sweep")
    # Where the base is as the task ends: to all digits that the log prints.
    lines = csv[0].splitlines()
    column = lines[0].split(",").index("truth.base.x [m]")
    end = told["transitions"][-1]["time"]
    alone = next(float(line.split(",")[column]) for line in lines[1:] if abs(float(line.split(",")[0]) - end) < 1e-9)
    with sqlite3.connect(folder / "alone.db") as database:
        swept = database.execute("SELECT value_3 FROM cells WHERE cell = 5").fetchone()[0]
    expect(abs(alone - swept) <= 5e-9 * abs(swept), f"x = {alone} m alone, {swept} m in the sweep")
    replayed = zwang("replay", "first")
    expect(replayed.returncode == 0, f"replay: {replayed.stdout}{replayed.stderr}")

    (folder / "scene.yaml").write_text(SCENE.replace("20 kg", "21 kg"))
    other = zwang("sweep", "study.yaml", "--out", "alone.db")
    expect(other.returncode == 2 and "--fresh" in other.stderr, f"results of other files: {other.stderr}")

    # A file of a cell that has not run yet counts, too.
    choice = STUDY.replace("draw:\n", "draw:\n  robot: {choice: [robots/kelo_base.yaml, robots/omni_base.yaml]}\n")
    (folder / "choice.yaml").write_text(choice)
    zwang("sweep", "choice.yaml", "--runs", "1", "-j", "1")
    with sqlite3.connect(folder / "choice.db") as database:
        first = database.execute("SELECT of_matrix FROM cells").fetchone()[0]
    other_robot = folder / "robots" / ("omni_base.urdf" if "kelo" in first else "kelo_base.urdf")
    other_robot.write_text(other_robot.read_text() + "<!-- another text -->\n")
    other = zwang("sweep", "choice.yaml", "--runs", "2", "-j", "1")
    expect(other.returncode == 2 and "--fresh" in other.stderr, f"results of another robot's file: {other.stderr}")

    expect(zwang("run", "study.yaml").returncode == 2, "a study runs without the number of a cell")
    expect(zwang("sweep", "study.yaml", "--shard", "3/2").returncode == 2, "a part beyond the last one")
    expect(zwang("sweep", "task.yaml").returncode == 1, "a task is swept")

    shutil.rmtree(folder)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


def cells(path):
    try:
        with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as database:
            return database.execute("SELECT count(*) FROM cells").fetchone()[0]
    except sqlite3.OperationalError:
        return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
