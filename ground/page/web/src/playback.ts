// Frames come twenty-five times a second, late by what the network likes; a screen wants sixty, evenly.
//
// So the picture runs a little behind: it is drawn for a moment a tenth of a second ago, between two frames that are
// both there. The clock of the picture is the server's, carried on by the browser's; the frame that took the shortest
// way tells how the two stand to each other. After the newest frame nothing is invented: the picture stands.

import type { Frame } from './messages';

export const kDelay_s = 0.1;
const kMost = 50;        // frames kept: two seconds
const kForget = 2e-4;    // per frame: clocks drift, and a server that paused is not taken for a faster way

export interface Moment {
  before: Frame;
  after: Frame;
  share: number;  // 0: as before, 1: as after
}

export class Playback {
  private frames: Frame[] = [];
  private offset_s: number | undefined;  // server's time minus the browser's, by the quickest frame
  private heard_s = -Infinity;

  clear(): void {
    this.frames = [];
    this.offset_s = undefined;
    this.heard_s = -Infinity;
  }

  add(frame: Frame, now_s: number): void {
    const last = this.frames[this.frames.length - 1];
    if (last !== undefined && frame.server_time_s <= last.server_time_s) {
      if (last.server_time_s - frame.server_time_s < 1) return;  // a repetition
      this.clear();                                               // time ran back: another server
    }
    const offset_s = frame.server_time_s - now_s;
    if (this.offset_s === undefined || Math.abs(offset_s - this.offset_s) > 1) this.offset_s = offset_s;
    else this.offset_s = Math.max(offset_s, this.offset_s - kForget);
    this.heard_s = now_s;
    this.frames.push(frame);
    if (this.frames.length > kMost) this.frames.shift();
  }

  get newest(): Frame | undefined {
    return this.frames[this.frames.length - 1];
  }

  age_s(now_s: number): number {
    return now_s - this.heard_s;
  }

  /** How far the picture is behind the server, as far as a browser can tell. */
  behind_s(now_s: number): number {
    const newest = this.newest;
    if (newest === undefined || this.offset_s === undefined) return 0;
    return Math.max(kDelay_s, now_s + this.offset_s - newest.server_time_s);
  }

  /** The frames after one time of the server and up to another. */
  during(from_s: number, to_s: number): Frame[] {
    return this.frames.filter((frame) => frame.server_time_s > from_s && frame.server_time_s <= to_s);
  }

  at(now_s: number): Moment | undefined {
    const newest = this.newest;
    if (newest === undefined || this.offset_s === undefined) return undefined;
    const time_s = now_s + this.offset_s - kDelay_s;
    if (time_s >= newest.server_time_s) return { before: newest, after: newest, share: 0 };
    for (let i = this.frames.length - 1; i > 0; --i) {
      const before = this.frames[i - 1]!;
      const after = this.frames[i]!;
      if (time_s < before.server_time_s) continue;
      const span_s = after.server_time_s - before.server_time_s;
      return { before, after, share: Math.min(1, (time_s - before.server_time_s) / span_s) };
    }
    const first = this.frames[0]!;
    return { before: first, after: first, share: 0 };
  }
}

export function between(a: number, b: number, share: number): number {
  return a + (b - a) * share;
}

/** Phases go around: from just below 2 pi to just above 0 is a small step. */
export function phase_between(a: number, b: number, share: number): number {
  const turn = 2 * Math.PI;
  const step = ((((b - a) % turn) + turn + Math.PI) % turn) - Math.PI;
  return (((a + step * share) % turn) + turn) % turn;
}

/** Between two triples; one that is not there yields to the other. */
export function triple_between(a: number[], b: number[], share: number, into: [number, number, number]): boolean {
  const from = a.length === 3 ? a : b;
  const to = b.length === 3 ? b : a;
  if (from.length !== 3 || to.length !== 3) return false;
  for (let i = 0; i < 3; ++i) into[i] = between(from[i]!, to[i]!, share);
  return true;
}
