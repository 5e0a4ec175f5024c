// "Hurt it": where the server owns the processes, anybody may try to disturb the load, and sees by how much it moved.

import type { Connection } from './connection';
import { element, found, mark, say, show } from './dom';
import type { Log } from './log';
import type { HurtRequest, Process } from './messages';
import type { Swarm } from './swarm';
import { millimetres, seconds } from './words';

const kPush_s = 0.5;

export class HurtPanel {
  private readonly who = found<HTMLSelectElement>('hurt-who');
  private readonly strength = found<HTMLInputElement>('push-strength');

  constructor(private readonly swarm: Swarm, private readonly connection: Connection, private readonly log: Log) {
    for (const button of found('hurt').querySelectorAll<HTMLButtonElement>('button[data-hurt]'))
      button.addEventListener('click', () => void this.hurt(button));
    for (const button of found('hurt').querySelectorAll<HTMLButtonElement>('button[data-push]'))
      button.addEventListener('click', () => void this.push(button));
    this.who.addEventListener('change', () => swarm.select_process(this.who.value));
    this.strength.addEventListener('input', () => this.say_strength());
    for (const change of ['hello', 'status', 'selection', 'online', 'reset', 'mission'] as const) swarm.on(change, () => this.draw());
    this.draw();
  }

  private draw(): void {
    const { hello, status } = this.swarm;
    const owns = hello?.owns_processes === true && hello.takes_orders && this.connection.token !== '';
    show(found('hurt'), owns);
    if (!owns) return;
    this.draw_who(status?.processes.filter((process) => process.name !== 'ground') ?? []);
    const chosen = status?.processes.find((process) => process.name === this.who.value);
    for (const button of found('hurt').querySelectorAll<HTMLButtonElement>('button'))
      button.disabled = !this.swarm.online || (button.dataset['hurt'] !== undefined && !may(button.dataset['hurt'], chosen));
    this.say_strength();
    this.draw_outcome();
  }

  private draw_who(processes: Process[]): void {
    const names = processes.map((process) => process.name);
    const shown = [...this.who.options].map((option) => option.value);
    if (names.join() !== shown.join())
      this.who.replaceChildren(...names.map((name) => element('option', { text: name, attributes: { value: name } })));
    const usual = processes.find((process) => process.carrier !== 0)?.name ?? names[0];
    const wanted = names.includes(this.swarm.process) ? this.swarm.process : names.includes(this.who.value) && this.swarm.process === '' && shown.length > 0 ? this.who.value : usual;
    if (wanted !== undefined && this.who.value !== wanted) this.who.value = wanted;
    for (const process of processes) {
      const option = [...this.who.options].find((candidate) => candidate.value === process.name);
      if (option !== undefined) say(option, process.well ? process.name : `${process.name} (${process.state})`);
    }
  }

  private draw_outcome(): void {
    const hurt = this.swarm.status?.hurt;
    const any = hurt !== undefined && hurt.number > 0;
    mark(found('outcome'), 'data-any', String(any));
    if (!any) return;
    say(found('outcome-what'), hurt.text);
    say(found('outcome-moved'), millimetres(hurt.moved_max_m));
    const before = `before: ${millimetres(hurt.before_m)}`;
    const calm = hurt.calm_after_s < 0 ? `not calm yet, after ${seconds(hurt.since_s)}` : `calm after ${seconds(hurt.calm_after_s)}`;
    say(found('outcome-more'), `${before}  ·  ${calm}`);
  }

  // -------------------------------------------------------------------------------------------------------- asking

  private async hurt(button: HTMLButtonElement): Promise<void> {
    const kind = button.dataset['hurt'] as HurtRequest['kind'];
    const process = this.who.value;
    if (process === '') return;
    await this.ask(`${button.dataset['says'] ?? button.textContent ?? kind} ${process}`, {
      kind,
      process,
      amount: Number(button.dataset['amount'] ?? '0'),
    });
  }

  private force_n(): number {
    const { mass_kg = 0, gravity_m_s2 = 0 } = this.swarm.mission ?? {};
    return (Number(this.strength.value) / 100) * mass_kg * gravity_m_s2;
  }

  private say_strength(): void {
    const force = this.force_n();
    const newtons = force > 0 ? `, ${Number(force.toPrecision(2))} N` : '';
    say(found('push-says'), `${this.strength.value} % of its weight${newtons}, for ${kPush_s} s`);
  }

  private async push(button: HTMLButtonElement): Promise<void> {
    const force = this.force_n();
    if (force <= 0) return this.log.reply('Push', false, 'the weight of the load is not known yet');
    const direction = (button.dataset['push'] ?? '').split(' ').map(Number);
    await this.ask('Push the load', { kind: 'PUSH', force_w_n: direction.map((axis) => axis * force), duration_s: kPush_s });
  }

  private async ask(what: string, request: Partial<HurtRequest>): Promise<void> {
    const answer = await this.connection.hurt(request);
    this.log.reply(what, answer.done, answer.text || (answer.done ? 'done' : 'refused'));
  }
}

/** What makes sense for a process as it is. */
function may(kind: string, process: Process | undefined): boolean {
  if (process === undefined) return false;
  const stopped = process.state === 'stopped';
  if (kind === 'RESTART') return true;
  if (process.pid === 0) return false;
  if (kind === 'CONTINUE') return stopped;
  return kind === 'STOP' ? !stopped : true;
}
