// The load's displacement, magnified: one millimetre on the screen is one micrometre of the load, as long as it fits.
//
// A load that hangs within 0.003 mm looks nailed to the sky; only here one sees that it moves at all. CSS has 96 pixels
// to an inch, so that "1000 times" is meant literally on a screen that keeps to it.

import { css_color, found, say } from './dom';
import type { Frame } from './messages';
import { nice } from './scene/geometry';
import type { Swarm } from './swarm';
import type { Theme } from './theme';
import { millimetres } from './words';

const kPixelsPerMetre = 96 / 0.0254;
const kTrace_s = 20;
const kMost = 520;       // frames in the trace
const kMagnifications = [10000, 1000, 100, 10, 1, 0.1];
const kEvery_s = 1 / 13;

interface Spot {
  time_s: number;
  at: readonly [number, number, number];
}

export class Inset {
  private readonly canvas = found<HTMLCanvasElement>('inset-canvas');
  private trace: Spot[] = [];
  private drawn_s = -Infinity;
  private times = 1000;

  constructor(private readonly swarm: Swarm, theme: Theme) {
    swarm.on('frame', () => this.take(swarm.frame!));
    swarm.on('reset', () => (this.trace = []));
    theme.on_change(() => this.draw());
  }

  private take(frame: Frame): void {
    const [x, y, z] = frame.displacement_w_m;
    if (x === undefined || y === undefined || z === undefined) return;
    const last = this.trace[this.trace.length - 1];
    if (last !== undefined && frame.server_time_s < last.time_s) this.trace = [];
    this.trace.push({ time_s: frame.server_time_s, at: [x, y, z] });
    while (this.trace.length > kMost || this.trace[0]!.time_s < frame.server_time_s - kTrace_s) this.trace.shift();
    if (Math.abs(frame.server_time_s - this.drawn_s) < kEvery_s) return;
    this.drawn_s = frame.server_time_s;
    this.draw();
  }

  private draw(): void {
    const side = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (side === 0 || height === 0) return;
    const density = Math.min(2, window.devicePixelRatio);
    if (this.canvas.width !== Math.round(side * density) || this.canvas.height !== Math.round(height * density)) {
      this.canvas.width = Math.round(side * density);
      this.canvas.height = Math.round(height * density);
    }
    // Such a canvas stays with the processor, which for so small a drawing is quicker than to ask the graphics card.
    const paint = this.canvas.getContext('2d', { willReadFrequently: true });
    if (paint === null) return;
    paint.setTransform(density, 0, 0, density, 0, 0);
    paint.clearRect(0, 0, side, height);
    const bar = 26;  // the height is a bar on the right
    const plane = { x: (side - bar) / 2, y: height / 2 - 4, reach: Math.min(side - bar, height - 26) / 2 - 6 };
    this.choose_scale(plane.reach);
    const scale = this.times * kPixelsPerMetre;
    this.draw_frame(paint, plane, side - bar / 2 - 2, scale);
    this.draw_trace(paint, plane, side - bar / 2 - 2, scale);
    this.tell();
  }

  /** The strongest magnification that the trace fits in; it comes back only when there is room to spare. */
  private choose_scale(reach: number): void {
    const most = Math.max(0, ...this.trace.map((spot) => Math.max(Math.hypot(spot.at[0], spot.at[1]), Math.abs(spot.at[2]))));
    const fits = (times: number, room: number): boolean => most * times * kPixelsPerMetre <= reach * room;
    const wanted = kMagnifications.find((times) => fits(times, 1)) ?? 0.1;
    if (wanted < this.times) this.times = wanted;
    else if (wanted > this.times && this.times < 1000) this.times = kMagnifications.find((times) => fits(times, 0.5) && times <= 1000) ?? this.times;
    this.times = Math.min(this.times, 1000);
  }

  private draw_frame(paint: CanvasRenderingContext2D, plane: { x: number; y: number; reach: number }, bar_x: number, scale: number): void {
    const { x, y, reach } = plane;
    paint.lineWidth = 1;
    paint.strokeStyle = css_color('grid');
    paint.beginPath();
    paint.moveTo(x - reach, y);
    paint.lineTo(x + reach, y);
    paint.moveTo(x, y - reach);
    paint.lineTo(x, y + reach);
    paint.moveTo(bar_x, y - reach);
    paint.lineTo(bar_x, y + reach);
    paint.moveTo(bar_x - 5, y);
    paint.lineTo(bar_x + 5, y);
    paint.stroke();
    const step = nice((0.45 * reach) / scale);
    paint.beginPath();
    for (let ring = step; ring * scale < reach; ring += step) {
      paint.moveTo(x + ring * scale, y);
      paint.arc(x, y, ring * scale, 0, 2 * Math.PI);
    }
    paint.stroke();
    paint.fillStyle = css_color('muted');
    paint.font = '11px system-ui, sans-serif';
    paint.textAlign = 'right';
    paint.fillText('x', x + reach, y - 4);
    paint.textAlign = 'left';
    paint.fillText('y', x + 4, y - reach + 9);
    paint.textAlign = 'center';
    paint.fillText('z', bar_x, y + reach + 13);
    this.draw_bar(paint, x - reach, y + reach + 13, step, scale);
  }

  private draw_bar(paint: CanvasRenderingContext2D, x: number, y: number, step: number, scale: number): void {
    const end = x + step * scale;
    paint.strokeStyle = css_color('ink');
    paint.lineWidth = 1.5;
    paint.beginPath();
    paint.moveTo(x, y - 7);
    paint.lineTo(x, y - 1);
    paint.moveTo(x, y - 4);
    paint.lineTo(end, y - 4);
    paint.moveTo(end, y - 7);
    paint.lineTo(end, y - 1);
    paint.stroke();
    paint.fillStyle = css_color('ink');
    paint.textAlign = 'left';
    paint.fillText(`${Number((step * 1000).toPrecision(1))} mm`, end + 6, y);
  }

  private draw_trace(paint: CanvasRenderingContext2D, plane: { x: number; y: number; reach: number }, bar_x: number, scale: number): void {
    const newest = this.trace[this.trace.length - 1];
    if (newest === undefined) return;
    const spots = this.trace.map((spot) => [plane.x + spot.at[0] * scale, plane.y - spot.at[1] * scale] as const);
    const tone = css_color('accent');
    paint.strokeStyle = tone;
    paint.lineWidth = 1.25;
    paint.lineJoin = 'round';
    const pieces = 6;  // each fainter than the next: the trace fades without a stroke for each point
    for (let piece = 0; piece < pieces; ++piece) {
      const from = Math.floor((spots.length * piece) / pieces);
      const to = Math.min(spots.length - 1, Math.floor((spots.length * (piece + 1)) / pieces));
      paint.globalAlpha = 0.08 + (0.72 * (piece + 1)) / pieces;
      paint.beginPath();
      for (let i = from; i <= to; ++i) paint.lineTo(spots[i]![0], spots[i]![1]);
      paint.stroke();
    }
    paint.globalAlpha = 1;
    paint.fillStyle = tone;
    const [x, y] = spots[spots.length - 1]!;
    paint.beginPath();
    paint.arc(x, y, 4, 0, 2 * Math.PI);
    paint.fill();
    const heights = this.trace.map((spot) => spot.at[2] * scale);
    const [low, high] = [Math.min(...heights), Math.max(...heights)];
    paint.globalAlpha = 0.3;
    paint.fillRect(bar_x - 3, plane.y - high, 6, Math.max(1, high - low));
    paint.globalAlpha = 1;
    paint.fillRect(bar_x - 6, plane.y - newest.at[2] * scale - 1.5, 12, 3);
  }

  private tell(): void {
    const newest = this.trace[this.trace.length - 1];
    if (newest === undefined) return;
    say(found('moved-now'), millimetres(this.swarm.within_m ?? Math.hypot(...newest.at)));
    const { rotation_deg = 0, residual = 0 } = this.swarm.frame ?? {};
    say(found('inset-more'), `turned ${small(rotation_deg)}°, ${small(residual * 100)} % of its weight unheld`);
    say(found('magnified'), this.times > 1 ? `magnified ${this.times} times` : this.times === 1 ? 'true to size' : 'a tenth of its size');
  }
}

function small(value: number): string {
  if (!Number.isFinite(value)) return '?';
  return value < 1e-4 ? '< 0.0001' : value.toPrecision(1).includes('e') ? value.toFixed(0) : String(Number(value.toPrecision(2)));
}
