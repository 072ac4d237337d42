// What steers the run: pause, a tick, speed, restart, parameters; and the way back through what came.
import { onKeys, type Followers } from './controls';
import type { LiveClock } from './clock';
import { h, write } from './dom';
import type { LiveParameter, Request, State } from './stream';
import { seconds } from './units';

type Ask = (request: Request) => void;
const speeds = [1, 0.5, 0.25, 0.1, 0.02];

export interface Steering { element: HTMLElement; tell(state: State): void; end(): void }

export function liveControls(clock: LiveClock, task: (time: number) => string, views: Followers[], ask: Ask): Steering {
  let paused = false;
  const pause = h('button', { class: 'wide-button', id: 'pause', onclick: () => ask({ do: paused ? 'go' : 'pause' }) }, 'Pause');
  const tick = h('button', { class: 'wide-button', id: 'tick', onclick: () => ask({ do: 'tick' }) }, 'One tick');
  const restart = h('button', { class: 'wide-button', id: 'restart', onclick: () => ask({ do: 'restart' }) }, 'Restart');
  const speed = h('select', { 'aria-label': 'Speed of the run', id: 'speed', onchange: () => ask({ do: 'speed', value: Number(speed.value) }) },
    ...speeds.map((value) => h('option', { value, selected: value === 1 }, value === 1 ? 'real time' : `${value} × real time`)));
  const status = h('span', { id: 'status', role: 'status' }, 'running');
  const scrub = h('input', { type: 'range', min: 0, max: 1, step: 'any', value: 0, 'aria-label': 'Time', class: 'scrub', oninput: () => clock.show(Number(scrub.value)) });
  const toNow = h('button', { class: 'wide-button', id: 'now', onclick: () => clock.show(clock.duration) }, 'To now');
  const follow = h('input', { type: 'checkbox', id: 'follow', onchange: () => {
    for (const view of views) {
      view.follow = follow.checked;
      view.draw();
    }
  } });
  const now = h('output', { class: 'now', 'aria-live': 'off' });
  clock.onTime((time) => {
    scrub.max = String(clock.duration);
    scrub.value = String(time);
    write(now, `${seconds(time)}  ${task(time)}`);
    scrub.setAttribute('aria-valuetext', `${seconds(time)}, ${task(time)}`);
    toNow.disabled = clock.isLive;
  });
  onKeys((far) => {
    const step = clock.duration / (far ? 10 : 100);
    return {
      ' ': () => pause.click(), '.': () => tick.click(), ArrowRight: () => clock.show(clock.time + step), ArrowLeft: () => clock.show(clock.time - step),
      Home: () => clock.show(0), End: () => clock.show(clock.duration), f: () => follow.click(),
    };
  });
  const element = h('div', { class: 'controls', role: 'group', 'aria-label': 'The run' }, pause, tick, restart, h('label', {}, speed), status,
    scrub, now, toNow, h('label', { for: 'follow' }, follow, ' follow'),
    h('span', { class: 'keys' }, 'space pauses, . makes a tick, arrows look back, End is now, f follows, w a s d push'));
  const steers = [pause, tick, restart, speed];
  return {
    element,
    tell: (state) => {
      paused = state.paused;
      pause.textContent = paused ? 'Go on' : 'Pause';
      pause.disabled = tick.disabled = state.over;
      if (document.activeElement !== speed) speed.value = String(state.speed);
      const word = state.over ? '■ over' : paused ? '‖ paused' : state.speed === 1 ? '● running' : `● running at ${state.speed} ×`;
      status.textContent = state.refused ? `${word}; refused: ${state.refused}` : word;
    },
    end: () => {
      for (const one of steers) one.disabled = true;
      status.textContent = '✗ zwang has ended: the page keeps what came';
    },
  };
}

/** A slider and a field for each parameter, in the unit of its author. */
export function parameterPanel(parameters: LiveParameter[], ask: Ask): Steering {
  const rows = parameters.map((one) => {
    const shown = (value: number): string => String(Number((value / one.scale).toPrecision(6)));
    const [low, high] = (one.range ?? [null, null]).map((value) => (value === null ? undefined : value / one.scale));
    const set = (input: HTMLInputElement): void => {
      const value = input.valueAsNumber;
      if (!Number.isNaN(value)) ask({ do: 'set', name: one.name, value: value * one.scale });
    };
    const id = `set-${one.name}`;
    const name = one.unit ? `${one.name} [${one.unit}]` : one.name;
    const field = h('input', { type: 'number', id, step: 'any', min: low, max: high, value: shown(one.value), onchange: () => set(field) });
    const slider = low !== undefined && high !== undefined
      ? h('input', { type: 'range', min: low, max: high, step: (high - low) / 200, value: shown(one.value), 'aria-label': name, 'data-parameter': one.name, oninput: () => { field.value = slider!.value; set(slider!); } }) : null;
    const range = low !== undefined && high !== undefined ? `${Number(low.toPrecision(4))} to ${Number(high.toPrecision(4))} ${one.unit}` : 'no range';
    const element = h('div', { class: 'parameter' }, h('label', { for: id }, name), slider, field, h('span', { class: 'note' }, one.help ? `${range}. ${one.help}` : range));
    const tell = (value: number): void => {
      for (const input of [field, slider]) {
        if (input && input !== document.activeElement) input.value = shown(value);
      }
    };
    const end = (): void => { for (const input of [field, slider]) if (input) input.disabled = true; };
    return { name: one.name, element, tell, end };
  });
  const none = h('p', { class: 'note' }, 'The task has no parameters.');
  return {
    element: h('div', {}, ...(rows.length ? [h('p', { class: 'note' }, 'A value holds from the next tick on, and is in the log.'), ...rows.map((row) => row.element)] : [none])),
    tell: (state) => rows.forEach((row) => row.tell(state.values[row.name]!)),
    end: () => rows.forEach((row) => row.end()),
  };
}
