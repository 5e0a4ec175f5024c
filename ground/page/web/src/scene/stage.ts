// The scene: what stands on it, the loop that draws it, and what a person does to it.

import * as three from 'three';
import { now_s } from '../connection';
import { css_color, element, found, say, show } from '../dom';
import type { Frame, FrameCarrier } from '../messages';
import type { Swarm } from '../swarm';
import type { Theme } from '../theme';
import { carrier_tone, rgb, tension_gradient, written_on } from '../tones';
import { good_displacement, metres, millimetres } from '../words';
import { Cables } from './cables';
import { Camera } from './camera';
import { Carriers } from './carriers';
import { extent, tension_range } from './geometry';
import type { Extent } from './geometry';
import { Ground } from './ground';
import { Labels } from './labels';
import { Load } from './load';
import { pose_at } from './pose';
import type { Pose } from './pose';
import { draws_by_processor, Pacer } from './quality';
import { Ribbons } from './ribbons';

const kAstray_m = 0.02;
const kClick_px = 5;
const kWide_px = 760;    // from here on the inset lies on the scene
const kInset_px = 210;

export class Stage {
  private readonly scene = new three.Scene();
  private readonly renderer: three.WebGLRenderer;
  private readonly camera: Camera;
  private readonly pacer: Pacer;
  private readonly load = new Load();
  private readonly cables = new Cables();
  private readonly carriers = new Carriers();
  private readonly ground = new Ground();
  private readonly labels: Labels;
  private readonly closest = new Ribbons(1, 2, { width: 1.5, opacity: 0.9, dash: 0.1 });
  private readonly sky = new three.HemisphereLight(0xffffff, 0x8899aa, 1.6);
  private readonly box = found('stage');
  private size = { width: 1, height: 1 };
  private extent: Extent | undefined;
  private fitted = '';
  private stale = true;
  private drawn_s = 0;
  private told_s = 0;
  following = false;

  private constructor(private readonly swarm: Swarm, private readonly theme: Theme, held: boolean) {
    const canvas = found<HTMLCanvasElement>('scene');
    const software = draws_by_processor(probe_renderer());
    this.pacer = new Pacer(software, held);
    this.renderer = new three.WebGLRenderer({ canvas, antialias: !software || held, alpha: true, powerPreference: 'high-performance' });
    this.renderer.shadowMap.type = three.PCFSoftShadowMap;
    this.camera = new Camera(canvas);
    this.labels = new Labels(found('labels'));
    this.scene.add(this.sky, this.ground.group, this.load.group, this.carriers.group, this.closest.mesh);
    this.apply_quality();
    new ResizeObserver(() => this.resize()).observe(this.box);
    this.resize();
    const again = (): void => void (this.stale = true);
    for (const change of ['mission', 'selection', 'reset', 'status'] as const) swarm.on(change, again);
    theme.on_change(again);
    this.choose_by_pointer(canvas);
    requestAnimationFrame(() => this.draw());
  }

  /** Absent where the browser has no WebGL: everything else on the page works without. */
  static begin(swarm: Swarm, theme: Theme, held: boolean): Stage | undefined {
    try {
      return new Stage(swarm, theme, held);
    } catch {
      found('labels').append(element('p', { class: 'no-scene', text: 'This browser cannot draw in three dimensions (no WebGL). Everything else works.' }));
      return undefined;
    }
  }

  // ------------------------------------------------------------------------------------------------------ building

  private resize(): void {
    this.size = { width: Math.max(1, this.box.clientWidth), height: Math.max(1, this.box.clientHeight) };
    this.renderer.setSize(this.size.width, this.size.height, false);
    this.camera.resize(this.size.width, this.size.height, this.size.width > kWide_px ? kInset_px : 0);
    this.carriers.screen = this.size;
    this.closest.screen = this.size;
  }

  private apply_quality(): void {
    const { pixels, shadows } = this.pacer.quality;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2) * Math.min(1, pixels / Math.min(window.devicePixelRatio, 2)));
    this.renderer.setSize(this.size.width, this.size.height, false);
    this.renderer.shadowMap.enabled = shadows;
    this.ground.light.castShadow = shadows;
  }

  private rebuild(): void {
    this.stale = false;
    const { mission, ids: swarm_ids } = this.swarm;
    const reach = extent(mission, this.swarm.frame);
    if (reach === undefined) return;
    const key = JSON.stringify([mission?.name, mission?.plan, mission?.complete, swarm_ids, this.swarm.hello?.server]);
    if (key !== this.fitted) {
      const first = this.extent === undefined || distance(this.extent, reach) > 0.5 * reach.radius;
      this.extent = reach;
      this.fitted = key;
      this.load.build(mission, reach);
      this.scene.remove(this.cables.mesh);
      this.cables.build(mission, swarm_ids.length);
      this.scene.add(this.cables.mesh);
      this.carriers.build(mission, swarm_ids, reach);
      this.ground.build(reach);
      this.labels.build(swarm_ids);
      this.closest.dash = reach.radius * 0.03;
      this.carriers.screen = this.size;
      if (first) this.camera.fit(reach, now_s(), true);
      this.tell_legend();
    }
    this.repaint();
  }

  private repaint(): void {
    const { ids, frame, status } = this.swarm;
    const paper = this.theme.paper;
    const heard = new Map(frame?.carriers.map((carrier) => [carrier.id, carrier.heard]));
    const states = new Map(status?.processes.filter((process) => process.carrier !== 0).map((process) => [process.carrier, process]));
    this.load.repaint();
    this.cables.repaint();
    this.ground.repaint();
    this.sky.groundColor.set(css_color('sky-ground'));
    this.closest.paint(0, rgb(css_color('muted')), () => 1);
    this.carriers.repaint(paper, (i) => heard.get(ids[i]!) ?? false, (i) => this.swarm.shows(ids[i]!));
    ids.forEach((id, i) => {
      const process = states.get(id);
      const bad = process !== undefined && !process.well;
      const tone = carrier_tone(i, paper);
      this.labels.paint(i, tone, written_on(tone), this.swarm.shows(id) ? 'full' : 'faint', bad);
    });
    found('tension-map').style.background = tension_gradient(paper);
  }

  private tell_legend(): void {
    const { min, max } = tension_range(this.swarm.mission);
    const limits = this.swarm.mission?.limits.tension_n;
    const limited = limits !== undefined && Number.isFinite(limits.max) && limits.max > 0;
    say(found('tension-min'), `${tidy(min)} N`);
    say(found('tension-max'), `${tidy(max)} N`);
    say(found('tension-what'), limited ? 'tension, within its limits' : 'tension');
    const { clearance_m = 0, clearance_between = '' } = this.swarm.mission ?? {};
    const touching = clearance_m > 0 && Number.isFinite(clearance_m);
    say(found('clearance'), touching ? `a carrier may stray ${metres(clearance_m)} before anything touches` : '');
    found('clearance').title = clearance_between;
    if (this.extent !== undefined)
      say(found('ground-says'), `grid ${metres(this.ground.cell_m)} · ground drawn ${metres(this.extent.lowest - this.extent.floor)} below all`);
  }

  // ------------------------------------------------------------------------------------------------------- drawing

  private draw(): void {
    requestAnimationFrame(() => this.draw());
    const now = now_s();
    if (!this.pacer.is_due(now)) return;
    const interval_s = now - this.drawn_s;
    this.drawn_s = now;
    if (this.stale) this.rebuild();
    const moment = this.swarm.playback.at(now);
    if (moment !== undefined && this.extent !== undefined) {
      const pose = pose_at(moment, this.swarm.mission, this.swarm.ids);
      const time_s = moment.before.server_time_s + (moment.after.server_time_s - moment.before.server_time_s) * moment.share;
      this.place(pose, time_s, now);
    }
    this.renderer.render(this.scene, this.camera.eye);
    if (this.pacer.drew(interval_s, now)) this.apply_quality();
    if (now - this.told_s > 0.5) this.tell(now);
  }

  private place(pose: Pose, time_s: number, now: number): void {
    const eye = this.camera.eye;
    const shows = (id: number): boolean => this.swarm.shows(id);
    const pixel = (at: three.Vector3): number => this.camera.pixel_at(at.distanceTo(eye.position));
    const followed = this.following ? pose.carriers.find((carrier) => carrier.id === this.swarm.selected[0] && carrier.seen) : undefined;
    this.camera.update(followed?.position, now);
    this.load.place(pose);
    this.cables.place(pose, this.theme.paper, (at) => 1.15 * pixel(at), shows);
    const spot = new three.Vector3();
    this.carriers.place(pose, time_s, this.swarm.playback, (carrier) => 5 * pixel(spot.set(...carrier.position)));
    pose.carriers.forEach((carrier, i) => this.labels.place(i, carrier.seen ? carrier.position : undefined, eye, this.size));
    this.labels.put_below(this.labels.load, pose.has_load ? this.load.corners(pose) : [], eye, this.size);
    this.place_closest(pose);
  }

  private place_closest(pose: Pose): void {
    const frame = this.swarm.frame;
    const pair = (frame?.closest ?? []).map((id) => pose.carriers.find((carrier) => carrier.id === id));
    const [a, b] = pair;
    const known = frame !== undefined && a !== undefined && b !== undefined && a.seen && b.seen;
    this.closest.mesh.visible = known;
    if (!known) {
      show(this.labels.closest, false);
      return;
    }
    this.closest.segment(0, a.position, b.position);
    const middle = a.position.map((value, axis) => (value + b.position[axis]!) / 2) as [number, number, number];
    this.labels.put(this.labels.closest, middle, this.camera.eye, this.size);
  }

  /** What is read rather than seen: twice a second is often enough, and a layout each time would not be cheap. */
  private tell(now: number): void {
    this.told_s = now;
    const { frame, ids, within_m } = this.swarm;
    document.body.dataset['fps'] = this.pacer.frames_per_second.toFixed(0);
    say(found('fps'), `${this.pacer.frames_per_second.toFixed(0)} pictures/s`);
    if (frame === undefined) return;
    say(this.labels.closest, Number.isFinite(frame.closest_m) ? metres(frame.closest_m) : '');
    say(this.labels.load, within_m === undefined ? '' : `${within_m <= good_displacement(this.swarm.mission) ? 'still, within' : 'swings within'} ${millimetres(within_m)}`);
    this.tell_tensions(frame);
    const by_id = new Map(frame.carriers.map((carrier) => [carrier.id, carrier]));
    ids.forEach((id, i) => {
      const carrier = by_id.get(id);
      const chosen = this.swarm.selected.includes(id) || (ids.length <= 8 && this.swarm.selected.length === 0);
      this.labels.tell(i, carrier === undefined ? '' : label_words(carrier, chosen));
    });
  }

  /** Where on the scale all cables are now. */
  private tell_tensions(frame: Frame): void {
    const { min, max } = tension_range(this.swarm.mission);
    const shares = frame.carriers.filter((carrier) => carrier.heard).map((carrier) => (carrier.tension_n - min) / (max - min));
    const span = found('tension-span');
    show(span, shares.length > 0);
    if (shares.length === 0) return;
    const [low, high] = [Math.min(...shares), Math.max(...shares)].map((share) => Math.min(1, Math.max(0, share))) as [number, number];
    span.style.left = `${(low * 100).toFixed(1)}%`;
    span.style.width = `${Math.max(2, (high - low) * 100).toFixed(1)}%`;
  }

  // -------------------------------------------------------------------------------------------------------- asking

  above(): void {
    this.following = false;
    this.camera.above(now_s());
  }

  reset(): void {
    this.following = false;
    this.camera.reset(now_s());
  }

  private choose_by_pointer(canvas: HTMLCanvasElement): void {
    let down = { x: 0, y: 0 };
    canvas.addEventListener('pointerdown', (event) => (down = { x: event.clientX, y: event.clientY }));
    canvas.addEventListener('pointerup', (event) => {
      if (Math.hypot(event.clientX - down.x, event.clientY - down.y) > kClick_px) return;
      const box = canvas.getBoundingClientRect();
      const index = this.labels.near(event.clientX - box.left, event.clientY - box.top);
      if (index === undefined) this.swarm.select_none();
      else this.swarm.select(this.swarm.ids[index]!, event.shiftKey || event.ctrlKey || event.metaKey);
    });
  }
}

function distance(a: Extent, b: Extent): number {
  return Math.hypot(...a.center.map((value, axis) => value - b.center[axis]!)) + Math.abs(a.radius - b.radius);
}

/** A carrier that strays says so, whether it is selected or not. */
function label_words(carrier: FrameCarrier, chosen: boolean): string {
  const speed = chosen && carrier.heard ? `${carrier.speed_m_s.toFixed(2)} m/s` : '';
  const astray = !carrier.heard ? 'not heard' : carrier.deviation_m > kAstray_m ? `${metres(carrier.deviation_m)} off` : '';
  return [speed, astray].filter(Boolean).join(' · ');
}

function tidy(value: number): string {
  return String(Number(value.toPrecision(3)));
}

/** The renderer's name, from a context that is given back: the real one is made to fit. */
function probe_renderer(): string {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = context != null && names != null ? String(context.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}
