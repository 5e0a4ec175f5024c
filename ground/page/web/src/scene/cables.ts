// Cables: straight, from attachment to carrier, coloured by tension between the limits; red beyond them.

import * as three from 'three';
import type { Mission } from '../messages';
import { css_color } from '../dom';
import { rgb, tension_tone } from '../tones';
import type { Paper } from '../tones';
import { tension_range } from './geometry';
import type { Pose } from './pose';

const kUp = new three.Vector3(0, 1, 0);

export class Cables {
  mesh = this.make(0);
  private range = { min: 0, max: 1 };
  private readonly from = new three.Vector3();
  private readonly span = new three.Vector3();
  private readonly turn = new three.Quaternion();
  private readonly size = new three.Vector3();
  private readonly matrix = new three.Matrix4();
  private readonly color = new three.Color();
  private unknown = '#888888';
  private bad = '#cc0000';

  private make(count: number): three.InstancedMesh {
    const tube = new three.CylinderGeometry(1, 1, 1, 6, 1, true);
    tube.translate(0, 0.5, 0);
    const mesh = new three.InstancedMesh(tube, new three.MeshBasicMaterial(), count);
    mesh.castShadow = true;
    mesh.frustumCulled = false;
    return mesh;
  }

  build(mission: Mission | undefined, count: number): void {
    this.mesh.geometry.dispose();
    this.mesh.dispose();
    this.mesh = this.make(count);
    this.range = tension_range(mission);
  }

  repaint(): void {
    this.unknown = css_color('muted');
    this.bad = css_color('bad');
  }

  /** `thickness` is of the cable at a place in the world: so many pixels from wherever one looks. */
  place(pose: Pose, paper: Paper, thickness: (at: three.Vector3) => number, shows: (id: number) => boolean): void {
    pose.carriers.forEach((carrier, i) => {
      this.from.set(...carrier.attachment);
      this.span.set(...carrier.position).sub(this.from);
      const length = carrier.seen && pose.has_load ? this.span.length() : 0;
      const radius = thickness(this.from) * (shows(carrier.id) ? 1 : 0.5);
      this.turn.setFromUnitVectors(kUp, length > 0 ? this.span.divideScalar(length) : kUp);
      this.mesh.setMatrixAt(i, this.matrix.compose(this.from, this.turn, this.size.set(radius, length, radius)));
      const [r, g, b] = this.tone(carrier.tension_n, carrier.heard, paper);
      this.color.setRGB(r / 255, g / 255, b / 255, three.SRGBColorSpace);
      this.mesh.setColorAt(i, this.color);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor !== null) this.mesh.instanceColor.needsUpdate = true;
  }

  private tone(tension_n: number, heard: boolean, paper: Paper): readonly [number, number, number] {
    if (!heard) return rgb(this.unknown);
    const { min, max } = this.range;
    if (tension_n < min || tension_n > max) return rgb(this.bad);
    return tension_tone((tension_n - min) / (max - min), paper);
  }
}
