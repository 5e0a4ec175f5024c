// The plots of the last minute: each carrier's figures inside what was certified, the load, the clocks.
//
// Up to eight carriers are drawn each by a line. Of more, those that are selected are, and the others are the area
// between the least and the greatest: forty-eight lines tell nothing and cost a frame.

import { css_color, found } from './dom';
import { kFigures } from './history';
import type { Figure } from './history';
import type { Range } from './messages';
import { Plot } from './plot';
import type { Kind } from './plot';
import type { Bound, Curve, Picture } from './plot_reach';
import type { Rows } from './history';
import type { Swarm } from './swarm';
import type { Theme } from './theme';
import { carrier_dash, carrier_tone } from './tones';

const kLinesMost = 8;
const kQuickest_ms = 250;
const kShare = 25;  // of the time, at most one part in so many goes into plots

const kTitles: Record<Figure, [title: string, unit: string]> = {
  tension_n: ['Tension', 'N'],
  length_m: ['Cable length', 'm'],
  speed_m_s: ['Speed', 'm/s'],
  winch_rate_m_s: ['Winch rate', 'm/s'],
  altitude_m: ['Altitude', 'm'],
};

export class Plots {
  private readonly plots: Plot[];

  constructor(private readonly swarm: Swarm, private readonly theme: Theme) {
    const kinds: Kind[] = [
      { key: 'displacement', title: 'Load displaced', unit: 'mm', logarithmic: true, picture: () => this.displacement() },
      ...kFigures.map((key) => ({ key, title: kTitles[key][0], unit: kTitles[key][1], logarithmic: false, picture: () => this.figure(key) })),
      { key: 'clocks', title: 'Clock uncertainty', unit: 'µs', logarithmic: true, picture: () => this.clocks() },
    ];
    this.plots = kinds.map((kind) => new Plot(kind, 'gyre'));
    found('plots').append(...this.plots.map((plot) => plot.box));
    theme.on_change(() => this.plots.forEach((plot) => plot.forget()));
    const again = (): void => this.plots.forEach((plot) => plot.draw());
    swarm.on('selection', again);
    swarm.on('mission', again);
    const go_on = (): void => {
      const begun_ms = performance.now();
      if (!document.hidden && swarm.online) again();
      const took_ms = performance.now() - begun_ms;
      setTimeout(go_on, Math.min(1500, Math.max(kQuickest_ms, kShare * took_ms)));
    };
    go_on();
  }

  private ages(times: Rows): number[] {
    const newest = times.length > 0 ? times.get(times.length - 1, 0) : 0;
    return times.column(0).map((time) => (time ?? 0) - newest);
  }

  private drawn(): number[] {
    const { ids, selected } = this.swarm;
    if (selected.length > 0) return selected.map((id) => ids.indexOf(id)).filter((index) => index >= 0).slice(0, kLinesMost);
    return ids.length <= kLinesMost ? ids.map((_, i) => i) : [];
  }

  private curves(rows: Rows): Curve[] {
    return this.drawn().map((index) => ({
      name: String(this.swarm.ids[index]),
      tone: carrier_tone(index, this.theme.paper),
      dash: carrier_dash(index),
      width: 1.5,
      values: rows.column(index),
    }));
  }

  private envelope(rows: Rows): Picture['envelope'] {
    if (rows.width <= kLinesMost) return undefined;
    const low: (number | null)[] = [];
    const high: (number | null)[] = [];
    for (let i = 0; i < rows.length; ++i) {
      let [least, most] = [Infinity, -Infinity];
      for (let c = 0; c < rows.width; ++c) {
        const value = rows.get(i, c);
        if (value < least) least = value;
        if (value > most) most = value;
      }
      low.push(least <= most ? least : null);
      high.push(least <= most ? most : null);
    }
    return { low, high };
  }

  private figure(key: Figure): Picture {
    const rows = this.swarm.history.figures[key];
    const certified = this.swarm.mission?.complete === true ? this.swarm.mission.carriers.map((carrier) => carrier.certified[key]) : [];
    return {
      times: this.ages(this.swarm.history.times),
      curves: this.curves(rows),
      envelope: this.envelope(rows),
      bands: this.bands(certified),
      bounds: bounds(this.swarm.mission?.complete === true ? this.swarm.mission.limits[key] : undefined),
    };
  }

  /** Each carrier's own where a few are selected, else what they cover together. */
  private bands(certified: Range[]): Picture['bands'] {
    const { selected } = this.swarm;
    const drawn = selected.length > 0 ? this.drawn() : certified.map((_, i) => i);
    const mine = drawn.map((index) => ({ index, band: certified[index] })).filter((one) => one.band !== undefined);
    if (mine.length === 0) return [];
    if (selected.length > 0)
      return mine.map(({ index, band }) => ({ ...band!, tone: `${carrier_tone(index, this.theme.paper)}1f` }));
    const min = Math.min(...mine.map(({ band }) => band!.min));
    const max = Math.max(...mine.map(({ band }) => band!.max));
    return [{ min, max, tone: css_color('band') }];
  }

  private displacement(): Picture {
    const { load, times } = this.swarm.history;
    const floor_mm = 1e-4;  // a logarithm knows no zero
    const values = load.column(0).map((value) => (value === null ? null : Math.max(value, floor_mm)));
    const most_mm = (this.swarm.mission?.displacement_max_m ?? 0) * 1000;
    return {
      times: this.ages(times),
      curves: [{ name: 'load', tone: css_color('accent'), dash: [], width: 1.75, values }],
      envelope: undefined,
      bands: [],
      bounds: most_mm > 0 ? [{ value: most_mm, what: 'good up to' }] : [],
    };
  }

  private clocks(): Picture {
    const { clocks, clock_times } = this.swarm.history;
    const budget_us = (this.swarm.status?.skew_budget_s ?? 0) * 1e6;
    return {
      times: this.ages(clock_times),
      curves: this.curves(clocks),
      envelope: this.envelope(clocks),
      bands: [],
      bounds: budget_us > 0 ? [{ value: budget_us, what: 'skew budget' }] : [],
    };
  }
}

/** A bound of nothing is none: a winch rate's least is minus its greatest, or it stands at zero. */
function bounds(limits: Range | undefined): Bound[] {
  if (limits === undefined || (limits.min === 0 && limits.max === 0)) return [];
  const out: Bound[] = [];
  if (Number.isFinite(limits.min) && limits.min !== 0) out.push({ value: limits.min, what: 'least' });
  if (Number.isFinite(limits.max)) out.push({ value: limits.max, what: 'limit' });
  return out;
}
