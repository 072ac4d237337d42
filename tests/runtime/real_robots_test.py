"""Public robots from their URDF to a verdict, as their owners would go.

    real_robots_test.py PROGRAM FOLDER

Drafted, filled in, inspected. The figures of `robot inspect` are computed here from the URDF: sums of masses, the
parallel axis theorem, and the directions that plain wheels leave. With ZWANG_LONG set the drafted tasks run, too:
minutes for each robot with an arm.
Ends with 1 and says why when anything is otherwise, with 77 where FOLDER is not there.
"""

import collections
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import numpy as np

# What an owner fills in. A trial value where the data sheet is not public.
FILLED = {"radius": "60 mm", "effort": "5 N m", "mass": "0.1 kg",
          "polygon": "[[0.3 m, 0.25 m], [-0.3 m, 0.25 m], [-0.3 m, -0.25 m], [0.3 m, -0.25 m]]"}
MECANUM = {"panther_mecanum", "ridgeback", "summit_xl"}
SKID = {"panther", "husky"}

# Freedoms of the base: of plain wheels on one axle 2; of wheels with rollers, on swivels, or that skid 3.
BASE_FREEDOMS = {"turtlebot3_burger": 2, "diffbot": 2, "mir100": 2, "create3": 2, "fetch": 2, "freight": 2, "pmb2": 2,
                 "tiago": 2, "mp_400": 2, "summit_xl": 3, "ridgeback": 3, "panther": 3, "panther_mecanum": 3,
                 "husky": 3, "robotino": 3}
# What a drafted task comes to where that is not `done`: how the run ends, the code of its refusal, or a part of the
# reason why no task is written.
WALL_ALIGN = {"create3": "round ahead", "robotino": "round ahead", "limo_ack": "E621", "husky": "E621", "panther": "E621",
              "eddie": "failed"}
OBSTACLE = {"limo_ack": "E406", "husky": "E404", "panther": "E404", "eddie": "stopped", "robile_4wheel": "failed"}

failures = []
compared = collections.Counter()  # figures, by what they are


def expect(holds, what):
    if not holds:
        failures.append(what)


def near(name, what, value, expected, share=0.01, slack=0.0):
    compared[what] += 1
    bound = share * abs(expected) + slack
    expect(abs(value - expected) <= bound, f"{name}: {what} is {value:.6g}, by hand {expected:.6g}")


def turn(axis, angle):
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def origin(element):
    """Rotation and place of an <origin>: Rz(yaw) Ry(pitch) Rx(roll)."""
    found = element.find("origin") if element is not None else None
    numbers = lambda key: [float(n) for n in (found.get(key, "0 0 0") if found is not None else "0 0 0").split()]
    roll, pitch, yaw = numbers("rpy")
    return turn((0, 0, 1), yaw) @ turn((0, 1, 0), pitch) @ turn((1, 0, 0), roll), np.array(numbers("xyz"))


class Body:
    def __init__(self, link):
        self.mass, self.at, self.inertia = 0.0, np.zeros(3), np.zeros((3, 3))
        inertial = link.find("inertial")
        if inertial is None:
            return
        rotation, self.at = origin(inertial)
        self.mass = float(inertial.find("mass").get("value"))
        m = {key: float(value) for key, value in inertial.find("inertia").attrib.items()}
        tensor = np.array([[m["ixx"], m["ixy"], m["ixz"]], [m["ixy"], m["iyy"], m["iyz"]], [m["ixz"], m["iyz"], m["izz"]]])
        self.inertia = rotation @ tensor @ rotation.T


class Robot:
    """A URDF at a posture, in the axes of a link."""

    def __init__(self, path, base, posture):
        tree = xml.parse(path).getroot()
        self.bodies = {link.get("name"): Body(link) for link in tree.findall("link")}
        self.joints = {joint.get("name"): joint for joint in tree.findall("joint")}
        pose = {}
        above = {joint.find("child").get("link"): joint for joint in self.joints.values()}
        root = next(link for link in self.bodies if link not in above)

        def place(link):
            if link == root:
                return np.eye(3), np.zeros(3)
            if link not in pose:
                joint = above[link]
                rotation, at = place(joint.find("parent").get("link"))
                own, offset = origin(joint)
                rotation, at = rotation @ own, at + rotation @ offset
                q = posture.get(joint.get("name"), self.at_rest(joint))
                if joint.get("type") == "prismatic":
                    at = at + rotation @ self.axis(joint) * q
                elif q:
                    rotation = rotation @ turn(self.axis(joint), q)
                pose[link] = rotation, at
            return pose[link]

        to_base, base_at = place(base)
        self.pose = {link: (to_base.T @ place(link)[0], to_base.T @ (place(link)[1] - base_at)) for link in self.bodies}

    @staticmethod
    def axis(joint):
        found = joint.find("axis")
        axis = np.array([float(n) for n in found.get("xyz", "1 0 0").split()]) if found is not None else np.array([1.0, 0, 0])
        return axis / np.linalg.norm(axis)

    @staticmethod
    def at_rest(joint):
        limit = joint.find("limit")
        if limit is None or joint.get("type") not in ("revolute", "prismatic"):
            return 0.0
        return min(max(0.0, float(limit.get("lower", 0))), float(limit.get("upper", 0)))

    def mass(self):
        return sum(body.mass for body in self.bodies.values())

    def centre(self):
        sums = [body.mass * (self.pose[link][0] @ body.at + self.pose[link][1]) for link, body in self.bodies.items()]
        return sum(sums) / self.mass()

    def planar(self):
        """The mass matrix of (x, y, turn) about the base's origin."""
        matrix = np.zeros((3, 3))
        for link, body in self.bodies.items():
            rotation, at = self.pose[link]
            x, y, _ = rotation @ body.at + at
            about = (rotation @ body.inertia @ rotation.T)[2, 2]
            m = body.mass
            matrix += np.array([[m, 0, -m * y], [0, m, m * x], [-m * y, m * x, about + m * (x * x + y * y)]])
        return matrix

    def wheel(self, joint):
        """Its rate times its radius, and its slip sideways, as rows of (x, y, turn); its inertia about the axle."""
        link = self.joints[joint].find("child").get("link")
        rotation, (x, y, _) = self.pose[link]
        axle = rotation @ self.axis(self.joints[joint])
        ahead = np.cross(axle, (0, 0, 1))
        row = lambda d: np.array([d[0], d[1], d[1] * x - d[0] * y])
        return row(ahead), row(axle), self.axis(self.joints[joint]) @ self.bodies[link].inertia @ self.axis(self.joints[joint])


def effective(planar, free, axis):
    """1 / (e N (N' M N)^-1 N' e) along an axis, N the motions that the wheels leave."""
    part = free[axis]
    return 1.0 / (part @ np.linalg.solve(free.T @ planar @ free, part))


def null_space(rows):
    _, values, v = np.linalg.svd(np.array(rows))
    return v[int(np.sum(values > 1e-3)):].T  # rad: two wheels are never drawn on one axle to the last digit


class Run:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def __call__(self, *arguments):
        done = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=600)
        return done.returncode, done.stdout + done.stderr

    def json(self, *arguments):
        done = subprocess.run([self.program, *arguments, "--format", "json"], cwd=self.folder, capture_output=True,
                              text=True, timeout=600)
        return json.loads(done.stdout)


def fill(name, text):
    values = dict(FILLED, kind="mecanum" if name in MECANUM else "skid")
    return re.sub(r"(\w+): FILL_IN", lambda found: f"{found[1]}: {values[found[1]]}", text)


def posture_of(text):
    block = re.search(r"\nposture:\n((?:  .*\n)+)", text)
    values = re.findall(r"  (\S+): (\S+) (\w+)", block[1]) if block else []
    units = {"deg": math.pi / 180.0, "rad": 1.0, "mm": 1e-3, "m": 1.0}
    return {joint: float(value) * units[unit] for joint, value, unit in values}


def check_figures(name, text, robot, inspected):
    radius = {wheel["joint"]: wheel["radius"] for wheel in inspected["wheels"]}
    driven = {wheel["joint"]: wheel["effort"] for wheel in inspected["wheels"] if wheel["actuated"]}
    near(name, "mass", inspected["mass"], robot.mass() + 0.1 * text.count("mass: 0.1 kg"), 1e-4)
    ground = np.mean([robot.pose[robot.joints[j].find("child").get("link")][1][2] - r for j, r in radius.items()])
    near(name, "height of the centre of mass", inspected["statics"]["height"], robot.centre()[2] - ground, 0.01, 2e-3)
    analysis = inspected["analysis"]
    if name in BASE_FREEDOMS and len(robot_joints(text)) == len(driven):
        compared["mobility"] += 1
        expect(analysis["mobility"] == BASE_FREEDOMS[name], f"{name}: mobility {analysis['mobility']}")
    if name not in BASE_FREEDOMS or name == "robotino":
        return
    near(name, "largest force", analysis["axes"]["x"]["largest_force"][1], sum(t / radius[j] for j, t in driven.items()))
    moves = [j for j in robot_joints(text) if j not in radius]
    if moves or len(radius) > len(driven) or "\ninertias:" in text or name in MECANUM:
        return
    planar, held = robot.planar(), []
    for joint, r in radius.items():
        rolls, slips, about_axle = robot.wheel(joint)
        planar += about_axle / r**2 * np.outer(rolls, rolls)
        held.append(slips)
    free = np.eye(3) if name in SKID else null_space(held)
    near(name, "mass along x", analysis["axes"]["x"]["effective_mass"][1], effective(planar, free, 0), 0.02)
    near(name, "inertia about z", analysis["axes"]["rz"]["effective_mass"][1], effective(planar, free, 2), 0.02)


def robot_joints(text):
    """Joints of `actuated`."""
    block = re.search(r"\nactuated:\n((?:  .*\n)+)", text)
    return re.findall(r"  (\S+):", block[1])


def draft(run, name, task):
    out = f"{name}_{task}.yaml"
    code, said = run("robot", "init", f"{name}.urdf", "--task", task, "-o", out)
    text = (run.folder / out).read_text()
    asked = len(re.findall(r"^[^#\n]*FILL_IN", text, re.MULTILINE))
    expect(asked <= 8, f"{name}: {asked} values to fill in")
    text = fill(name, text)
    (run.folder / out).write_text(text)
    return code, said, text


def check_verdict(run, name, task, expected):
    code, said, _ = draft(run, name, task)
    if code != 0:
        expect(code == 2 and expected in said, f"{name}: no {task} was written, {expected} was expected: {said[-300:]}")
        return
    file = f"{name}_{task}_{task}.yaml"
    if expected not in ("done", "failed", "stopped"):
        code, said = run("validate", file)
        expect(code == 1 and expected in said, f"{name}: {task} is not refused by {expected}: {said[-300:]}")
        return
    for yaw in ("-20deg", "5deg", "20deg") if task == "wall_align" and expected == "done" else (None,):
        report = run.json("run", "--quiet", file, *(["--start-yaw", yaw] if yaw else []))
        outcome = report["outcome"]
        expect(outcome == expected, f"{name}: {task} from {yaw} ended {outcome}, not {expected}")
        if task == "wall_align" and outcome == "done":
            askew = math.degrees(report["truth"]["base"]["yaw"])
            expect(abs(askew) < 1.0, f"{name}: aligned {askew:.2f} deg askew from {yaw}")


def main(program, robots):
    if not robots.is_dir():
        print(f"{robots} is not here")
        return 77
    names = sorted(path.stem for path in robots.glob("*.urdf"))
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / ".zwang-root").touch()
        run = Run(program, folder)
        for name in names:
            (folder / f"{name}.urdf").write_bytes((robots / f"{name}.urdf").read_bytes())
            if name == "husky_bullet":
                code, said = run("robot", "init", "husky_bullet.urdf")
                expect(code == 1 and "E855" in said, f"{name}: {said[-300:]}")
                continue
            _, _, text = draft(run, name, "feel_wall")
            base = re.search(r"^base: (\S+)", text, re.MULTILINE)[1]
            robot = Robot(folder / f"{name}.urdf", base, posture_of(text))
            check_figures(name, text, robot, run.json("robot", "inspect", f"{name}_feel_wall.yaml"))
            if os.environ.get("ZWANG_LONG"):
                check_verdict(run, name, "wall_align", WALL_ALIGN.get(name, "done"))
                check_verdict(run, name, "obstacle", OBSTACLE.get(name, "done"))
    least = {"mass": 18, "height of the centre of mass": 18, "largest force": 14, "mobility": 10, "mass along x": 6,
             "inertia about z": 6}
    for what, count in least.items():
        expect(compared[what] >= count, f"{what}: compared for {compared[what]} robots only")
    for failure in failures:
        print(failure)
    print(f"{len(names)} robots, {sum(compared.values())} figures, {len(failures)} otherwise than expected")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])))
