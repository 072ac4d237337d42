"""`zwang drive` and `zwang simulate` as two processes, over DDS on this machine.

    two_processes.py PROGRAM ROOT FOLDER_OF_CLIENTS [docking]

A run ends as the same run inside one process does, with its peak force within 10 %. Either side may
be killed or stopped: the other one brakes. Ends with 1 and says why when anything is otherwise.
"""

import concurrent.futures
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

from pair import CLOCK, EFFORT, PATIENCE, SIGNALS, SLACK, STALE_AFTER, TIMEOUT, TWIST, VELOCITY, Pair
from pair import Unreachable, expect, kill_what_runs, number, resident, skip_unless_long, start, workplace


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


def silence_of_the_robot_stops(program, root, folder):
    pair = Pair(program, folder, workplace(root, folder), EFFORT, [], 3)
    pair.wait_until_it_drives(0.4)
    pair.simulate.send_signal(signal.SIGSTOP)
    time.sleep(0.5)
    # Nobody shows it a base at rest: it would brake for 10 s.
    pair.drive.send_signal(signal.SIGTERM)
    code = pair.drive.wait(20)
    pair.simulate.kill()
    drive = pair.text("drive")
    expect(code == 1 and "stopped" in drive, "it is not stopped", drive)
    silence = number(r"stopped ([0-9.]+) ms after the last sample", drive)
    expect(silence < 1e3 * (STALE_AFTER + SLACK), "it stops late", drive)


def a_killed_drive_leaves_a_robot_at_rest(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 4)
    pair.wait_until_it_drives(0.7)
    pair.drive.kill()
    _, _, simulate = pair.end()
    last = number(r"last command at ([0-9.]+) s", simulate)
    expect(0.1 < last < 2.5, "it was not killed while it drove", simulate)
    # The timeout, then the brake of the simulated drive, which is a step.
    expect(number(r"moved last at ([0-9.]+) s", simulate) - last < TIMEOUT + 0.5 + SLACK, "it goes on", simulate)


def a_request_ends_it_with_zeros(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 5)
    pair.wait_until_it_drives(0.3)
    pair.drive.send_signal(signal.SIGTERM)
    code, drive, simulate = pair.end()
    expect(code == 1 and "stopped after" in drive, "it is not stopped", drive)
    last = number(r"last command at ([0-9.]+) s", simulate)
    expect(number(r"moved last at ([0-9.]+) s", simulate) < last + 0.5, "it moved behind the last command", simulate)


def services_start_and_stop_it(program, root, folder):
    # Slowly and for long: a client takes a second or more until it has found the service.
    task = folder / "slow.yaml"
    task.write_text("zwang: 2\nrobot: robot.yaml\nstart: go\ntasks:\n  go:\n    constraints:\n"
                    "      go: {move: base_link, in: base_link, x: {velocity: 0.02 m/s}, y: {velocity: 0 m/s}, "
                    "rz: {velocity: 0 rad/s}}\n    exits:\n      - {when: elapsed > 60 s, goto: done}\n", encoding="utf-8")
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml", "--scene", root / "specs/scenes/open.yaml"]
    pair = Pair(program, folder, task, TWIST, options, 6, more="start: wait\n" + CLOCK)
    pair.wait_for("waiting for the service /zwang/start")
    time.sleep(0.5)
    expect("the task begins" not in pair.text("drive"), "it begins before it is asked to", pair.text("drive"))
    expect(pair.call("/zwang/start").startswith("success"), "start is refused", pair.text("drive"))
    pair.wait_until_it_drives(0.5)
    expect(pair.call("/zwang/start") == "refused: the task runs already\n", "it starts twice", pair.text("drive"))
    expect(pair.call("/zwang/stop") == "success: it brakes, and the run ends\n", "stop is refused")
    code, drive, _ = pair.end()
    expect(code == 1 and "stopped after" in drive, "it is not stopped", drive)


def this_machine_alone_is_enough(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 7, ros2="reach: machine")
    code, drive, simulate = pair.end()
    expect(code == 0, "not done", drive, simulate)


def a_stuck_odometry_stops(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 8,
                base="  base: {topic: /odom}\n", simulated=["--stuck-odometry", "0.6"])
    code, drive, simulate = pair.end()
    expect(code == 1 and "frozen_base" in drive, "it is not stopped", drive, simulate)
    # 0.5 m/s^2 to 0.3 m/s in 9 cm. 2 cm and 0.1 s of patience at 0.4 m/s at most, then 8 cm of braking from there.
    expect(number(r"base at (-?[0-9.]+) m", simulate) < 0.09 + 0.02 + 0.4 * (0.1 + SLACK) + 0.08, "it goes on", simulate)


ROLL = """zwang: 2
robot: robot.yaml
start: go
params: {speed: {value: 0.02 m/s, range: [0.01 m/s, 0.3 m/s]}, until: {value: 60 s, range: [0.1 s, 60 s]}}
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: $speed}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: elapsed > $until, goto: done}
    timeout: {after: 100 s, goto: failed}
"""


def goals_run_tasks(program, root, folder):
    (folder / "roll.yaml").write_text(ROLL, encoding="utf-8")
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml", "--scene", root / "specs/scenes/open.yaml"]
    pair = Pair(program, folder, folder / "roll.yaml", TWIST, options, 9, more="start: goals\ntasks: {roll: roll.yaml}\n")
    pair.wait_for("waiting for goals")
    said = pair.goal("dance")
    expect("status 6, outcome 4: task `dance` is unknown: the connection file has `roll`" in said, "unknown", said)
    said = pair.goal("roll", "speed=3 m/s")
    expect("status 6, outcome 4" in said and "speed" in said, "a parameter out of its range", said)
    said = pair.goal("roll", "speed=0.2 m/s", "until=1 s")
    expect("topic says 4, feedback came" in said and "status 4, outcome 0: \n" in said, "not done", said)
    said = pair.goal("roll", cancel_after=1.0)
    expect("cancel says 0 of 1" in said and "status 5, outcome 3" in said, "not cancelled", said)
    # 0.2 m/s for 1 s and 0.02 m/s for 1 s at most, and a brake from each.
    pair.drive.send_signal(signal.SIGTERM)
    code = pair.drive.wait(20)
    pair.simulate.send_signal(signal.SIGTERM)
    pair.simulate.wait(20)
    expect(code == 0, "it has not ended well", pair.text("drive"))
    way = number(r"base at (-?[0-9.]+) m", pair.text("simulate"))
    expect(0.05 < way < 0.28, "another way", pair.text("simulate"), pair.text("drive"))


def a_parameter_is_set_while_it_drives(program, root, folder):
    (folder / "roll.yaml").write_text(ROLL, encoding="utf-8")
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml", "--scene", root / "specs/scenes/open.yaml"]
    pair = Pair(program, folder, folder / "roll.yaml", TWIST, options, 12)
    pair.wait_until_it_drives(0.1)
    expect(pair.client("parameter_client", "speed", "3") == "`speed` is from 0.01 to 0.3, in SI, now 0.02\n", "out of range")
    expect(pair.client("parameter_client", "pull", "3").startswith("the task has no parameter `pull`"), "unknown")
    expect(pair.client("parameter_client", "until", "0.2") == "set, now 0.2\n", "not set")
    code, drive, _ = pair.end()  # else it would drive for 60 s
    expect(code == 0 and "done after" in drive, "not done", drive)


def transforms_tell_where_it_is(program, root, folder):
    scene = folder / "measured.yaml"
    scene.write_text("zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 0 deg}\nfloor: {friction: 0.9}\nstate: {fix: {rate: 20 Hz}}\n", encoding="utf-8")
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml", "--scene", scene]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 14,
                base="  fix: {tf: {parent: map, child: base_link}}\n")
    code, drive, simulate = pair.end()
    expect(code == 0 and "done after" in drive, "not done", drive, simulate)
    # 2 s at 20 Hz, and the same before; a message that is late or lost is none of this law.
    expect(number(r"/tf \(tf2_msgs/TFMessage\): ([0-9]+) received, 0 bad", drive) > 20, "they do not come", drive)


def the_base_is_told_to_others(program, root, folder):
    """Another `drive` looks: it hears zwang's odometry and its transform as those of a robot."""
    (folder / "roll.yaml").write_text(ROLL.replace("value: 0.02 m/s", "value: 0.1 m/s"), encoding="utf-8")
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml", "--scene", root / "specs/scenes/open.yaml"]
    pair = Pair(program, folder, folder / "roll.yaml", TWIST, options, 43,
                more="publish: {odometry: {topic: /zwang/odom}, tf: {parent: odom, child: base_link}}\n")
    pair.wait_until_it_drives(1.0)
    looking = folder / "looking.yaml"
    text = (folder / "connection_43.yaml").read_text(encoding="utf-8")
    text = re.sub(r"publish: .*\n", "", text)
    looking.write_text(text.replace("command:", "  base: {topic: /zwang/odom}\n  fix: {tf: {parent: odom, child: base_link}}\n"
                                    "command:"), encoding="utf-8")
    said = start([program, "drive", folder / "roll.yaml", "--over", looking, "--observe", "3"] + options,
                 stdout=subprocess.PIPE, text=True).communicate(timeout=60)[0]
    pair.drive.send_signal(signal.SIGTERM)
    pair.end()
    # 50 times a second; 0.1 m/s for 3 s, less what it takes to find each other.
    for topic in ("/zwang/odom", "/tf"):
        rate = number(re.escape(topic) + r" \(.*\): \d+ received, 0 bad, ([0-9.]+) Hz", said)
        expect(40.0 < rate < 55.0, "another rate", said)
    expect(0.05 < number(r"the base went (-?[0-9.]+) m ahead", said) < 0.35, "another way", said)


def a_stopped_task_begins_anew(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 44, more="start: wait\n")
    pair.wait_for("waiting for the service /zwang/start")
    expect(pair.call("/zwang/start").startswith("success"), "start is refused", pair.text("drive"))
    pair.wait_until_it_drives(0.5)
    pair.simulate.send_signal(signal.SIGSTOP)
    time.sleep(STALE_AFTER + SLACK)
    pair.simulate.send_signal(signal.SIGCONT)
    pair.wait_for("waiting for the service /zwang/reset")
    expect("stopped after" in pair.text("drive"), "it is not stopped", pair.text("drive"))
    expect(pair.call("/zwang/start") == "refused: the protective stop is latched: call /zwang/reset first\n", "it starts")
    expect(pair.call("/zwang/reset") == "success: /zwang/start begins the task anew\n", "reset is refused")
    time.sleep(0.5)
    expect(pair.text("drive").count("the task begins") == 1, "it begins before it is asked to", pair.text("drive"))
    expect(pair.call("/zwang/start").startswith("success"), "the second start is refused", pair.text("drive"))
    code, drive, _ = pair.end()
    expect(code == 0 and "done after" in drive, "not done", drive)


def a_late_computer_is_told(program, root, folder):
    """A drive that stands for ten of its cycles of 2 ms: half of what the guard rides through."""
    pair = Pair(program, folder, workplace(root, folder), EFFORT, [], 45)
    pair.wait_until_it_drives(0.4)
    pair.drive.send_signal(signal.SIGSTOP)
    time.sleep(0.02)
    pair.drive.send_signal(signal.SIGCONT)
    time.sleep(0.3)
    pair.drive.send_signal(signal.SIGTERM)
    _, drive, _ = pair.end()
    expect("overrun time 0.0" in drive, "it does not say that it was late", drive)


def a_clock_in_long_steps_is_refused(program, root, folder):
    """Ticks of 0.4 ms here, and a simulator that tells the time every 10 ms: 20 ticks are 8 ms."""
    task, slow = workplace(root, folder), folder / "robot_of_the_simulator.yaml"
    text = (folder / "robot.yaml").read_text(encoding="utf-8")
    slow.write_text(text.replace("control_period: 2 ms", "control_period: 10 ms"), encoding="utf-8")
    (folder / "robot.yaml").write_text(text.replace("control_period: 2 ms", "control_period: 0.4 ms"), encoding="utf-8")
    pair = Pair(program, folder, task, EFFORT, [], 46, more=CLOCK, simulated=["--robot", slow])
    code = pair.drive.wait(30)
    pair.simulate.send_signal(signal.SIGTERM)
    pair.simulate.wait(20)
    said = "/clock tells the time every 0.01 s, and a robot that ticks every 0.0004 s is stopped after 0.008 s"
    expect(code == 2 and said in pair.text("drive"), "it is not refused", pair.text("drive"))
    expect("last command at 0.000 s" in pair.text("simulate") or "moved last at 0.000 s" in pair.text("simulate"), "it moves",
           pair.text("simulate"))


def ten_thousand_calls_are_answered(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 10, more="start: wait\n")
    pair.wait_for("waiting for the service /zwang/start")
    begin = resident(pair.drive.pid)
    pair.simulate.kill()  # so that each call is refused
    time.sleep(0.5)
    said = pair.call("/zwang/start", 10_000)
    expect(said == "refused: no samples come from the robot\n", "a call is not answered", said)
    grown = resident(pair.drive.pid) - begin
    pair.drive.kill()
    expect(grown < 20e6, f"it has grown by {grown} bytes", "")


def cyclone_is_answered(program, root, folder):
    if not (Pair.clients / "cyclone_client").exists():
        print("skipped: Cyclone DDS is not installed (cyclonedds-dev, cyclonedds-tools)", flush=True)
        return
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 13, ros2="reach: machine",
                more="start: wait\n")
    pair.wait_for("waiting for the service /zwang/start")
    said = pair.client("cyclone_client", "/zwang/start", "0")
    expect('state {"state":"ready"' in said, "the state does not reach a late subscriber", said)
    expect("health 0 zwang: task: ready (mecanum_base, 2 values)" in said, "the diagnostics do not come", said)
    said = pair.client("cyclone_client", "/zwang/reset", "1000")
    expect("1000 of 1000 answered: nothing is latched" in said, "a call is not answered", said)
    said = pair.client("cyclone_client", "/zwang/start", "50")
    code, drive, _ = pair.end()
    expect("50 of 50 answered: the task" in said, "a call is not answered", said)
    expect(code == 0 and "done after" in drive, "the first call has not started it", drive)


def ends_over_cyclone(program, folder, task, command, number_of_pair, **parts):
    """A run of the twist base over a robot by Cyclone DDS, done: what `drive`, `simulate` and the robot say."""
    scene = folder / "measured.yaml"
    scene.write_text("zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 0 deg}\nfloor: {friction: 0.9}\nstate: {fix: {rate: 20 Hz}}\n"
                     "objects: {wall: {wall: {length: 4 m}, at: [2 m, 0 m], fixed: true}}\n"
                     "signals: {ahead: {distance_to: wall}}\n", encoding="utf-8")
    options = ["--robot", pathlib.Path(task).parent / "robot.yaml", "--scene", scene]
    pair = Pair(program, folder, task, command, options, number_of_pair, "reach: machine", motors_apart=32, **parts)
    robot = pair.start_cyclone_robot()
    code, drive, simulate = pair.end(within=120)
    robot.terminate()
    passed = robot.communicate(timeout=20)[0]
    expect(code == 0 and "done after" in drive, "not done", drive, simulate, passed)
    return drive, simulate, passed


def messages_pass_cyclone(program, root, folder):
    """Those that no use case has: an odometry, a fix of both kinds, a scan, a twist without a stamp."""
    if not Pair.has_cyclone():
        print("skipped: Cyclone DDS is not installed (cyclonedds-dev, cyclonedds-tools)", flush=True)
        return
    (folder / "robot.yaml").write_text((root / "specs/robots/blind/mecanum_twist.yaml").read_text(encoding="utf-8").replace(
        "based_on: ../mecanum_base.yaml", "based_on: mecanum_base.yaml"), encoding="utf-8")
    for part in ("mecanum_base.yaml", "mecanum_base.urdf"):
        (folder / part).write_text((root / "specs/robots" / part).read_text(encoding="utf-8"), encoding="utf-8")
    task = folder / "roll.yaml"
    task.write_text(ROLL.replace("value: 0.02 m/s", "value: 0.2 m/s").replace("tasks:\n", "signals: {ahead: {type: number, unit: m, stale_after: 200 ms}}\ntasks:\n")
                    .replace("elapsed > $until", "ahead < 1.2 m"), encoding="utf-8")
    twist = TWIST.replace("TwistStamped", "Twist")
    scan = "signals:\n  ahead: {topic: /scan, type: sensor_msgs/LaserScan, nearest: [-10 deg, 10 deg]}\n"
    # The base stands 2 m before the wall and ends 1.2 m before it, and the brake's 0.2 m/s.
    for number_of_pair, fix in ((47, "fix: {topic: /amcl_pose}"), (48, "fix: {tf: {parent: map, child: base_link}}")):
        drive, simulate, passed = ends_over_cyclone(program, folder, task, twist, number_of_pair, more=CLOCK + scan,
                                                    base=f"  base: {{topic: /odom}}\n  {fix}\n")
        expect(0.75 < number(r"base at (-?[0-9.]+) m", simulate) < 0.9, "another way", simulate)
        for topic in ("/odom", "/scan", "/cmd_vel", "/amcl_pose" if "topic" in fix else "/tf"):
            expect(number(rf"rt{topic}: (\d+) passed", passed) > 10, f"{topic} has not passed", passed)
            if topic != "/cmd_vel":
                expect(number(re.escape(topic) + r" \([^)]*\): \d+ received, (\d+) bad", drive) == 0, "it is bad", drive)


def observing_tells_clocks_that_differ(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    for number_of_pair, ahead, wanted in ((41, "0", 0), (42, "3600", 1)):
        pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options + ["--wait", "30"],
                    number_of_pair, simulated=["--stamps-ahead", ahead], more="start: wait\n")
        pair.drive.kill()  # another process looks
        words = [program, "drive", root / "specs/laws/speed_limit.yaml", "--over",
                 folder / f"connection_{number_of_pair}.yaml", "--observe", "3"] + options
        said = subprocess.run(words, capture_output=True, text=True, check=False)
        pair.simulate.kill()
        expect(said.returncode == wanted, f"exit code {said.returncode}, not {wanted}", said.stdout, said.stderr)
        expect(("more than stale_after" in said.stdout) == (wanted == 1), "the clocks", said.stdout)


def a_robot_that_comes_back_is_not_driven_on(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 11)
    pair.wait_until_it_drives(0.5)
    pair.simulate.kill()
    pair.simulate.wait()
    time.sleep(0.6)  # 0.1 s until it is told, and the brake from 0.4 m/s at most
    # The same robot, after its driver was started anew on a computer whose clock is an hour ahead.
    again = folder / "again"
    with open(again, "w", encoding="utf-8") as out:
        words = [program + "-simulate", root / "specs/laws/speed_limit.yaml", "--over", folder / "connection_11.yaml",
                 "--stamps-ahead", "3600"] + options
        pair.simulate = start(words, stdout=out, stderr=out)
    code, drive, _ = pair.end()
    simulate = again.read_text(encoding="utf-8")
    expect(code == 1 and "stopped after" in drive, "it is not stopped", drive)
    expect(abs(number(r"base at (-?[0-9.]+) m", simulate)) < 0.01, "it drives on", drive, simulate)


def main(program, root, clients):
    Pair.clients = pathlib.Path(clients)
    root = pathlib.Path(root)

    def is_good(case):
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            try:
                case(program, root, pathlib.Path(folder))
                print(f"ok      {time.monotonic() - begin:5.1f} s  {case.__name__}", flush=True)
                return True
            except AssertionError as error:
                print(f"FAILED  {time.monotonic() - begin:5.1f} s  {case.__name__}\n{error}", flush=True)
                return False

    # Mostly they wait: two at a time take a tenth of a processor.
    cases = (wall_aligns_as_inside_one_process, a_twist_drives_as_far, silence_of_the_robot_stops,
             a_killed_drive_leaves_a_robot_at_rest, a_request_ends_it_with_zeros, services_start_and_stop_it,
             this_machine_alone_is_enough, a_stuck_odometry_stops, goals_run_tasks, ten_thousand_calls_are_answered,
             a_robot_that_comes_back_is_not_driven_on, a_parameter_is_set_while_it_drives, cyclone_is_answered,
             observing_tells_clocks_that_differ, transforms_tell_where_it_is, the_base_is_told_to_others,
             a_stopped_task_begins_anew, a_late_computer_is_told, a_clock_in_long_steps_is_refused, messages_pass_cyclone,
             *(ends_as_inside_one_process(name, 15 + i) for i, name in enumerate(SIGNALS)),
             *(ends_as_inside_one_process(name, 20 + i, by_cyclone=True) for i, name in enumerate(SIGNALS)))
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
