// A button that asks before it acts: the first press arms it, the second, or Enter, does it; Escape or waiting does not.

import { mark } from './dom';

const kArmed_ms = 5000;

export class TwoStep {
  private static armed: TwoStep | undefined;  // one at a time: Enter means one thing
  private timer = 0;
  private readonly calm: string;

  constructor(readonly button: HTMLButtonElement, private readonly question: () => string, private readonly act: () => void) {
    this.calm = button.textContent ?? '';
    button.addEventListener('click', () => this.press());
    button.addEventListener('blur', () => window.setTimeout(() => document.activeElement !== button && this.disarm(), 150));
  }

  press(): void {
    if (this.button.disabled) return;
    if (TwoStep.armed === this) {
      this.disarm();
      this.act();
      return;
    }
    TwoStep.armed?.disarm();
    TwoStep.armed = this;
    this.button.focus();
    this.say(this.question(), true);
    this.timer = window.setTimeout(() => this.disarm(), kArmed_ms);
  }

  private disarm(): void {
    window.clearTimeout(this.timer);
    if (TwoStep.armed !== this) return;
    TwoStep.armed = undefined;
    this.say(this.calm, false);
  }

  private say(words: string, armed: boolean): void {
    const label = this.button.querySelector('.label-text') ?? this.button;
    label.textContent = words;
    mark(this.button, 'data-armed', String(armed));
  }

  /** Whether something was armed and is not any more. */
  static cancel(): boolean {
    const was = TwoStep.armed;
    was?.disarm();
    return was !== undefined;
  }

  /** Whether something was armed and was done. */
  static confirm(): boolean {
    const was = TwoStep.armed;
    was?.press();
    return was !== undefined;
  }
}
