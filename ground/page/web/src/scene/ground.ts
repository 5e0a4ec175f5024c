// A ground to see the height against: a grid that fades, and the shadows. No mission has one; it is drawn below the
// lowest thing, and the scene says so.

import * as three from 'three';
import { css_color } from '../dom';
import { nice } from './geometry';
import type { Extent } from './geometry';

const kPieces = 24;  // of a line, so that it can fade towards its ends

export class Ground {
  readonly group = new three.Group();
  readonly light = new three.DirectionalLight(0xffffff, 2.1);
  cell_m = 1;
  private readonly lines = new three.LineSegments(
    new three.BufferGeometry(),
    new three.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }),
  );
  private readonly shade = new three.Mesh(
    new three.CircleGeometry(1, 48),
    new three.ShadowMaterial({ opacity: 0.2, depthWrite: false }),
  );
  private extent: Extent | undefined;

  constructor() {
    this.shade.receiveShadow = true;
    this.light.castShadow = true;
    this.light.shadow.mapSize.set(1024, 1024);
    this.light.shadow.radius = 5;
    this.group.add(this.shade, this.lines, this.light, this.light.target);
  }

  build(extent: Extent): void {
    this.extent = extent;
    const [x, y] = extent.center;
    this.cell_m = nice(extent.radius / 4);
    this.shade.position.set(x, y, extent.floor);
    this.shade.scale.setScalar(2.2 * extent.radius);
    this.light.target.position.set(...extent.center);
    this.light.position.set(x + 0.5 * extent.radius, y - 0.8 * extent.radius, extent.center[2] + 3 * extent.radius);
    const camera = this.light.shadow.camera;
    const reach = 1.25 * extent.radius;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.5 * extent.radius, far: 6 * extent.radius });
    camera.updateProjectionMatrix();
    this.repaint();
  }

  repaint(): void {
    const extent = this.extent;
    if (extent === undefined) return;
    const color = new three.Color(css_color('grid'));
    (this.shade.material as three.ShadowMaterial).opacity = Number(css_color('shadow') || '0.2');
    const [x, y] = extent.center;
    const reach = Math.ceil((2.4 * extent.radius) / this.cell_m) * this.cell_m;
    const x0 = Math.round(x / this.cell_m) * this.cell_m;
    const y0 = Math.round(y / this.cell_m) * this.cell_m;
    const points: number[] = [];
    const colors: number[] = [];
    const corner = (px: number, py: number): void => {
      points.push(px, py, extent.floor);
      const share = Math.hypot(px - x, py - y) / reach;
      colors.push(color.r, color.g, color.b, Math.max(0, 1 - share * share * 1.15));
    };
    for (let line = -reach; line <= reach + 1e-6; line += this.cell_m)
      for (let i = 0; i < kPieces; ++i) {
        const [from, to] = [-reach + (2 * reach * i) / kPieces, -reach + (2 * reach * (i + 1)) / kPieces];
        corner(x0 + line, y0 + from);
        corner(x0 + line, y0 + to);
        corner(x0 + from, y0 + line);
        corner(x0 + to, y0 + line);
      }
    this.lines.geometry.dispose();
    this.lines.geometry = new three.BufferGeometry();
    this.lines.geometry.setAttribute('position', new three.Float32BufferAttribute(points, 3));
    this.lines.geometry.setAttribute('color', new three.Float32BufferAttribute(colors, 4));
  }
}
