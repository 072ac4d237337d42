// What a hand does to the world of a live run, by the keyboard alone: blocked signals, faults, objects that move.
import { h } from './dom';
import type { Steering } from './live_controls';
import type { Place } from './motion';
import type { HandChoices, HandState, Request } from './stream';

type Ask = (request: Request) => void;
type Fault = HandChoices['faults'][number];

const degree = Math.PI / 180;
const rounded = (value: number): string => String(Number(value.toPrecision(4)));

function signalSwitches(signals: string[], ask: Ask): Steering {
  const boxes = signals.map((name) => {
    const box = h('input', { type: 'checkbox', id: `block-${name}`, onchange: () => ask({ do: 'block', name, value: box.checked }) });
    return { name, box };
  });
  const element = h('fieldset', {}, h('legend', {}, 'Blocked signals'),
    ...boxes.map(({ name, box }) => h('label', { for: `block-${name}` }, box, ` ${name}`)));
  return {
    element,
    tell: ({ hand }) => { for (const { name, box } of boxes) box.checked = hand.blocked.includes(name); },
    end: () => { for (const { box } of boxes) box.disabled = true; },
  };
}

/** One fault at a time is chosen and put on; those in force stand below, each with its end. */
function faultForm(faults: Fault[], ask: Ask): Steering {
  const kind = h('select', { id: 'fault', 'aria-label': 'Fault', onchange: () => show() }, ...faults.map(({ name }) => h('option', { value: name }, name)));
  const word = h('select', { id: 'fault-word', 'aria-label': 'What it is' });
  const number = h('input', { id: 'fault-number', type: 'number', step: 'any', 'aria-label': 'How much' });
  const range = h('span', { class: 'note', id: 'fault-range' });
  const chosen = (): Fault => faults.find(({ name }) => name === kind.value)!;
  const put = h('button', { class: 'wide-button', id: 'fault-put', onclick: () => {
    const fault = chosen();
    const value = fault.words ? word.value : number.valueAsNumber;
    if (typeof value === 'string' || Number.isFinite(value)) ask({ do: 'fault', name: fault.name, value });
  } }, 'Put on');
  const show = (): void => {
    const fault = chosen();
    word.hidden = !fault.words;
    number.hidden = range.hidden = Boolean(fault.words);
    if (fault.words) {
      word.replaceChildren(...fault.words.slice(1).map((one) => h('option', { value: one }, one)));
    } else {
      [number.min, number.max] = [String(fault.low), String(fault.high)];
      range.textContent = `${rounded(fault.low!)} to ${rounded(fault.high!)} ${fault.unit}`;
    }
  };
  show();
  const list = h('ul', { class: 'in-force', 'aria-label': 'Faults in force' });
  let shown = '';
  const tell = ({ hand }: { hand: HandState }): void => {
    const now = JSON.stringify(hand.faults);
    if (now === shown) return;
    shown = now;
    list.replaceChildren(...Object.entries(hand.faults).map(([name, value]) => {
      const unit = faults.find((one) => one.name === name)?.unit ?? '';
      return h('li', {}, h('code', {}, `${name}: ${typeof value === 'number' ? `${rounded(value)} ${unit}`.trim() : value}`), ' ',
        h('button', { class: 'wide-button', 'aria-label': `End ${name}`, onclick: () => {
          ask({ do: 'fault', name, value: null });
          kind.focus();
        } }, 'End'));
    }));
  };
  const element = h('fieldset', {}, h('legend', {}, 'Faults'), h('div', { class: 'fields' }, kind, word, number, range, put), list);
  const steers = [kind, word, number, put];
  return { element, tell, end: () => { for (const one of [...steers, ...list.querySelectorAll('button')]) one.disabled = true; } };
}

/** `placeOf`: where an object stands now. */
function objectForm(objects: string[], placeOf: (name: string) => Place, ask: Ask): Steering {
  const object = h('select', { id: 'object', 'aria-label': 'Object', onchange: () => show() }, ...objects.map((name) => h('option', { value: name }, name)));
  const field = (id: string, name: string): HTMLInputElement => h('input', { id, type: 'number', step: 'any', 'aria-label': name });
  const [x, y, yaw] = [field('object-x', 'x [m]'), field('object-y', 'y [m]'), field('object-yaw', 'yaw [deg]')];
  const show = (): void => {
    const place = placeOf(object.value);
    x.value = rounded(place.x);
    y.value = rounded(place.y);
    yaw.value = rounded(place.yaw / degree);
  };
  show();
  const move = h('button', { class: 'wide-button', id: 'object-move', onclick: () => {
    const to: [number, number] = [x.valueAsNumber, y.valueAsNumber];
    if (Number.isFinite(to[0] + to[1] + yaw.valueAsNumber)) ask({ do: 'move', name: object.value, to, yaw: yaw.valueAsNumber * degree });
  } }, 'Move');
  const named = (name: string, input: HTMLInputElement): HTMLElement => h('label', { for: input.id }, `${name} `, input);
  const element = h('fieldset', {}, h('legend', {}, 'Objects'),
    h('div', { class: 'fields' }, object, named('x [m]', x), named('y [m]', y), named('yaw [deg]', yaw), move),
    h('p', { class: 'note' }, 'It goes there at 0.25 m/s, whatever stands in its way. A drag in the view from above does the same.'));
  return { element, tell: () => undefined, end: () => { for (const one of [object, x, y, yaw, move]) one.disabled = true; } };
}

export function handPanel(choices: HandChoices, placeOf: (name: string) => Place, ask: Ask): Steering {
  const parts = [
    ...(choices.signals.length ? [signalSwitches(choices.signals, ask)] : []),
    faultForm(choices.faults, ask),
    ...(choices.objects.length ? [objectForm(choices.objects, placeOf, ask)] : []),
  ];
  return {
    element: h('div', { class: 'hand' }, h('p', { class: 'note' }, 'All of it counts from the next tick on, and is in the log.'), ...parts.map((one) => one.element)),
    tell: (state) => { for (const one of parts) one.tell(state); },
    end: () => { for (const one of parts) one.end(); },
  };
}
