// What the page knows of the swarm, and which carriers a person looks at. Everything that shows something reads it.
//
// Nothing grows: frames, points of plots and lines of the log are kept for so long, and then the oldest go.

import { carrier_ids, History } from './history';
import type { Frame, Happening, Hello, Mission, Status } from './messages';
import { Playback } from './playback';

const kLinesMost = 300;
const kPeakWindow_s = 10;

export interface Line {
  key: string;      // tells a repetition
  time: string;
  level: Happening['level'];
  who: string;
  text: string;
}

type Change = 'hello' | 'mission' | 'frame' | 'status' | 'line' | 'selection' | 'online' | 'reset';

export class Swarm {
  hello: Hello | undefined;
  mission: Mission | undefined;
  frame: Frame | undefined;  // the newest; the picture runs behind it: `playback`
  status: Status | undefined;
  readonly playback = new Playback();
  readonly history = new History();
  lines: Line[] = [];        // the newest first
  online = false;
  ever = false;

  selected: number[] = [];   // ids; empty: all of them
  process = '';              // the name of the selected one; empty: none

  private readonly heard = new Map<Change, (() => void)[]>();
  private peaks: { time_s: number; moved_m: number }[] = [];
  private seen = 0;          // the greatest number of a happening

  on(change: Change, act: () => void): void {
    const acts = this.heard.get(change) ?? [];
    acts.push(act);
    this.heard.set(change, acts);
  }

  private tell(change: Change): void {
    for (const act of this.heard.get(change) ?? []) act();
  }

  get ids(): number[] {
    return this.history.ids;
  }

  /** The load's greatest displacement lately. */
  get within_m(): number | undefined {
    return this.peaks.length === 0 ? undefined : Math.max(...this.peaks.map((peak) => peak.moved_m));
  }

  set_online(online: boolean): void {
    if (this.online === online) return;
    this.online = online;
    this.ever ||= online;
    this.tell('online');
  }

  take_hello(hello: Hello): void {
    if (this.hello !== undefined && this.hello.server !== hello.server) this.reset();
    this.hello = hello;
    this.tell('hello');
  }

  private reset(): void {
    this.mission = undefined;
    this.frame = undefined;
    this.status = undefined;
    this.playback.clear();
    this.history.begin([]);
    this.lines = [];
    this.peaks = [];
    this.seen = 0;
    this.selected = [];
    this.process = '';
    this.tell('reset');
    this.tell('line');
    this.tell('selection');
  }

  take_mission(mission: Mission): void {
    this.mission = mission;
    this.settle_ids();
    this.tell('mission');
  }

  take_frame(frame: Frame, now_s: number): void {
    if (this.frame !== undefined && frame.server_time_s < this.frame.server_time_s - 1) {
      this.history.begin(this.history.ids);  // a recording that began again
      this.peaks = [];
    }
    this.frame = frame;
    this.playback.add(frame, now_s);
    this.settle_ids();
    this.history.add(frame);
    if (frame.displacement_w_m.length === 3) {
      this.peaks.push({ time_s: frame.server_time_s, moved_m: Math.hypot(...frame.displacement_w_m) });
      while (this.peaks[0]!.time_s < frame.server_time_s - kPeakWindow_s) this.peaks.shift();
    }
    this.tell('frame');
  }

  private settle_ids(): void {
    const ids = carrier_ids(this.mission, this.frame);
    if (ids.length === this.ids.length && ids.every((id, i) => id === this.ids[i])) return;
    this.history.begin(ids);
    this.selected = this.selected.filter((id) => ids.includes(id));
    this.tell('mission');
    this.tell('selection');
  }

  take_status(status: Status): void {
    this.status = status;
    if (this.frame !== undefined) this.history.add_clocks(status, this.frame.server_time_s);
    this.tell('status');
  }

  take_happening(happening: Happening, time: string): void {
    if (happening.number <= this.seen) return;  // the last ones come again on every connection
    this.seen = happening.number;
    this.add_line({ key: `h${happening.number}`, time, level: happening.level, who: happening.who, text: happening.text });
  }

  add_line(line: Line): void {
    this.lines.unshift(line);
    this.lines.length = Math.min(this.lines.length, kLinesMost);
    this.tell('line');
  }

  // ------------------------------------------------------------------------------------------------ the selection

  shows(id: number): boolean {
    return this.selected.length === 0 || this.selected.includes(id);
  }

  /** One carrier alone, or none again; `more`: besides those that are selected. */
  select(id: number, more = false): void {
    const was = this.selected.includes(id);
    if (more) this.selected = was ? this.selected.filter((other) => other !== id) : [...this.selected, id];
    else this.selected = was && this.selected.length === 1 ? [] : [id];
    const process = this.status?.processes.find((candidate) => candidate.carrier === id && id !== 0);
    if (process !== undefined && this.selected.includes(id)) this.process = process.name;
    this.tell('selection');
  }

  select_process(name: string): void {
    this.process = name;
    const carrier = this.status?.processes.find((candidate) => candidate.name === name)?.carrier ?? 0;
    this.selected = carrier !== 0 ? [carrier] : [];
    this.tell('selection');
  }

  select_none(): void {
    this.selected = [];
    this.process = '';
    this.tell('selection');
  }

  select_next(step: 1 | -1): void {
    if (this.ids.length === 0) return;
    const at = this.ids.indexOf(this.selected[0] ?? -1);
    const next = at < 0 ? (step > 0 ? 0 : this.ids.length - 1) : (at + step + this.ids.length) % this.ids.length;
    this.selected = [];
    this.select(this.ids[next]!);
  }
}
