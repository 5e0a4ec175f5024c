// How the browser's clock stands to the server's, and how long a word takes: as NTP finds it.
//
// A question that was answered after the time it took on the way there and back was answered somewhere in between: so
// the offset is known to half of that, and the quickest of several questions is the one to believe.

import { now_s } from './connection';

const kEvery_ms = 5000;
const kBest = 8;

export interface Skew {
  offset_s: number;       // the server's time minus the browser's
  uncertainty_s: number;  // half of the quickest way there and back
}

/** Pure: the one to believe. */
export function best(probes: Skew[]): Skew | undefined {
  return probes.reduce<Skew | undefined>(
    (least, probe) => (least === undefined || probe.uncertainty_s < least.uncertainty_s ? probe : least),
    undefined,
  );
}

export class TimeSync {
  private probes: Skew[] = [];

  get skew(): Skew | undefined {
    return best(this.probes);
  }

  begin(): void {
    void this.burst();
    setInterval(() => void this.probe(), kEvery_ms);
  }

  /** After another server was found. */
  again(): void {
    this.probes = [];
    void this.burst();
  }

  private async burst(): Promise<void> {
    for (let i = 0; i < 4; ++i) await this.probe();
  }

  private async probe(): Promise<void> {
    const asked_s = now_s();
    try {
      const reply = await fetch('/api/time', { cache: 'no-store' });
      const answered_s = now_s();
      const wire: unknown = await reply.json();
      const server_s = (wire as { server_time_s?: unknown } | null)?.server_time_s;
      if (!reply.ok || typeof server_s !== 'number') return;
      this.probes.push({ offset_s: server_s - (asked_s + answered_s) / 2, uncertainty_s: (answered_s - asked_s) / 2 });
      if (this.probes.length > kBest) this.probes.shift();
    } catch {
      // a server that is gone is said elsewhere
    }
  }
}
