// The page's way to its server: the stream of events, and what a person asks for.
//
// A browser looks again for a stream that broke off, but gives up after some answers and says nothing of a stream that
// is open and silent. The server says something four times a second; so silence is taken for what it is.

import * as messages from './messages';
import type { MessageReader } from './readers';
import type { Swarm } from './swarm';
import { clock } from './words';

const kSilence_ms = 3000;
const kLookAgain_ms = 1000;
const kAnswerWithin_ms = 15000;
const kStored = 'gyre-token';

export const now_s = (): number => performance.now() / 1000;

export class Connection {
  private stream: EventSource | undefined;
  private heard_ms = 0;
  private opened_ms = 0;
  token = '';

  constructor(private readonly swarm: Swarm) {}

  begin(): void {
    this.take_token();
    this.open();
    setInterval(() => this.watch(), 500);
  }

  /** The token stands in the address that the server printed; it does not stay there, where it would be shared. */
  private take_token(): void {
    const given = new URLSearchParams(location.hash.slice(1)).get('token');
    if (given !== null && given !== '') {
      this.keep_token(given);
      history.replaceState(null, '', location.pathname + location.search);
      return;
    }
    try {
      this.token = sessionStorage.getItem(kStored) ?? '';
    } catch {
      this.token = '';  // a browser that keeps nothing: the address has to be opened again
    }
  }

  keep_token(token: string): void {
    this.token = token.trim();
    try {
      sessionStorage.setItem(kStored, this.token);
    } catch {
      // kept for this page alone
    }
  }

  private open(): void {
    this.stream?.close();
    const stream = new EventSource('/api/events');
    this.stream = stream;
    this.opened_ms = performance.now();
    const take = <T>(name: string, reader: MessageReader<T>, act: (value: T) => void): void => {
      stream.addEventListener(name, (event: MessageEvent<string>) => {
        this.heard_ms = performance.now();
        let wire: unknown;
        try {
          wire = JSON.parse(event.data);
        } catch {
          return;  // a line that was cut off; the next one is whole
        }
        act(reader.read(wire));
        this.swarm.set_online(true);
      });
    };
    take('hello', messages.Hello, (hello) => this.swarm.take_hello(hello));
    take('mission', messages.Mission, (mission) => this.swarm.take_mission(mission));
    take('frame', messages.Frame, (frame) => this.swarm.take_frame(frame, now_s()));
    take('status', messages.Status, (status) => this.swarm.take_status(status));
    take('happening', messages.Happening, (line) => this.swarm.take_happening(line, clock(line.swarm_time_s)));
    stream.addEventListener('error', () => this.swarm.set_online(false));
  }

  private watch(): void {
    const now_ms = performance.now();
    if (now_ms - this.heard_ms > kSilence_ms) this.swarm.set_online(false);
    const closed = this.stream?.readyState === EventSource.CLOSED;
    const stuck = now_ms - Math.max(this.heard_ms, this.opened_ms) > 3 * kSilence_ms;
    if ((closed && now_ms - this.opened_ms > kLookAgain_ms) || stuck) this.open();
  }

  // ---------------------------------------------------------------------------------------------- what is asked for

  order(order: Partial<messages.Order>): Promise<messages.Answer> {
    return this.ask('/api/order', order, messages.Answer, (text) => ({ done: false, text }));
  }

  hurt(request: Partial<messages.HurtRequest>): Promise<messages.Answer> {
    return this.ask('/api/hurt', request, messages.Answer, (text) => ({ done: false, text }));
  }

  check(mission: string): Promise<messages.Verdict> {
    return this.ask('/api/check', { mission }, messages.Verdict, (text) => ({ readable: false, admissible: false, name: '', text }));
  }

  private async ask<T>(path: string, body: object, reader: MessageReader<T>, failed: (text: string) => T): Promise<T> {
    const quit = new AbortController();
    const timer = setTimeout(() => quit.abort(), kAnswerWithin_ms);
    try {
      const reply = await fetch(path, {
        method: 'POST',
        headers: { 'Content-Type': 'application/json', 'X-Gyre-Token': this.token },
        body: JSON.stringify(body),
        signal: quit.signal,
        cache: 'no-store',
      });
      return await this.read_reply(reply, reader, failed);
    } catch {
      return failed(quit.signal.aborted ? 'The server did not answer within 15 s.' : 'The server cannot be reached.');
    } finally {
      clearTimeout(timer);
    }
  }

  private async read_reply<T>(reply: Response, reader: MessageReader<T>, failed: (text: string) => T): Promise<T> {
    const body = await reply.text();
    if (reply.status === 401 || reply.status === 403)
      return failed('The server does not take orders with this token. Open the address that it printed when it started.');
    let wire: unknown;
    try {
      wire = JSON.parse(body);
    } catch {
      return failed(reply.ok ? 'The server answered with something that is no answer.' : refusal(reply.status, body));
    }
    return reader.read(wire);
  }
}

function refusal(status: number, body: string): string {
  if (status === 413) return 'The server does not take so large a file.';
  if (status === 429) return 'The server is asked too often; try again in a moment.';
  return `The server refused (${status}): ${body.slice(0, 200) || 'without a word'}`;
}
