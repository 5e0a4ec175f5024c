// What a plot shows, and how far its axis has to reach for that. Pure.

export interface Curve {
  name: string;
  tone: string;
  dash: readonly number[];
  width: number;
  values: (number | null)[];
}

export interface Bound {
  value: number;
  what: string;
}

/** What is drawn, anew each time. */
export interface Picture {
  times: number[];                        // seconds before now, up to 0
  curves: Curve[];
  envelope: { low: (number | null)[]; high: (number | null)[] } | undefined;
  bands: { min: number; max: number; tone: string }[];
  bounds: Bound[];
}

const kNear = 0.9;  // a bound farther from what is drawn than its height times this is named at the edge instead

/** The axis from what is drawn on it. Pure. */
export function reach(picture: Picture, logarithmic: boolean): { min: number; max: number } {
  let min = Infinity;
  let max = -Infinity;
  const take = (value: number | null): void => {
    if (value === null || !Number.isFinite(value) || (logarithmic && value <= 0)) return;
    if (value < min) min = value;
    if (value > max) max = value;
  };
  for (const curve of picture.curves) curve.values.forEach(take);
  picture.envelope?.low.forEach(take);
  picture.envelope?.high.forEach(take);
  for (const band of picture.bands) [band.min, band.max].forEach(take);
  if (min > max) return logarithmic ? { min: 0.001, max: 1 } : { min: 0, max: 1 };
  if (logarithmic) {
    for (const bound of picture.bounds) if (bound.value > 0 && bound.value < max * 100) take(bound.value);
    const [low, high] = [10 ** Math.floor(Math.log10(min * 0.999)), 10 ** Math.ceil(Math.log10(max * 1.001))];
    return { min: low, max: high > low ? high : low * 10 };
  }
  const span = Math.max(max - min, 1e-3 * Math.max(Math.abs(max), Math.abs(min)), 1e-9);
  for (const bound of picture.bounds)
    if (bound.value > min - kNear * span && bound.value < max + kNear * span) take(bound.value);
  const margin = 0.1 * Math.max(max - min, span);
  return { min: min - margin, max: max + margin };
}
