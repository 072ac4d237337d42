// How finely a view is drawn while it moves, and how often.
// Without a graphics card the processors draw each pixel, and the whole page waits for them. A view that moves has as many
// pixels as this machine has just drawn within `budget`. Where the fewest are too many, it rests as long as it drew: the
// view takes at most half of the time. A view that stands is drawn sharp.
const budget = 8;        // [ms] of the 16.7 ms between two frames; the page's own work and the browser have the rest
const coarsest = 0.25;   // pixels of the canvas per pixel of the page: 80 000 become 5000
const restAfter = 250;   // [ms] without a change: an eye's rest, and longer than a hand that scrubs stands still

/** The share that a ratio grows by: the number of pixels, and so the time, goes with its square. */
export function adapted(ratio: number, took: number, finest: number): number {
  // One slow frame, such as the first with its shaders, does not spoil the next ones; a step up is small, as it may be too much.
  const step = Math.min(1.15, Math.max(0.5, Math.sqrt(budget / Math.max(took, 1e-3))));
  return Math.min(finest, Math.max(coarsest, ratio * step));
}

export class Pace {
  private ratio = 1;
  private isWanted = false;
  private isDrawing = false;
  private isSeen = true;
  private rest = 0;

  /** `draw` ends when the pixels are there. */
  constructor(element: Element, private readonly draw: (ratio: number) => Promise<void>) {
    new IntersectionObserver((entries) => {
      this.isSeen = entries.at(-1)!.isIntersecting;
      this.next();
    }).observe(element);
  }

  /** Something has changed. */
  want(): void {
    this.isWanted = true;
    this.next();
  }

  /** Two samples a pixel and axis, averaged by the browser, smooth the edges; three are too many for any screen. */
  private get finest(): number {
    return Math.min(3, 2 * (devicePixelRatio || 1));
  }

  private next(): void {
    if (!this.isWanted || this.isDrawing || !this.isSeen) return;
    clearTimeout(this.rest);
    this.isDrawing = true;
    requestAnimationFrame(() => void this.frame(Math.min(this.ratio, this.finest), true));
  }

  private async frame(ratio: number, isMoving: boolean): Promise<void> {
    this.isWanted = false;
    const begin = performance.now();
    await this.draw(ratio);
    const took = performance.now() - begin;
    if (isMoving) this.ratio = adapted(ratio, took, this.finest);
    if (isMoving && ratio < this.finest) this.rest = window.setTimeout(() => this.sharpen(), restAfter + took);
    setTimeout(() => {
      this.isDrawing = false;
      this.next();
    }, isMoving ? Math.max(0, took - budget) : 0);
  }

  private sharpen(): void {
    if (this.isDrawing || !this.isSeen) return;
    this.isDrawing = true;
    void this.frame(this.finest, false);
  }
}
