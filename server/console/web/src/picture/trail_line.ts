import { BufferAttribute, BufferGeometry, Color, Line, LineBasicMaterial } from 'three';

import { kTrailPoints, Trail } from '../logic/trail';
import type { Vec3 } from '../protocol/messages';

/** The path of one point in the last 3 s; older parts fade into the background. */
export class TrailLine {
  private readonly trail = new Trail();
  private readonly positions = new Float32Array(3 * kTrailPoints);
  private readonly shares = new Float32Array(kTrailPoints);
  private readonly colours = new Float32Array(3 * kTrailPoints);
  private readonly geometry = new BufferGeometry();
  readonly line: Line;
  private readonly mixed = new Color();

  constructor() {
    this.geometry.setAttribute('position', new BufferAttribute(this.positions, 3));
    this.geometry.setAttribute('color', new BufferAttribute(this.colours, 3));
    this.line = new Line(this.geometry, new LineBasicMaterial({ vertexColors: true }));
    // The bounds change with each frame; a line of 180 points costs less than its bounding sphere.
    this.line.frustumCulled = false;
  }

  update(t: number, x: Vec3 | null, colour: Color, background: Color, shown: boolean): void {
    this.trail.push(t, x);
    this.line.visible = shown;
    if (!shown) return;
    const n = this.trail.write(this.positions, this.shares, t);
    for (let i = 0; i < n; i += 1) {
      this.mixed.lerpColors(background, colour, this.shares[i] ?? 0).toArray(this.colours, 3 * i);
    }
    this.geometry.setDrawRange(0, n);
    for (const attribute of Object.values(this.geometry.attributes)) attribute.needsUpdate = true;
  }

  dispose(): void {
    this.geometry.dispose();
    (this.line.material as LineBasicMaterial).dispose();
  }
}
