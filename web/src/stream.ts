// The messages of `zwang run --live`: JSON with its length before it, numbers behind it.
import type { Bound, RunData, World } from './data';

export interface LiveColumn { name: string; unit: string; file: number; line: number; words: boolean }
export interface LiveParameter {
  name: string; value: number; unit: string; scale: number; help: string; range?: [number | null, number | null];
}
/** What a hand may do to the simulated world: a fault has words, or a number within a range, in SI. */
export interface HandChoices {
  signals: string[]; objects: string[];
  faults: { name: string; words?: string[]; unit?: string; low?: number; high?: number }[];
}
export interface HandState { blocked: string[]; faults: Record<string, string | number> }
export interface Begin {
  kind: 'begin'; facts: Record<string, string>; files: { path: string; text: string }[]; columns: LiveColumn[];
  parameters: LiveParameter[]; period: number; world: World; graph: NonNullable<RunData['graph']>; bounds: Bound[];
  hand: HandChoices;
}
/** Behind it: of each column two extremes in their order, then the last values. Times are in s. */
export interface Bucket {
  kind: 'bucket'; begin: number; end: number; records: number; task: string | null; tasks: [number, string][];
  events: { time: number; code: string; signal: string; value: number | null }[];
}
export interface State {
  kind: 'state'; paused: boolean; speed: number; over: boolean; time: number; values: Record<string, number>; refused: string;
  hand: HandState;
}
export interface Over { kind: 'over'; report: RunData['report'] }
export type Message = Begin | Bucket | State | Over;

export type Request =
  | { do: 'ready' | 'pause' | 'go' | 'tick' | 'restart' } | { do: 'speed'; value: number } | { do: 'set'; name: string; value: number }
  | { do: 'push'; at: [number, number]; force: [number, number] }
  | { do: 'block'; name: string; value: boolean } | { do: 'fault'; name: string; value: string | number | null }
  | { do: 'move'; name: string; to: [number, number]; yaw: number };

export class Stream {
  private readonly socket: WebSocket;
  private isOpen = false;

  /** `path` counts from the page. */
  constructor(path: string, onMessage: (message: Message, numbers: Float32Array) => void, onEnd: () => void) {
    const address = new URL(path, location.href);
    address.protocol = 'ws:';
    this.socket = new WebSocket(address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => { this.isOpen = true; };
    this.socket.onclose = () => {
      this.isOpen = false;
      onEnd();
    };
    this.socket.onmessage = ({ data }: MessageEvent<ArrayBuffer>) => {
      const length = new DataView(data).getUint32(0, true);
      const text = new TextDecoder().decode(new Uint8Array(data, 4, length));
      onMessage(JSON.parse(text) as Message, new Float32Array(data, 4 + length));
    };
  }

  ask(request: Request): void {
    if (this.isOpen) this.socket.send(JSON.stringify(request));
  }
}
