// Light or dark: as the system has it, until a person chooses.

import type { Paper } from './tones';

const kStored = 'gyre-paper';
const kDark = window.matchMedia('(prefers-color-scheme: dark)');

export class Theme {
  private chosen: Paper | undefined;
  private readonly changed: (() => void)[] = [];

  constructor() {
    try {
      const kept = localStorage.getItem(kStored);
      if (kept === 'light' || kept === 'dark') this.chosen = kept;
    } catch {
      // a browser that keeps nothing: the system's choice
    }
    kDark.addEventListener('change', () => this.apply());
    this.apply();
  }

  get paper(): Paper {
    return this.chosen ?? (kDark.matches ? 'dark' : 'light');
  }

  on_change(act: () => void): void {
    this.changed.push(act);
  }

  toggle(): void {
    const wanted = this.paper === 'light' ? 'dark' : 'light';
    this.chosen = wanted === (kDark.matches ? 'dark' : 'light') ? undefined : wanted;  // back to the system's: with it again
    try {
      if (this.chosen === undefined) localStorage.removeItem(kStored);
      else localStorage.setItem(kStored, this.chosen);
    } catch {
      // for this page alone
    }
    this.apply();
  }

  private apply(): void {
    document.documentElement.dataset['paper'] = this.paper;
    for (const act of this.changed) act();
  }
}
