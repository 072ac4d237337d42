#!/usr/bin/env python3
"""Draws one row's way from YAML to torque through the three rooms.

docs/pictures/row.py > docs/pictures/row.svg
"""
BOX_W, BOX_H, GAP = 132, 46, 22
ROOMS = [
    ("lang: once, before the run", "#2b6cb0", "#d7e6f7",
     [("text", "x: {force: 20 N}"), ("read, parse", "Node, TaskFile"), ("check, physics", "names, units, model"),
      ("lower", "Program: numbers")]),
    ("runtime: each tick", "#2f855a", "#dff3e6",
     [("sense", "Sensed: q, qd, signals"), ("guard, estimate", "State"), ("conditions, exits", "active task"),
      ("rows, blend", "AxisConstraint")]),
    ("solver: each tick", "#c05621", "#fbe6d8",
     [("fill", "Row: a, b, [lo, hi]"), ("sweep inward", "A to the base, B_i"), ("levels, bounds", "nu"),
      ("sum T tau = sum B nu", "tau")]),
    ("runtime: each tick", "#2f855a", "#dff3e6",
     [("friction", "tau"), ("guard", "finite, limit, slew"), ("record", "log"), ("apply", "motors")]),
]


def main():
    left, top, row_h = 20, 40, 98
    width = 2 * left + 4 * BOX_W + 3 * GAP
    height = top + row_h * len(ROOMS) + 8
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">')
    print('<defs><marker id="tip" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto">'
          '<path d="M0 0 L8 4 L0 8 Z" fill="#555"/></marker></defs>')
    print(f'<rect width="{width}" height="{height}" fill="#fff"/>')
    for i, (room, dark, light, boxes) in enumerate(ROOMS):
        y = top + i * row_h
        print(f'<text x="{left}" y="{y - 10}" font-weight="bold" fill="{dark}">{room}</text>')
        for j, (step, result) in enumerate(boxes):
            x = left + j * (BOX_W + GAP)
            print(f'<rect x="{x}" y="{y}" width="{BOX_W}" height="{BOX_H}" rx="6" fill="{light}" stroke="{dark}"/>'
                  f'<text x="{x + BOX_W / 2}" y="{y + 19}" text-anchor="middle" font-weight="bold">{step}</text>'
                  f'<text x="{x + BOX_W / 2}" y="{y + 36}" text-anchor="middle" fill="#444">{result}</text>')
            if j > 0:
                print(f'<line x1="{x - GAP}" y1="{y + BOX_H / 2}" x2="{x - 2}" y2="{y + BOX_H / 2}" stroke="#555" '
                      'marker-end="url(#tip)"/>')
        if i > 0:  # from the end of the row above to the start of this one
            right, bend = left + 3 * (BOX_W + GAP) + BOX_W / 2, y - 38
            print(f'<path d="M {right} {y - row_h + BOX_H} V {bend} H {left + BOX_W / 2 + 60} V {y - 2}" fill="none" '
                  'stroke="#555" marker-end="url(#tip)"/>')
    print("</svg>")


if __name__ == "__main__":
    main()
