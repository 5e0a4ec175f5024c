// A swarm as the page hears it, without one: the load hangs on cables whose forces sum up to its weight at every phase.
//
// Carriers are ordered round a ring. Along each edge of the ring two attachments pull at each other with
// offset + amplitude sin(phase + heading): that balances itself out, so the load feels nothing, and makes every carrier
// fly a circle. What the load moves is made up: noise, and what a hurt adds.

const kGravity = 9.81;
const add = (a, b, s = 1) => a.map((value, i) => value + s * b[i]);
const norm = (a) => Math.hypot(...a);
const rounded = (value) => Number(value.toPrecision(7));

/** A stream of numbers in -1 .. 1 that is the same every time. */
function noise(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 31 - 1;
  };
}

export class MockSwarm {
  constructor(n, { mass_kg = 3.5 * n, rate_rad_s = 1.1 } = {}) {
    this.n = n;
    this.mass_kg = mass_kg;
    this.rate = rate_rad_s;
    this.ring = Math.max(1.3, 0.34 * n);
    this.center = [0, 0, 8];
    this.share_n = (mass_kg * kGravity) / n;
    this.amplitude_n = (0.16 * this.share_n) / Math.sin((2 * Math.PI) / Math.max(3, n));
    this.lean_n = (0.34 * this.share_n) / (2 * Math.sin(Math.PI / n));
    this.attachments = Array.from({ length: n }, (_, i) => {
      const a = (2 * Math.PI * i) / n;
      return [this.ring * Math.cos(a), this.ring * Math.sin(a), 0.3];
    });
    this.edges = this.attachments.map((from, i) => {
      const along = add(this.attachments[(i + 1) % n], from, -1);
      return { unit: along.map((value) => value / norm(along)), heading: Math.atan2(along[1], along[0]) };
    });
    this.random = noise(7);
    this.sway = [0, 0, 0];
    this.push = { force: [0, 0, 0], left_s: 0 };
    this.shove = [0, 0, 0];
    this.shove_speed = [0, 0, 0];
    this.phase = 0;
    this.pace = 0;
    this.wanted = 1;
    this.time_s = 0;
    this.strays = new Map();
  }

  period_s() {
    return (2 * Math.PI) / this.rate;
  }

  force_n(i, phase) {
    const pull = (edge) => this.amplitude_n * Math.sin(phase + edge.heading) - this.lean_n;
    const out = this.edges[i];
    const into = this.edges[(i + this.n - 1) % this.n];
    return add(add([0, 0, this.share_n], out.unit, pull(out)), into.unit, -pull(into));
  }

  carrier(i, phase) {
    const force = this.force_n(i, phase);
    const attachment = this.attachments[i];
    const rise = 4.6 + (i % 2) * 0.55 - attachment[2];
    const length = (rise * norm(force)) / force[2];
    const position = add(add(this.center, attachment), force, length / norm(force));
    return { position, length, tension: norm(force) };
  }

  step(dt_s) {
    this.time_s += dt_s;
    this.pace += Math.max(-0.25 * dt_s, Math.min(0.25 * dt_s, this.wanted - this.pace));
    this.phase = (this.phase + this.rate * this.pace * dt_s) % (2 * Math.PI);
    for (let axis = 0; axis < 3; ++axis) {
      this.sway[axis] += -this.sway[axis] * 1.5 * dt_s + 4e-6 * Math.sqrt(dt_s) * this.random();
      const pushed = this.push.left_s > 0 ? this.push.force[axis] / this.mass_kg : 0;
      this.shove_speed[axis] += (pushed - 9 * this.shove[axis] - 1.1 * this.shove_speed[axis]) * dt_s;
      this.shove[axis] += this.shove_speed[axis] * dt_s;
    }
    this.push.left_s -= dt_s;
  }

  displacement() {
    const along = this.phase * 2;
    const wobble = [1.6e-6 * Math.sin(along), 1.6e-6 * Math.cos(along * 1.5), 0.7e-6 * Math.sin(along * 3)];
    return add(add(this.sway, wobble), this.shove);
  }

  mission() {
    const points = 72;
    const corners = this.hull();
    const everyone = this.attachments.map((attachment, i) => {
      const path = Array.from({ length: points }, (_, p) => this.carrier(i, (2 * Math.PI * p) / points));
      const step_s = this.period_s() / points;
      const range = (values) => ({ min: Math.min(...values), max: Math.max(...values) });
      const next = (p) => path[(p + 1) % points];
      return {
        id: i + 1,
        attachment_b_m: attachment,
        radius_m: this.n > 12 ? 0.3 : 0.4,
        orbit_w_m: path.flatMap((point) => point.position.map(rounded)),
        certified: {
          tension_n: range(path.map((point) => point.tension)),
          length_m: range(path.map((point) => point.length)),
          speed_m_s: range(path.map((point, p) => norm(add(next(p).position, point.position, -1)) / step_s)),
          winch_rate_m_s: range(path.map((point, p) => (next(p).length - point.length) / step_s)),
          altitude_m: range(path.map((point) => point.position[2])),
        },
      };
    });
    return {
      name: `mock-${this.n}`,
      complete: true,
      plan: '1.1',
      period_s: this.period_s(),
      mass_kg: this.mass_kg,
      gravity_m_s2: kGravity,
      position_w_m: this.center,
      orientation_w_b: [1, 0, 0, 0],
      hull_b_m: corners.points,
      hull_faces: corners.faces,
      carriers: everyone,
      limits: {
        tension_n: { min: this.share_n * 0.6, max: this.share_n * 1.5 },
        length_m: { min: 3, max: 8 },
        speed_m_s: { min: 0.2, max: 3 },
        winch_rate_m_s: { min: -1, max: 1 },
        altitude_m: { min: '-Infinity', max: 'Infinity' },
      },
      displacement_max_m: 0.001,
      rotation_max_deg: 0.1,
      clearance_m: 0.31,
      clearance_between: 'carriers 1 and 2',
    };
  }

  /** A prism below the attachments. */
  hull() {
    const sides = Math.min(this.n, 12) < 5 ? 4 : Math.min(this.n, 12);
    const points = [];
    for (const z of [-0.3, 0.3])
      for (let i = 0; i < sides; ++i) {
        const a = (2 * Math.PI * i) / sides;
        points.push(this.ring * 1.02 * Math.cos(a), this.ring * 1.02 * Math.sin(a), z);
      }
    const faces = [];
    for (let i = 0; i < sides; ++i) {
      const j = (i + 1) % sides;
      faces.push(i, j, sides + j, i, sides + j, sides + i);
      if (i > 0 && j > 0) faces.push(0, j, i, sides, sides + i, sides + j);
    }
    return { points, faces };
  }

  frame(server_time_s) {
    const moved = this.displacement();
    const later = (this.phase + this.rate * this.pace * 0.01) % (2 * Math.PI);
    const carriers = this.attachments.map((_, i) => {
      const now = this.carrier(i, this.phase);
      const next = this.carrier(i, later);
      const stray = this.strays.get(i + 1) ?? 0;
      const position = add(now.position, [stray, 0.6 * stray, 0]);
      return {
        id: i + 1,
        heard: true,
        position_w_m: position.map(rounded),
        planned_w_m: now.position.map(rounded),
        deviation_m: rounded(Math.abs(stray)),
        tension_n: rounded(now.tension),
        length_m: rounded(now.length),
        speed_m_s: rounded(norm(add(next.position, now.position, -1)) / 0.01),
        winch_rate_m_s: rounded((next.length - now.length) / 0.01),
      };
    });
    let closest = { distance: Infinity, ids: [] };
    for (let i = 0; i < this.n; ++i)
      for (let j = i + 1; j < this.n; ++j) {
        const distance = norm(add(carriers[i].position_w_m, carriers[j].position_w_m, -1));
        if (distance < closest.distance) closest = { distance, ids: [i + 1, j + 1] };
      }
    return {
      server_time_s,
      swarm_time_s: this.time_s + 12,
      plan_time_s: this.time_s,
      phase_rad: this.phase,
      pace: this.pace,
      load_w_m: add(this.center, moved),
      load_orientation_w_b: [1, 0, 0, 0],
      displacement_w_m: moved,
      rotation_deg: 0.0001,
      residual: 1e-7,
      carriers,
      closest_m: Number.isFinite(closest.distance) ? rounded(closest.distance) : 'Infinity',
      closest: closest.ids,
    };
  }
}
