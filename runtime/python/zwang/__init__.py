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
from ._zwang import (Command, Diagnostic, Edit, Error, Limit, Log, Program, Result, Rows, Runner, ScenePlant, Sensed, Solution,
                     Solver, read_log, simulate)

__all__ = ["Command", "Diagnostic", "Edit", "Error", "Limit", "Log", "Plant", "Program", "Result", "Rows", "Runner",
           "ScenePlant", "Sensed", "Solution", "Solver", "load", "read_log", "run", "sweep", "validate"]


def _shipped(path, below="."):
    """`wall_align` is the shipped task of that name, where no file is called so. Below `robots` it is a robot."""
    if path is None:
        return None
    given = pathlib.Path(path)
    if given.name != str(path) or given.suffix or given.exists():
        return path
    around = pathlib.Path(__file__).resolve().parents[4]  # of the installation, or of the source tree
    for folder in (around / "share" / "zwang" / "specs", around / "specs"):
        if (folder / below / f"{path}.yaml").is_file():
            return folder / below / f"{path}.yaml"
    return path


def load(path, *, robot=None, scene=None, **options):
    return _zwang.load(_shipped(path), robot=_shipped(robot, "robots"), scene=_shipped(scene, "scenes"), **options)


def validate(path, *, task=None, robot=None, scene=None, **options):
    return _zwang.validate(_shipped(path), task=_shipped(task), robot=_shipped(robot, "robots"),
                           scene=_shipped(scene, "scenes"), **options)


load.__doc__, validate.__doc__ = _zwang.load.__doc__, _zwang.validate.__doc__


def _to_pandas(self):
    """A DataFrame with the log's columns; needs pandas."""
    import pandas  # no package of zwang's own: whoever calls this has it

    return pandas.DataFrame({name: self[name] for name in self.columns})


Log.to_pandas = _to_pandas


def _plan(self, task, sensed=None):
    """The Rows of a task at the start of its scene, as `zwang plan` prints them, or in the state of a Sensed."""
    return _zwang._plan(self, task, sensed)


Program.plan = _plan


class Plant:
    """Your own robot. `sense` fills the snapshot, `apply` sends the command; each is called once a period."""

    def sense(self, sensed: Sensed) -> None:
        """Writes what the robot measures into `sensed`: its time [s], `q` and `qd` at least."""
        raise NotImplementedError

    def apply(self, command: Command) -> None:
        """Sends the command to the motors; it holds for a control period."""
        raise NotImplementedError


def run(program, plant=None, *, most=600.0, log=False, seed=0, start_at=None, start_yaw=None, on_tick=None):
    """Runs the task to its end, or for `most` seconds.

    Without a plant it runs on the simulated robot, and returns a Result. With one it calls `plant.sense`,
    `Runner.step` and `plant.apply` until the task is over, and returns the Runner: the plant sets the pace.
    `on_tick(runner, sensed)` is called once a tick. `log="runs/a"` writes `runs/a/log.mcap` for `zwang report`,
    `zwang replay` and `read_log`; `log=True` keeps a run on the simulated robot, without `on_tick`, in memory.
    """
    if log is True and (plant is not None or on_tick is not None):
        raise ValueError('log=True keeps a run on the simulated robot without on_tick; else write a file: log="runs/a"')
    file = None if isinstance(log, bool) or log is None else _log_file(log)
    if plant is None and on_tick is None:
        return simulate(program, most=most, log=log is True, seed=seed, start_at=start_at, start_yaw=start_yaw, file=file)
    if plant is None:
        plant = ScenePlant(program, seed=seed, start_at=start_at, start_yaw=start_yaw)
    runner = Runner(program)
    if file is None:
        _step(program, runner, plant, most, on_tick, lambda: None)
        return runner
    recorder = _zwang._FileRecorder(runner, program, file)
    try:
        _step(program, runner, plant, most, on_tick, recorder.wait)
    finally:
        recorder.close()
    return runner


def _log_file(log):
    """`runs/a` is a folder, as of `zwang run`; `a.mcap` is the file itself."""
    path = pathlib.Path(log)
    path = path if path.suffix == ".mcap" else path / "log.mcap"
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def _step(program, runner, plant, most, on_tick, wait):
    sensed, begin = Sensed(program), None
    while not runner.finished:
        plant.sense(sensed)
        begin = sensed.time if begin is None else begin
        if sensed.time - begin > most:
            break
        wait()
        command = runner.step(sensed)
        if on_tick is not None:
            on_tick(runner, sensed)
        plant.apply(command)


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
