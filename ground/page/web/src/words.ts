// Figures and states in words. Pure: told everything, touches nothing.

import type { Frame, Mission, Process, Status } from './messages';

/** "0.003 mm": as many digits as a person can use, never fewer than say that something moved. */
export function millimetres(metres: number): string {
  const mm = Math.abs(metres) * 1000;
  if (!Number.isFinite(mm)) return 'unknown';
  if (mm < 0.0005) return '< 0.001 mm';
  return `${mm.toFixed(mm >= 100 ? 0 : mm >= 10 ? 1 : mm >= 0.1 ? 2 : 3)} mm`;
}

/** A length at the scale of the scene. */
export function metres(value: number): string {
  if (!Number.isFinite(value)) return 'unknown';
  const size = Math.abs(value);
  return size < 0.1 ? `${(value * 1000).toFixed(size < 0.01 ? 1 : 0)} mm` : `${value.toFixed(size < 10 ? 2 : 1)} m`;
}

export function seconds(value: number): string {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return 'unknown';
  if (size < 1e-3) return `${(value * 1e6).toFixed(0)} µs`;
  if (size < 1) return `${(value * 1e3).toFixed(size < 0.01 ? 1 : 0)} ms`;
  return size < 60 ? `${value.toFixed(1)} s` : clock(value);
}

export function percent(share: number): string {
  return `${Math.round(share * 100)} %`;
}

/** Swarm time as a clock reads: minutes, seconds, tenths; hours once there are any. */
export function clock(time_s: number): string {
  if (!Number.isFinite(time_s) || time_s < 0) return '–:––.–';
  const tenths = Math.floor(time_s * 10);
  const two = (value: number): string => String(value).padStart(2, '0');
  const minutes = Math.floor(tenths / 600);
  const rest = `${two(Math.floor(tenths / 10) % 60)}.${tenths % 10}`;
  return minutes < 60 ? `${minutes}:${rest}` : `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${rest}`;
}

export function degrees(phase_rad: number): string {
  return `${((((phase_rad * 180) / Math.PI) % 360) + 360) % 360 | 0}°`;
}

/** "4 carriers", "1 carrier". */
export function counted(count: number, one: string): string {
  const numbers = ['No', 'One', 'Two', 'Three', 'Four', 'Five', 'Six', 'Seven', 'Eight', 'Nine', 'Ten', 'Eleven', 'Twelve'];
  return `${numbers[count] ?? count} ${one}${count === 1 ? '' : 's'}`;
}

/** "0.86 to 0.95 m/s". */
export function spread(values: number[], unit: string): string {
  const known = values.filter(Number.isFinite);
  if (known.length === 0) return `? ${unit}`;
  const digits = Math.max(...known) >= 10 ? 1 : 2;
  const low = Math.min(...known).toFixed(digits);
  const high = Math.max(...known).toFixed(digits);
  return low === high ? `${low} ${unit}` : `${low} to ${high} ${unit}`;
}

export type Mood = 'calm' | 'waiting' | 'complaint' | 'gone';
export interface Headline {
  mood: Mood;
  line: string;  // what counts, in one sentence
  sub: string;   // what stands behind it
}

export interface Situation {
  online: boolean;             // the server is heard
  ever: boolean;               // it was heard before
  frames_age_s: number;        // since the last frame
  recording: boolean;
  frame: Frame | undefined;
  status: Status | undefined;
  within_m: number | undefined;  // the load's greatest displacement lately
  good_m: number;                // up to here a load counts as still
}

/** Up to where a load counts as still: the mission says, or a millimetre does. */
export function good_displacement(mission: Mission | undefined): number {
  const told = mission?.displacement_max_m ?? 0;
  return told > 0 && Number.isFinite(told) ? told : 0.001;
}

const kRest = 0.001;  // a pace below is none that an eye sees
const kFull = 0.999;

function motion(frame: Frame | undefined): string {
  if (frame === undefined) return 'Nothing is heard of the load yet';
  if (frame.pace < kRest) return 'At rest';
  return frame.pace > kFull ? 'In motion' : `In motion at ${percent(frame.pace)} of its pace`;
}

function hangs({ within_m, good_m }: Situation): string {
  if (within_m === undefined) return 'the load is not heard';
  return `the load ${within_m <= good_m ? 'hangs' : 'swings'} within ${millimetres(within_m)}`;
}

function capital(words: string): string {
  return words.charAt(0).toUpperCase() + words.slice(1);
}

function behind(situation: Situation): string {
  const { frame, status } = situation;
  const parts: string[] = [];
  if (status?.complaint) parts.push(capital(`${motion(frame)}: ${hangs(situation)}`));
  else if (frame !== undefined && frame.carriers.length > 0) {
    const speeds = frame.carriers.filter((carrier) => carrier.heard).map((carrier) => carrier.speed_m_s);
    const flying = counted(frame.carriers.length, 'carrier');
    parts.push(frame.pace < kRest ? `${flying}, standing` : `${flying} never stop${frame.carriers.length === 1 ? 's' : ''}: ${spread(speeds, 'm/s')}`);
  }
  if (status !== undefined && status.displacement_max_m > 0)
    parts.push(`${millimetres(status.displacement_max_m)} at most since the motion began`);
  if (status !== undefined && status.course.includes('->')) parts.push(status.course);
  return parts.join('  ·  ');
}

export function headline(situation: Situation): Headline {
  const { status, frame } = situation;
  if (!situation.online) {
    return situation.ever
      ? { mood: 'gone', line: 'The server is gone; looking for it again …', sub: 'What you see is the last that was heard.' }
      : { mood: 'waiting', line: 'Looking for the server …', sub: 'It is the program that printed this address.' };
  }
  if (frame !== undefined && situation.frames_age_s > 1.5) {
    return {
      mood: 'gone',
      line: `Nothing is heard of the swarm for ${Math.round(situation.frames_age_s)} s`,
      sub: 'The server is there. What you see is the last that was heard.',
    };
  }
  if (status === undefined || frame === undefined)
    return { mood: 'waiting', line: 'Waiting for a word of the swarm …', sub: 'The server is there.' };
  const still = hangs(situation);
  if (status.complaint !== '')
    return { mood: 'complaint', line: capital(status.complaint), sub: behind(situation) };
  if (!status.connected && !situation.recording)
    return { mood: 'complaint', line: `No coordinator is heard; ${still}`, sub: behind(situation) };
  if (status.missing.length > 0 && frame.pace < kRest) {
    const missing = status.missing.length === 1 ? 'one thing is missing' : `${status.missing.length} things are missing`;
    return { mood: 'waiting', line: `Getting ready: ${missing}`, sub: behind(situation) };
  }
  return { mood: 'calm', line: `${motion(frame)}: ${still}`, sub: behind(situation) };
}

/** A process in few words, for a cell and for a screen reader. */
export function losses(process: Process): number {
  const { late, duplicate, wrong_term, nonsense } = process.dropped;
  return late + duplicate + wrong_term + nonsense;
}
