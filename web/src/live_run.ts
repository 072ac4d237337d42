// A run that grows: what came through the stream, as the parts of the page read a run.
import type { Column, Run, RunData } from './data';
import type { Begin, Bucket } from './stream';

/** Twice as many points a curve; beyond, two neighbours become one. */
const mostBuckets = 12000;

/** Numbers in a row, with room for more. */
class Row {
  private all = new Float32Array(1024);
  count = 0;

  push(value: number): void {
    if (this.count === this.all.length) {
      const more = new Float32Array(2 * this.count);
      more.set(this.all);
      this.all = more;
    }
    this.all[this.count++] = value;
  }
  get values(): Float32Array {
    return this.all.subarray(0, this.count);
  }
  /** Of each four values the two that `choose` says, of each `by` the last one. */
  thin(choose: (four: number[]) => number[], by: number): void {
    const old = this.values.slice();
    this.count = 0;
    let i = 0;
    for (; i + by <= old.length; i += by) choose(Array.from(old.subarray(i, i + by))).forEach((value) => this.push(value));
    for (; i < old.length; ++i) this.push(old[i]!);
  }
}

/** The least and the largest, in their order; a blank is neither. */
function extremesOf(values: number[]): number[] {
  const known = values.filter((value) => !Number.isNaN(value));
  if (!known.length) return [NaN, NaN];
  const [low, high] = [Math.min(...known), Math.max(...known)];
  return values.indexOf(low) <= values.indexOf(high) ? [low, high] : [high, low];
}

export class LiveRun implements Run {
  readonly data: RunData;
  readonly columns: Map<string, Column>;
  private readonly time = new Row();
  private readonly sampleTime = new Row();
  private readonly curves: Row[];
  private readonly samples: Row[];
  private readonly place: Map<string, number>;

  constructor(begin: Begin) {
    this.data = {
      log: '', facts: begin.facts, damage: [], records: 0, begin: 0, end: 0, report: null, files: begin.files, tasks: [], events: [],
      curves: { count: 0, times: '', columns: [], points: '', records_a_bucket: 1 }, samples: { count: 0, times: '', columns: [], values: '' },
      world: begin.world, graph: begin.graph, bounds: begin.bounds,
    };
    this.columns = new Map(begin.columns.filter((one) => !one.words && one.name !== 'time').map((one) => [one.name, one]));
    this.place = new Map(begin.columns.map((one, i) => [one.name, i]));
    this.curves = begin.columns.map(() => new Row());
    this.samples = begin.columns.map(() => new Row());
  }

  add(bucket: Bucket, numbers: Float32Array): void {
    const { data } = this;
    const count = this.curves.length;
    if (numbers.length !== 3 * count) return;
    if (data.records === 0) data.begin = bucket.begin;
    data.records += bucket.records;
    data.end = bucket.end;
    this.time.push(bucket.begin - data.begin);
    this.time.push(bucket.end - data.begin);
    this.sampleTime.push(bucket.end - data.begin);
    for (let i = 0; i < count; ++i) {
      this.curves[i]!.push(numbers[i]!);
      this.curves[i]!.push(numbers[count + i]!);
      this.samples[i]!.push(numbers[2 * count + i]!);
    }
    for (const [time, task] of bucket.tasks) this.enter(task, time);
    // Buckets in between may have been missed.
    if (bucket.task !== null && bucket.task !== data.tasks.at(-1)?.task) this.enter(bucket.task, bucket.begin);
    const last = data.tasks.at(-1);
    if (last) last.end = bucket.end;
    for (const event of bucket.events) data.events.push({ ...event, value: event.value ?? NaN });
    if (this.sampleTime.count > mostBuckets) this.thin();
  }

  private enter(task: string, time: number): void {
    const last = this.data.tasks.at(-1);
    if (last) last.end = time;
    this.data.tasks.push({ task, begin: time, end: time });
  }

  private thin(): void {
    const ends = (four: number[]): number[] => [four[0]!, four[3]!];
    const last = (two: number[]): number[] => [two[1]!];
    this.time.thin(ends, 4);
    this.sampleTime.thin(last, 2);
    for (const row of this.curves) row.thin(extremesOf, 4);
    for (const row of this.samples) row.thin(last, 2);
  }

  get duration(): number {
    return Math.max(this.data.end - this.data.begin, 1e-3);
  }
  get times(): Float32Array {
    return this.time.values;
  }
  get sampleTimes(): Float32Array {
    return this.sampleTime.values;
  }
  curve(name: string): Float32Array | undefined {
    return this.columns.has(name) ? this.curves[this.place.get(name)!]!.values : undefined;
  }
  sample(name: string): Float32Array | undefined {
    return this.columns.has(name) ? this.samples[this.place.get(name)!]!.values : undefined;
  }
}
