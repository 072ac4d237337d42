"""What stops a robot that `zwang drive` moves, and what it says of that, for two_processes.py."""

import signal
import subprocess
import time

from pair import CLOCK, EFFORT, ROLL, SLACK, STALE_AFTER, TIMEOUT, TWIST, Pair, expect, number, start, workplace


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


def a_stuck_odometry_stops(program, root, folder):
    options = ["--robot", root / "specs/robots/blind/mecanum_twist.yaml"]
    pair = Pair(program, folder, root / "specs/laws/speed_limit.yaml", TWIST, options, 8,
                base="  base: {topic: /odom}\n", simulated=["--stuck-odometry", "0.6"])
    code, drive, simulate = pair.end()
    expect(code == 1 and "frozen_base" in drive, "it is not stopped", drive, simulate)
    # 0.5 m/s^2 to 0.3 m/s in 9 cm. 2 cm and 0.1 s of patience at 0.4 m/s at most, then 8 cm of braking from there.
    expect(number(r"base at (-?[0-9.]+) m", simulate) < 0.09 + 0.02 + 0.4 * (0.1 + SLACK) + 0.08, "it goes on", simulate)


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


def a_drive_that_is_held_back_is_waited_for(program, root, folder):
    """By a published clock. 40 ms are twice what the guard rides through, and less than two commands are apart."""
    task = folder / "roll.yaml"
    task.write_text(ROLL.replace("y: {velocity: 0 m/s}, ", "").replace("value: 60 s", "value: 1 s"), encoding="utf-8")
    options = ["--robot", root / "specs/robots/turtlebot3_burger.yaml", "--scene", root / "specs/scenes/open.yaml"]
    pair = Pair(program, folder, task, TWIST.replace("50 Hz", "20 Hz"), options, 49, more=CLOCK, stale_after="500 ms")
    pair.wait_until_it_drives(0.1)
    for _ in range(5):
        pair.drive.send_signal(signal.SIGSTOP)
        time.sleep(0.04)
        pair.drive.send_signal(signal.SIGCONT)
        time.sleep(0.05)
    code, drive, simulate = pair.end()
    expect(code == 0 and "done after" in drive and "lost_ticks" not in drive, "not done", drive, simulate)


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


CASES = (silence_of_the_robot_stops, a_killed_drive_leaves_a_robot_at_rest, a_request_ends_it_with_zeros,
         a_stuck_odometry_stops, a_robot_that_comes_back_is_not_driven_on, a_late_computer_is_told,
         a_drive_that_is_held_back_is_waited_for, a_clock_in_long_steps_is_refused, observing_tells_clocks_that_differ)
