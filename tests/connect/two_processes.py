"""`zwang drive` and `zwang simulate` as two processes, over DDS on this machine.

    two_processes.py PROGRAM ROOT FOLDER_OF_CLIENTS [CASE ..]

A run ends as the same run inside one process does, with its peak force within 10 %. Either side may
be killed or stopped: the other one brakes. Ends with 1 and says why when anything is otherwise.
"""

import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import call_cases
import cyclone_cases
import stop_cases
from pair import CLOCK, EFFORT, PATIENCE, SIGNALS, TWIST, VELOCITY, Pair, Unreachable, expect, kill_what_runs, number
from pair import skip_unless_long, workplace


def wall_aligns_as_inside_one_process(program, root, folder):
    task = workplace(root, folder)
    alone = subprocess.run([program, "run", task, "--quiet", "--log", folder / "log"], capture_output=True, text=True,
                           check=False)
    expect(alone.returncode == 0, "the task is not done inside one process", alone.stdout, alone.stderr)
    peak_alone = number(r"peak ([0-9.]+) N", alone.stdout)
    code, drive, simulate = Pair(program, folder, task, EFFORT, [], 1, more=CLOCK).end()
    expect(code == 0 and "done after" in drive, "not done", drive, simulate)
    peak = number(r"wall: force [0-9.-]+ N, peak ([0-9.]+) N", simulate)
    expect(abs(peak - peak_alone) < 0.1 * peak_alone, f"peak {peak} N, alone {peak_alone} N", drive, simulate)
    expect(abs(number(r"yaw (-?[0-9.]+) deg", simulate)) < 0.1, "the wall has not squared it up", simulate)


def ends_as_inside_one_process(name, number_of_pair, by_cyclone=False):
    """A use case by efforts and velocities at 50 Hz, by the clock of the simulation.

    `by_cyclone`: all that the task hears comes from Cyclone DDS, and all that it says goes there.
    """

    def case(program, root, folder):
        task = root / f"specs/{name}.yaml"
        options = ["--robot", root / "specs/robots/feels/mecanum_effort_50_hz.yaml"]
        alone = subprocess.run([program, "run", task, "--quiet", "--format", "json", "--log", folder / "log"] + options,
                               capture_output=True, text=True, check=False)
        report = json.loads(alone.stdout)
        more = CLOCK + SIGNALS[name]
        robot = None
        if by_cyclone:
            if not Pair.has_cyclone():
                print("skipped: Cyclone DDS is not installed (cyclonedds-dev, cyclonedds-tools)", flush=True)
                return
            pair = Pair(program, folder, task, VELOCITY, options, number_of_pair, "reach: machine", more, motors_apart=32,
                        stale_after=PATIENCE)
            robot = pair.start_cyclone_robot()
        else:
            pair = Pair(program, folder, task, VELOCITY, options, number_of_pair, more=more, stale_after=PATIENCE)
        try:
            _, drive, simulate = pair.end(within=240)
        except subprocess.TimeoutExpired:  # nobody has commanded it, or it hangs
            pair.drive.kill()
            pair.simulate.kill()
            drive, simulate = pair.text("drive"), pair.text("simulate")
        if robot:
            robot.terminate()
            passed = robot.communicate(timeout=20)[0]
            expect(number(r"rt/joint_states: (\d+) passed", passed) > 100, "the robot has told nothing", passed, drive)
            expect(number(r"commands: (\d+) passed", passed) > 100, "the robot was told nothing", passed, drive)
        if "no time on /clock" in drive:
            raise Unreachable(drive)
        expect(report["outcome"] + " after" in drive, f"alone it is {report['outcome']}", drive, simulate)
        for thing, truth in report["truth"].items():
            peak_alone = truth.get("peak_force") or 0.0
            if thing == "base" or peak_alone < 20.0:
                continue
            peak = number(thing + r": force [0-9.-]+ N, peak ([0-9.]+) N", simulate)
            expect(abs(peak - peak_alone) < 0.1 * peak_alone, f"peak {peak} N, alone {peak_alone} N", drive, simulate)

    case.__name__ = f"{name}_ends_as_inside_one_process" + ("_by_cyclone" if by_cyclone else "")
    return case


def a_twist_drives_as_far(program, root, _folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    task = root / "specs/laws/speed_limit.yaml"
    code, drive, simulate = Pair(program, _folder, task, TWIST, options, 2, more=CLOCK).end()
    expect(code == 0, "not done", drive, simulate)
    # 0.5 m/s^2 up to 0.4 m/s within 2 s, and down at 1 m/s^2: 0.64 m + 0.08 m.
    expect(abs(number(r"base at (-?[0-9.]+) m", simulate) - 0.72) < 0.04, "another way", simulate)


def a_log_tells_how_it_ended(program, root, folder):
    """By the clock of this computer, which counts from 1970."""
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    log = folder / "log.mcap"
    code, drive, simulate = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 31,
                                 driven=["--log", log]).end()
    expect(code == 0, "not done", drive, simulate)
    told = json.loads(subprocess.run([program, "info", log, "--format", "json"], capture_output=True, text=True, check=False).stdout)
    expect(told["outcome"] == "done" and told["verdict"].startswith("done after"), "no outcome", str(told))
    said = subprocess.run([program, "info", log], capture_output=True, text=True, check=False).stdout
    # At 0.5 m/s^2 to 0.4 m/s, for 2 s in all.
    expect(1.9 < number(r"from ([0-9.]+) s *task `done`", said) < 2.2, "times are not those of the run", said)


def a_page_has_the_margins(program, root, folder):
    """As that of `zwang run` has them: of the same rows, at the same lines."""
    if not (root / "web/dist/report.html").exists():
        print("skipped: the parts of the page are not built: ./dev web", flush=True)
        return
    task, robot = root / "specs/laws/speed_limit.yaml", ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    run = subprocess.run([program, "run", task, *robot, "--log", folder / "run", "--format", "json"], capture_output=True, text=True, check=True)
    of_run = {one["row"]: one["where"] for one in json.loads(run.stdout)["limits"]}
    log, page = folder / "log.mcap", folder / "page.html"
    code, drive, simulate = Pair(program, folder, task, TWIST, robot, 32, driven=["--log", log]).end()
    expect(code == 0, "not done", drive, simulate)
    subprocess.run([program, "report", log, "-o", page], check=True, capture_output=True)
    _, found, rest = page.read_text(encoding="utf-8").partition('"limits":[')
    expect(found, "no margins on the page", drive, simulate)
    limits = {one["row"]: one for one in json.JSONDecoder().raw_decode("[" + rest)[0]}
    of_drive = {row: one["where"] for row, one in limits.items()}
    expect(of_drive == of_run, "other rows", str(of_drive), str(of_run))
    # At 0.5 m/s^2 for 2 s into the limit of 0.4 m/s.
    worst = limits["go.ahead.x.velocity"]
    expect(worst["limit"] == 0.4 and abs(worst["worst"] - 0.4) < 0.02, "another limit", str(worst))


def this_machine_alone_is_enough(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 7, ros2="reach: machine")
    code, drive, simulate = pair.end()
    expect(code == 0, "not done", drive, simulate)


def main(program, root, clients, *chosen):
    Pair.clients = pathlib.Path(clients)
    root = pathlib.Path(root)

    def is_good(case):
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            try:
                case(program, root, pathlib.Path(folder))
                print(f"ok      {time.monotonic() - begin:5.1f} s  {case.__name__}", flush=True)
                return True
            except (AssertionError, subprocess.SubprocessError) as error:
                print(f"FAILED  {time.monotonic() - begin:5.1f} s  {case.__name__}\n{error}", flush=True)
                return False

    # Mostly they wait: two at a time take a tenth of a processor.
    cases = (wall_aligns_as_inside_one_process, a_twist_drives_as_far, a_log_tells_how_it_ended, a_page_has_the_margins,
             this_machine_alone_is_enough,
             *stop_cases.CASES, *call_cases.CASES, *cyclone_cases.CASES,
             *(ends_as_inside_one_process(name, 15 + i) for i, name in enumerate(SIGNALS)),
             *(ends_as_inside_one_process(name, 20 + i, by_cyclone=True) for i, name in enumerate(SIGNALS)))
    if chosen:
        cases = [case for case in cases if case.__name__ in chosen]
    try:
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            return 0 if all(list(pool.map(is_good, cases))) else 1
    finally:
        kill_what_runs()


def docking_alone(program, root, _clients):
    """The one that every run of the tests has: it waits for its commands, and takes little of a processor."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            ends_as_inside_one_process("docking", 30)(program, pathlib.Path(root), pathlib.Path(folder))
        except Unreachable as error:
            print(f"skipped: DDS finds no peer here\n{error}")
            return 77
    return 0


if __name__ == "__main__":
    if sys.argv[4:] == ["docking"]:
        sys.exit(docking_alone(*sys.argv[1:4]))
    skip_unless_long()
    sys.exit(main(*sys.argv[1:]))
