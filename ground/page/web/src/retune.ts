// Another motion of the same load, from a file: checked by the server first, the certificate shown, then confirmed.

import type { Commands } from './commands';
import type { Connection } from './connection';
import { found, mark, say, show } from './dom';
import type { Swarm } from './swarm';

const kLargest = 1 << 20;  // no mission is as large; a film that fell onto the page by mistake is
const kCheckAfter_ms = 500;

export class Retune {
  private readonly dialog = found<HTMLDialogElement>('retune-dialog');
  private readonly mission = found<HTMLTextAreaElement>('retune-mission');
  private readonly confirm = found<HTMLButtonElement>('retune-confirm');
  private readonly chooser = found<HTMLInputElement>('retune-file');
  private asked = 0;  // only the answer to the last question counts
  private timer = 0;

  constructor(private readonly swarm: Swarm, private readonly connection: Connection, private readonly commands: Commands) {
    found('retune').addEventListener('click', () => this.open());
    found('retune-cancel').addEventListener('click', () => this.dialog.close());
    this.confirm.addEventListener('click', () => void this.send());
    this.chooser.addEventListener('change', () => void this.read(this.chooser.files?.[0]));
    this.mission.addEventListener('input', () => {
      this.judge_later();
    });
    this.take_drops();
  }

  open(): void {
    if (this.swarm.hello?.takes_orders === false || this.connection.token === '' || this.dialog.open) return;
    const { mission_file = '' } = this.swarm.hello ?? {};
    const is_text = mission_file.includes('{');
    if (is_text && this.mission.value === '') this.mission.value = mission_file;
    say(found('retune-hint'), is_text || mission_file === '' ? '' : `Flown now: ${mission_file}`);
    this.dialog.showModal();
    if (this.mission.value === '') this.say_verdict('Choose a mission file, drop one onto this page, or write one here.', 'none');
    else void this.judge();
  }

  private take_drops(): void {
    const has_file = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
    window.addEventListener('dragover', (event) => {
      if (!has_file(event)) return;
      event.preventDefault();
      document.body.dataset['drop'] = 'true';
    });
    window.addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) delete document.body.dataset['drop'];
    });
    window.addEventListener('drop', (event) => {
      delete document.body.dataset['drop'];
      if (!has_file(event)) return;
      event.preventDefault();
      void this.read(event.dataTransfer?.files[0]);
    });
  }

  private async read(file: File | undefined): Promise<void> {
    if (file === undefined) return;
    this.open();
    if (!this.dialog.open) return;
    this.chooser.value = '';  // the same file again is a choice again
    if (file.size > kLargest) return this.say_verdict(`${file.name} is too large to be a mission.`, 'bad');
    this.mission.value = await file.text();
    say(found('retune-hint'), file.name);
    return this.judge();
  }

  private judge_later(): void {
    this.confirm.disabled = true;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.judge(), kCheckAfter_ms);
  }

  private async judge(): Promise<void> {
    const asked = ++this.asked;
    const mission = this.mission.value;
    this.confirm.disabled = true;
    this.say_verdict('The server checks it …', 'none');
    const verdict = await this.connection.check(mission);
    if (asked !== this.asked) return;
    this.say_verdict(verdict.text, verdict.admissible ? 'good' : 'bad');
    this.confirm.disabled = !verdict.admissible;
    say(this.confirm, verdict.admissible && verdict.name !== '' ? `Retune to ${verdict.name}` : 'Retune');
  }

  private say_verdict(words: string, kind: 'none' | 'good' | 'bad'): void {
    say(found('retune-verdict'), words);
    mark(found('retune-verdict'), 'data-kind', kind);
    say(found('retune-judged'), kind === 'none' ? '' : kind === 'good' ? 'Admissible' : 'Not admissible');
    show(found('retune-judged'), kind !== 'none');
    mark(found('retune-judged'), 'data-kind', kind);
  }

  private async send(): Promise<void> {
    const name = (this.confirm.textContent ?? 'Retune').trim();
    const mission = this.mission.value;
    this.dialog.close();
    await this.commands.order(name, { kind: 'RETUNE', mission });
  }
}
