"""Each shipped task that a wire can carry, over `zwang drive` and `zwang simulate` on the robot of its own file.

    matrix.py PROGRAM ROOT FOLDER_OF_CLIENTS [fast|cyclone] [TASK ..]

Once with Fast DDS on both sides, once with a robot by Cyclone DDS, where that is installed. The verdict is that of one
process, and each peak force above 20 N is within 10 % of it.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import pair as both
import yaml

MESSAGES = {"bool": "std_msgs/Bool", "number": "std_msgs/Float64", "pose": "geometry_msgs/PoseStamped",
            "wrench": "geometry_msgs/WrenchStamped"}
LEAST_PEAK = 20.0  # [N] of the peaks that are compared

# Tasks that go on until somebody ends them.
WITHOUT_END = {"patrol", "guide"}


def topics_of(task):
    text = ""
    for section in ("signals", "outputs"):
        declared = yaml.safe_load(task.read_text(encoding="utf-8")).get(section) or {}
        lines = [f"  {name}: {{topic: /{section}/{name}, type: {MESSAGES[of['type']]}}}\n" for name, of in declared.items()]
        text += f"{section}:\n{''.join(lines)}" if lines else ""
    return text


def told_of(program, task, folder, what):
    """What E923 says of a command without motors: what the drive takes, and each motor. Nothing is sent."""
    connection = folder / "motors.yaml"
    connection.write_text("zwang_connection: 1\nstate: {joints: {topic: /joint_states}}\n" + topics_of(task) +
                          f"command: {{joints: {{topic: /c, what: {what}, order: [], timeout: 200 ms}}}}\n", encoding="utf-8")
    return subprocess.run([program, "drive", task, "--over", connection, "--observe", "0.1"], capture_output=True, text=True,
                          check=False).stderr


def command_of(program, task, folder):
    what = "effort"
    said = told_of(program, task, folder, what)
    if "takes twists" in said:
        return both.TWIST
    if "takes wheel velocities" in said:
        what = "velocity"
        said = told_of(program, task, folder, what)
    motors = re.findall(r"leaves out the motor of joint `([^`]+)`", said)
    return f"command:\n  joints: {{topic: /commands, what: {what}, order: [{', '.join(motors)}], timeout: 300 ms}}\n"


def drive_over(middleware, program, task, folder, number):
    """What `drive` and `simulate` say of a run."""
    command, more = command_of(program, task, folder), both.CLOCK + topics_of(task)
    if middleware == "fast":
        return both.Pair(program, folder, task, command, [], number, more=more, stale_after=both.PATIENCE).end(within=600)[1:]
    pair = both.Pair(program, folder, task, command, [], number, ros2="reach: machine", more=more, motors_apart=32,
                     stale_after=both.PATIENCE)
    robot = pair.start_cyclone_robot()
    _, drive, simulate = pair.end(within=600)
    robot.terminate()
    passed = robot.communicate(timeout=20)[0]
    both.expect(both.number(r"rt/joint_states: (\d+) passed", passed) > 20, "the robot has told nothing", passed, drive)
    return drive, simulate


def ends_as_alone(middleware, program, root, folder, name, number):
    task = root / f"specs/{name}.yaml"
    alone = subprocess.run([program, "run", task, "--quiet", "--format", "json", "--log", folder / "log"], capture_output=True,
                           text=True, check=False)
    report = json.loads(alone.stdout)
    drive, simulate = drive_over(middleware, program, task, folder, number)
    both.expect(report["outcome"] + " after" in drive, f"alone it is {report['outcome']}", drive, simulate)
    peaks = []
    for thing, truth in report["truth"].items():
        alone_peak = truth.get("peak_force") or 0.0
        if thing == "base" or alone_peak < LEAST_PEAK:
            continue
        peak = both.number(re.escape(thing) + r": force [0-9.-]+ N, peak ([0-9.]+) N", simulate)
        both.expect(abs(peak - alone_peak) < 0.1 * alone_peak, f"{thing}: peak {peak} N, alone {alone_peak} N", drive, simulate)
        peaks.append(f"{thing} {peak:.0f} N, alone {alone_peak:.0f} N")
    return f"{report['outcome']}; " + ", ".join(peaks)


def main(program, root, clients, *names):
    both.Pair.clients = pathlib.Path(clients)
    root = pathlib.Path(root)
    all_names = sorted(p.stem for p in (root / "specs").glob("*.yaml") if p.stem not in WITHOUT_END)
    middlewares = [name for name in names if name in ("fast", "cyclone")]
    names = [name for name in names if name not in middlewares]
    if not middlewares:
        middlewares = ["fast", "cyclone"] if both.Pair.has_cyclone() else ["fast"]
    is_good = True
    for number, (middleware, name) in enumerate((m, n) for m in middlewares for n in names or all_names):
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            try:
                said = ends_as_alone(middleware, program, root, pathlib.Path(folder), name, 50 + number)
                print(f"ok      {middleware} {name}: {said}", end="")
            except (AssertionError, subprocess.TimeoutExpired) as error:
                is_good = False
                print(f"FAILED  {middleware} {name}: {error}", end="")
            print(f" ({time.monotonic() - begin:.0f} s)", flush=True)
        both.kill_what_runs()
    return 0 if is_good else 1


if __name__ == "__main__":
    both.skip_unless_long()
    sys.exit(main(*sys.argv[1:]))
