// One plot over the last minute: lines, a band that was certified, limits that must not be crossed.

import uPlot from 'uplot';
import { css_color, element, say } from './dom';
import { kWindow_s } from './history';
import { reach } from './plot_reach';
import type { Picture } from './plot_reach';

export interface Kind {
  key: string;
  title: string;
  unit: string;
  logarithmic: boolean;
  picture: () => Picture;
}

/** One line for each power of ten; those between tell nothing in so small a plot. */
function decades(_: uPlot, __: number, min: number, max: number): number[] {
  const out: number[] = [];
  for (let power = Math.ceil(Math.log10(min) - 1e-6); power <= Math.log10(max) + 1e-6; ++power) out.push(10 ** power);
  return out;
}

function figure(value: number): string {
  return Number(value.toPrecision(3)).toString();
}

export class Plot {
  readonly box: HTMLElement;
  private readonly canvas = element('div', { class: 'plot-canvas' });
  private readonly says = element('span', { class: 'plot-says' });
  private chart: uPlot | undefined;
  private picture: Picture | undefined;
  private curves = '';
  visible = true;

  constructor(private readonly kind: Kind, private readonly sync: string) {
    const head = element('header', {}, element('h3', { text: kind.title }), this.says);
    this.box = element('section', { class: 'plot', attributes: { 'data-plot': kind.key, 'aria-label': kind.title } }, head, this.canvas);
    new IntersectionObserver((entries) => (this.visible = entries.some((entry) => entry.isIntersecting))).observe(this.box);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  /** Colours are read anew. */
  forget(): void {
    this.curves = '';
  }

  draw(): void {
    if (!this.visible) return;
    const picture = this.kind.picture();
    this.picture = picture;
    const curves = picture.curves.map((curve) => [curve.name, curve.tone, curve.width].join()).join(';') + (picture.envelope ? '+' : '');
    if (this.chart === undefined || curves !== this.curves) this.make(picture);
    this.curves = curves;
    const columns = picture.curves.map((curve) => curve.values);
    if (picture.envelope !== undefined) columns.push(picture.envelope.high, picture.envelope.low);
    this.chart!.setData([picture.times, ...columns] as uPlot.AlignedData);
    this.tell(picture.times.length - 1);
  }

  private tell(at: number): void {
    const picture = this.picture;
    if (picture === undefined) return;
    const shown = picture.curves.length > 0 ? picture.curves.map((curve) => curve.values[at]) : [picture.envelope?.low[at], picture.envelope?.high[at]];
    const known = shown.filter((value): value is number => typeof value === 'number');
    if (known.length === 0) return say(this.says, this.kind.unit);
    const [low, high] = [figure(Math.min(...known)), figure(Math.max(...known))];
    const when = at < picture.times.length - 1 ? `, ${(-(picture.times[at] ?? 0)).toFixed(1)} s ago` : '';
    say(this.says, `${low === high ? low : `${low} … ${high}`} ${this.kind.unit}${when}`);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.chart !== undefined && width > 0) this.chart.setSize({ width, height });
  }

  private make(picture: Picture): void {
    this.chart?.destroy();
    const line = (tone: string, width: number, dash: readonly number[]): uPlot.Series => ({
      stroke: tone,
      width,
      dash: [...dash],
      points: { show: false },
      spanGaps: false,
    });
    const series: uPlot.Series[] = [{}, ...picture.curves.map((curve) => line(curve.tone, curve.width, curve.dash))];
    const bands: uPlot.Band[] = [];
    if (picture.envelope !== undefined) {
      bands.push({ series: [series.length, series.length + 1], fill: css_color('envelope') });
      series.push(line(css_color('muted'), 0.75, []), line(css_color('muted'), 0.75, []));
    }
    const axis = {
      stroke: css_color('muted'),
      grid: { stroke: css_color('hairline'), width: 1 },
      ticks: { show: false },
      font: '11px system-ui, sans-serif',
    };
    const logarithmic = this.kind.logarithmic;
    this.chart = new uPlot(
      {
        width: Math.max(40, this.canvas.clientWidth),
        height: Math.max(40, this.canvas.clientHeight),
        series,
        bands,
        legend: { show: false },
        cursor: { sync: { key: this.sync }, drag: { x: false, y: false }, points: { show: false }, y: false },
        scales: {
          x: { time: false, range: [-kWindow_s, 0] },
          y: {
            distr: logarithmic ? 3 : 1,
            range: () => {
              const { min, max } = reach(this.picture ?? picture, logarithmic);
              return [min, max];
            },
          },
        },
        axes: [
          { ...axis, size: 20, gap: 3, splits: () => [-45, -30, -15, 0], values: (_, at) => at.map((t) => (t === 0 ? 'now' : `${t} s`)) },
          { ...axis, size: 46, gap: 4, space: 26, ...(logarithmic ? { splits: decades } : {}), values: (_, at) => at.map((value) => (value === null ? '' : figure(value))) },
        ],
        hooks: {
          drawClear: [(chart) => this.draw_bands(chart)],
          draw: [(chart) => this.draw_bounds(chart)],
          setCursor: [(chart) => this.tell(chart.cursor.idx ?? (this.picture?.times.length ?? 1) - 1)],
        },
      },
      [[], ...series.slice(1).map(() => [])] as unknown as uPlot.AlignedData,
      this.canvas,
    );
  }

  private draw_bands(chart: uPlot): void {
    const { left, top, width, height } = chart.bbox;
    const paint = chart.ctx;
    paint.save();
    paint.beginPath();
    paint.rect(left, top, width, height);
    paint.clip();
    for (const band of this.picture?.bands ?? []) {
      if (!Number.isFinite(band.min) || !Number.isFinite(band.max)) continue;
      const high = chart.valToPos(band.max, 'y', true);
      const low = chart.valToPos(band.min, 'y', true);
      paint.fillStyle = band.tone;
      paint.fillRect(left, high, width, Math.max(1, low - high));
    }
    paint.restore();
  }

  private draw_bounds(chart: uPlot): void {
    const { left, top, width, height } = chart.bbox;
    const paint = chart.ctx;
    const density = window.devicePixelRatio;
    paint.save();
    paint.fillStyle = css_color('bad');
    paint.font = `${10 * density}px system-ui, sans-serif`;
    paint.textAlign = 'left';
    const write = (words: string, y: number): void => {
      paint.lineWidth = 3 * density;
      paint.strokeStyle = css_color('sheet');
      paint.setLineDash([]);
      paint.strokeText(words, left + 4 * density, y);
      paint.fillText(words, left + 4 * density, y);
    };
    for (const bound of this.picture?.bounds ?? []) {
      if (!Number.isFinite(bound.value) || (this.kind.logarithmic && bound.value <= 0)) continue;
      const y = chart.valToPos(bound.value, 'y', true);
      const words = `${bound.what} ${figure(bound.value)}`;
      if (y < top) write(`${words} ↑`, top + 10 * density);
      else if (y > top + height) write(`${words} ↓`, top + height - 4 * density);
      else {
        paint.lineWidth = density;
        paint.strokeStyle = css_color('bad');
        paint.setLineDash([5 * density, 4 * density]);
        paint.beginPath();
        paint.moveTo(left, y);
        paint.lineTo(left + width, y);
        paint.stroke();
        const below = y < top + 14 * density;
        write(words, below ? y + 11 * density : y - 4 * density);
      }
    }
    paint.restore();
  }
}
