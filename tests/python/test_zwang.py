"""The Python module: the same runs as the program's, the same texts, numpy columns, an own plant."""

import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import types

import numpy as np
import pytest

import zwang

SPECS = pathlib.Path(os.environ["ZWANG_SPECS"])
PROGRAM = os.environ["ZWANG_PROGRAM"]
WALL_ALIGN = SPECS / "wall_align.yaml"


def test_a_run_is_the_programs_run(tmp_path):
    run = zwang.run(zwang.load(WALL_ALIGN, params={"push": "30 N"}), start_yaw=math.radians(10))
    told = subprocess.run([PROGRAM, "run", WALL_ALIGN, "-p", "push=30N", "--start-yaw", "10 deg", "--format", "json",
                           "--log", tmp_path / "log"], capture_output=True, text=True, check=False)
    report = json.loads(told.stdout)
    assert run.outcome == report["outcome"] == "done"
    assert run.truth["wall.peak_force"] == report["truth"]["wall"]["peak_force"]
    assert run.truth["base.yaw"] == report["truth"]["base"]["yaw"]
    assert {limit.row: limit.worst for limit in run.limits} == {
        limit["row"]: limit["worst"] for limit in report["limits"]}


def test_a_log_in_memory_is_the_log_of_the_program(tmp_path):
    run = zwang.run(zwang.load(WALL_ALIGN), most=2.0, log=True)
    subprocess.run([PROGRAM, "run", WALL_ALIGN, "--quiet", "--log", tmp_path / "log"], check=False,
                   capture_output=True)
    read = zwang.read_log(tmp_path / "log" / "log.mcap")
    assert run.outcome == "unfinished"
    assert len(run.log) == 2000
    assert run.log.columns == read.columns
    for name in ["time", "base.x", "front_left_wheel.tau", "truth.wall.force", "task"]:
        np.testing.assert_array_equal(run.log[name], read[name][:2000])
    assert run.log.words("task")[int(run.log["task"][0])] == "press"
    assert run.log.unit("front_left_wheel.tau") == "N m"


def test_columns_are_read_only_views_that_outlive_the_run():
    column = zwang.run(zwang.load(WALL_ALIGN), most=0.1, log=True).log["time"]
    assert column[-1] == pytest.approx(0.099)
    with pytest.raises(ValueError):
        column[0] = 1.0
    log = zwang.run(zwang.load(WALL_ALIGN), most=0.1, log=True).log
    with pytest.raises(KeyError, match="no column `no_such`"):
        log["no_such"]
    with pytest.raises(KeyError, match="there is `estimated.force.x`"):
        log["force.x"]


def test_a_mistake_is_an_error_with_its_diagnostics(tmp_path):
    task = tmp_path / "task.yaml"
    task.write_text(WALL_ALIGN.read_text().replace("0.08 m/s]", "0.08 m]")
                    .replace("robots/", f"{SPECS}/robots/").replace("scenes/", f"{SPECS}/scenes/"))
    with pytest.raises(zwang.Error) as caught:
        zwang.load(task)
    codes = [d.code for d in caught.value.diagnostics]
    assert codes and all(code.startswith("E") for code in codes)
    assert isinstance(caught.value, ValueError)
    told = subprocess.run([PROGRAM, "validate", "--format", "json", task], capture_output=True, text=True, check=False)
    spoken = [d for d in json.loads(told.stdout)["diagnostics"] if d["severity"] == "error"]
    assert [(d.code, d.line, d.column) for d in caught.value.diagnostics if d.severity == "error"] == [
        (d["code"], d["range"]["start"]["line"], d["range"]["start"]["column"]) for d in spoken]
    assert [d.code for d in zwang.validate(task)] == codes


def mended(text, edits):
    """The text with all edits, the last one first: lines and columns count from 1, ends are exclusive."""
    lines = text.splitlines(keepends=True)
    for e in sorted(edits, key=lambda edit: (edit.line, edit.column), reverse=True):
        before, after = lines[e.line - 1][:e.column - 1], lines[e.end_line - 1][e.end_column - 1:]
        lines[e.line - 1:e.end_line] = [before + e.text + after]
    return "".join(lines)


def test_the_edits_of_a_mistake_mend_it(tmp_path):
    for folder in ("robots", "scenes"):
        shutil.copytree(SPECS / folder, tmp_path / folder)
    task = tmp_path / "task.yaml"
    right = WALL_ALIGN.read_text()
    task.write_text(right.replace("goto: hold", "goto: holt").replace("time_constant", "time_constnt"))
    told = [d for d in zwang.validate(task) if d.severity == "error"]
    assert len(told) == 2 and all(d.edits for d in told)
    said = subprocess.run([PROGRAM, "validate", "--format", "json", task], capture_output=True, text=True, check=False)
    spoken = [e for d in json.loads(said.stdout)["diagnostics"] for e in d["edits"]]
    assert [(e.path, e.line, e.column, e.end_line, e.end_column, e.text) for d in told for e in d.edits] == [
        (e["file"], e["range"]["start"]["line"], e["range"]["start"]["column"], e["range"]["end"]["line"],
         e["range"]["end"]["column"], e["text"]) for e in spoken]
    assert mended(task.read_text(), [e for d in told for e in d.edits]) == right


class Integrator(zwang.Plant):
    """A base whose wheels turn as the torques say, and nothing else: I qdd = tau."""

    def __init__(self, program):
        count = len(program.joints)
        self.time, self.q, self.qd = 0.0, np.zeros(count), np.zeros(count)

    def sense(self, sensed):
        sensed.time = self.time
        sensed.q[:] = self.q
        sensed.qd[:] = self.qd

    def apply(self, command):
        self.qd = self.qd + 1e-3 * command.torque / 0.2
        self.q = self.q + 1e-3 * self.qd
        self.time += 1e-3


def test_an_own_plant_is_driven_to_what_the_task_asks():
    program = zwang.load(SPECS / "laws" / "straight_on.yaml")
    plant = Integrator(program)
    speeds = []
    runner = zwang.run(program, plant, most=3.0, on_tick=lambda runner, sensed: speeds.append(runner.state))
    assert runner.state == "running" or runner.finished
    assert len(speeds) > 1000
    assert np.all(plant.qd > 1.0)


def test_the_log_of_an_own_plant_is_replayed_to_the_last_bit(tmp_path):
    program = zwang.load(SPECS / "laws" / "straight_on.yaml")
    speeds = []
    zwang.run(program, Integrator(program), most=0.5, log=tmp_path / "own",
              on_tick=lambda runner, sensed: speeds.append(np.array(sensed.qd)))
    log = zwang.read_log(tmp_path / "own")
    assert np.array_equal(log[program.joints[0] + ".qd"], [qd[0] for qd in speeds])
    said = subprocess.run([PROGRAM, "replay", tmp_path / "own"], capture_output=True, text=True)
    assert said.returncode == 0, said.stdout + said.stderr
    assert f"{len(speeds)} records, {len(speeds)} with the same torques to the last bit" in said.stdout


def test_a_simulated_run_is_written_as_by_the_program(tmp_path):
    kept = zwang.run(zwang.load(WALL_ALIGN), log=True, most=0.2).log
    zwang.run(zwang.load(WALL_ALIGN), log=tmp_path / "a.mcap", most=0.2)
    written = zwang.read_log(tmp_path / "a.mcap")
    assert written.columns == kept.columns
    assert all(np.array_equal(written[name], kept[name], equal_nan=True) for name in kept.columns)


def test_the_torques_of_a_force_row_are_its_lever_arms():
    program = zwang.load(WALL_ALIGN)
    rows, solver = program.plan("press"), zwang.Solver(program)
    row = int(np.flatnonzero(rows.force)[0])
    assert rows.name[row] == "contact.x" and rows.force[row] == 20.0
    assert np.allclose(rows.A[:, row], [1, 0, 0, 0, 0, 0])
    assert rows.where[row].startswith(str(WALL_ALIGN)) and rows.A.shape == (6, len(rows))
    solution = solver.solve(rows)
    assert solution.status == "ok" and abs(solution.nu[row] - 20.0) < 1e-9
    # Power at rest: ahead, each of four equal wheels takes the same, and the sum of tau / r is the force.
    assert np.allclose(solution.tau, solution.tau[0])
    rows.force = 2.0 * rows.force
    assert np.allclose(solver.solve(rows).tau, 2.0 * solution.tau)
    with pytest.raises(KeyError):
        program.plan("nothing")
    rows.b = np.full(len(rows), np.nan)
    with pytest.raises(ValueError):
        solver.solve(rows)


def test_the_rows_of_another_state():
    """A velocity row asks for (wanted - v) / T: nothing at rest, and twice as much at twice the speed."""
    program = zwang.load(WALL_ALIGN)
    asked = []
    for speed in (0.0, 0.02, 0.04):
        sensed = zwang.Sensed(program)
        sensed.linear[1] = speed
        rows = program.plan("press", sensed)
        asked.append(rows.b[rows.name.index("contact.y")])
    assert asked[0] == 0.0 and asked[1] < 0.0
    assert asked[2] == pytest.approx(2.0 * asked[1], rel=1e-12)
    at_start = program.plan("press")
    assert at_start.name == program.plan("press", zwang.Sensed(program)).name
    with pytest.raises(ValueError, match="another program"):
        program.plan("press", zwang.Sensed(zwang.load(SPECS / "hospital.yaml")))


def test_what_an_own_plant_raises_comes_out():
    class Broken(zwang.Plant):
        def sense(self, sensed):
            raise OSError("no bus")

    with pytest.raises(OSError, match="no bus"):
        zwang.run(zwang.load(WALL_ALIGN), Broken())


def test_a_loop_of_ones_own_on_the_simulated_robot():
    program = zwang.load(WALL_ALIGN)
    plant, runner, sensed = zwang.ScenePlant(program), zwang.Runner(program), zwang.Sensed(program)
    commands = []
    for _ in range(500):
        plant.sense(sensed)
        commands.append(runner.step(sensed))
        plant.apply(commands[-1])
    assert runner.task == "press"
    assert not np.array_equal(commands[0].torque, commands[100].torque)  # each one is a copy
    runner.stop()
    runner.step(sensed)
    assert runner.state == "stopped"
    assert runner.events[-1]["code"] == "requested"


def test_a_command_lasts_a_control_period(tmp_path):
    for folder in ("robots", "scenes"):
        shutil.copytree(SPECS / folder, tmp_path / folder)
    robot = tmp_path / "robots" / "mecanum_base.yaml"
    robot.write_text(robot.read_text() + "control_period: 10 ms\n")
    program = zwang.load(shutil.copy(WALL_ALIGN, tmp_path), robot=robot)
    plant, sensed = zwang.ScenePlant(program), zwang.Sensed(program)
    command = zwang.Runner(program).step(sensed)
    plant.apply(command)
    plant.sense(sensed)
    assert sensed.time == pytest.approx(0.010)


def test_parameters_and_signals_are_told_by_name():
    runner = zwang.Runner(zwang.load(WALL_ALIGN))
    runner.set("push", 25.0)
    with pytest.raises(ValueError, match="no parameter `push`"):
        runner.set("push", 4000.0)
    sensed = zwang.Sensed(zwang.load(SPECS / "hospital.yaml"))
    sensed.measure("loaded", True)
    sensed.measure("nearest", 1.5)
    with pytest.raises(KeyError, match="no signal `nearst`"):
        sensed.measure("nearst", 1.5)


def test_a_parameter_may_be_a_number_in_si():
    assert zwang.load(WALL_ALIGN, params={"push": 30.0}).params["push"] == 30.0
    assert zwang.load(WALL_ALIGN, params={"still": np.float64(0.01)}).params["still"] == pytest.approx(0.01, rel=1e-15)
    with pytest.raises(zwang.Error) as caught:
        zwang.load(WALL_ALIGN, params={"psh": 30.0})
    assert [d.code for d in caught.value.diagnostics] == ["E301"]


def test_texts_are_read_in_the_place_of_files():
    text = WALL_ALIGN.read_text()
    assert zwang.load(WALL_ALIGN, text=text.replace("value: 20 N", "value: 25 N")).params["push"] == 25.0
    wall = (SPECS / "scenes" / "wall.yaml").read_text()
    told = zwang.validate(WALL_ALIGN, open_files={SPECS / "scenes" / "wall.yaml": wall.replace("stiffness", "stifness")})
    assert [(d.code, d.replacement) for d in told if d.severity == "error"] == [("E101", "stiffness")]


def test_files_of_each_kind_are_validated():
    for path in ("wall_align.yaml", "robots/mecanum_base.yaml", "scenes/wall.yaml", "scenarios/wall_align.yaml",
                 "connections/twist.yaml", "studies/docking.yaml"):
        assert [d for d in zwang.validate(SPECS / path) if d.severity == "error"] == [], path


def test_a_connection_is_checked_against_a_task():
    connection = SPECS / "connections" / "twist.yaml"
    told = zwang.validate(connection, task="wall_align")  # a robot on torques
    assert [d.code for d in told if d.severity == "error"] == ["E923"]
    fits = zwang.validate(connection, task="wall_align", robot=SPECS / "robots/blind/mecanum_twist.yaml")
    assert "E923" not in [d.code for d in fits]


def test_shipped_tasks_are_found_by_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert zwang.load("wall_align").path == str(WALL_ALIGN)
    kelo = zwang.load("wall_align", robot="kelo_base", scene="wall_far")
    assert kelo.robot == zwang.load("wall_align", robot=SPECS / "robots/kelo_base.yaml").robot
    assert not [d for d in zwang.validate("wall_align", robot="kelo_base") if d.severity == "error"]
    with pytest.raises(zwang.Error):
        zwang.load("no_such_task")


def test_samples_of_another_type_and_robot_are_refused():
    sensed = zwang.Sensed(zwang.load(SPECS / "hospital.yaml"))
    with pytest.raises(TypeError, match="signal `nearest` is a number in SI"):
        sensed.measure("nearest", "far")
    with pytest.raises(TypeError, match="no twist"):
        sensed.measure("nearest", 1.0, twist=np.zeros(6))
    runner = zwang.Runner(zwang.load(SPECS / "hospital.yaml", robot=SPECS / "robots" / "diff_base.yaml"))
    with pytest.raises(ValueError, match="other joints"):
        runner.step(sensed)
    with pytest.raises(ValueError, match="on_tick"):
        zwang.run(zwang.load(WALL_ALIGN), on_tick=lambda runner, sensed: None, log=True)


def test_a_robot_that_feels_is_told_what_it_feels():
    """Without its efforts it would be stopped after 20 ticks."""
    program = zwang.load(WALL_ALIGN, robot=SPECS / "robots" / "feels" / "mecanum_effort_50_hz.yaml")
    runner, sensed = zwang.Runner(program), zwang.Sensed(program)
    for tick in range(200):
        sensed.time = tick * runner.period
        sensed.measured_at = sensed.time
        sensed.effort = np.zeros(len(program.joints))
        runner.step(sensed)
    assert not [e for e in runner.events if e["code"] == "lost_ticks"]
    assert runner.transitions[0][1] == "press"
    assert "press.contact.x.force" in [limit.row for limit in runner.limits] or runner.limits


def test_every_member_says_what_it_is():
    said = {}
    for name, value in vars(zwang).items():
        if name.startswith("_") or isinstance(value, types.ModuleType):
            continue
        said[name] = value.__doc__
        if isinstance(value, type) and value is not zwang.Error:  # its other members are those of ValueError
            said |= {f"{name}.{m}": getattr(value, m).__doc__ for m in dir(value) if not m.startswith("_")}
    assert [name for name, doc in said.items() if not doc] == []


def test_a_long_run_can_be_interrupted():
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        zwang.run(zwang.load(SPECS / "patrol.yaml"), most=3600.0)


def test_the_tour_runs(monkeypatch, capsys):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    tour = SPECS.parent / "examples" / "python" / "tour.py"
    exec(compile(tour.read_text(), str(tour), "exec"), {"__name__": "__main__"})
    assert re.search(r"largest push: [123]0\.0 N", capsys.readouterr().out)  # some of the pushes do it, and 40 N does not


def test_a_host_reads_what_a_task_sets(tmp_path):
    for folder in ("robots", "scenes"):
        shutil.copytree(SPECS / folder, tmp_path / folder)
    task = tmp_path / "task.yaml"
    task.write_text("""zwang: 2
robot: robots/mecanum_base.yaml
scene: scenes/wall.yaml
start: grip
outputs:
  gripper: {type: bool, stop: keep}
  lamp: {type: number, unit: m, stop: 0 m, start: 20 cm}
tasks:
  grip:
    enter: {set: {outputs.gripper: true}}
    constraints: {go: {move: base, in: base, x: {velocity: 1 cm/s}}}
    timeout: {after: 1 s, goto: done}
""")
    program = zwang.load(task)
    plant, runner, sensed = zwang.ScenePlant(program), zwang.Runner(program), zwang.Sensed(program)
    plant.sense(sensed)
    command = runner.step(sensed)
    assert program.outputs == ["gripper", "lamp"]
    assert command.outputs == [1.0, 0.2]
    assert runner.outputs == {"gripper": 1.0, "lamp": 0.2}


def test_a_sweep_is_its_runs_in_their_order():
    grid = {"push": ["10 N", "20 N"], "start_yaw": [-0.1, 0.1]}
    runs = zwang.sweep(WALL_ALIGN, grid, jobs=2)
    alone = [zwang.run(zwang.load(WALL_ALIGN, params={"push": push}), start_yaw=yaw)
             for push in grid["push"] for yaw in grid["start_yaw"]]
    assert [r.outcome for r in runs] == ["done"] * 4
    assert [r.truth for r in runs] == [r.truth for r in alone]


def test_a_run_leaves_other_threads_their_turn():
    turns = []
    done = threading.Event()

    def count():
        while not done.is_set():
            turns.append(0)
            time.sleep(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    zwang.run(zwang.load(WALL_ALIGN))
    done.set()
    thread.join()
    assert len(turns) > 10


def test_the_blocks_of_the_page_run(monkeypatch, capsys):
    blocks = re.findall(r"```python\n(.*?)```", (SPECS.parent / "docs/python.md").read_text(), re.DOTALL)
    assert len(blocks) == 8
    monkeypatch.chdir(SPECS)
    drawn = []
    plots = types.SimpleNamespace(plot=lambda *columns: drawn.append(columns), show=lambda: None)
    monkeypatch.setitem(sys.modules, "matplotlib", types.SimpleNamespace(pyplot=plots))  # a package of its own
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", plots)
    names: dict = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)  # as a reader pastes them, one after the other
    run, (time_drawn, force_drawn) = names["run"], drawn[0]
    assert run.outcome == "done"
    assert len(time_drawn) == len(force_drawn) and np.nanmax(force_drawn) == run.truth["wall.peak_force"]
    # The page's question has no answer as the file ships, and one within the range of the push at half of the speed.
    assert run.truth["wall.peak_force"] > 150.0
    assert 0 < len(names["gentle"]) < len(names["pushes"])
    assert names["runner"].task == "press" and "E202" in capsys.readouterr().out
