// What a person may order: engage, release, freeze, another pace. Each is asked back once, and its reply is shown.

import type { Connection } from './connection';
import { found, say, show } from './dom';
import type { Log } from './log';
import type { Order } from './messages';
import type { Swarm } from './swarm';
import { TwoStep } from './two_step';
import { percent } from './words';

export class Commands {
  readonly engage: TwoStep;
  readonly release: TwoStep;
  readonly freeze: TwoStep;
  readonly set_pace: TwoStep;
  private readonly pace = found<HTMLInputElement>('pace-wanted');
  private readonly phase = found<HTMLInputElement>('release-phase');
  private touched = false;

  constructor(private readonly swarm: Swarm, private readonly connection: Connection, private readonly log: Log) {
    const button = (id: string): HTMLButtonElement => found<HTMLButtonElement>(id);
    this.engage = new TwoStep(button('engage'), () => 'Engage? ⏎', () => void this.order('Engage', { kind: 'ENGAGE' }));
    this.release = new TwoStep(button('release'), () => `Release${this.at_phase()}? ⏎`, () => void this.send_release());
    this.freeze = new TwoStep(button('freeze'), () => 'Freeze? ⏎', () => void this.freeze_now());
    this.set_pace = new TwoStep(button('set-pace'), () => `Pace ${this.wanted()}? ⏎`, () => void this.send_pace());
    this.pace.addEventListener('input', () => {
      this.touched = true;
      say(found('pace-shown'), this.wanted());
    });
    this.pace.addEventListener('change', () => this.set_pace.press());
    found<HTMLFormElement>('token-form').addEventListener('submit', (event) => {
      event.preventDefault();
      const field = found<HTMLInputElement>('token-field');
      if (field.value.trim() !== '') this.connection.keep_token(token_of(field.value));
      field.value = '';
      this.draw();
    });
    for (const change of ['hello', 'online'] as const) swarm.on(change, () => this.draw());
    swarm.on('frame', () => this.follow_pace());
    this.draw();
  }

  private draw(): void {
    const takes = this.swarm.hello?.takes_orders !== false;
    const known = this.connection.token !== '';
    show(found('commands'), takes);
    show(found('token-form'), takes && !known);
    show(found('command-buttons'), known);
    for (const field of found('command-buttons').querySelectorAll<HTMLButtonElement | HTMLInputElement>('button, input'))
      field.disabled = !this.swarm.online;
  }

  /** Until a person moves it, the slider stands where the swarm is. */
  private follow_pace(): void {
    this.mark_next();
    const pace = this.swarm.frame?.pace ?? 0;
    if (this.touched || document.activeElement === this.pace) return;
    const value = String(Math.round(pace * 100));
    if (this.pace.value !== value) this.pace.value = value;
    say(found('pace-shown'), this.wanted());
  }

  /** What a person will most likely want next stands out. */
  private mark_next(): void {
    const rests = (this.swarm.frame?.pace ?? 0) < 0.5;
    this.engage.button.classList.toggle('main', rests);
    this.release.button.classList.toggle('main', !rests);
  }

  private wanted(): string {
    return percent(Number(this.pace.value) / 100);
  }

  private at_phase(): string {
    return this.phase.value.trim() === '' ? '' : ` at ${this.phase.value.trim()}°`;
  }

  private async send_release(): Promise<void> {
    const words = this.phase.value.trim();
    const phase_deg = Number(words);
    if (words === '') return this.order('Release', { kind: 'RELEASE' });
    if (!Number.isFinite(phase_deg)) return this.log.reply('Release', false, `"${words}" is no angle in degrees`);
    return this.order(`Release at ${phase_deg}°`, { kind: 'RELEASE', phase_deg });
  }

  private async send_pace(): Promise<void> {
    await this.order(`Pace ${this.wanted()}`, { kind: 'PACE', pace: Number(this.pace.value) / 100 });
    this.touched = false;
  }

  /** In a hurry: without asking back. Nothing is lost by it, the load hangs as still as before. */
  async freeze_now(): Promise<void> {
    await this.order('Freeze', { kind: 'FREEZE' });
  }

  async order(what: string, order: Partial<Order>): Promise<void> {
    if (this.connection.token === '') return this.log.reply(what, false, 'orders need the address that the server printed');
    const answer = await this.connection.order(order);
    this.log.reply(what, answer.done, answer.text || (answer.done ? 'done' : 'refused'));
  }
}

/** A person may paste the whole address. */
function token_of(words: string): string {
  const at = words.indexOf('token=');
  return (at < 0 ? words : words.slice(at + 6)).trim();
}
