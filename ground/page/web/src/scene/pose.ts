// The scene at one moment, between two frames: what all parts of the scene are drawn from. Pure.

import type { FrameCarrier, Mission } from '../messages';
import { between, triple_between } from '../playback';
import type { Moment } from '../playback';
import { placed } from './geometry';
import type { Triple } from './geometry';

export interface CarrierPose {
  id: number;
  seen: boolean;          // it has a position
  heard: boolean;         // and tells it now
  position: Triple;
  planned: Triple;
  has_plan: boolean;
  attachment: Triple;
  tension_n: number;
  speed_m_s: number;
  deviation_m: number;
}

export interface Pose {
  load: Triple;
  orientation: [number, number, number, number];  // w x y z
  has_load: boolean;
  carriers: CarrierPose[];
}

export function pose_at(moment: Moment, mission: Mission | undefined, ids: number[]): Pose {
  const { before, after, share } = moment;
  const load: Triple = [0, 0, 0];
  let has_load = triple_between(before.load_w_m, after.load_w_m, share, load);
  let orientation = quaternion(after.load_orientation_w_b);
  if (!has_load && mission !== undefined && mission.position_w_m.length === 3) {
    load.splice(0, 3, ...mission.position_w_m);  // nobody measures the load: it is drawn where it is to hang
    orientation = quaternion(mission.orientation_w_b);
    has_load = true;
  }
  const earlier = new Map(before.carriers.map((carrier) => [carrier.id, carrier]));
  const later = new Map(after.carriers.map((carrier) => [carrier.id, carrier]));
  const attachments = new Map(mission?.carriers.map((carrier) => [carrier.id, carrier.attachment_b_m]));
  const carriers = ids.map((id) => {
    const attachment = placed(load, orientation, attachments.get(id) ?? []);
    return carrier_pose(id, earlier.get(id), later.get(id), share, attachment);
  });
  return { load, orientation, has_load, carriers };
}

function quaternion(wire: number[]): [number, number, number, number] {
  return wire.length === 4 ? (wire as [number, number, number, number]) : [1, 0, 0, 0];
}

function carrier_pose(
  id: number,
  before: FrameCarrier | undefined,
  after: FrameCarrier | undefined,
  share: number,
  attachment: Triple,
): CarrierPose {
  const from = before ?? after;
  const to = after ?? before;
  const position: Triple = [0, 0, 0];
  const planned: Triple = [0, 0, 0];
  const seen = triple_between(from?.position_w_m ?? [], to?.position_w_m ?? [], share, position);
  const has_plan = triple_between(from?.planned_w_m ?? [], to?.planned_w_m ?? [], share, planned);
  return {
    id,
    seen,
    heard: to?.heard ?? false,
    position,
    planned,
    has_plan,
    attachment,
    tension_n: between(from?.tension_n ?? 0, to?.tension_n ?? 0, share),
    speed_m_s: between(from?.speed_m_s ?? 0, to?.speed_m_s ?? 0, share),
    deviation_m: to?.deviation_m ?? 0,
  };
}
