// Where things are, and how far the scene reaches. Pure. World frame, z up, metres; quaternions [w, x, y, z].

import type { Frame, Mission } from '../messages';

export type Triple = [number, number, number];

/** A point of the body in the world: p + R(q) b. */
export function placed(position_w: readonly number[], orientation_w_b: readonly number[], point_b: readonly number[]): Triple {
  const [px = 0, py = 0, pz = 0] = position_w;
  const [w = 1, x = 0, y = 0, z = 0] = orientation_w_b;
  const [bx = 0, by = 0, bz = 0] = point_b;
  const tx = 2 * (y * bz - z * by);
  const ty = 2 * (z * bx - x * bz);
  const tz = 2 * (x * by - y * bx);
  return [
    px + bx + w * tx + y * tz - z * ty,
    py + by + w * ty + z * tx - x * tz,
    pz + bz + w * tz + x * ty - y * tx,
  ];
}

export interface Extent {
  center: Triple;
  radius: number;   // of a ball around everything that moves
  lowest: number;
  floor: number;    // where the ground is drawn: below the lowest thing
}

/** Of everything that is known; absent while nothing is. */
export function extent(mission: Mission | undefined, frame: Frame | undefined): Extent | undefined {
  const points: Triple[] = [];
  const every = (flat: number[]): void => {
    for (let i = 0; i + 2 < flat.length; i += 3) points.push([flat[i]!, flat[i + 1]!, flat[i + 2]!]);
  };
  if (mission !== undefined && mission.position_w_m.length === 3) {
    points.push(mission.position_w_m as Triple);
    for (let i = 0; i + 2 < mission.hull_b_m.length; i += 3)
      points.push(placed(mission.position_w_m, mission.orientation_w_b, mission.hull_b_m.slice(i, i + 3)));
    for (const carrier of mission.carriers) {
      if (carrier.attachment_b_m.length === 3)
        points.push(placed(mission.position_w_m, mission.orientation_w_b, carrier.attachment_b_m));
      every(carrier.orbit_w_m);
    }
  }
  if (points.length < 2 && frame !== undefined) {
    every(frame.load_w_m);
    for (const carrier of frame.carriers) every(carrier.position_w_m);
  }
  const sound = points.filter((point) => point.every(Number.isFinite));
  if (sound.length === 0) return undefined;
  const low = [0, 1, 2].map((axis) => Math.min(...sound.map((point) => point[axis]!)));
  const high = [0, 1, 2].map((axis) => Math.max(...sound.map((point) => point[axis]!)));
  const center = low.map((value, axis) => (value + high[axis]!) / 2) as Triple;
  const radius = Math.max(0.1, ...sound.map((point) => Math.hypot(...point.map((value, axis) => value - center[axis]!))));
  return { center, radius, lowest: low[2]!, floor: low[2]! - 0.3 * radius };
}

/** The next of 1, 2, 5, 10 ... that is not below. */
export function nice(value: number): number {
  const ten = 10 ** Math.floor(Math.log10(value));
  return ten * ([1, 2, 5].find((step) => step * ten >= value * 0.999) ?? 10);
}

/** How a cable is loaded between the limits; the certified band stands in where there are none. */
export function tension_range(mission: Mission | undefined): { min: number; max: number } {
  let { min, max } = mission?.limits.tension_n ?? { min: 0, max: 0 };
  const certified = mission?.carriers.map((carrier) => carrier.certified.tension_n) ?? [];
  if (!Number.isFinite(min)) min = 0;
  if (!Number.isFinite(max) || max <= min) max = 1.2 * Math.max(0, ...certified.map((band) => band.max).filter(Number.isFinite));
  return { min, max: max > min ? max : min + 1 };
}
