// The page of a run that goes on.
import { band } from './band';
import { LiveClock, type Moments } from './clock';
import { onKeys } from './controls';
import { curvesOf } from './curves';
import { taskAt, type Run } from './data';
import { h, part } from './dom';
import { graph } from './graph';
import { Grip } from './grip';
import { handPanel } from './hand_panel';
import { baseAt, type Place } from './motion';
import { Hand } from './push';
import { liveControls, parameterPanel, type Steering } from './live_controls';
import { LiveRun } from './live_run';
import { symbols } from './run_page';
import { SpaceView } from './space';
import { Stream, type Begin, type Over, type State } from './stream';
import { events, factList, margins, why } from './tables';
import { TopView } from './top';
import { placeOf } from './world';

const viewsEvery = 33;    // [ms]
const chartsEvery = 250;
const bandEvery = 1000;
const restShare = 1.5;     // of the time that drawing takes, until it draws again

/** A part that is drawn anew: what listened to the clock for the last drawing ends with it. */
function redrawn(clock: LiveClock, build: (moments: Moments) => HTMLElement): { element: HTMLElement; draw(): void } {
  const element = h('div', {});
  let listeners: ((time: number) => void)[] = [];
  clock.onTime((time) => { for (const listener of listeners) listener(time); });
  const draw = (): void => {
    // Nobody loses the place where the keyboard is.
    if (element.contains(document.activeElement)) return;
    const next: typeof listeners = [];
    element.replaceChildren(build({ onTime: (listener) => { next.push(listener); }, show: (time) => clock.show(time) }));
    listeners = next;
    for (const listener of listeners) listener(clock.time);
  };
  return { element, draw };
}

/** Draws when something came, and leaves the browser time for the rest. */
function paced(every: number, draw: () => void): () => void {
  let isDue = false;
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  return () => {
    if (isDue) return;
    isDue = true;
    const wait = calm.matches ? Math.max(500, every) : every;
    setTimeout(() => {
      const begin = performance.now();
      draw();
      // The second frame comes when the first one is on the screen: without a graphics card that takes long.
      requestAnimationFrame(() => requestAnimationFrame(() => {
        setTimeout(() => { isDue = false; }, restShare * (performance.now() - begin));
      }));
    }, wait);
  };
}

const byKeys = 40;  // [N]
const ways: Record<string, [number, number]> = { w: [0, byKeys], a: [-byKeys, 0], s: [0, -byKeys], d: [byKeys, 0] };

/** As long as one of four keys is held, as the views have up, left, down and right. */
function pressByKeys(hand: Hand): void {
  onKeys(() => Object.fromEntries(Object.entries(ways).map(([key, force]) => [key, () => hand.press(force)])));
  const release = (): void => hand.press([0, 0]);
  document.addEventListener('keyup', (event) => { if (event.key in ways) release(); });
  window.addEventListener('blur', release);
}

interface Page { onBucket(): void; onOver(over: Over): void; steerings: Steering[] }

function build(begin: Begin, run: LiveRun, ask: (request: Parameters<Stream['ask']>[0]) => void): Page {
  const clock = new LiveClock(run.duration);
  const { charts, source, onLine, onCurve, element: curves } = curvesOf(run, clock);
  const top = new TopView([{ run, world: begin.world }], clock);
  const space = new SpaceView(run, begin.world, clock);
  const hand = new Hand((push) => ask({ do: 'push', ...push }), () => (clock.isLive ? baseAt(run, run.duration) : null));
  const grip = new Grip(run, begin.world, () => clock.isLive, (object, { x, y, yaw }) => ask({ do: 'move', name: object, to: [x, y], yaw }));
  top.takeHands(hand, grip);
  pressByKeys(hand);
  const name = begin.facts['task']?.split('/').at(-1) ?? 'a run';
  document.title = `${name}: live`;
  const sign = h('span', { 'aria-hidden': 'true' }, '● ');
  const sentence = h('p', { id: 'verdict' }, 'The run goes on.');
  const header = h('header', { class: 'verdict' }, h('h1', {}, sign, name), sentence);
  const steering = liveControls(clock, (time) => taskAt(run, time), [top, space], ask);
  const parameters = parameterPanel(begin.parameters, ask);
  const placeNow = (object: string): Place => placeOf(run, begin.world.scene!.objects.find((one) => one.name === object)!, run.duration);
  const byHand = handPanel(begin.hand, placeNow, ask);
  const bands = redrawn(clock, (moments) => band(run, moments));
  const tasks = redrawn(clock, (moments) => graph(run, moments));
  const told = redrawn(clock, (moments) => events(run, moments));
  const ending = h('div', {});
  document.getElementById('page')!.replaceChildren(header, steering.element,
    h('main', {},
      h('div', { class: 'wide' },
        ending,
        part('parameters', 'Parameters', parameters.element),
        part('hand', 'By hand', byHand.element),
        part('views', 'Where', h('div', { class: 'views' }, top.element, space.element)),
        part('band', 'Tasks over time', bands.element),
        curves,
        part('graph', 'Tasks', tasks.element),
        part('events', 'Events', told.element),
        part('facts', 'Parameters at the start, seed, versions', factList(Object.entries(begin.facts)))),
      h('aside', { 'aria-label': 'Files' }, part('source', 'Files', source.element))));
  let [shownTasks, shownEvents] = [-1, -1];
  const drawViews = paced(viewsEvery, () => {
    top.grow();
    space.grow();
    clock.grow(run.duration);
  });
  const drawCharts = paced(chartsEvery, () => {
    for (const chart of charts) chart.grow();
    if (run.data.tasks.length !== shownTasks) tasks.draw();
    if (run.data.events.length !== shownEvents) told.draw();
    [shownTasks, shownEvents] = [run.data.tasks.length, run.data.events.length];
  });
  const drawBand = paced(bandEvery, () => bands.draw());
  const onOver = ({ report }: Over): void => {
    if (!report) return;
    run.data.report = report;
    header.className = `verdict ${report.outcome}`;
    document.title = `${name}: ${report.outcome}`;
    sign.textContent = `${symbols[report.outcome] ?? '?'} `;
    sentence.textContent = report.verdict;
    const reason = why(run as Run, onLine);
    const parts = [reason && part('why', 'Why', reason), part('margins', 'Margins, worst first', margins(run, clock, onLine, onCurve))];
    ending.replaceChildren(...parts.filter((one) => one !== null));
    clock.grow(run.duration);
    for (const chart of charts) chart.grow();
    bands.draw();
    tasks.draw();
    told.draw();
  };
  (window as unknown as { zwang: unknown }).zwang = { clock, run, top };
  clock.grow(run.duration);
  setTimeout(() => space.start(), 50);
  return {
    onBucket: () => {
      drawViews();
      drawCharts();
      drawBand();
    },
    onOver, steerings: [steering, parameters, byHand],
  };
}

export function livePage(path: string): void {
  const place = document.getElementById('page')!;
  place.append(h('p', { class: 'note', role: 'status' }, 'Waits for the run.'));
  let begin: Begin | null = null;
  let run: LiveRun | null = null;
  let page: Page | null = null;
  let state: State | null = null;
  const stream = new Stream(path, (message, numbers) => {
    // Another run begins: the page, too.
    if (message.kind === 'begin' && begin) return location.reload();
    if (message.kind === 'begin') {
      begin = message;
      run = new LiveRun(begin);
    } else if (message.kind === 'bucket' && begin && run) {
      run.add(message, numbers);
      if (!page) {
        page = build(begin, run, (request) => stream.ask(request));
        if (state) for (const one of page.steerings) one.tell(state);
        setTimeout(() => stream.ask({ do: 'ready' }), 200);
      }
      page.onBucket();
    } else if (message.kind === 'state') {
      state = message;
      for (const one of page?.steerings ?? []) one.tell(message);
    } else if (message.kind === 'over') {
      page?.onOver(message);
    }
  }, () => {
    if (page) for (const one of page.steerings) one.end();
    else place.replaceChildren(h('p', { class: 'note', role: 'status' }, 'The connection ended before the run began. Look at the terminal, then load this page again.'));
  });
}
