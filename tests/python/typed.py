"""What a user writes, for mypy --strict: never run."""

import numpy as np
from numpy.typing import NDArray

import zwang


def largest_force(push: str) -> float:
    run = zwang.run(zwang.load("wall_align.yaml", params={"push": push}), log=True)
    assert run.log is not None
    force: NDArray[np.float64] = run.log["truth.wall.force"]
    return float(np.nanmax(force))


class MyRobot(zwang.Plant):
    def __init__(self, joints: int) -> None:
        self.torque: NDArray[np.float64] = np.zeros(joints)

    def sense(self, sensed: zwang.Sensed) -> None:
        sensed.time += 1e-3
        sensed.q[:] = 0.0
        sensed.measure("nearest", 1.5)

    def apply(self, command: zwang.Command) -> None:
        self.torque = command.torque


def own_loop(program: zwang.Program) -> str:
    runner: zwang.Runner = zwang.run(program, MyRobot(len(program.joints)))
    return runner.why


def peaks() -> list[float | None]:
    runs = zwang.sweep("wall_align.yaml", {"push": ["10 N", "20 N"], "start_yaw": [0.0, 0.2]}, jobs=2)
    return [run.truth["wall.peak_force"] for run in runs]


def texts_for(path: str) -> list[tuple[int, int, str]]:
    return [(edit.line, edit.end_column, edit.text) for d in zwang.validate(path) for edit in d.edits]
