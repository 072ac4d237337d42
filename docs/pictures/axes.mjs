// The axes of docs/language.md and their signs. The base, the frame and the numbers are those of a run's first record.
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, writeFileSync } from 'node:fs';

const goal = [1.35, 0.62];  // [m] in the world
const task = `zwang: 1
robot: robots/mecanum_base.yaml
scene: floor.yaml
frames:
  goal: {parent: world, at: [${goal[0]} m, ${goal[1]} m, 0 m]}
start: go
tasks:
  go:
    constraints:
      way: {move: base, in: goal, x: {position: 0 m}, y: {position: 0 m}, rz: {position: 0 deg}}
    timeout: {after: 0.1 s, goto: done}
`;
const scene = 'zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 20 deg}\n';

/** What the run says of its first moment. */
function firstRecord(zwang, specs, folder) {
  mkdirSync(folder, { recursive: true });
  cpSync(`${specs}/robots`, `${folder}/robots`, { recursive: true });
  writeFileSync(`${folder}/way.yaml`, task);
  writeFileSync(`${folder}/floor.yaml`, scene);
  execFileSync(zwang, ['run', `${folder}/way.yaml`, '--log', `${folder}/run`, '--quiet'], { stdio: 'pipe' });
  const [head, values] = execFileSync(zwang, ['log', `${folder}/run`], { encoding: 'utf8' }).split('\n').map((line) => line.split(','));
  return (name) => Number(values[head.findIndex((one) => one.startsWith(`${name} [`) || one === name)]);
}

const scale = 158;          // [px/m]
const origin = [350, 150];  // [px] where the frame stands
const degrees = 180 / Math.PI;

const line = (a, b, colour, more = '') =>
  `<line x1="${a[0]}" y1="${a[1]}" x2="${b[0]}" y2="${b[1]}" stroke="${colour}" ${more}/>`;
const text = (x, y, words, colour = '#16202e', more = '') => `<text x="${x}" y="${y}" fill="${colour}" ${more}>${words}</text>`;
const marker = (id, colour) => `<marker id="${id}" markerWidth="9" markerHeight="9" refX="7" refY="4.5" orient="auto"><path d="M0 1 L8 4.5 L0 8 Z" fill="${colour}"/></marker>`;
const [red, green, blue, grey, violet] = ['#c53030', '#2f855a', '#2b6cb0', '#6b7280', '#6b46c1'];
const dark = [red, green, blue, grey, violet].map((colour, i) => marker(['red', 'green', 'blue', 'grey', 'violet'][i], colour)).join('\n');
const tip = (name) => `stroke-width="2.5" marker-end="url(#${name})"`;

function fromAbove(record) {
  const [x, y, yaw] = ['x', 'y', 'rz'].map((axis) => record(`go.way.${axis}.position`));
  const at = [origin[0] + scale * x, origin[1] - scale * y].map((value) => Math.round(value));
  const turned = (yaw * degrees).toFixed(1);
  const reach = 112;
  const end = [at[0] + reach * Math.cos(yaw), at[1] - reach * Math.sin(yaw)].map((value) => value.toFixed(1));
  const metres = (value) => `${value.toFixed(2)} m`.replace('-', '−');
  return [
    text(20, 28, 'move: base, in: goal (from above)', undefined, 'font-weight="bold"'),
    `<g transform="translate(${at[0]} ${at[1]}) rotate(${-turned})">`,
    `<rect x="${-0.4 * scale}" y="${-0.28 * scale}" width="${0.8 * scale}" height="${0.56 * scale}" rx="8" fill="#d7e6f7" stroke="${blue}" stroke-width="2"/>`,
    ...[[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([i, k]) =>
      `<rect x="${(i * 0.27 - 0.0759) * scale}" y="${k * 0.22 * scale - 6}" width="${0.1518 * scale}" height="12" rx="3" fill="#444"/>`),
    line([0, 0], [56, 0], blue, tip('blue')), line([0, 0], [0, -36], blue, tip('blue')), '</g>',
    `<circle cx="${at[0]}" cy="${at[1]}" r="4" fill="${blue}"/>`,
    text(at[0] - 20, at[1] + 78, 'base', blue),
    line(origin, [origin[0] + 70, origin[1]], red, tip('red')), line(origin, [origin[0], origin[1] - 70], green, tip('green')),
    `<circle cx="${origin[0]}" cy="${origin[1]}" r="4" fill="#333"/>`,
    text(origin[0] + 76, origin[1] + 5, 'x', red), text(origin[0] - 5, origin[1] - 80, 'y', green), text(origin[0] + 12, origin[1] + 24, 'goal'),
    line(origin, [at[0], origin[1]], red, 'stroke-dasharray="6 4"'), text(at[0] + 8, origin[1] - 10, `x.position = ${metres(x)}`, red),
    line([at[0], origin[1]], at, green, 'stroke-dasharray="6 4"'), text(at[0] + 8, origin[1] + 22, `y.position = ${metres(y)}`, green),
    line(at, [at[0] + 165, at[1]], grey, 'stroke-dasharray="3 4"'),
    `<path d="M ${at[0] + reach} ${at[1]} A ${reach} ${reach} 0 0 0 ${end[0]} ${end[1]}" fill="none" stroke="${violet}" stroke-width="2" marker-end="url(#violet)"/>`,
    text(at[0] + reach + 8, at[1] - 14, `rz.position = +${turned}°`, violet),
  ];
}

const ofAFrame = [
  line([470, 20], [470, 320], '#ddd'), text(500, 28, 'six axes of a frame', undefined, 'font-weight="bold"'),
  line([600, 210], [700, 180], red, tip('red')), line([600, 210], [525, 165], green, tip('green')), line([600, 210], [600, 90], grey, tip('grey')),
  '<circle cx="600" cy="210" r="4" fill="#333"/>',
  text(706, 180, 'x ahead', red), text(494, 158, 'y left', green), text(582, 80, 'z up', grey),
  `<path d="M 613 115.5 A 24 9 0 1 0 622 128" fill="none" stroke="${violet}" stroke-width="2" marker-end="url(#violet)"/>`, text(632, 132, 'rz', violet),
  `<path d="M 655 200 A 9 22 -15 1 1 670 209" fill="none" stroke="${grey}" stroke-width="2" marker-end="url(#grey)"/>`, text(684, 214, 'rx', grey),
  `<path d="M 552 168 A 9 20 30 1 1 543 196" fill="none" stroke="${grey}" stroke-width="2" marker-end="url(#grey)"/>`, text(522, 212, 'ry', grey),
  text(500, 268, 'The wheels move x, y and rz.'), text(500, 288, 'The ground holds z, rx and ry.', grey),
  text(500, 308, 'speed is the norm of the x-y velocity.'),
];

export function axes(zwang, specs, out, folder) {
  const record = firstRecord(zwang, specs, folder);
  writeFileSync(out, [
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 780 340" font-family="sans-serif" font-size="13">',
    `<defs>\n${dark}\n</defs>`, '<rect width="780" height="340" fill="#fff"/>', ...fromAbove(record), ...ofAFrame, '</svg>\n'].join('\n'));
}
