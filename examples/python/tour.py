# From a task file to a plot, to a sweep, to a robot of one's own. Each `# %%` begins a cell of an editor or of Jupyter.
# PYTHONPATH has to name the module: docs/python.md.

# %% A run, and its contact force over time [N]
import numpy as np
import zwang

run = zwang.run(zwang.load("wall_align"), start_yaw=0.2, log=True)
print(run.outcome, "after", run.time, "s; the hardest hit:", run.truth["wall.peak_force"], "N")
try:
    import matplotlib.pyplot as plt
except ImportError:  # python3-matplotlib is a package of its own
    plt = None
if plt is not None:
    plt.plot(run.log["time"], run.log["truth.wall.force"])
    plt.xlabel("time [s]")
    plt.ylabel("force of the wall [N]")
    plt.show()

# %% What did it wait for, and how near did it come to its limits?
print(run.why or "nothing")
for limit in sorted(run.limits, key=lambda limit: limit.margin)[:3]:
    print(limit.row, "at worst", limit.worst, "of", limit.limit, limit.unit)

# %% The largest push whose hardest hit stays below 150 N. A hit is at most F + sqrt(F^2 + K m v^2): at the 8 cm/s of the file
# no push does it, so the base comes at 4 cm/s here.
path = zwang.load("wall_align").path
with open(path, encoding="utf-8") as file:
    slow = file.read().replace("0.08 m/s", "0.04 m/s")
pushes = np.arange(10.0, 41.0, 10.0)
runs = zwang.sweep(path, {"push": pushes}, text=slow, jobs=2)
gentle = [push for push, r in zip(pushes, runs) if r.outcome == "done" and r.truth["wall.peak_force"] < 150.0]
print("largest push:", max(gentle, default=None), "N")


# %% A robot of one's own: wheels that turn as the torques say, and nothing else
class Wheels(zwang.Plant):
    """I qdd = tau, with 0.2 kg m^2 a wheel."""

    def __init__(self, program):
        count = len(program.joints)
        self.time, self.q, self.qd = 0.0, np.zeros(count), np.zeros(count)

    def sense(self, sensed):
        sensed.time = self.time
        sensed.q[:] = self.q
        sensed.qd[:] = self.qd

    def apply(self, command):
        self.qd = self.qd + 1e-3 * command.torque / 0.2
        self.q = self.q + 1e-3 * self.qd
        self.time += 1e-3


program = zwang.load("wall_align")
wheels = Wheels(program)
runner = zwang.run(program, wheels, most=1.0)
print(runner.state, "in", runner.task, "with wheels at", wheels.qd, "rad/s")
