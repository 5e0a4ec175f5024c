// What counts, in words: the state of the load in one sentence, the phase as a ring that turns, the swarm's time.

import { now_s } from './connection';
import { found, mark, say } from './dom';
import type { Swarm } from './swarm';
import type { TimeSync } from './time_sync';
import { clock, degrees, good_displacement, headline, percent, seconds } from './words';
import { kDelay_s, phase_between } from './playback';

const kRing = 2 * Math.PI * 26;  // the length of the ring in index.html

export class Header {
  private said_s = 0;
  private announced = '';

  constructor(private readonly swarm: Swarm, private readonly time: TimeSync) {
    const turn = (): void => {
      requestAnimationFrame(turn);
      this.move();
    };
    requestAnimationFrame(turn);
    setInterval(() => this.say_state(), 250);
    for (const change of ['hello', 'mission', 'status', 'online', 'reset'] as const) swarm.on(change, () => this.say_state());
    this.say_state();
  }

  private move(): void {
    const now = now_s();
    if (now - this.said_s < 1 / 15) return;  // tenths of a second are read, not sixtieths
    this.said_s = now;
    const moment = this.swarm.playback.at(now);
    if (moment === undefined) {
      say(found('swarm-time'), clock(-1));
      return;
    }
    const { before, after, share } = moment;
    const phase = phase_between(before.phase_rad, after.phase_rad, share);
    found('phase-hand').setAttribute('transform', `rotate(${((phase * 180) / Math.PI).toFixed(1)} 32 32)`);
    found('pace-ring').setAttribute('stroke-dasharray', `${(kRing * Math.min(1, after.pace)).toFixed(1)} ${kRing.toFixed(1)}`);
    say(found('phase'), degrees(phase));
    say(found('pace'), percent(after.pace));
    // The clock shows now, not the picture's moment: it is carried on as far as frames are heard.
    const late = Math.min(kDelay_s, Math.max(0, this.swarm.playback.age_s(now)));
    const swarm_s = after.swarm_time_s < 0 ? -1 : after.swarm_time_s + (this.swarm.online ? late : 0);
    say(found('swarm-time'), clock(swarm_s));
  }

  private say_state(): void {
    const { swarm } = this;
    const now = now_s();
    const state = headline({
      online: swarm.online,
      ever: swarm.ever,
      frames_age_s: swarm.playback.newest === undefined ? 0 : swarm.playback.age_s(now),
      recording: swarm.hello !== undefined && !swarm.hello.takes_orders,
      frame: swarm.frame,
      status: swarm.status,
      within_m: swarm.within_m,
      good_m: good_displacement(swarm.mission),
    });
    mark(document.body, 'data-mood', state.mood);
    say(found('headline'), state.line);
    this.announce(state.line);
    say(found('subline'), state.sub);
    say(found('mission-name'), swarm.mission?.name || 'no mission heard yet');
    document.title = swarm.online ? `${state.line} · Gyre` : 'Gyre: looking for the server';
    this.say_connection(now);
    this.say_beside();
  }

  /** To those who listen: a new state, and not every new figure of the same one. */
  private announce(line: string): void {
    const state = line.replace(/[\d.]+/g, '');
    if (state === this.announced) return;
    this.announced = state;
    say(found('announced'), line);
  }

  private say_connection(now: number): void {
    const { hello, online, ever, mission } = this.swarm;
    const words = online ? (hello?.takes_orders === false ? 'recording' : 'live') : ever ? 'gone' : 'looking';
    say(found('connection'), words);
    mark(found('connection'), 'data-state', words);
    const skew = this.time.skew;
    const parts: string[] = [];
    if (skew !== undefined) parts.push(`page ± ${seconds(skew.uncertainty_s)}`);
    if (online && this.swarm.frame !== undefined) parts.push(`${this.swarm.playback.behind_s(now).toFixed(1)} s behind`);
    say(found('skew'), parts.join(' · '));
    found('skew').title = "How surely this page knows the server's time, and how far its picture is behind it";
    const domain = hello === undefined ? '' : `domain ${hello.domain}`;
    say(found('mission-more'), [mission?.plan ? `plan ${mission.plan}` : '', domain, mission?.complete === false ? 'its shape and limits were not heard' : ''].filter(Boolean).join(' · '));
  }

  private say_beside(): void {
    const lease_s = this.swarm.status?.lease_left_s ?? 0;
    const words = !this.swarm.status?.connected ? '' : lease_s === Infinity ? 'flies on without a word' : `lease ${seconds(Math.max(0, lease_s))}`;
    say(found('lease'), words);
  }
}
