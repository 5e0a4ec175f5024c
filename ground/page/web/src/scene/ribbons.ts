// Lines of so many pixels, which fade: trails, orbits, the closest approach. All lines of one kind are one draw call.
//
// WebGL draws lines one pixel wide, whatever is asked for. So a line is a strip of triangles that the vertex shader
// spreads on the screen: every point is there twice, and knows the next one.

import * as three from 'three';
import type { Triple } from './geometry';

const kVertex = `
  attribute vec3 there;
  attribute float side;
  attribute float fade;
  attribute float along;
  attribute vec3 tone;
  uniform vec2 screen;
  uniform float width;
  varying float shade;
  varying float way;
  varying vec3 paint;
  void main() {
    vec4 a = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    vec4 b = projectionMatrix * modelViewMatrix * vec4(there, 1.0);
    vec2 step = (b.xy / b.w - a.xy / a.w) * screen;
    vec2 across = length(step) > 1e-5 ? normalize(vec2(-step.y, step.x)) : vec2(0.0);
    a.xy += across * side * width * mix(0.35, 1.0, fade) / screen * a.w;
    gl_Position = a;
    shade = fade;
    way = along;
    paint = tone;
  }`;

const kFragment = `
  uniform float opacity;
  uniform float dash;
  varying float shade;
  varying float way;
  varying vec3 paint;
  void main() {
    if (dash > 0.0 && fract(way / dash) > 0.55) discard;
    gl_FragColor = vec4(paint, opacity * shade);
  }`;

interface Options {
  width: number;    // CSS pixels
  opacity: number;
  dash?: number;    // metres of a dash and its gap
}

export class Ribbons {
  readonly mesh: three.Mesh<three.BufferGeometry, three.ShaderMaterial>;
  private readonly here: Float32Array;
  private readonly there: Float32Array;
  private readonly fade: Float32Array;
  private readonly along: Float32Array;
  private readonly tone: Float32Array;

  constructor(readonly lines: number, readonly points: number, options: Options) {
    const vertices = lines * points * 2;
    this.here = new Float32Array(vertices * 3);
    this.there = new Float32Array(vertices * 3);
    this.fade = new Float32Array(vertices);
    this.along = new Float32Array(vertices);
    this.tone = new Float32Array(vertices * 3);
    const side = new Float32Array(vertices).map((_, i) => (i % 2 === 0 ? 1 : -1));
    const corners: number[] = [];
    for (let line = 0; line < lines; ++line)
      for (let i = 0; i + 1 < points; ++i) {
        const at = (line * points + i) * 2;
        corners.push(at, at + 1, at + 2, at + 1, at + 3, at + 2);
      }
    const geometry = new three.BufferGeometry();
    const attribute = (name: string, values: Float32Array, size: number): void => {
      geometry.setAttribute(name, new three.BufferAttribute(values, size).setUsage(three.DynamicDrawUsage));
    };
    attribute('position', this.here, 3);
    attribute('there', this.there, 3);
    attribute('side', side, 1);
    attribute('fade', this.fade, 1);
    attribute('along', this.along, 1);
    attribute('tone', this.tone, 3);
    geometry.setIndex(corners);
    const material = new three.ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: {
        screen: { value: new three.Vector2(1, 1) },
        width: { value: options.width },
        opacity: { value: options.opacity },
        dash: { value: options.dash ?? 0 },
      },
      transparent: true,
      depthWrite: false,
      side: three.DoubleSide,
    });
    this.mesh = new three.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  set screen(size: { width: number; height: number }) {
    (this.mesh.material.uniforms['screen']!.value as three.Vector2).set(size.width, size.height);
  }

  set opacity(value: number) {
    this.mesh.material.uniforms['opacity']!.value = value;
  }

  set dash(value: number) {
    this.mesh.material.uniforms['dash']!.value = value;
  }

  /** Colours go to the screen as they are: 0 .. 255 in the screen's own space. */
  paint(line: number, tone: readonly number[], fade: (share: number) => number): void {
    for (let i = 0; i < this.points; ++i)
      for (let copy = 0; copy < 2; ++copy) {
        const at = (line * this.points + i) * 2 + copy;
        this.fade[at] = fade(i / (this.points - 1));
        for (let c = 0; c < 3; ++c) this.tone[at * 3 + c] = tone[c]! / 255;
      }
    this.renew('fade', 'tone');
  }

  /** The points of one line, x y z x y z ...; fewer than there is room for: the last one again. */
  lay(line: number, flat: ArrayLike<number>): void {
    const count = Math.floor(flat.length / 3);
    if (count === 0) return;
    let way = 0;
    for (let i = 0; i < this.points; ++i) {
      const at = Math.min(i, count - 1) * 3;
      const next = Math.min(i + 1, count - 1) * 3;
      const last = next === at && at >= 3 ? at - 3 : -1;  // the end goes on as it came
      for (let c = 0; c < 3; ++c) {
        const here = flat[at + c]!;
        const there = last >= 0 ? 2 * here - flat[last + c]! : flat[next + c]!;
        for (let copy = 0; copy < 2; ++copy) {
          const cell = ((line * this.points + i) * 2 + copy) * 3 + c;
          this.here[cell] = here;
          this.there[cell] = there;
        }
      }
      this.along[(line * this.points + i) * 2] = way;
      this.along[(line * this.points + i) * 2 + 1] = way;
      way += Math.hypot(flat[next]! - flat[at]!, flat[next + 1]! - flat[at + 1]!, flat[next + 2]! - flat[at + 2]!);
    }
    this.renew('position', 'there', 'along');
  }

  segment(line: number, from: Triple, to: Triple): void {
    this.lay(line, [...from, ...to]);
  }

  private renew(...names: string[]): void {
    for (const name of names) (this.mesh.geometry.getAttribute(name) as three.BufferAttribute).needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
