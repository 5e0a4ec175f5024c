// The load: its real hull, the attachments on it. A load whose shape nobody told is a ball with a rod to each attachment.

import * as three from 'three';
import type { Mission } from '../messages';
import { css_color } from '../dom';
import { placed } from './geometry';
import type { Extent, Triple } from './geometry';
import type { Pose } from './pose';

export class Load {
  readonly group = new three.Group();
  private hull: Triple[] = [];  // its corners, in the body
  private readonly body = new three.MeshLambertMaterial({ flatShading: true });
  private readonly edges = new three.LineBasicMaterial({ transparent: true, opacity: 0.55 });
  private readonly dots = new three.MeshBasicMaterial();

  build(mission: Mission | undefined, extent: Extent): void {
    for (const child of [...this.group.children]) {
      this.group.remove(child);
      if (child instanceof three.Mesh || child instanceof three.LineSegments) (child.geometry as three.BufferGeometry).dispose();
    }
    const attachments = (mission?.carriers ?? []).map((carrier) => carrier.attachment_b_m).filter((point) => point.length === 3);
    this.hull = [[0, 0, -0.05 * extent.radius]];
    for (let i = 0; i + 2 < (mission?.hull_b_m.length ?? 0); i += 3) this.hull.push(mission!.hull_b_m.slice(i, i + 3) as Triple);
    if (mission !== undefined && sound(mission)) this.add_hull(mission);
    else this.add_point(attachments, extent);
    this.add_attachments(attachments, extent);
  }

  private add_hull(mission: Mission): void {
    const shape = new three.BufferGeometry();
    shape.setAttribute('position', new three.Float32BufferAttribute(mission.hull_b_m, 3));
    shape.setIndex(mission.hull_faces);
    const flat = shape.toNonIndexed();
    flat.computeVertexNormals();
    shape.dispose();
    this.add_solid(flat);
    this.group.add(new three.LineSegments(new three.EdgesGeometry(flat, 8), this.edges));
  }

  private add_point(attachments: number[][], extent: Extent): void {
    const size = 0.045 * extent.radius;
    this.add_solid(new three.IcosahedronGeometry(size, 2));
    for (const [x = 0, y = 0, z = 0] of attachments) {
      const end = new three.Vector3(x, y, z);
      if (end.length() < size) continue;
      const rod = new three.CylinderGeometry(0.18 * size, 0.18 * size, end.length(), 8);
      rod.translate(0, end.length() / 2, 0);
      rod.applyQuaternion(new three.Quaternion().setFromUnitVectors(new three.Vector3(0, 1, 0), end.clone().normalize()));
      this.add_solid(rod);
    }
  }

  private add_solid(geometry: three.BufferGeometry): void {
    const mesh = new three.Mesh(geometry, this.body);
    mesh.castShadow = true;
    this.group.add(mesh);
  }

  private add_attachments(attachments: number[][], extent: Extent): void {
    const dots = new three.InstancedMesh(new three.SphereGeometry(0.009 * extent.radius, 10, 8), this.dots, attachments.length);
    const place = new three.Matrix4();
    attachments.forEach(([x = 0, y = 0, z = 0], i) => dots.setMatrixAt(i, place.makeTranslation(x, y, z)));
    this.group.add(dots);
  }

  /** In the world. */
  corners(pose: Pose): Triple[] {
    return this.hull.map((corner) => placed(pose.load, pose.orientation, corner));
  }

  repaint(): void {
    this.body.color.set(css_color('load-face'));
    this.edges.color.set(css_color('ink'));
    this.dots.color.set(css_color('ink'));
  }

  place(pose: Pose): void {
    const [w, x, y, z] = pose.orientation;
    this.group.visible = pose.has_load;
    this.group.position.set(...pose.load);
    this.group.quaternion.set(x, y, z, w);
  }
}

function sound(mission: Mission): boolean {
  const corners = Math.floor(mission.hull_b_m.length / 3);
  return corners >= 4 && mission.hull_faces.length >= 12 && mission.hull_faces.every((corner) => corner < corners);
}
