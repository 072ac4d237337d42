"""Task files for robots that touch the world.

    import zwang
    program = zwang.load("wall_align.yaml", params={"push": "30 N"})
    run = zwang.run(program, log=True)
    print(run.outcome, run.truth["wall.peak_force"])

Numbers are SI: m, rad, s, N, N m. Frames and columns have the names of the task file and of the log.
"""

import concurrent.futures
import itertools
import pathlib

from . import _zwang
from ._zwang import (Command, Diagnostic, Error, Limit, Log, Program, Result, Runner, ScenePlant, Sensed, read_log,
                     simulate)

__all__ = ["Command", "Diagnostic", "Error", "Limit", "Log", "Plant", "Program", "Result", "Runner", "ScenePlant",
           "Sensed", "load", "read_log", "run", "sweep", "validate"]


def _shipped(path):
    """`wall_align` is the shipped task of that name, where no file is called so."""
    given = pathlib.Path(path)
    if given.name != str(path) or given.suffix or given.exists():
        return path
    around = pathlib.Path(__file__).resolve().parents[4]  # of the installation, or of the source tree
    for folder in (around / "share" / "zwang" / "specs", around / "specs"):
        if (folder / f"{path}.yaml").is_file():
            return folder / f"{path}.yaml"
    return path


def load(path, **options):
    return _zwang.load(_shipped(path), **options)


def validate(path, **options):
    return _zwang.validate(_shipped(path), **options)


load.__doc__, validate.__doc__ = _zwang.load.__doc__, _zwang.validate.__doc__


def _to_pandas(self):
    """A DataFrame with the log's columns; needs pandas."""
    import pandas  # no package of zwang's own: whoever calls this has it

    return pandas.DataFrame({name: self[name] for name in self.columns})


Log.to_pandas = _to_pandas


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
    `on_tick(runner, sensed)` is called once a tick. `log` is of the simulated robot, without `on_tick`.
    """
    if log and (plant is not None or on_tick is not None):
        raise ValueError("log=True keeps a run on the simulated robot without on_tick; else keep what you need in on_tick")
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


def sweep(path, grid, *, jobs=1, text=None, robot=None, scene=None, most=600.0, log=False):
    """Runs a task file once for each combination of the grid's values, and returns the Results in their order.

    `grid`: {'push': ['10 N', '20 N'], 'start_yaw': [-0.3, 0.3]}. `start_yaw` [rad], `start_at` (x, y) [m] and
    `seed` are the run's own; all other names are parameters, with their units or in SI. The runs share as many
    threads as `jobs` says.
    """
    names = list(grid)
    cells = [dict(zip(names, values)) for values in itertools.product(*grid.values())]

    def one(cell):
        own = {name: cell[name] for name in ("start_yaw", "start_at", "seed") if name in cell}
        params = {name: value for name, value in cell.items() if name not in own}
        program = load(path, text=text, robot=robot, scene=scene, params=params)
        return simulate(program, most=most, log=log, **own)

    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        return list(pool.map(one, cells))
