// Colours: of carriers as `gyre plot` paints them, of cables by their tension. Pure.
//
// ground/plot/core/palette.cpp says why these and in this order; a test holds the two together.

export type Paper = 'light' | 'dark';

const kCarriers: readonly (readonly [light: string, dark: string])[] = [
  ['#1547a2', '#4ea8f4'],
  ['#b72400', '#f05c12'],
  ['#18a088', '#5df3a3'],
  ['#d65fd7', '#da72b7'],
  ['#a9911f', '#d5ba25'],
  ['#30789d', '#c4e5fc'],
  ['#32047c', '#965ee3'],
  ['#8c0050', '#b65c8b'],
  ['#4e8b08', '#3a9c2d'],
  ['#63625a', '#b9bcd7'],
  ['#512a0a', '#ae8a74'],
  ['#dc6174', '#f6988f'],
];

export const kDashes: readonly (readonly number[])[] = [[], [6, 3], [2, 3], [9, 3, 2, 3], [12, 4], [1, 4]];

export function carrier_tone(index: number, paper: Paper): string {
  return kCarriers[index % kCarriers.length]![paper === 'light' ? 0 : 1];
}

export function carrier_dash(index: number): readonly number[] {
  return kDashes[Math.floor(index / kCarriers.length) % kDashes.length]!;
}

/** Ink that is read on a tone: white, or the dark paper. */
export function written_on(tone: string): string {
  const [r, g, b] = rgb(tone).map((c) => (c / 255) ** 2.2) as unknown as Rgb;
  const light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  return 1.05 / (light + 0.05) > (light + 0.05) / 0.056 ? '#ffffff' : '#0d1117';
}

export type Rgb = readonly [number, number, number];

export function rgb(hex: string): Rgb {
  const value = Number.parseInt(hex.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

// From slack to taut; lightness goes one way, away from the paper, so that they are told apart without hue, too.
const kTension: Record<Paper, readonly Rgb[]> = {
  light: ['#8cc7d4', '#4a9fc0', '#3b6fb0', '#4a3f95', '#3a1257'].map(rgb),
  dark: ['#3a5585', '#3f83ab', '#55b3a4', '#a3d987', '#f6f1a0'].map(rgb),
};

/** Of a cable; share 0: at the least tension allowed, 1: at the greatest. Components 0 .. 255. */
export function tension_tone(share: number, paper: Paper): Rgb {
  const stops = kTension[paper];
  const at = Math.min(1, Math.max(0, Number.isFinite(share) ? share : 0)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  const [from, to] = [stops[i]!, stops[i + 1]!];
  return [0, 1, 2].map((c) => from[c]! + (to[c]! - from[c]!) * (at - i)) as unknown as Rgb;
}

export function tension_gradient(paper: Paper): string {
  return `linear-gradient(90deg, ${kTension[paper].map((tone) => `rgb(${tone.join(' ')})`).join(', ')})`;
}
