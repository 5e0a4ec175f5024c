// What happened, the newest first; and toasts, which say the same of what a person just asked for.

import { element, found } from './dom';
import type { Line, Swarm } from './swarm';
import { clock } from './words';

const kSigns: Record<Line['level'], [sign: string, word: string]> = {
  INFO: ['', 'note'],
  WARNING: ['▲', 'warning'],
  ERROR: ['●', 'error'],
};
const kToast_ms = 6000;
const kToastsMost = 3;

export class Log {
  private readonly list = found('log');
  private readonly toasts = found('toasts');
  private shown: string | undefined;  // the key of the newest line that is drawn
  private own = 0;

  constructor(private readonly swarm: Swarm) {
    swarm.on('line', () => this.draw());
  }

  private draw(): void {
    const { lines } = this.swarm;
    if (lines.length === 0) {
      this.list.replaceChildren();
      this.shown = undefined;
      return;
    }
    const known = lines.findIndex((line) => line.key === this.shown);
    const fresh = known < 0 ? lines : lines.slice(0, known);
    if (known < 0) this.list.replaceChildren();
    this.list.prepend(...fresh.map((line) => this.line(line)));
    while (this.list.children.length > lines.length) this.list.lastElementChild?.remove();
    this.shown = lines[0]!.key;
  }

  private line(line: Line): HTMLElement {
    const [sign, word] = kSigns[line.level];
    return element(
      'li',
      { attributes: { 'data-level': line.level } },
      element('time', { text: line.time }),
      element('span', { class: 'sign', text: sign, attributes: { 'aria-label': word, role: 'img' } }),
      element('b', { text: line.who }),
      element('span', { class: 'what', text: line.text }),
    );
  }

  /** A reply to a person: seen at once, and kept. */
  reply(what: string, good: boolean, text: string): void {
    const level = good ? 'INFO' : 'ERROR';
    const time = clock(this.swarm.frame?.swarm_time_s ?? -1);
    this.swarm.add_line({ key: `o${++this.own}`, time, level, who: 'you', text: `${what}: ${text}` });
    const toast = element('div', { class: 'toast', attributes: { 'data-good': String(good) } }, element('b', { text: what }), element('span', { text }));
    this.toasts.append(toast);
    while (this.toasts.children.length > kToastsMost) this.toasts.firstElementChild?.remove();
    setTimeout(() => toast.remove(), kToast_ms);
  }
}
