import { ArrowHelper, Vector3, type Color } from 'three';

import type { Vec3 } from '../protocol/messages';

/** Longest arrow [m]. */
const kLengthMax = 0.06;
/** Forces below this one are not drawn [N]. */
const kForceMin = 0.02;

/** A force as an arrow. All arrows of the picture have one scale [m/N]. */
export class ForceArrow {
  readonly arrow = new ArrowHelper(new Vector3(1, 0, 0), new Vector3(), 0.01);
  private readonly direction = new Vector3();

  set(at: Vec3 | null, force: Vec3 | null, scale: number, colour: Color, shown: boolean): void {
    const size = force ? Math.hypot(...force) : 0;
    this.arrow.visible = shown && at !== null && force !== null && size > kForceMin && Number.isFinite(size);
    if (!this.arrow.visible || !at || !force) return;
    const length = Math.min(kLengthMax, size * scale);
    this.arrow.position.set(at[0], at[1], at[2]);
    this.arrow.setDirection(this.direction.set(force[0] / size, force[1] / size, force[2] / size));
    this.arrow.setLength(length, Math.min(0.004, length * 0.5), 0.0026);
    this.arrow.setColor(colour);
  }

  dispose(): void {
    this.arrow.dispose();
  }
}

/** Returns the force that an arrow of 10 mm stands for [N]: 0.1, 0.2, 0.5, 1, 2, 5, ... for the largest force limit. */
export function forceOfArrow(force_max_n: number): number {
  const wanted = Math.max(0.1, force_max_n / 4);
  const decade = 10 ** Math.floor(Math.log10(wanted) + 1e-9);
  const step = [1, 2, 5, 10].find((factor) => factor * decade >= wanted * (1 - 1e-9)) ?? 10;
  return step * decade;
}
