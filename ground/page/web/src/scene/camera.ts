// From where one looks: around the load with the pointer, from above, along with a carrier. Every way there is smooth,
// unless the system asks for less motion.

import * as three from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { is_still } from '../dom';
import type { Extent, Triple } from './geometry';

const kAzimuth = (-62 * Math.PI) / 180;
const kElevation = (25 * Math.PI) / 180;
const kWay_s = 0.6;

interface Way {
  from: { eye: three.Vector3; target: three.Vector3 };
  to: { eye: three.Vector3; target: three.Vector3 };
  begun_s: number;
}

export class Camera {
  readonly eye = new three.PerspectiveCamera(32, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private way: Way | undefined;
  private extent: Extent | undefined;
  private followed: Triple | undefined;
  private height = 1;
  private free = 1;  // width of what is not covered, over the height

  constructor(canvas: HTMLElement) {
    this.eye.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.eye, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.94;
    this.controls.zoomSpeed = 0.7;
    this.controls.addEventListener('start', () => (this.way = undefined));
  }

  /** `taken`: so many pixels on the left are covered; the scene moves into the middle of the others. */
  resize(width: number, height: number, taken: number): void {
    this.height = height;
    this.free = (width - taken) / Math.max(1, height);
    this.eye.aspect = width / Math.max(1, height);
    this.eye.setViewOffset(width, height, -taken / 2, 0, width, height);
    this.eye.updateProjectionMatrix();
  }

  /** How large a pixel is, at a distance in front of the eye. */
  pixel_at(distance: number): number {
    return (2 * distance * Math.tan((this.eye.fov * Math.PI) / 360)) / this.height;
  }

  fit(extent: Extent, now_s: number, at_once: boolean): void {
    this.extent = extent;
    this.eye.near = 0.02 * extent.radius;
    this.eye.far = 40 * extent.radius;
    this.eye.updateProjectionMatrix();
    this.controls.minDistance = 0.3 * extent.radius;
    this.controls.maxDistance = 12 * extent.radius;
    this.look(kAzimuth, kElevation, now_s, at_once);
  }

  above(now_s: number): void {
    this.look(-Math.PI / 2, Math.PI / 2 - 0.002, now_s, false);
  }

  reset(now_s: number): void {
    this.look(kAzimuth, kElevation, now_s, false);
  }

  private look(azimuth: number, elevation: number, now_s: number, at_once: boolean): void {
    const extent = this.extent;
    if (extent === undefined) return;
    const half = (this.eye.fov * Math.PI) / 360;
    const narrow = Math.atan(Math.tan(half) * Math.min(1, this.free));
    const room = elevation > 1 ? 1.12 : 0.9;  // from above, what is high is near and looks larger
    const distance = (extent.radius * room) / Math.sin(narrow);
    const target = new three.Vector3(extent.center[0], extent.center[1], extent.center[2] - 0.06 * extent.radius);
    const level = Math.cos(elevation) * distance;
    const eye = new three.Vector3(Math.cos(azimuth) * level, Math.sin(azimuth) * level, Math.sin(elevation) * distance).add(target);
    this.go({ eye, target }, now_s, at_once || is_still());
  }

  private go(to: { eye: three.Vector3; target: three.Vector3 }, now_s: number, at_once: boolean): void {
    if (at_once) {
      this.way = undefined;
      this.eye.position.copy(to.eye);
      this.controls.target.copy(to.target);
      return;
    }
    this.way = { from: { eye: this.eye.position.clone(), target: this.controls.target.clone() }, to, begun_s: now_s };
  }

  /** Goes along with what is at this place from now on; undefined: nothing any more. */
  update(followed: Triple | undefined, now_s: number): void {
    if (this.way !== undefined) this.walk(this.way, now_s);
    if (followed !== undefined) {
      const target = new three.Vector3(...followed);
      const step = target.sub(this.controls.target);
      if (this.followed === undefined && !is_still()) step.multiplyScalar(0.12);
      else if (step.length() > 0) step.multiplyScalar(is_still() ? 1 : 0.2);
      this.controls.target.add(step);
      this.eye.position.add(step);
    }
    this.followed = followed;
    this.controls.update();
  }

  private walk(way: Way, now_s: number): void {
    const share = Math.min(1, (now_s - way.begun_s) / kWay_s);
    const smooth = share * share * (3 - 2 * share);
    this.controls.target.lerpVectors(way.from.target, way.to.target, smooth);
    // Around the load, not through it: the direction turns, the distance changes.
    const a = new three.Spherical().setFromVector3(turned(way.from.eye.clone().sub(way.from.target)));
    const b = new three.Spherical().setFromVector3(turned(way.to.eye.clone().sub(way.to.target)));
    const theta = a.theta + (((((b.theta - a.theta) % (2 * Math.PI)) + 3 * Math.PI) % (2 * Math.PI)) - Math.PI) * smooth;
    const at = new three.Vector3().setFromSpherical(
      new three.Spherical(a.radius + (b.radius - a.radius) * smooth, a.phi + (b.phi - a.phi) * smooth, theta),
    );
    this.eye.position.copy(this.controls.target).add(new three.Vector3(at.x, -at.z, at.y));
    if (share >= 1) this.way = undefined;
  }
}

/** Spherical takes y for up. */
function turned(v: three.Vector3): three.Vector3 {
  return new three.Vector3(v.x, v.z, -v.y);
}
