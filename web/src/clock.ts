// The moment that the page shows: one for all of its parts.
export type Listener = (time: number) => void;

/** What a part needs that shows a moment, and leads to another one. */
export interface Moments { onTime(listener: Listener): void; show(time: number): void }

export class Clock {
  time = 0;
  playing = false;
  speed = 1;
  private listeners: Listener[] = [];
  private states: (() => void)[] = [];
  private last = 0;
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(public duration: number) {}

  onTime(listener: Listener): void {
    this.listeners.push(listener);
  }
  onState(listener: () => void): void {
    this.states.push(listener);
  }

  show(time: number): void {
    this.time = Math.min(Math.max(time, 0), this.duration);
    for (const listener of this.listeners) listener(this.time);
  }

  toggle(): void {
    if (!this.playing && this.time >= this.duration) this.show(0);
    this.playing = !this.playing;
    this.last = performance.now();
    this.tell();
    if (this.playing) this.next();
  }

  private tell(): void {
    for (const listener of this.states) listener();
  }

  /** Whoever asks for less motion sees two pictures a second. */
  private next(): void {
    if (this.calm.matches) setTimeout(() => this.step(performance.now()), 500);
    else requestAnimationFrame((now) => this.step(now));
  }

  private step(now: number): void {
    if (!this.playing) return;
    const passed = Math.max(0, now - this.last) / 1000;
    this.last = now;
    this.show(this.time + passed * this.speed);
    if (this.time >= this.duration) {
      this.playing = false;
      this.tell();
    } else {
      this.next();
    }
  }
}

/** Of a run that goes on: stays at its end until somebody looks back. */
export class LiveClock extends Clock {
  isLive = true;

  override show(time: number): void {
    this.isLive = time >= this.duration;
    super.show(time);
  }

  grow(duration: number): void {
    const wasLive = this.isLive;
    this.duration = duration;
    this.show(wasLive ? duration : this.time);
  }
}
