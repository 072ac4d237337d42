#!/usr/bin/env python3
"""Draws the moving picture of the README from the log of a run.

zwang run specs/wall_align.yaml --log RUN && docs/pictures/wall_align.py RUN/log.csv > docs/pictures/wall_align.svg

Above: the robot from the top, where the plant measured it. Below: the force at the wall, over time.
Numbers of the drawing are those of specs/robots/mecanum_base.yaml and specs/scenes/wall.yaml.
"""
import csv
import math
import sys

FRAMES_A_SECOND = 15
PIXELS_A_METRE = 260
LENGTH, WIDTH = 0.80, 0.56  # [m] footprint
WHEEL_X, WHEEL_Y, WHEEL_RADIUS, WHEEL_WIDTH = 0.27, 0.22, 0.0759, 0.079  # [m]
WALL_FACE = 0.972  # [m]
LARGEST_FORCE = 60.0  # [N] shown; the first hit is higher and is cut off
ASKED = 20.0  # [N]


def read(path):
    """Rows of (time [s], x [m], y [m], yaw [deg], force [N])."""
    with open(path, newline="", encoding="utf-8") as f:
        rows = csv.reader(f)
        names = [name.split(" [")[0] for name in next(rows)]
        at = [names.index(n) for n in ("time", "truth.base.x", "truth.base.y", "truth.base.yaw", "truth.wall.force")]
        return [(float(r[at[0]]), float(r[at[1]]), float(r[at[2]]), math.degrees(float(r[at[3]])), float(r[at[4]]))
                for r in rows if r[at[1]]]


def main():
    rows = read(sys.argv[1])
    end = rows[-1][0]
    bins = [[] for _ in range(int(end * FRAMES_A_SECOND) + 1)]
    for row in rows:
        bins[int(row[0] * FRAMES_A_SECOND)].append(row)
    frames = [b for b in bins if b]
    poses = [b[0] for b in frames]
    forces = [max(r[4] for r in b) for b in frames]  # the highest of each frame: no peak is lost

    scale, top, width, height = PIXELS_A_METRE, 170, 640, 460
    left = 130  # of the world's origin
    plot_x, plot_y, plot_w, plot_h = 60, 350, 540, 80

    def animate(kind, values):
        return (f'<animateTransform attributeName="transform" type="{kind}" dur="{end + 1:.1f}s" repeatCount="indefinite" '
                f'calcMode="linear" keyTimes="{times}" values="{";".join(values)}"/>')

    last = len(poses) - 1
    share = end / (end + 1.0)  # the last second stands still
    times = ";".join(f"{share * i / last:.4f}" for i in range(last + 1)) + ";1"
    moves = [f"{left + scale * x:.1f} {top - scale * y:.1f}" for _, x, y, _, _ in poses]
    turns = [f"{-yaw:.2f}" for _, _, _, yaw, _ in poses]
    curve = " ".join(f"{plot_x + plot_w * t / end:.1f},{plot_y + plot_h * (1 - min(f, LARGEST_FORCE) / LARGEST_FORCE):.1f}"
                     for (t, *_), f in zip(poses, forces))
    cursor = [f"{plot_x + plot_w * t / end:.1f} 0" for t, *_ in poses]
    asked = plot_y + plot_h * (1 - ASKED / LARGEST_FORCE)
    wall = left + scale * WALL_FACE
    wheels = "".join(
        f'<rect x="{scale * (sx * WHEEL_X - WHEEL_RADIUS):.1f}" y="{scale * (sy * WHEEL_Y - WHEEL_WIDTH / 2):.1f}" '
        f'width="{2 * scale * WHEEL_RADIUS:.1f}" height="{scale * WHEEL_WIDTH:.1f}" rx="3" fill="#444"/>'
        for sx in (-1, 1) for sy in (-1, 1))
    print(f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">
<rect width="{width}" height="{height}" fill="#fff"/>
<rect x="{wall:.1f}" y="10" width="26" height="320" fill="#b8b8b8"/>
<text x="{wall + 36:.1f}" y="30" fill="#555">wall, unknown to the robot</text>
<g>{animate("translate", moves + moves[-1:])}<g>{animate("rotate", turns + turns[-1:])}
<rect x="{-scale * LENGTH / 2:.1f}" y="{-scale * WIDTH / 2:.1f}" width="{scale * LENGTH:.1f}" height="{scale * WIDTH:.1f}" rx="8" fill="#d7e6f7" stroke="#2b6cb0" stroke-width="2"/>
{wheels}
<path d="M -14 0 H 44 M 34 -7 L 46 0 L 34 7" fill="none" stroke="#2b6cb0" stroke-width="3"/>
</g></g>
<text x="{plot_x}" y="{plot_y - 8}" fill="#333">force at the wall, as the simulator measures it [N]</text>
<line x1="{plot_x}" y1="{plot_y + plot_h}" x2="{plot_x + plot_w}" y2="{plot_y + plot_h}" stroke="#999"/>
<line x1="{plot_x}" y1="{asked:.1f}" x2="{plot_x + plot_w}" y2="{asked:.1f}" stroke="#c53030" stroke-dasharray="5 4"/>
<text x="{plot_x - 8}" y="{asked + 4:.1f}" text-anchor="end" fill="#c53030">20</text>
<text x="{plot_x - 8}" y="{plot_y + plot_h + 4}" text-anchor="end" fill="#333">0</text>
<text x="{plot_x + plot_w}" y="{plot_y + plot_h + 18}" text-anchor="end" fill="#333">{end:.0f} s</text>
<polyline points="{curve}" fill="none" stroke="#2b6cb0" stroke-width="1.5"/>
<g>{animate("translate", cursor + cursor[-1:])}<line x1="0" y1="{plot_y}" x2="0" y2="{plot_y + plot_h}" stroke="#333"/></g>
</svg>''')


if __name__ == "__main__":
    main()
