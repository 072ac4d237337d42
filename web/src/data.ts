// The run as `zwang report` packed it.
export interface Pose { p: number[]; r: number[] }
export interface Column { name: string; unit: string; file: number; line: number }
export interface Body {
  name: string; parent: number; pose: Pose; joint: string; type: string; axis: number[]; effort: number | null;
  box: { sides: number[]; pose: Pose };
}
export interface Wheel { body: number; radius: number; roller: number | null }
export interface Robot {
  name: string; footprint: number[][]; height: number; bodies: Body[]; wheels: Wheel[];
  frames: { name: string; body: number; pose: Pose }[]; posture: number[];
}
export interface SceneObject {
  name: string; shape: 'wall' | 'box' | 'cylinder'; size: number[]; at: number[]; yaw: number; moves: boolean; dock?: number[];
  lean?: Pose;  // of one that leans: its axes in the world, with the origin on the floor
}
export interface Scene { objects: SceneObject[]; robots: { name: string; at: number[]; yaw: number; robot?: Robot }[] }
export interface Frame {
  name: string; parent: 'world' | 'body' | 'frame' | 'signal'; index: number; pose: Pose; declared: boolean; set: boolean;
}
export interface Region { name: string; parent: number; polygon: number[][]; centre: number[]; radius: number }
/** Points of a path in its frame; of a closed one the last point is the first. */
export interface Path { name: string; frame: number; closed: boolean; points: number[][] }
export interface World { robot: Robot; scene: Scene | null; regions: Region[]; paths?: Path[]; frames: Frame[] }
export interface Bound {
  column: string; task: string | null; low: number | null; high: number | null; file: number; line: number;
}
export interface Limit {
  row: string; line: number | null; limit: number; worst: number; margin: number; broken: boolean; unit: string; where: string;
}
export interface Term {
  text: string; is: string; holds_back: boolean; value: number | null; unit: string; because?: string; stood?: number;
  signals?: { name: string; received: boolean; age: number; stale_after: number; words?: string }[];
}
export interface Exit {
  column: string; when: string; line: number | null; to: string; is: string; longest: number; times?: number; for: number; terms: Term[];
}
export interface Report {
  outcome: string; verdict: string; elapsed: number; seed: number;
  transitions: { time: number; from: string | null; to: string; why: string }[];
  events: { time: number; code: string; signal: string; value: number | null }[];
  limits: Limit[];
  why?: { sentence: string; cause: string; time: number; task: string; exits: Exit[] };
}
/** What was said of the files before the run began. */
export interface Warning { code: string; message: string; help: string; file: number; line: number }
export interface Edge { from: string; to: string; label: string; dashed: boolean }
export interface RunData {
  log: string; facts: Record<string, string>; damage: string[]; records: number; begin: number; end: number;
  report: Report | null;
  files: { path: string; text: string }[];
  tasks: { task: string; begin: number; end: number }[];
  events: { time: number; code: string; signal: string; value: number }[];
  curves: { count: number; times: string; columns: Column[]; points: string; records_a_bucket: number };
  samples: { count: number; times: string; columns: string[]; values: string };
  world: World | null;
  warnings?: Warning[];
  graph?: { tasks: string[]; start: string; always: boolean; edges: Edge[] };
  bounds?: Bound[];
}

/** Times count from the begin of the run. */
export interface Run {
  data: RunData;
  duration: number;
  times: Float32Array;
  columns: Map<string, Column>;
  curve(name: string): Float32Array | undefined;
  sampleTimes: Float32Array;
  sample(name: string): Float32Array | undefined;
}

/** A file that the two runs do not have alike: from `line` on, as many lines each. */
export interface FileDifference {
  first: string; second: string; line: number;
  first_lines: string[]; second_lines: string[]; first_count: number; second_count: number;
}
export interface ColumnDifference {
  name: string; unit: string; input: boolean; time: number; first: string; second: string; records: number;
  largest: number | null; largest_time: number;
}
export interface Happening { time: number; what: string }
/** Two lists; `differs`: the number of the first pair that is not alike. */
export interface Happenings { first: Happening[]; second: Happening[]; counts: number[]; differs: number | null }
export interface Comparison {
  facts: { name: string; first: string | null; second: string | null }[];
  files: FileDifference[];
  compared: number; until: number; periods: number[];
  columns: ColumnDifference[]; only_first: string[]; only_second: string[];
  transitions: Happenings; events: Happenings;
}
export interface ComparisonData { names: string[]; runs: [RunData, RunData]; comparison: Comparison }

export interface Expectation {
  text: string; held: boolean; margin: number | null; value: number | null; unit: string; time: number; where: string;
}
/** Lists of a run, cut where they are long; `counts`: how many transitions, events and limits there were. */
export interface Story {
  transitions: [number, string, string, string][]; events: [number, string, string][]; counts: number[];
  limits: [string, number, number, number, string, boolean][]; path: number[];
}
export interface Cell {
  scenario: number; name: string; passed: boolean; outcome: string; because: string; why: string; simulated: number; torque: number;
  worst: number | null; expectations: Expectation[]; story: Story; command: string; scene?: number;
  robots?: { name: string; outcome: string; because: string }[];
}
/** All runs of `zwang test`, the worst first. */
export interface MatrixData {
  seconds: number; runs: number;
  scenarios: { file: string; about: string; readable: boolean; diagnostics: string }[];
  cells: Cell[];
  scenes: { objects: SceneObject[]; footprint: number[][] }[];
}

/** An expectation of a study, over all of its cells. */
export interface StudyClaim {
  text: string; verdict: string; held: number; runs: number; share: [number, number]; confidence: number; probability?: number;
  margins?: { share: number; margin: number }[];
  correlations: { draw: string; margin?: number; misses?: number }[];
}
/** All cells of `zwang sweep`. */
export interface StudyData {
  study: {
    study: string; passed: boolean; cells: number; wanted: number; outcomes: Record<string, number>; expectations: StudyClaim[];
    groups: { name: string; hold: number; runs: number }[];
    worst: { cell: number; of_matrix: string; outcome: string; because: string; why: string; expectation: string; drawn: Record<string, number>; margin?: number }[];
  };
  about: string; command: string;
  draws: { name: string; unit: string; is_log: boolean }[];
  /** Parallel lists: of cells, of what each drew, of each expectation. */
  points: { cells: number[]; drawn: number[][]; expectations: { held: number[]; margins: (number | null)[] }[] };
}

/** Base 64, deflated, the four bytes of the numbers in four planes. */
async function unpack(text: string): Promise<Float32Array> {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = planes.length / 4;
  const bytes = new Uint8Array(planes.length);
  for (let i = 0; i < count; ++i) {
    for (let b = 0; b < 4; ++b) bytes[4 * i + b] = planes[b * count + i]!;
  }
  return new Float32Array(bytes.buffer);
}

export async function load(data: RunData): Promise<Run> {
  const [times, points, sampleTimes, values] = await Promise.all(
    [data.curves.times, data.curves.points, data.samples.times, data.samples.values].map(unpack),
  ) as [Float32Array, Float32Array, Float32Array, Float32Array];
  const slices = (all: Float32Array, count: number, names: string[]): Map<string, Float32Array> =>
    new Map(names.map((name, i) => [name, all.subarray(i * count, (i + 1) * count)]));
  const curves = slices(points, data.curves.count, data.curves.columns.map((c) => c.name));
  const samples = slices(values, data.samples.count, data.samples.columns);
  return {
    data, times, sampleTimes,
    duration: Math.max(data.end - data.begin, 1e-3),
    columns: new Map(data.curves.columns.map((c) => [c.name, c])),
    curve: (name) => curves.get(name),
    sample: (name) => samples.get(name),
  };
}

/** The last index whose time is not after `time`. */
export function indexAt(times: Float32Array, time: number): number {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** The number of the stretch of `tasks` that the time lies in, in the order of the log. */
export function stretchAt(run: Run, time: number): number {
  let found = 0;
  run.data.tasks.forEach((one, i) => { if (one.begin - run.data.begin <= time) found = i; });
  return found;
}
export const taskAt = (run: Run, time: number): string => run.data.tasks[stretchAt(run, time)]?.task ?? '';
