import {
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  SphereGeometry,
  TorusGeometry,
  Color,
  Vector3,
} from 'three';

import type { SceneSeat, SeatState } from '../protocol/messages';
import { isClipping } from '../logic/limits';
import { seatColour } from '../logic/seat_colour';
import { t } from '../strings/strings';
import { ForceArrow } from './force_arrow';
import { Label } from './label';
import type { PictureColours } from './palette';
import { TrailLine } from './trail_line';

const kBall = new SphereGeometry(0.0042, 20, 14);
const kHandle = new CylinderGeometry(0.0017, 0.0026, 0.02, 12);
const kRing = new TorusGeometry(0.0066, 0.0007, 6, 24);

export interface PictureOptions {
  trails: boolean;
  forces: boolean;
  names: boolean;
  /** Length of an arrow per force [m/N]. */
  forceScale: number;
  reducedMotion: boolean;
}

/** The hand of one seat: a translucent ball with a handle, its name, its force and its trail. */
export class HandGhost {
  readonly group = new Group();
  private readonly body = new Group();
  private readonly place = new Vector3();
  private readonly colour: Color;
  private readonly material: MeshLambertMaterial;
  private readonly ring: Mesh<TorusGeometry, MeshBasicMaterial>;
  readonly label: Label;
  private readonly force = new ForceArrow();
  private readonly trail = new TrailLine();

  constructor(private readonly index: number) {
    this.colour = new Color(seatColour(index));
    this.label = new Label(seatColour(index));
    this.material = new MeshLambertMaterial({ color: this.colour, transparent: true, opacity: 0.62 });
    const handle = new Mesh(kHandle, this.material);
    // The handle of a pen points up and towards the person.
    handle.rotation.set(Math.PI / 2 + 0.6, 0, 0);
    handle.position.set(0, -0.006, 0.009);
    this.ring = new Mesh(kRing, new MeshBasicMaterial({ color: '#b42318' }));
    this.body.add(new Mesh(kBall, this.material), handle, this.ring);
    this.group.add(this.body, this.force.arrow, this.trail.line);
  }

  update(
    seat: SeatState,
    scene: SceneSeat | undefined,
    now: number,
    colours: PictureColours,
    options: PictureOptions,
  ): void {
    const present = seat.x !== null && seat.taken !== false;
    this.body.visible = present;
    this.label.show(present && options.names);
    this.trail.update(now, present ? seat.x : null, this.colour, colours.background, options.trails);
    this.force.set(present ? seat.x : null, seat.f, options.forceScale, this.colour, options.forces);
    if (!present || !seat.x) return;
    this.body.position.set(seat.x[0], seat.x[1], seat.x[2]);
    this.material.opacity = seat.heard === false ? 0.2 : seat.engaged === false ? 0.34 : 0.72;
    const clipping = isClipping(seat, scene);
    this.ring.visible = clipping;
    if (clipping) {
      this.ring.material.color.copy(colours.limit);
      this.ring.scale.setScalar(options.reducedMotion ? 1.2 : 1.15 + 0.2 * Math.abs(Math.sin(now * 6)));
    }
    const name = scene?.name ?? String(this.index + 1);
    this.label.set(clipping ? `${name} · ${t('picture.limit')}` : name, clipping);
  }

  /** Place of the label [m], above the hand. */
  get top(): Vector3 {
    return this.place.copy(this.body.position).setZ(this.body.position.z + 0.021);
  }

  /** Turns the ring towards the camera. */
  face(quaternion: Mesh['quaternion']): void {
    this.ring.quaternion.copy(quaternion);
  }

  dispose(): void {
    this.material.dispose();
    this.ring.material.dispose();
    this.force.dispose();
    this.trail.dispose();
  }
}
