// Play, scrub, speed, follow; the same by keys.
import type { Clock } from './clock';
import { h, write } from './dom';
import { seconds } from './units';

export interface Followers { follow: boolean; draw(): void }

/** `task`: what is active at a time, in words. */
export function controls(clock: Clock, task: (time: number) => string, views: Followers[]): HTMLElement {
  const { duration } = clock;
  const play = h('button', { class: 'play', 'aria-label': 'Play', onclick: () => clock.toggle() }, '▶');
  const scrub = h('input', { type: 'range', min: 0, max: duration, step: duration / 2000, value: 0, 'aria-label': 'Time', class: 'scrub', oninput: () => clock.show(Number(scrub.value)) });
  const speed = h('select', { 'aria-label': 'Speed', onchange: () => { clock.speed = Number(speed.value); } },
    ...[0.1, 0.25, 0.5, 1, 2, 5, 10, 50].map((value) => h('option', { value, selected: value === 1 }, `${value} ×`)));
  const follow = h('input', { type: 'checkbox', id: 'follow', onchange: () => {
    for (const view of views) {
      view.follow = follow.checked;
      view.draw();
    }
  } });
  const now = h('output', { class: 'now', 'aria-live': 'off' });
  clock.onState(() => {
    play.textContent = clock.playing ? '⏸' : '▶';
    play.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
  });
  clock.onTime((time) => {
    scrub.value = String(time);
    write(now, `${seconds(time)}  ${task(time)}`);
    scrub.setAttribute('aria-valuetext', `${seconds(time)}, ${task(time)}`);
  });
  onKeys((far) => {
    const step = duration / (far ? 10 : 100);
    return {
      ' ': () => clock.toggle(), ArrowRight: () => clock.show(clock.time + step), ArrowLeft: () => clock.show(clock.time - step),
      Home: () => clock.show(0), End: () => clock.show(duration), f: () => follow.click(),
    };
  });
  return h('div', { class: 'controls', role: 'group', 'aria-label': 'Playback' }, play, scrub, now,
    h('label', {}, speed), h('label', { for: 'follow' }, follow, ' follow'), h('span', { class: 'keys' }, 'space plays, arrows step, shift steps far, f follows'));
}

/** Keys of the whole page, where nothing else takes them. `far`: with shift. */
export function onKeys(keys: (far: boolean) => Record<string, () => void>): void {
  document.addEventListener('keydown', (event) => {
    const isTyping = event.target instanceof Element && event.target.closest('select, button, input, [role=tablist]') !== null;
    if (isTyping || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = keys(event.shiftKey)[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}
