// The parts of the page that need no browser: what they must hold, whatever comes over the wire.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { History, Rows } from '../src/history';
import * as messages from '../src/messages';
import type { Frame } from '../src/messages';
import { kDelay_s, phase_between, Playback } from '../src/playback';
import { reach } from '../src/plot_reach';
import { extent, nice, placed, tension_range } from '../src/scene/geometry';
import { draws_by_processor, Pacer } from '../src/scene/quality';
import { pose_at } from '../src/scene/pose';
import { Swarm } from '../src/swarm';
import { tension_tone, written_on } from '../src/tones';
import { clock, headline, metres, millimetres, seconds, spread } from '../src/words';

const frame = (wire: object): Frame => messages.Frame.read(wire);
const at = (time_s: number, more: object = {}): Frame => frame({ server_time_s: time_s, ...more });

test('a message reads whatever the wire says', () => {
  for (const wire of [null, 3, 'x', [], {}, { carriers: 3 }, { carriers: [null, 'x', { id: '7' }] }, { pace: 'NaN' }])
    assert.doesNotThrow(() => messages.Frame.read(wire));
  assert.equal(messages.Range.read({ min: '-Infinity', max: 'Infinity' }).max, Infinity);
  assert.equal(messages.Happening.read({ number: '12', level: 'ERROR' }).number, 12);
  assert.equal(messages.Happening.read({ level: 'constructor' }).level, 'INFO');
  assert.equal(messages.Order.read({}).phase_deg, undefined);
});

test('the picture is drawn between two frames, and stands after the last', () => {
  const playback = new Playback();
  playback.add(at(10), 100);
  playback.add(at(10.04), 100.04);
  playback.add(at(10.08), 100.08);
  const moment = playback.at(100.02 + kDelay_s)!;
  assert.equal(moment.before.server_time_s, 10);
  assert.ok(Math.abs(moment.share - 0.5) < 1e-6);
  assert.equal(playback.at(200)!.after.server_time_s, 10.08);
  assert.equal(playback.at(200)!.share, 0);
});

test('a frame that was late on its way does not hold the picture back', () => {
  const playback = new Playback();
  playback.add(at(10), 100);
  playback.add(at(10.04), 100.09);
  playback.add(at(10.08), 100.1);
  assert.ok(Math.abs(playback.behind_s(100.1) - kDelay_s) < 0.02);
});

test('the frames of another server begin anew', () => {
  const playback = new Playback();
  playback.add(at(500), 100);
  playback.add(at(0.5), 101);
  assert.equal(playback.newest!.server_time_s, 0.5);
  assert.equal(playback.at(101 + kDelay_s)!.before.server_time_s, 0.5);
});

test('phases go around', () => {
  const turn = 2 * Math.PI;
  assert.ok(Math.abs(phase_between(turn - 0.1, 0.1, 0.5) % turn) < 1e-9 || Math.abs((phase_between(turn - 0.1, 0.1, 0.5) % turn) - turn) < 1e-9);
  assert.ok(Math.abs(phase_between(1, 2, 0.25) - 1.25) < 1e-12);
});

test('rows keep so many and no more, in their order', () => {
  const rows = new Rows(1, 3);
  for (const value of [1, 2, 3, 4, 5]) rows.add([value]);
  assert.deepEqual(rows.column(0), [3, 4, 5]);
  rows.raise([4]);
  assert.deepEqual(rows.column(0), [3, 4, 5]);
  rows.raise([9]);
  assert.deepEqual(rows.column(0), [3, 4, 9]);
  rows.add([NaN]);
  assert.deepEqual(rows.column(0), [4, 9, null]);
});

test('a minute of frames is as long as two, and a peak between two points stays', () => {
  const history = new History();
  history.begin([1]);
  for (let i = 0; i < 60 * 25 * 3; ++i) {
    const peak = i === 60 * 25 * 3 - 4 ? 0.005 : 0.001;
    history.add(at(i / 25, { displacement_w_m: [peak, 0, 0], carriers: [{ id: 1, heard: true, tension_n: 2, position_w_m: [0, 0, 3] }] }));
  }
  assert.ok(history.times.length <= 900);
  assert.ok(history.times.get(history.times.length - 1, 0) - history.times.get(0, 0) >= 60);
  assert.ok(history.load.column(0).some((value) => value === 5));
  assert.equal(history.figures.altitude_m.column(0)[5], 3);
});

test('a point of the body turns with it', () => {
  const half = Math.SQRT1_2;  // a quarter turn about z: x becomes y
  const [x, y, z] = placed([1, 2, 3], [half, 0, 0, half], [1, 0, 0.5]);
  assert.ok(Math.hypot(x - 1, y - 3, z - 3.5) < 1e-12);
});

test('the ground is below the lowest thing, and everything is in the ball', () => {
  const mission = messages.Mission.read({
    position_w_m: [0, 0, 8],
    orientation_w_b: [1, 0, 0, 0],
    hull_b_m: [1, 0, -2, -1, 0, 0],
    carriers: [{ id: 1, attachment_b_m: [0, 0, 0], orbit_w_m: [5, 0, 12, 0, 5, 12] }],
  });
  const reaches = extent(mission, undefined)!;
  assert.ok(reaches.floor < 6);
  assert.equal(reaches.lowest, 6);
  for (const point of [[5, 0, 12], [1, 0, 6]] as const)
    assert.ok(Math.hypot(...point.map((value, axis) => value - reaches.center[axis]!)) <= reaches.radius + 1e-9);
  assert.equal(extent(undefined, undefined), undefined);
});

test('limits that are not there do not spoil the colours', () => {
  const range = tension_range(messages.Mission.read({ limits: { tension_n: { min: '-Infinity', max: 'Infinity' } } }));
  assert.ok(Number.isFinite(range.min) && range.max > range.min);
  assert.ok(tension_tone(NaN, 'dark').every(Number.isFinite));
});

test('lightness goes one way from slack to taut', () => {
  for (const paper of ['light', 'dark'] as const) {
    const lights = [0, 0.25, 0.5, 0.75, 1].map((share) => {
      const [r, g, b] = tension_tone(share, paper);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    });
    const steps = lights.slice(1).map((light, i) => Math.sign(light - lights[i]!));
    assert.deepEqual(steps, Array(4).fill(paper === 'light' ? -1 : 1));
  }
});

test('what is written on a tone is read on it', () => {
  assert.equal(written_on('#1547a2'), '#ffffff');
  assert.equal(written_on('#c4e5fc'), '#0d1117');
});

test('a carrier that is not heard has no place, one half heard has the place it told', () => {
  const before = at(1, { carriers: [{ id: 1 }, { id: 2, position_w_m: [0, 0, 1] }] });
  const after = at(2, { carriers: [{ id: 1, heard: true, position_w_m: [4, 0, 0] }, { id: 2, position_w_m: [0, 0, 3] }] });
  const pose = pose_at({ before, after, share: 0.5 }, undefined, [1, 2, 3]);
  assert.deepEqual(pose.carriers.map((carrier) => carrier.seen), [true, true, false]);
  assert.deepEqual(pose.carriers[0]!.position, [4, 0, 0]);
  assert.deepEqual(pose.carriers[1]!.position, [0, 0, 2]);
});

test('figures have as many digits as somebody can use', () => {
  assert.equal(millimetres(3e-6), '0.003 mm');
  assert.equal(millimetres(1e-7), '< 0.001 mm');
  assert.equal(millimetres(0.0123), '12.3 mm');
  assert.equal(millimetres(NaN), 'unknown');
  assert.equal(metres(2), '2.00 m');
  assert.equal(seconds(2.2e-5), '22 µs');
  assert.equal(clock(83.27), '1:23.2');
  assert.equal(clock(3600 + 62), '1:01:02.0');
  assert.equal(clock(-1), '–:––.–');
  assert.equal(spread([0.854, 0.761], 'm/s'), '0.76 to 0.85 m/s');
});

test('the headline says what counts most', () => {
  const flying = frame({ pace: 1, carriers: [{ id: 1, heard: true, speed_m_s: 1 }] });
  const calm = messages.Status.read({ connected: true, calm: true });
  const base = { online: true, ever: true, frames_age_s: 0, recording: false, frame: flying, status: calm, within_m: 3e-6, good_m: 0.001 };
  assert.equal(headline(base).line, 'In motion: the load hangs within 0.003 mm');
  assert.match(headline({ ...base, frame: frame({ pace: 0 }) }).line, /^At rest: the load hangs/);
  assert.match(headline({ ...base, within_m: 0.05 }).line, /the load swings within 50.0 mm/);
  assert.match(headline({ ...base, online: false }).line, /server is gone/);
  assert.match(headline({ ...base, online: false, ever: false }).line, /Looking for the server/);
  assert.match(headline({ ...base, frames_age_s: 4 }).line, /Nothing is heard of the swarm for 4 s/);
  const complains = messages.Status.read({ connected: true, complaint: 'agent 3 has ended' });
  assert.deepEqual([headline({ ...base, status: complains }).line, headline({ ...base, status: complains }).mood], ['Agent 3 has ended', 'complaint']);
  assert.match(headline({ ...base, status: messages.Status.read({}) }).line, /No coordinator/);
  const missing = messages.Status.read({ connected: true, missing: [{ who: 'agent 3', what: 'was not heard' }] });
  assert.match(headline({ ...base, status: missing, frame: frame({ pace: 0 }) }).line, /one thing is missing/);
});

test('an axis holds what is drawn, and a limit that is near', () => {
  const picture = { times: [0], curves: [{ name: '', tone: '', dash: [], width: 1, values: [1, null, 2] }], envelope: undefined, bands: [], bounds: [{ value: 2.5, what: 'limit' }, { value: 90, what: 'far' }] };
  const { min, max } = reach(picture, false);
  assert.ok(min < 1 && max > 2.5 && max < 5);
  const powers = reach({ ...picture, bounds: [] }, true);
  assert.deepEqual([powers.min, powers.max], [0.1, 10]);
  assert.ok(reach({ ...picture, curves: [], bounds: [] }, false).max > 0);
});

test('another server: nothing of the first one is left; the same one: nothing comes twice', () => {
  const swarm = new Swarm();
  const hello = (server: string) => messages.Hello.read({ server });
  const line = (number: number) => messages.Happening.read({ number: String(number), text: 'x' });
  swarm.take_hello(hello('a'));
  swarm.take_frame(at(1, { carriers: [{ id: 1 }], displacement_w_m: [0, 0, 1] }), 0);
  for (const number of [1, 2, 1, 2, 3]) swarm.take_happening(line(number), '');
  swarm.take_hello(hello('a'));
  assert.equal(swarm.lines.length, 3);
  assert.equal(swarm.within_m, 1);
  swarm.take_hello(hello('b'));
  assert.deepEqual([swarm.lines.length, swarm.frame, swarm.ids.length, swarm.within_m], [0, undefined, 0, undefined]);
  swarm.take_happening(line(1), '');
  assert.equal(swarm.lines.length, 1);
});

test('the log forgets', () => {
  const swarm = new Swarm();
  for (let i = 1; i <= 1000; ++i) swarm.take_happening(messages.Happening.read({ number: i, text: String(i) }), '');
  assert.equal(swarm.lines.length, 300);
  assert.equal(swarm.lines[0]!.text, '1000');
});

test('selecting: one, several, none, the next', () => {
  const swarm = new Swarm();
  swarm.take_frame(at(1, { carriers: [{ id: 3 }, { id: 5 }, { id: 9 }] }), 0);
  swarm.select(5);
  swarm.select(9, true);
  assert.deepEqual(swarm.selected, [5, 9]);
  swarm.select_next(1);
  assert.deepEqual(swarm.selected, [9]);
  swarm.select_next(1);
  assert.deepEqual(swarm.selected, [3]);
  swarm.select(3);
  assert.deepEqual(swarm.selected, []);
  assert.ok(swarm.shows(9));
});

test('beauty goes before speed does, and a processor that draws is asked thirty times a second', () => {
  const slow = new Pacer(false, false);
  const first = slow.quality.pixels;
  for (let i = 1; i < 200; ++i) slow.drew(0.1, i * 0.1);
  assert.ok(slow.quality.pixels < first && !slow.quality.shadows);
  const held = new Pacer(true, true);
  for (let i = 1; i < 200; ++i) assert.equal(held.drew(0.1, i * 0.1), false);
  const soft = new Pacer(true, false);
  let drawn = 0;
  for (let i = 0; i < 600; ++i) if (soft.is_due(i / 60)) ++drawn;
  assert.ok(drawn >= 290 && drawn <= 310, String(drawn));
  assert.ok(draws_by_processor('ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)))') && !draws_by_processor('Mesa Intel(R) UHD Graphics 620'));
});

test('scales have round steps', () => {
  assert.deepEqual([0.7, 1, 1.1, 3, 6, 12].map(nice), [1, 1, 2, 5, 10, 20]);
});
