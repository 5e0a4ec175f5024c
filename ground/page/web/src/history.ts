// What was flown in the last minute, for plots: columns of fixed length that the newest overwrite.

import type { Frame, Mission, Status } from './messages';

export const kWindow_s = 60;
const kStep_s = 0.07;  // at 25 frames a second every other one: more points than a plot has pixels
const kMost = Math.ceil(kWindow_s / kStep_s) + 20;
const kCarriersMost = 128;

/** Rows of numbers in the order they came; the oldest go. `width` numbers a row. */
export class Rows {
  private readonly cells: Float64Array;
  private first = 0;
  length = 0;

  constructor(readonly width: number, readonly most: number) {
    this.cells = new Float64Array(width * most).fill(NaN);
  }

  add(row: ArrayLike<number>): void {
    const at = (this.first + this.length) % this.most;
    for (let i = 0; i < this.width; ++i) this.cells[at * this.width + i] = row[i] ?? NaN;
    if (this.length < this.most) ++this.length;
    else this.first = (this.first + 1) % this.most;
  }

  get(row: number, column: number): number {
    return this.cells[((this.first + row) % this.most) * this.width + column]!;
  }

  /** The last row again, with the larger of each: a peak between two points is not lost. */
  raise(row: ArrayLike<number>): void {
    const at = (this.first + this.length - 1) % this.most;
    for (let i = 0; i < this.width; ++i) {
      const cell = at * this.width + i;
      const value = row[i] ?? NaN;
      if (!(this.cells[cell]! >= value) && Number.isFinite(value)) this.cells[cell] = value;
    }
  }

  column(index: number): (number | null)[] {
    const out = new Array<number | null>(this.length);
    for (let i = 0; i < this.length; ++i) {
      const value = this.get(i, index);
      out[i] = Number.isFinite(value) ? value : null;
    }
    return out;
  }
}

export const kFigures = ['tension_n', 'length_m', 'speed_m_s', 'winch_rate_m_s', 'altitude_m'] as const;
export type Figure = (typeof kFigures)[number];

export class History {
  ids: number[] = [];  // of the carriers, in the order of their columns
  figures: Record<Figure, Rows> = this.empty(0);
  times: Rows = new Rows(1, kMost);
  load: Rows = new Rows(1, kMost);  // displacement, millimetres, peaks kept
  clock_times: Rows = new Rows(1, kWindow_s * 5);
  clocks: Rows = new Rows(0, 1);    // uncertainty, microseconds
  private next_s = -Infinity;

  private empty(width: number): Record<Figure, Rows> {
    const made = {} as Record<Figure, Rows>;
    for (const figure of kFigures) made[figure] = new Rows(width, kMost);
    return made;
  }

  begin(ids: number[]): void {
    this.ids = ids.slice(0, kCarriersMost);
    this.figures = this.empty(this.ids.length);
    this.times = new Rows(1, kMost);
    this.load = new Rows(1, kMost);
    this.clock_times = new Rows(1, kWindow_s * 5);
    this.clocks = new Rows(this.ids.length, kWindow_s * 5);
    this.next_s = -Infinity;
  }

  add(frame: Frame): void {
    const moved_mm = frame.displacement_w_m.length === 3 ? Math.hypot(...frame.displacement_w_m) * 1000 : NaN;
    if (frame.server_time_s < this.next_s) {
      this.load.raise([moved_mm]);
      return;
    }
    this.next_s = frame.server_time_s + kStep_s;
    this.times.add([frame.server_time_s]);
    this.load.add([moved_mm]);
    const by_id = new Map(frame.carriers.map((carrier) => [carrier.id, carrier]));
    for (const figure of kFigures) {
      this.figures[figure].add(
        this.ids.map((id) => {
          const carrier = by_id.get(id);
          if (carrier === undefined || !carrier.heard) return NaN;
          return figure === 'altitude_m' ? (carrier.position_w_m[2] ?? NaN) : carrier[figure];
        }),
      );
    }
  }

  add_clocks(status: Status, server_time_s: number): void {
    const by_carrier = new Map(status.processes.map((process) => [process.carrier, process]));
    this.clock_times.add([server_time_s]);
    this.clocks.add(
      this.ids.map((id) => {
        const uncertainty_s = by_carrier.get(id)?.clock_uncertainty_s ?? -1;
        return uncertainty_s >= 0 ? uncertainty_s * 1e6 : NaN;
      }),
    );
  }
}

/** The carriers' ids in their order: the mission's, or as they are heard while none is known. */
export function carrier_ids(mission: Mission | undefined, frame: Frame | undefined): number[] {
  if (mission !== undefined && mission.carriers.length > 0) return mission.carriers.map((carrier) => carrier.id);
  return frame === undefined ? [] : frame.carriers.map((carrier) => carrier.id);
}

