// The words of a view: none lies over another one, and none is cut by the edge.
export interface Label { text: string; at: [number, number]; style: string; font?: string }
export interface Box { text: string; left: number; top: number; right: number; bottom: number }

const height = 14;  // [px] of a line
const away = 5;     // [px] from the point that is named

/** Where a text may stand, beside its point: nearest first. */
function* places([x, y]: [number, number], width: number): Generator<[number, number]> {
  for (const step of [0, 1, -1, 2, -2, 3, -3, 4, -4]) {
    const middle = y - height / 2 - away + step * height;
    yield [x + away, middle];
    yield [x - away - width, middle];
    yield [x - width / 2, middle];
  }
}

const overlap = (a: Box, b: Box): boolean => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** Draws the labels, the first ones nearest to their points; one that finds no place is left to a closer look. */
export function drawLabels(c: CanvasRenderingContext2D, labels: Label[], width: number, room: number, halo: string): Box[] {
  const drawn: Box[] = [];
  c.save();
  c.textBaseline = 'middle';
  c.lineJoin = 'round';
  c.lineWidth = 3;
  c.strokeStyle = halo;
  for (const label of labels) {
    if (label.font) c.font = label.font;
    const wide = c.measureText(label.text).width;
    const [x, y] = label.at;
    // Of what lies outside of the view the name does, too.
    if (x < -width || x > 2 * width || y < -room || y > 2 * room) continue;
    for (const [left, middle] of places(label.at, wide)) {
      const inside = Math.min(Math.max(left, 2), width - wide - 2);
      const box = { text: label.text, left: inside, right: inside + wide, top: middle - height / 2, bottom: middle + height / 2 };
      if (box.top < 1 || box.bottom > room - 1 || drawn.some((other) => overlap(box, other))) continue;
      c.fillStyle = label.style;
      c.strokeText(label.text, inside, middle);
      c.fillText(label.text, inside, middle);
      drawn.push(box);
      break;
    }
  }
  c.restore();
  return drawn;
}
