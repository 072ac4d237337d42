// What each quantity does on an axis, for docs/language.md: curves of real runs, a driver on the left, a range on the right.
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, writeFileSync } from 'node:fs';

const panels = {
  position: [
    { axis: '{position: 0.2 m}', until: 4, column: 'truth.base.x', unit: 'm', top: 0.25, line: 0.2, told: 'p' },
    { axis: '{velocity: 0.4 m/s, position: [-1 m, 1 m]}', until: 4, column: 'truth.base.x', unit: 'm', top: 1.25, line: 1, told: 'upper end' },
  ],
  velocity: [
    { axis: '{velocity: 0.4 m/s}', until: 3, column: 'base.vx', unit: 'm/s', top: 0.5, line: 0.4, told: 'v', marks: [[0.5, '63 % after T'], [2, '98 % after 4 T']] },
    { axis: '{position: 1 m, velocity: +-0.3 m/s}', until: 6, column: 'base.vx', unit: 'm/s', top: 0.5, line: 0.3, told: 'upper end' },
  ],
  acceleration: [
    { axis: '{acceleration: 0.2 m/s^2}', until: 2, column: 'base.vx', unit: 'm/s', top: 0.5, slope: 0.2, told: 'c' },
    { axis: '{velocity: 0.4 m/s, acceleration: +-0.2 m/s^2}', until: 4, column: 'base.vx', unit: 'm/s', top: 0.5, slope: 0.2, told: 'upper end' },
  ],
  force: [
    { axis: '{force: 20 N, velocity: +-0.08 m/s}', until: 5, column: 'truth.wall.force', unit: 'N', top: 30, line: 20, told: 'f' },
    { axis: '{velocity: 0.08 m/s, force: +-5 N}', until: 5, column: 'truth.wall.force', unit: 'N', top: 30, line: 5, told: 'upper end' },
  ],
};

const scene = `zwang_scene: 1
state: perfect
objects:
  wall: {wall: {length: 4 m}, at: [AHEAD m, 0 m], damping: 1}
`;
const task = (axis, until) => `zwang: 2
robot: robots/mecanum_base.yaml
scene: floor.yaml
start: go
tasks:
  go:
    enter: {blend: 0 s}
    constraints:
      g: {move: base, in: world, x: ${axis}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    timeout: {after: ${until} s, goto: done}
`;

/** [time, value] of a column. */
function curve(zwang, folder, panel) {
  writeFileSync(`${folder}/floor.yaml`, scene.replace('AHEAD', panel.unit === 'N' ? '0.5' : '6'));
  writeFileSync(`${folder}/go.yaml`, task(panel.axis, panel.until));
  spawnSync(zwang, ['run', `${folder}/go.yaml`, '--log', `${folder}/run`, '--quiet'], { stdio: 'pipe' });
  const [head, ...lines] = execFileSync(zwang, ['log', `${folder}/run`], { encoding: 'utf8', maxBuffer: 1 << 28 }).trim().split('\n')
    .map((line) => line.split(','));
  const column = head.findIndex((name) => name.startsWith(`${panel.column} [`));
  if (column < 0) throw new Error(`the log of ${panel.axis} has no ${panel.column}`);
  return lines.filter((line) => Number(line[0]) <= panel.until).map((line) => [Number(line[0]), Number(line[column])]);
}

const [width, height, left, top, plot] = [420, 210, 46, 44, [350, 130]];
const text = (x, y, content, more = '') => `<text x="${x}" y="${y}" ${more}>${content}</text>`;

function draw(panel, points, shift) {
  const to = ([time, value]) => [shift + left + (time / panel.until) * plot[0],
    top + plot[1] - (Math.min(Math.max(value, 0), panel.top) / panel.top) * plot[1]].map((px) => px.toFixed(1));
  const path = points.filter((_, i) => i % 10 === 0).map((point) => to(point).join(' ')).join(' L ');
  const [x0, y0] = to([0, 0]);
  const [x1, y1] = to([panel.until, panel.top]);
  const reaches = panel.slope ? Math.min(panel.until, panel.top / panel.slope) : panel.until;
  const bound = panel.slope ? [to([0, 0]), to([reaches, panel.slope * reaches])] : [to([0, panel.line]), to([panel.until, panel.line])];
  const label = panel.slope ? [(Number(bound[0][0]) + Number(bound[1][0])) / 2 - 10, (Number(bound[0][1]) + Number(bound[1][1])) / 2 - 4] : [x1, Number(bound[0][1]) - 5];
  const marks = (panel.marks ?? []).map(([time, words]) => {
    const [x, y] = to([time, points.find((point) => point[0] >= time)[1]]);
    return `<circle cx="${x}" cy="${y}" r="3" fill="#c05621"/>${text(Number(x) + 6, Number(y) + 14, words, 'fill="#c05621"')}`;
  }).join('');
  const hit = points.find((point) => point[1] > panel.top);
  const told = hit ? text(Number(to(hit)[0]) + 8, top + 12, 'hit', 'fill="#444"') : '';
  return `${text(shift + left, 18, `x: ${panel.axis}`, 'font-family="monospace" font-size="12.5"')}
<path d="M ${x0} ${y1} V ${y0} H ${x1}" fill="none" stroke="#555"/>
${text(x0, y1 - 6, `${panel.unit === 'N' ? 'force on the wall' : panel.unit === 'm' ? 'place' : 'speed'} [${panel.unit}]`, 'fill="#444"')}
${text(x0 - 6, Number(y1) + 5, panel.top, 'text-anchor="end" fill="#444"')}${text(x0 - 6, y0, 0, 'text-anchor="end" fill="#444"')}
${text(x1, Number(y0) + 16, `${panel.until} s`, 'text-anchor="end" fill="#444"')}
<path d="M ${bound[0].join(' ')} L ${bound[1].join(' ')}" stroke="#c05621" stroke-dasharray="5 4" fill="none"/>
${text(label[0], label[1], panel.told, 'text-anchor="end" fill="#c05621"')}
<path d="M ${path}" fill="none" stroke="#2b6cb0" stroke-width="2"/>${marks}${told}`;
}

/** Four pictures, `NAME.svg` each. */
export function quantities(zwang, specs, out, folder) {
  mkdirSync(folder, { recursive: true });
  cpSync(`${specs}/robots`, `${folder}/robots`, { recursive: true });
  for (const [name, both] of Object.entries(panels)) {
    const drawn = both.map((panel, i) => draw(panel, curve(zwang, folder, panel), i * width)).join('\n');
    writeFileSync(`${out}/${name}.svg`, `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${2 * width} ${height}" font-family="sans-serif" font-size="12">
<rect width="${2 * width}" height="${height}" fill="#fff"/>
${drawn}
</svg>
`);
  }
}
