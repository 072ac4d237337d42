"""Both sides of a connection as processes of their own, for the tests that speak with them."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

STALE_AFTER = 0.1  # [s] in the connection files below
TIMEOUT = 0.3  # [s] after which the simulated receiver stops the motors
SLACK = 0.1  # [s] for a machine that does other things, too

EFFORT = """command:
  joints:
    topic: /effort_controller/commands
    what: effort
    order: [front_left_wheel, front_right_wheel, rear_left_wheel, rear_right_wheel]
    timeout: 300 ms
"""
TWIST = """command:
  twist: {topic: /cmd_vel, type: geometry_msgs/TwistStamped, rate: 50 Hz, timeout: 300 ms}
"""
VELOCITY = EFFORT.replace("what: effort", "what: velocity")

# What each use case measures beside joints, on the robot that feels by its motors' efforts.
SIGNALS = {
    "wall_align": "",
    "obstacle": "",
    "docking": """signals:
  partner: {topic: /partner, type: geometry_msgs/PoseStamped}
  latch: {topic: /latch, type: std_msgs/Bool}
""",
    "hospital": """signals:
  loaded: {topic: /loaded, type: std_msgs/Bool}
  nearest: {topic: /nearest, type: std_msgs/Float64}
  stop_key: {topic: /stop_key, type: std_msgs/Bool}
""",
}

CLOCK = "clock: {ros: /clock}\n"  # the world waits for commands: a busy machine is slow and not late
# With it `stale_after` is this computer's patience with a simulation that stands. Beside compilers on two cores, 100 ms without
# a message were seen.
PATIENCE = "500 ms"

# A base that rolls ahead for so long.
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


class Unreachable(Exception):
    """Two processes do not hear each other here."""


RUNNING = []  # every process that a case has begun


def start(words, **options):
    process = subprocess.Popen(words, **options)
    RUNNING.append(process)
    return process


def kill_what_runs():
    """Of a case that failed."""
    for process in RUNNING:
        if process.poll() is None:
            process.kill()


class Pair:
    """Both processes of a task, each with its own file of output."""

    clients = pathlib.Path()  # the folder of the programs that call services

    def __init__(self, program, folder, task, command, options, number, ros2="reach: loopback", more="", base="",
                 simulated=(), driven=(), motors_apart=0, stale_after="100 ms"):
        self.domain = domain = 100 + (os.getpid() + number) % 100  # another one than that of a test beside this one
        self.motors_apart = motors_apart
        self.files = {side: folder / f"{side}_{number}" for side in ("simulate", "drive")}
        for side in ("simulate", "drive"):
            connection = folder / f"connection_{number}{'_of_motors' if motors_apart and side == 'simulate' else ''}.yaml"
            # `motors_apart`: the simulation is in a domain of its own, that many further.
            in_domain = domain + (motors_apart if side == "simulate" else 0)
            self.connection = (
                f"zwang_connection: 1\nros2: {{domain: {in_domain}, {ros2}}}\n{more}loop: {{priority: 40}}\n"
                f"state:\n  joints: {{topic: /joint_states, stale_after: {stale_after}}}\n{base}" + command)
            connection.write_text(self.connection, encoding="utf-8")
            arguments = [task, "--over", connection] + options
            with open(self.files[side], "w", encoding="utf-8") as out:
                # `--stuck-odometry` is for tests: the program behind `zwang simulate` takes it, `zwang` does not.
                first = [program, side] if side == "drive" else [program + "-simulate"]
                words = arguments + list(simulated if side == "simulate" else driven)
                setattr(self, side, start(first + words, stdout=out, stderr=out))

    def end(self, within=40):
        """The exit code of `drive`, and what both have said."""
        code = self.drive.wait(within)
        try:
            self.simulate.wait(20)
        except subprocess.TimeoutExpired:
            expect(False, f"the simulated robot goes on; drive ended with {code}", self.text("drive"), self.text("simulate"))
        return code, self.text("drive"), self.text("simulate")

    @classmethod
    def has_cyclone(cls):
        return (cls.clients / "cyclone_robot").exists()

    def start_cyclone_robot(self):
        """All that `drive` hears comes from Cyclone DDS then, and all that it says goes there: for `motors_apart`."""
        # As punctual as both programs: `loop: {priority: 40}`. Without the right to it, a busy machine is too late.
        punctual = ["chrt", "-f", "40"] if os.geteuid() == 0 and shutil.which("chrt") else []
        return start(punctual + [self.clients / "cyclone_robot", str(self.domain), str(self.domain + self.motors_apart)] +
                     routes_of(self.connection), stdout=subprocess.PIPE, text=True)

    def text(self, side):
        return self.files[side].read_text(encoding="utf-8")

    def wait_until_it_drives(self, seconds):
        """And so long after."""
        self.wait_for("the task begins")
        time.sleep(seconds)

    def wait_for(self, words):
        end = time.monotonic() + 20.0
        while words not in self.text("drive") and time.monotonic() < end:
            time.sleep(0.01)

    def call(self, service, calls=1):
        return self.client("trigger_client", service, str(calls))

    def goal(self, task, *parameters, cancel_after=0.0):
        """All that a client of the action hears of a goal."""
        return self.client("action_client", str(cancel_after), task, *parameters)

    def client(self, name, *words):
        return subprocess.run([self.clients / name, str(self.domain), *words], capture_output=True, text=True, timeout=120,
                              check=False).stdout


def routes_of(connection):
    """What `cyclone_robot` passes on between both sides of a connection."""
    routes = ["state:/joint_states:sensor_msgs/JointState"]
    if CLOCK in connection:
        routes.append("state:/clock:rosgraph_msgs/Clock")
        routes.append("command:/zwang/ticked:rosgraph_msgs/Clock")
    kinds = {"signals:": "state", "outputs:": "output"}
    sources = {"base": "nav_msgs/Odometry", "fix": "geometry_msgs/PoseWithCovarianceStamped", "wrench": "geometry_msgs/WrenchStamped"}
    if "fix: {tf:" in connection:
        routes.append("state:/tf:tf2_msgs/TFMessage")
    section = ""
    for line in connection.splitlines():
        section = section if line.startswith(" ") else line
        topic = re.search(r"topic: ([\w/]+)", line)
        kind = re.search(r"type: ([\w/]+)", line)
        if section == "command:" and topic:
            routes.append(f"command:{topic[1]}:{kind[1] if kind else 'std_msgs/Float64MultiArray'}")
        elif section == "state:" and topic and line.split(":")[0].strip() in sources:
            routes.append(f"state:{topic[1]}:{sources[line.split(':')[0].strip()]}")
        elif section in kinds and topic:
            routes.append(f"{kinds[section]}:{topic[1]}:{kind[1]}")
    return routes


def number(pattern, text):
    found = re.search(pattern, text)
    if not found:
        raise AssertionError(f"no `{pattern}` in:\n{text}")
    return float(found[1])


def expect(condition, what, *texts):
    if not condition:
        raise AssertionError(what + "\n" + "\n".join(texts))


def slow_robot(root, folder):
    """The mecanum base with ticks of 2 ms: a busy machine keeps to them."""
    robot = folder / "robot.yaml"
    text = (root / "specs/robots/mecanum_base.yaml").read_text(encoding="utf-8")
    robot.write_text(text.replace("\nurdf: ", "\ncontrol_period: 2 ms\nurdf: ", 1), encoding="utf-8")
    for urdf in (root / "specs/robots").glob("mecanum_base.urdf"):
        (folder / urdf.name).write_text(urdf.read_text(encoding="utf-8"), encoding="utf-8")
    return robot


def workplace(root, folder):
    """Task, scene and robot below one folder, as zwang wants them."""
    robot = slow_robot(root, folder)
    scene = folder / "near_wall.yaml"
    scene.write_text((root / "tests/connect/near_wall.yaml").read_text(encoding="utf-8"), encoding="utf-8")
    task = folder / "wall_align.yaml"
    text = (root / "specs/wall_align.yaml").read_text(encoding="utf-8")
    text = text.replace("robots/mecanum_base.yaml", robot.name).replace("scenes/wall.yaml", scene.name)
    task.write_text(text, encoding="utf-8")
    return task


def resident(pid):
    """[bytes] that a process holds in memory."""
    return int(pathlib.Path(f"/proc/{pid}/statm").read_text(encoding="utf-8").split()[1]) * os.sysconf("SC_PAGE_SIZE")


def skip_unless_long():
    if "ZWANG_LONG" not in os.environ:
        print("skipped: ./dev test --long runs it")
        sys.exit(77)
