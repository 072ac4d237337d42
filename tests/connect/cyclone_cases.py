"""Cyclone DDS as the other side of `zwang drive`, for two_processes.py."""

import pathlib
import re

from pair import CLOCK, ROLL, TWIST, Pair, expect, number


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


CASES = (cyclone_is_answered, messages_pass_cyclone)
