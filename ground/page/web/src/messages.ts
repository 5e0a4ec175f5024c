// What the server and the page say to each other: idl/page.proto, name for name. A test holds the two together.

import { choice, flag, list, long, message, optional, real, text, whole } from './readers';
import type { Of } from './readers';

export const Hello = message('Hello', {
  server: text,
  domain: whole,
  takes_orders: flag,
  owns_processes: flag,
  mission_file: text,
});
export type Hello = Of<typeof Hello>;

export const Range = message('Range', { min: real, max: real });
export type Range = Of<typeof Range>;

export const Figures = message('Figures', {
  tension_n: Range,
  length_m: Range,
  speed_m_s: Range,
  winch_rate_m_s: Range,
  altitude_m: Range,
});
export type Figures = Of<typeof Figures>;

export const MissionCarrier = message('MissionCarrier', {
  id: whole,
  attachment_b_m: list(real),
  radius_m: real,
  orbit_w_m: list(real),
  certified: Figures,
});
export type MissionCarrier = Of<typeof MissionCarrier>;

export const Mission = message('Mission', {
  name: text,
  complete: flag,
  plan: text,
  period_s: real,
  mass_kg: real,
  gravity_m_s2: real,
  position_w_m: list(real),
  orientation_w_b: list(real),
  hull_b_m: list(real),
  hull_faces: list(whole),
  carriers: list(MissionCarrier),
  limits: Figures,
  displacement_max_m: real,
  rotation_max_deg: real,
  clearance_m: real,
  clearance_between: text,
});
export type Mission = Of<typeof Mission>;

export const FrameCarrier = message('FrameCarrier', {
  id: whole,
  heard: flag,
  position_w_m: list(real),
  planned_w_m: list(real),
  deviation_m: real,
  tension_n: real,
  length_m: real,
  speed_m_s: real,
  winch_rate_m_s: real,
});
export type FrameCarrier = Of<typeof FrameCarrier>;

export const Frame = message('Frame', {
  server_time_s: real,
  swarm_time_s: real,
  plan_time_s: real,
  phase_rad: real,
  pace: real,
  load_w_m: list(real),
  load_orientation_w_b: list(real),
  displacement_w_m: list(real),
  rotation_deg: real,
  residual: real,
  carriers: list(FrameCarrier),
  closest_m: real,
  closest: list(whole),
});
export type Frame = Of<typeof Frame>;

export const Dropped = message('Dropped', { late: long, duplicate: long, wrong_term: long, nonsense: long });
export type Dropped = Of<typeof Dropped>;

export const Process = message('Process', {
  name: text,
  state: text,
  well: flag,
  complaint: text,
  address: text,
  heard_age_s: real,
  carrier: whole,
  plan: text,
  clock_uncertainty_s: real,
  clock_drift_ppm: real,
  beacons_received: long,
  beacons_missed: long,
  dropped: Dropped,
  late_s: real,
  pid: whole,
});
export type Process = Of<typeof Process>;

export const Missing = message('Missing', { who: text, what: text });
export type Missing = Of<typeof Missing>;

export const Hurt = message('Hurt', {
  number: long,
  text: text,
  since_s: real,
  before_m: real,
  moved_max_m: real,
  calm_after_s: real,
});
export type Hurt = Of<typeof Hurt>;

export const Status = message('Status', {
  connected: flag,
  calm: flag,
  complaint: text,
  course: text,
  wish: text,
  news: text,
  term: long,
  lease_left_s: real,
  skew_s: real,
  skew_budget_s: real,
  processes: list(Process),
  missing: list(Missing),
  displacement_max_m: real,
  rotation_max_deg: real,
  hurt: Hurt,
});
export type Status = Of<typeof Status>;

export const Happening = message('Happening', {
  number: long,
  swarm_time_s: real,
  level: choice('Level', ['INFO', 'WARNING', 'ERROR']),
  who: text,
  text: text,
});
export type Happening = Of<typeof Happening>;

export const Order = message('Order', {
  kind: choice('Kind', ['NONE', 'ENGAGE', 'RELEASE', 'FREEZE', 'RETUNE', 'PACE']),
  pace: optional(real),
  phase_deg: optional(real),
  mission: text,
});
export type Order = Of<typeof Order>;

export const Answer = message('Answer', { done: flag, text: text });
export type Answer = Of<typeof Answer>;

export const CheckRequest = message('CheckRequest', { mission: text });
export type CheckRequest = Of<typeof CheckRequest>;

export const Verdict = message('Verdict', { readable: flag, admissible: flag, name: text, text: text });
export type Verdict = Of<typeof Verdict>;

export const HurtRequest = message('HurtRequest', {
  kind: choice('Kind', ['NONE', 'KILL', 'STOP', 'CONTINUE', 'RESTART', 'LOSE', 'SHIFT_CLOCK', 'PUSH']),
  process: text,
  amount: real,
  force_w_n: list(real),
  duration_s: real,
});
export type HurtRequest = Of<typeof HurtRequest>;
