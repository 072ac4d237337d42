"""An hour of `zwang drive` and `zwang simulate` at 100 Hz over DDS: neither of both grows.

    hour.py PROGRAM ROOT FOLDER_OF_CLIENTS [SECONDS]

One allocation that is lost in each tick is 32 bytes, the least that glibc's malloc hands out: 11.5 MB an hour.
A line through the memory of each process, without its first tenth, has to grow by less than that.
"""

import pathlib
import signal
import sys
import tempfile
import time

from pair import CLOCK, TWIST, Pair, resident, skip_unless_long

RATE = 100.0  # [Hz]
LEAST_CHUNK = 32.0  # [bytes] of glibc's malloc on 64 bits

# To and fro, so that the tasks change and the base stays near its start.
TASK = """zwang: 2
robot: robot.yaml
start: ahead
tasks:
  ahead:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.1 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0.2 rad/s}}
    exits:
      - {when: elapsed > 2 s, goto: astern}
  astern:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: -0.1 m/s}, y: {velocity: 0 m/s}, rz: {velocity: -0.2 rad/s}}
    exits:
      - {when: elapsed > 2 s, goto: ahead}
"""


def slope(times, sizes):
    """[bytes/s] of the line through the points that has the least squares."""
    t = sum(times) / len(times)
    s = sum(sizes) / len(sizes)
    return sum((a - t) * (b - s) for a, b in zip(times, sizes)) / sum((a - t) ** 2 for a in times)


def main(program, root, clients, seconds=3600.0):
    Pair.clients = pathlib.Path(clients)
    root = pathlib.Path(root)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        robot = folder / "robot.yaml"
        text = (root / "specs/robots/blind/mecanum_twist.yaml").read_text(encoding="utf-8")
        robot.write_text(text.replace("based_on: ../mecanum_base.yaml", "based_on: mecanum_base.yaml")
                         .replace("rate: 50 Hz", f"rate: {RATE:g} Hz"), encoding="utf-8")
        for part in ("mecanum_base.yaml", "mecanum_base.urdf"):
            (folder / part).write_text((root / "specs/robots" / part).read_text(encoding="utf-8"), encoding="utf-8")
        task = folder / "to_and_fro.yaml"
        task.write_text(TASK, encoding="utf-8")
        (folder / "open.yaml").write_text((root / "specs/scenes/open.yaml").read_text(encoding="utf-8"), encoding="utf-8")
        command = TWIST.replace("rate: 50 Hz", f"rate: {RATE:g} Hz")
        # By the clock of the simulation, so that a busy machine is slow and not late.
        pair = Pair(program, folder, task, command, ["--scene", folder / "open.yaml"], 40,
                                  more=CLOCK, stale_after="500 ms")
        pair.wait_for("the task begins")
        begin = time.monotonic()
        times, sizes = [], {"drive": [], "simulate": []}
        while (elapsed := time.monotonic() - begin) < float(seconds) and pair.drive.poll() is None:
            if elapsed > 0.1 * float(seconds):
                times.append(elapsed)
                for side, of_side in sizes.items():
                    of_side.append(resident(getattr(pair, side).pid))
            time.sleep(1.0)
        elapsed = time.monotonic() - begin
        pair.drive.send_signal(signal.SIGTERM)
        pair.end()
        print(pair.text("drive"), pair.text("simulate"), sep="\n")
        if elapsed < float(seconds):
            print(f"FAILED: it ended after {elapsed:.0f} s of {float(seconds):.0f} s")
            return 1
        is_good = True
        for side, of_side in sizes.items():
            grown = slope(times, of_side)  # [bytes/s]
            most = LEAST_CHUNK * RATE
            print(f"{side}: {of_side[0] / 1e6:.2f} MB, then {of_side[-1] / 1e6:.2f} MB: {3600 * grown / 1e6:+.3f} MB an hour, "
                  f"less than {3600 * most / 1e6:.1f} MB")
            is_good = is_good and grown < most
        return 0 if is_good else 1


if __name__ == "__main__":
    skip_unless_long()
    sys.exit(main(*sys.argv[1:]))
