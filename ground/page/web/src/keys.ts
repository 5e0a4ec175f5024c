// Keys, for those whose hands are on them. The list is what the overlay shows, so that none is left out of it.

import type { Commands } from './commands';
import { element, found } from './dom';
import type { Retune } from './retune';
import type { Stage } from './scene/stage';
import type { Swarm } from './swarm';
import type { Theme } from './theme';
import { TwoStep } from './two_step';

interface Key {
  keys: string[];   // as the browser names them
  shown: string;
  what: string;
  order: boolean;   // only where orders are taken
  act: (event: KeyboardEvent) => void;
}

interface Parts {
  swarm: Swarm;
  stage: Stage | undefined;
  commands: Commands;
  retune: Retune;
  theme: Theme;
}

export class Keys {
  private readonly help = found<HTMLDialogElement>('help');
  private readonly keys: Key[];

  constructor(private readonly parts: Parts) {
    this.keys = this.list(parts);
    found('help-list').append(
      ...this.keys.flatMap((key) => [element('dt', {}, element('kbd', { text: key.shown })), element('dd', { text: key.what })]),
    );
    found('help-open').addEventListener('click', () => this.toggle_help());
    found('help-close').addEventListener('click', () => this.help.close());
    window.addEventListener('keydown', (event) => this.press(event));
  }

  private list({ swarm, stage, commands, retune, theme }: Parts): Key[] {
    const key = (keys: string, shown: string, what: string, act: Key['act'], order = false): Key => ({ keys: keys.split(' '), shown, what, order, act });
    return [
      key('?', '?', 'this list', () => this.toggle_help()),
      key('e', 'e', 'engage', () => commands.engage.press(), true),
      key('r', 'r', 'release', () => commands.release.press(), true),
      key('f', 'f', 'freeze', () => commands.freeze.press(), true),
      key('F', 'Shift f', 'freeze at once, without asking back', () => void commands.freeze_now(), true),
      key('p', 'p', 'pace: arrows choose, Enter asks', () => found('pace-wanted').focus(), true),
      key('m', 'm', 'retune: another mission', () => retune.open(), true),
      key('Enter', 'Enter', 'confirm what was asked', () => TwoStep.confirm(), true),
      key('Escape', 'Esc', 'cancel it; select nothing', () => void (TwoStep.cancel() || swarm.select_none())),
      key('1 2 3 4 5 6 7 8 9', '1 … 9', 'select a carrier', (event) => this.select_number(Number(event.key))),
      key('[ ]', '[ ]', 'the carrier before, the next one', (event) => swarm.select_next(event.key === ']' ? 1 : -1)),
      key('o', 'o', 'go along with the selected carrier', () => this.toggle_follow()),
      key('t', 't', 'from above', () => stage?.above()),
      key('h 0', 'h', 'the view of the beginning', () => stage?.reset()),
      key('d', 'd', 'light or dark', () => theme.toggle()),
    ];
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const at = event.target instanceof HTMLElement ? event.target : document.body;
    if (document.querySelector('dialog[open]') !== null) {
      if (event.key === '?' && this.help.open) this.help.close();
      return;  // a dialog has its own keys
    }
    const writes = at.matches('input:not([type=range]), textarea, select');
    if (writes && event.key !== 'Escape') return;
    if (event.key === 'Enter' && at.matches('button, summary, a')) return;  // Enter presses what has the focus
    const key = this.keys.find((candidate) => candidate.keys.includes(event.key));
    if (key === undefined) return;
    if (key.order && (this.parts.swarm.hello?.takes_orders === false || found('command-buttons').hidden)) return;
    event.preventDefault();
    key.act(event);
  }

  private select_number(number: number): void {
    const id = this.parts.swarm.ids[number - 1];
    if (id !== undefined) this.parts.swarm.select(id);
  }

  toggle_follow(): void {
    const { stage, swarm } = this.parts;
    if (stage === undefined) return;
    if (swarm.selected.length === 0) swarm.select_next(1);
    stage.following = !stage.following;
    found('follow').setAttribute('aria-pressed', String(stage.following));
  }

  toggle_help(): void {
    if (this.help.open) this.help.close();
    else this.help.showModal();
  }
}
