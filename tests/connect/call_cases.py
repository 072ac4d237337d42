"""What others ask of `zwang drive` and hear from it: services, goals, parameters, transforms. For two_processes.py."""

import re
import signal
import subprocess
import time

from pair import CLOCK, ROLL, SLACK, STALE_AFTER, TWIST, Pair, expect, number, resident, start


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
    pair = Pair(program, folder, folder / "roll.yaml", TWIST, options, 12, more=CLOCK)
    pair.wait_until_it_drives(0.1)
    for name, value, told in (("speed", "3", "`speed` is from 0.01 to 0.3, in SI, now 0.02\n"),
                              ("pull", "3", "the task has no parameter `pull`"), ("until", "0.2", "set, now 0.2\n")):
        said = pair.client("parameter_client", name, value)
        expect(said.startswith(told), f"{name} {value}: not `{told}`", said, pair.text("drive"))
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
                more=CLOCK + "publish: {odometry: {topic: /zwang/odom}, tf: {parent: odom, child: base_link}}\n")
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
    # Each 50 times a second, as the joints, on a machine that may be late; 0.1 m/s for 3 s, less what it takes to find each other.
    joints, *others = (number(re.escape(topic) + r" \(.*\): \d+ received, 0 bad, ([0-9.]+) Hz", said)
                       for topic in ("/joint_states", "/zwang/odom", "/tf"))
    expect(all(0.8 * joints < rate < 1.1 * joints for rate in others), "another rate", said, pair.text("drive"))
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


CASES = (services_start_and_stop_it, goals_run_tasks, a_parameter_is_set_while_it_drives, transforms_tell_where_it_is,
         the_base_is_told_to_others, a_stopped_task_begins_anew, ten_thousand_calls_are_answered)
