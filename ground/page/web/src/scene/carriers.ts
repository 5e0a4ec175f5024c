// Carriers as rotor discs in the size of their vehicles, their trails, their planned orbits, and where each should be.
//
// A disc lies level: no message tells how a vehicle leans, so none is drawn leaning. The ghost is a ring somewhat
// larger than the vehicle: around one that follows its plan it is a halo, and away from one that strays.

import * as three from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import type { FrameCarrier, Mission } from '../messages';
import type { Playback } from '../playback';
import { css_color } from '../dom';
import { carrier_tone, rgb } from '../tones';
import type { Paper } from '../tones';
import type { Extent } from './geometry';
import type { CarrierPose, Pose } from './pose';
import { Ribbons } from './ribbons';

const kTrailOfPeriod = 0.6;
const kTrailMost_s = 14;

/** Coarser where there are many: each is small then, and there are processors that draw. */
function disc(many: boolean): three.BufferGeometry {
  const rim = new three.TorusGeometry(1, 0.085, many ? 4 : 6, many ? 20 : 40);
  const hub = new three.SphereGeometry(0.3, many ? 8 : 14, many ? 6 : 10);
  const arms = [0, 1].map((i) => {
    const arm = new three.BoxGeometry(2, 0.1, 0.1);
    arm.rotateZ((i * Math.PI) / 2 + Math.PI / 4);
    return arm;
  });
  const parts = [rim, hub, ...arms];
  const whole = mergeGeometries(parts);
  parts.forEach((part) => part.dispose());
  return whole;
}

export class Carriers {
  readonly group = new three.Group();
  private bodies!: three.InstancedMesh;
  private planes!: three.InstancedMesh;  // the swept area of the rotors, translucent
  private ghosts!: three.InstancedMesh;
  private trails: Ribbons | undefined;
  private orbits: Ribbons | undefined;
  private radii: number[] = [];
  private paths: Float32Array[] = [];
  private step_s = 0.1;
  private trailed_s = -Infinity;
  private readonly matrix = new three.Matrix4();
  private readonly color = new three.Color();

  build(mission: Mission | undefined, ids: number[], extent: Extent): void {
    for (const child of [...this.group.children]) this.group.remove(child);
    for (const old of [this.bodies, this.planes, this.ghosts] as (three.InstancedMesh | undefined)[]) {
      old?.geometry.dispose();
      (old?.material as three.Material | undefined)?.dispose();
      old?.dispose();
    }
    this.trails?.dispose();
    this.orbits?.dispose();
    const count = ids.length;
    const many = count > 16;
    const told = new Map(mission?.carriers.map((carrier) => [carrier.id, carrier.radius_m]));
    const usual = Math.min(0.055, 0.2 / Math.sqrt(Math.max(1, count))) * extent.radius;
    this.radii = ids.map((id) => (told.get(id) ?? 0) || usual);
    this.bodies = new three.InstancedMesh(disc(many), new three.MeshLambertMaterial(), count);
    this.bodies.castShadow = true;
    const glass = { transparent: true, depthWrite: false, side: three.DoubleSide };
    this.planes = new three.InstancedMesh(new three.CircleGeometry(1, many ? 20 : 40), new three.MeshBasicMaterial({ ...glass, opacity: 0.22 }), count);
    this.ghosts = new three.InstancedMesh(new three.TorusGeometry(1.42, 0.035, 4, many ? 20 : 40), new three.MeshBasicMaterial({ ...glass, opacity: 0.5 }), count);
    for (const mesh of [this.bodies, this.planes, this.ghosts]) mesh.frustumCulled = false;
    const points = many ? 40 : 96;
    const period_s = mission !== undefined && mission.period_s > 0 ? mission.period_s : 20;
    this.step_s = Math.min(kTrailMost_s, kTrailOfPeriod * period_s) / points;
    this.trails = new Ribbons(count, points, { width: many ? 3 : 7, opacity: 0.85 });
    this.paths = ids.map(() => new Float32Array(0));
    this.trailed_s = -Infinity;
    const orbits = ids.map((id) => mission?.carriers.find((carrier) => carrier.id === id)?.orbit_w_m ?? []);
    const longest = Math.max(2, ...orbits.map((orbit) => orbit.length / 3 + 1));
    this.orbits = new Ribbons(count, longest, { width: 1.1, opacity: 0.4 });
    orbits.forEach((orbit, i) => this.orbits!.lay(i, [...orbit, ...orbit.slice(0, 3)]));
    this.group.add(this.orbits.mesh, this.trails.mesh, this.bodies, this.ghosts, this.planes);
  }

  repaint(paper: Paper, heard: (index: number) => boolean, shows: (index: number) => boolean): void {
    const muted = css_color('muted');
    this.radii.forEach((_, i) => {
      const tone = heard(i) ? carrier_tone(i, paper) : muted;
      const weight = shows(i) ? 1 : 0.25;
      this.color.set(tone);
      for (const mesh of [this.bodies, this.planes, this.ghosts]) mesh.setColorAt(i, this.color);
      this.trails?.paint(i, rgb(tone), (share) => weight * share ** 1.7);
      this.orbits?.paint(i, rgb(tone), () => weight);
    });
    for (const mesh of [this.bodies, this.planes, this.ghosts])
      if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
  }

  /** `least` is the radius below which a vehicle would not be seen any more, at a place in the world. */
  place(pose: Pose, time_s: number, frames: Playback, least: (at: CarrierPose) => number): void {
    pose.carriers.forEach((carrier, i) => {
      const radius = carrier.seen ? Math.max(this.radii[i] ?? 0, least(carrier)) : 0;
      const put = (mesh: three.InstancedMesh, at: readonly number[], size: number): void => {
        this.matrix.makeScale(size, size, size).setPosition(at[0]!, at[1]!, at[2]!);
        mesh.setMatrixAt(i, this.matrix);
      };
      put(this.bodies, carrier.position, radius);
      put(this.planes, carrier.position, radius);
      put(this.ghosts, carrier.planned, carrier.has_plan ? Math.max(this.radii[i] ?? 0, least(carrier)) : 0);
    });
    for (const mesh of [this.bodies, this.planes, this.ghosts]) mesh.instanceMatrix.needsUpdate = true;
    this.draw_trails(pose, time_s, frames);
  }

  /** Through what was heard, not through what was drawn: where pictures are few, a trail is round all the same. */
  private draw_trails(pose: Pose, time_s: number, frames: Playback): void {
    const trails = this.trails;
    if (trails === undefined) return;
    const back = time_s < this.trailed_s - 1;
    const passed: Map<number, FrameCarrier>[] = [];
    for (const frame of frames.during(back ? -Infinity : this.trailed_s, time_s)) {
      if (!back && frame.server_time_s - this.trailed_s < this.step_s) continue;
      this.trailed_s = frame.server_time_s;
      passed.push(new Map(frame.carriers.map((carrier) => [carrier.id, carrier])));
    }
    pose.carriers.forEach((carrier, i) => {
      if (!carrier.seen) return;
      let path = this.paths[i]!;
      if (path.length === 0 || back) {
        path = this.paths[i] = new Float32Array(trails.points * 3);
        for (let p = 0; p < trails.points; ++p) path.set(carrier.position, p * 3);
      }
      for (const heard of passed) {
        const at = heard.get(carrier.id)?.position_w_m;
        if (at?.length !== 3) continue;
        path.set(at, path.length - 3);
        path.copyWithin(0, 3);
      }
      path.set(carrier.position, path.length - 3);
      trails.lay(i, path);
    });
  }

  set screen(size: { width: number; height: number }) {
    if (this.trails !== undefined) this.trails.screen = size;
    if (this.orbits !== undefined) this.orbits.screen = size;
  }
}
