// The server's side of the page without a swarm: the bundle, a made-up flight, answers to orders and hurts.
//
//     node test/mock_server.mjs DIRECTORY [--n 4] [--port 8480] [--token mock] [--recording] [--waiting] [--point]
//
// DIRECTORY is where build.mjs wrote. It speaks what idl/page.proto says, in the words of Protobuf's JSON.

import { createServer } from 'node:http';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { MockSwarm } from './mock_swarm.mjs';

const words = process.argv.slice(2);
const option = (name, usual) => (words.includes(`--${name}`) ? words[words.indexOf(`--${name}`) + 1] : usual);
const folder = words[0];
if (folder === undefined || folder.startsWith('--')) {
  console.error('mock_server.mjs: say where the page is: node test/mock_server.mjs DIRECTORY');
  process.exit(2);
}
const token = option('token', 'mock');
const recording = words.includes('--recording');
const swarm = new MockSwarm(Number(option('n', '4')));
const begun_ms = performance.now();
const server_time_s = () => (performance.now() - begun_ms) / 1000;
const mission = swarm.mission();
if (words.includes('--point')) Object.assign(mission, { hull_b_m: [], hull_faces: [] });
if (words.includes('--waiting')) swarm.wanted = 0;
else swarm.pace = 1;

const hello = {
  server: `mock ${process.pid} ${Date.now()}`,
  domain: 0,
  takes_orders: !recording,
  owns_processes: !recording,
  mission_file: 'mock.textproto',
};
const agents = mission.carriers.map((carrier) => `agent ${carrier.id}`);
const states = new Map(['coordinator', 'simulator', ...agents].map((name) => [name, { state: name.startsWith('agent') ? 'flying' : 'healthy', pid: 0, loss: 0 }]));
[...states.values()].forEach((state, i) => (state.pid = 4200 + i));
if (words.includes('--waiting')) for (const name of agents) states.get(name).state = 'ready';
let hurt = { number: '0', text: '', at_s: 0, before_m: 0, moved_max_m: 0, calm_s: -1 };
let most_m = 0;
const happenings = [];
const listeners = new Set();

function send(event, message) {
  const words = `event: ${event}\ndata: ${JSON.stringify(message)}\n\n`;
  for (const reply of listeners) if (reply.writableLength < 1 << 20) reply.write(words);
}

function happen(level, who, text) {
  const line = { number: String(happenings.length + 1), swarm_time_s: swarm.time_s + 12, level, who, text };
  happenings.push(line);
  send('happening', line);
}

function worded(name, entry) {
  const carrier = name.startsWith('agent ') ? Number(name.slice(6)) : 0;
  const well = !['ended', 'stopped'].includes(entry.state);
  const complaint = well ? '' : `${name} ${entry.state === 'ended' ? 'has ended' : 'does not answer'}`;
  const count = Math.floor(swarm.time_s * 50);
  const missed = Math.floor((count * entry.loss) / 100);
  return {
    name, state: entry.state, well, complaint, address: `127.0.0.1:${7400 + carrier}`,
    heard_age_s: well ? 0.05 : 2.5, carrier, plan: carrier > 0 ? "the mission's" : '',
    clock_uncertainty_s: carrier > 0 ? 2.2e-5 * (1 + 0.3 * Math.sin(swarm.time_s * 0.7 + carrier)) : -1,
    clock_drift_ppm: carrier > 0 ? 3.1 + carrier * 0.4 : 0,
    beacons_received: String(carrier > 0 ? count - missed : 0), beacons_missed: String(carrier > 0 ? missed : 0),
    dropped: { late: String(missed), duplicate: '0', wrong_term: '0', nonsense: '0' },
    late_s: 0.0004, pid: entry.pid,
  };
}

function status() {
  const processes = [...states].map(([name, entry]) => worded(name, entry));
  const unwell = processes.find((process) => !process.well);
  const moved = Math.hypot(...swarm.displacement());
  most_m = Math.max(most_m, moved);
  hurt.moved_max_m = Math.max(hurt.moved_max_m, moved);
  if (hurt.calm_s < 0 && unwell === undefined && moved < 1e-4 && server_time_s() - hurt.at_s > 1) hurt.calm_s = server_time_s() - hurt.at_s;
  const waits = words.includes('--waiting') && swarm.wanted === 0;
  return {
    connected: true, calm: unwell === undefined, complaint: unwell?.complaint ?? '',
    course: swarm.pace === swarm.wanted ? (swarm.pace > 0 ? 'motion' : 'rest') : `${swarm.pace < swarm.wanted ? 'rest -> motion' : 'motion -> rest'} (${Math.round(swarm.pace * 100)} %)`,
    wish: '', news: '', term: '1', lease_left_s: 4.9, skew_s: 4e-5, skew_budget_s: 0.002, processes,
    missing: waits ? [{ who: 'agent 3', what: 'its clock is not yet sure' }, { who: 'vehicle 2', what: 'was not heard' }] : [],
    displacement_max_m: most_m, rotation_max_deg: 0.0001,
    hurt: { number: hurt.number, text: hurt.text, since_s: server_time_s() - hurt.at_s, before_m: hurt.before_m, moved_max_m: hurt.moved_max_m, calm_after_s: hurt.calm_s },
  };
}

function do_order(order) {
  const name = { ENGAGE: 'to full pace', RELEASE: 'to rest', FREEZE: 'to rest, in a hurry', PACE: `to a pace of ${order.pace}`, RETUNE: 'to another plan' }[order.kind];
  if (name === undefined) return { done: false, text: 'no such order' };
  if (order.kind === 'PACE' && !(order.pace >= 0 && order.pace <= 1)) return { done: false, text: 'a pace is between 0 and 1' };
  swarm.wanted = { ENGAGE: 1, RELEASE: 0, FREEZE: 0, PACE: order.pace }[order.kind] ?? swarm.wanted;
  if (order.kind === 'ENGAGE') for (const agent of agents) if (states.get(agent).state === 'ready') states.get(agent).state = 'flying';
  happen('INFO', 'coordinator', `goes ${name}`);
  return { done: true, text: `goes ${name}` };
}

function check({ mission: text = '' }) {
  if (!text.includes('name:')) return { readable: false, admissible: false, name: '', text: 'mission.textproto:1:1: there is no name' };
  const name = /name: "([^"]*)"/.exec(text)?.[1] ?? 'unnamed';
  const refused = text.includes('refuse');
  const table = 'figure          certified          limit\nleast tension   25.1 N             25 N\nspeed           1.05 .. 1.10 m/s   0.2 .. 3 m/s\n';
  return { readable: true, admissible: !refused, name, text: refused ? `${table}\nREFUSED: tension falls to 19 N, below the 25 N that are allowed` : table };
}

function do_hurt(request) {
  const before_m = Math.hypot(...swarm.displacement());
  const entry = states.get(request.process);
  if (request.kind !== 'PUSH' && entry === undefined) return { done: false, text: `there is no process "${request.process}"` };
  const name = request.process;
  const said = {
    KILL: () => ((entry.state = 'ended'), (entry.pid = 0), `${name} was killed`),
    STOP: () => ((entry.state = 'stopped'), `${name} hangs`),
    CONTINUE: () => ((entry.state = 'flying'), `${name} goes on`),
    RESTART: () => ((entry.state = 'flying'), (entry.pid = 5000 + happenings.length), `${name} was started again`),
    LOSE: () => ((entry.loss = request.amount), `${name} loses ${request.amount} % of its packets`),
    SHIFT_CLOCK: () => `the clock of ${name} was shifted by ${request.amount} s`,
    PUSH: () => ((swarm.push = { force: request.force_w_n, left_s: request.duration_s }), `the load was pushed with ${Math.hypot(...request.force_w_n).toFixed(1)} N`),
  }[request.kind]?.();
  if (said === undefined) return { done: false, text: 'no such hurt' };
  hurt = { number: String(Number(hurt.number) + 1), text: said, at_s: server_time_s(), before_m, moved_max_m: before_m, calm_s: -1 };
  happen('WARNING', 'you', said);
  return { done: true, text: said };
}

const page = readFileSync(join(folder, 'index.html.gz'));
const policy = readFileSync(join(folder, 'csp.txt'), 'utf8').trim();

function stream(reply) {
  reply.writeHead(200, { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store' });
  reply.write('retry: 1000\n\n');
  listeners.add(reply);
  reply.on('close', () => listeners.delete(reply));
  const one = (event, message) => reply.write(`event: ${event}\ndata: ${JSON.stringify(message)}\n\n`);
  one('hello', hello);
  one('mission', mission);
  for (const line of happenings.slice(-50)) one('happening', line);
}

function answer(reply, code, message) {
  reply.writeHead(code, { 'Content-Type': 'application/json' });
  reply.end(JSON.stringify(message));
}

function asked(request, reply) {
  const act = { '/api/order': do_order, '/api/check': check, '/api/hurt': do_hurt }[request.url];
  if (act === undefined) return answer(reply, 404, { done: false, text: 'there is no such page' });
  if (request.headers['x-gyre-token'] !== token) return answer(reply, 403, { done: false, text: 'wrong token' });
  let body = '';
  request.on('data', (piece) => (body += piece));
  request.on('end', () => {
    try {
      answer(reply, 200, act(JSON.parse(body)));
    } catch (error) {
      answer(reply, 400, { done: false, text: String(error) });
    }
  });
}

createServer((request, reply) => {
  if (request.method === 'POST') return asked(request, reply);
  if (request.url === '/api/events') return stream(reply);
  if (request.url === '/api/time') return answer(reply, 200, { server_time_s: server_time_s() });
  if (request.url.split('?')[0] !== '/') return answer(reply, 404, { done: false, text: 'there is no such page' });
  reply.writeHead(200, { 'Content-Type': 'text/html; charset=utf-8', 'Content-Encoding': 'gzip', 'Content-Security-Policy': policy });
  reply.end(page);
}).listen(Number(option('port', '8480')), '127.0.0.1', function () {
  console.log(`http://127.0.0.1:${this.address().port}/#token=${token}`);
});

happen('INFO', 'coordinator', 'all agents are ready');
happen('INFO', 'coordinator', 'the flight begins');
happen('WARNING', '<i>nobody</i>', '<img src=x onerror="document.title=1"> is text');
const tick_s = 0.04;
setInterval(() => {
  for (let i = 0; i < 4; ++i) swarm.step(tick_s / 4);
  send('frame', swarm.frame(server_time_s()));
}, tick_s * 1000);
setInterval(() => send('status', status()), 250);
setInterval(() => listeners.forEach((reply) => reply.write(': still here\n\n')), 5000);
