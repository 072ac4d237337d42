"""Task files for robots that touch the world.

    import zwang
    program = zwang.load("wall_align.yaml", params={"push": "30 N"})
    run = zwang.run(program, log=True)
    print(run.outcome, run.truth["wall.peak_force"])

Numbers are SI: m, rad, s, N, N m. Frames and columns have the names of the task file and of the log.
"""

import concurrent.futures
import itertools

from ._zwang import (Command, Diagnostic, Error, Limit, Log, Program, Result, Runner, ScenePlant, Sensed, load,
                     read_log, simulate, validate)

__all__ = ["Command", "Diagnostic", "Error", "Limit", "Log", "Plant", "Program", "Result", "Runner", "ScenePlant",
           "Sensed", "load", "read_log", "run", "sweep", "validate"]


class Plant:
    """Your own robot. `sense` fills the snapshot, `apply` sends the command; each is called once a period."""

    def sense(self, sensed: Sensed) -> None:
        raise NotImplementedError

    def apply(self, command: Command) -> None:
        raise NotImplementedError


def run(program, plant=None, *, most=600.0, log=False, seed=0, start_at=None, start_yaw=None, on_tick=None):
    """Runs the task to its end, or for `most` seconds.

    Without a plant it runs on the simulated robot, and returns a Result. With one it calls `plant.sense`,
    `Runner.step` and `plant.apply` until the task is over, and returns the Runner: the plant sets the pace.
    `on_tick(runner, sensed)` is called once a tick.
    """
    if plant is None and on_tick is None:
        return simulate(program, most=most, log=log, seed=seed, start_at=start_at, start_yaw=start_yaw)
    if plant is None:
        plant = ScenePlant(program, seed=seed, start_at=start_at, start_yaw=start_yaw)
    runner, sensed = Runner(program), Sensed(program)
    begin = None
    while not runner.finished:
        plant.sense(sensed)
        begin = sensed.time if begin is None else begin
        if sensed.time - begin > most:
            break
        command = runner.step(sensed)
        if on_tick is not None:
            on_tick(runner, sensed)
        plant.apply(command)
    return runner


def sweep(path, grid, *, jobs=1, robot=None, scene=None, most=600.0, log=False):
    """Runs a task file once for each combination of the grid's values, and returns the Results in their order.

    `grid`: {'push': ['10 N', '20 N'], 'start_yaw': [-0.3, 0.3]}. `start_yaw` [rad], `start_at` (x, y) [m] and
    `seed` are the run's own; all other names are parameters, with their units. `jobs` runs take turns on as
    many threads.
    """
    names = list(grid)
    cells = [dict(zip(names, values)) for values in itertools.product(*grid.values())]

    def one(cell):
        own = {name: cell[name] for name in ("start_yaw", "start_at", "seed") if name in cell}
        params = {name: str(value) for name, value in cell.items() if name not in own}
        program = load(path, robot=robot, scene=scene, params=params)
        return simulate(program, most=most, log=log, **own)

    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        return list(pool.map(one, cells))
