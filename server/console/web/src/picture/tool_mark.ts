import { Color, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, RingGeometry, SphereGeometry } from 'three';

import { seatColour } from '../logic/seat_colour';
import type { SceneTool, State, ToolState, Vec3 } from '../protocol/messages';
import type { PictureOptions } from './hand_ghost';
import { ForceArrow } from './force_arrow';
import type { PictureColours } from './palette';
import { TrailLine } from './trail_line';

const kTip = new SphereGeometry(0.003, 20, 14);
const kContact = new RingGeometry(0.0045, 0.0062, 32);
const kInner = 0.0092;
const kOuter = 0.0112;
/** Gap between two bars of authority [rad]. */
const kGap = 0.06;

/** Bars around a tool: one arc per master, as long as its applied authority. */
class AuthorityBars {
  readonly group = new Group();
  private shown = '';

  update(applied: readonly number[], seats: readonly number[]): void {
    const key = applied.map((share) => Math.round(share * 200)).join(',') + seats.join(',');
    if (key === this.shown) return;
    this.shown = key;
    this.clear();
    let begin = Math.PI / 2;
    applied.forEach((share, i) => {
      const length = share * 2 * Math.PI;
      if (length > kGap * 1.5) {
        const arc = new RingGeometry(kInner, kOuter, 48, 1, begin - length + kGap / 2, length - kGap);
        this.group.add(new Mesh(arc, new MeshBasicMaterial({ color: seatColour(seats[i] ?? i), side: 2 })));
      }
      begin -= length;
    });
  }

  clear(): void {
    for (const child of [...this.group.children]) {
      if (child instanceof Mesh) {
        (child.geometry as RingGeometry).dispose();
        (child.material as MeshBasicMaterial).dispose();
      }
      this.group.remove(child);
    }
  }
}

/** Returns the place on the nearest touched surface, or the tool itself. */
function contactPlace(x: Vec3, scene: SceneTool | undefined): Vec3 {
  const place: [number, number, number] = [...x];
  for (const surface of [...(scene?.walls ?? []), ...(scene?.tissues ?? [])]) {
    const inside = surface.from_below ? x[surface.axis] >= surface.at_m : x[surface.axis] <= surface.at_m;
    if (inside) place[surface.axis] = surface.at_m;
  }
  return place;
}

/** One tool: its tip, the authority around it, the contact and its force. */
export class ToolMark {
  readonly group = new Group();
  private readonly body = new Group();
  private readonly material = new MeshLambertMaterial();
  private readonly bars = new AuthorityBars();
  private readonly contact = new Mesh(kContact, new MeshBasicMaterial({ side: 2 }));
  private readonly force = new ForceArrow();
  private readonly trail = new TrailLine();
  private readonly colour = new Color();

  constructor() {
    this.body.add(new Mesh(kTip, this.material), this.bars.group);
    this.group.add(this.body, this.contact, this.force.arrow, this.trail.line);
  }

  update(
    tool: ToolState,
    scene: SceneTool | undefined,
    state: State,
    masters: readonly number[],
    colours: PictureColours,
    options: PictureOptions,
  ): void {
    const x = tool.x;
    const touching = tool.touching === true && x !== null;
    this.body.visible = x !== null;
    this.contact.visible = touching;
    this.colour.copy(touching ? colours.contact : colours.tool);
    this.material.color.copy(this.colour);
    this.trail.update(state.t, x, this.colour, colours.background, options.trails);
    this.force.set(x, tool.f, options.forceScale, this.colour, options.forces);
    if (!x) return;
    this.body.position.set(x[0], x[1], x[2]);
    this.bars.update(tool.applied ?? tool.wanted ?? [], masters);
    if (touching) {
      this.contact.material.color.copy(colours.contact);
      this.contact.position.set(...contactPlace(x, scene));
      this.contact.scale.setScalar(1 + Math.min(2, (tool.depth_m ?? 0) / 0.002));
    }
  }

  /** Turns bars and contact towards the camera. */
  face(quaternion: Mesh['quaternion']): void {
    this.bars.group.quaternion.copy(quaternion);
    this.contact.quaternion.copy(quaternion);
  }

  dispose(): void {
    this.bars.clear();
    this.material.dispose();
    this.contact.material.dispose();
    this.force.dispose();
    this.trail.dispose();
  }
}
