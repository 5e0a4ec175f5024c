// Names beside what they name, as elements over the picture: crisp, in the page's own type, and cheap enough for a
// hundred, because only their places are written for each frame.

import * as three from 'three';
import { element, mark, say, show } from '../dom';
import type { Triple } from './geometry';

interface Label {
  box: HTMLElement;
  id: HTMLElement;
  more: HTMLElement;
  x: number;
  y: number;
}

export class Labels {
  private labels: Label[] = [];
  private readonly point = new three.Vector3();
  readonly closest = element('div', { class: 'label closest' });
  readonly load = element('div', { class: 'label load' });

  constructor(private readonly layer: HTMLElement) {
    layer.append(this.closest, this.load);
  }

  build(ids: number[]): void {
    for (const label of this.labels) label.box.remove();
    this.layer.classList.toggle('many', ids.length > 12);
    this.labels = ids.map((number) => {
      const id = element('b', { text: String(number) });
      const more = element('span', { class: 'more' });
      const box = element('div', { class: 'label carrier', attributes: { 'data-carrier': String(number) } }, id, more);
      this.layer.append(box);
      return { box, id, more, x: 0, y: 0 };
    });
  }

  paint(index: number, tone: string, ink: string, weight: 'full' | 'faint', bad: boolean): void {
    const label = this.labels[index];
    if (label === undefined) return;
    label.box.style.setProperty('--tone', tone);
    label.box.style.setProperty('--on-tone', ink);
    mark(label.box, 'data-weight', weight);
    mark(label.box, 'data-bad', String(bad));
  }

  tell(index: number, more: string): void {
    const label = this.labels[index];
    if (label !== undefined) say(label.more, more);
  }

  place(index: number, at: Triple | undefined, camera: three.Camera, size: { width: number; height: number }): void {
    const label = this.labels[index];
    if (label === undefined) return;
    const spot = at === undefined ? undefined : this.spot(at, camera, size);
    show(label.box, spot !== undefined);
    if (spot === undefined) return;
    label.x = spot.x;
    label.y = spot.y;
    label.box.style.transform = `translate(${spot.x.toFixed(1)}px, ${spot.y.toFixed(1)}px)`;
  }

  put(box: HTMLElement, at: Triple | undefined, camera: three.Camera, size: { width: number; height: number }): void {
    const spot = at === undefined ? undefined : this.spot(at, camera, size);
    show(box, spot !== undefined);
    if (spot !== undefined) box.style.transform = `translate(${spot.x.toFixed(1)}px, ${spot.y.toFixed(1)}px)`;
  }

  /** Beneath all of these points, wherever one looks from. */
  put_below(box: HTMLElement, points: Triple[], camera: three.Camera, size: { width: number; height: number }): void {
    const spots = points.map((point) => this.spot(point, camera, size)).filter((spot) => spot !== undefined);
    show(box, spots.length > 0);
    if (spots.length === 0) return;
    const lowest = spots.reduce((low, spot) => (spot.y > low.y ? spot : low));
    const x = (Math.min(...spots.map((spot) => spot.x)) + Math.max(...spots.map((spot) => spot.x))) / 2;
    box.style.transform = `translate(${x.toFixed(1)}px, ${lowest.y.toFixed(1)}px)`;
  }

  private spot(at: Triple, camera: three.Camera, size: { width: number; height: number }): { x: number; y: number } | undefined {
    this.point.set(...at).project(camera);
    if (this.point.z > 1 || Math.abs(this.point.x) > 1.05 || Math.abs(this.point.y) > 1.05) return undefined;
    return { x: ((this.point.x + 1) / 2) * size.width, y: ((1 - this.point.y) / 2) * size.height };
  }

  /** Which carrier a person pointed at: the index of the nearest label within reach. */
  near(x: number, y: number): number | undefined {
    let best: number | undefined;
    let least = 30;
    this.labels.forEach((label, i) => {
      if (label.box.hidden) return;
      const distance = Math.hypot(label.x - x, label.y - y);
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  }
}
