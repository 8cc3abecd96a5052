import type { Vec3 } from '../protocol/messages';

/** Largest distance of the intended hand from the start, per axis [m]: the reach of the keys in tandem-client. */
export const kReach = 0.06;
/** Motion per key press [m], and speed at full deflection of a gamepad [m/s]. */
export const kKeyStep = 0.005;
export const kStickSpeed = 0.12;
/** Deflection of a stick that counts as rest. */
export const kDeadZone = 0.12;
/** Frames of the pointer [1/s]: below the gateway's limit together with acknowledgements. */
export const kPointerRate = 45;

export type Axis = 0 | 1 | 2;
/** Views onto the device: to the right and up, or to the right and away. */
export type Plane = 'front' | 'above';

const bound = (value: number): number => (Number.isFinite(value) ? Math.min(kReach, Math.max(-kReach, value)) : 0);

/** The intended hand of the browser seat [m]: x to the right, y away from the person, z up. */
export class PointerDevice {
  private position: [number, number, number] = [0, 0, 0];
  private grips = new Set<string>();
  plane: Plane = 'front';

  get x(): Vec3 {
    return [...this.position];
  }

  /** The person holds the device: with pointer, key or gamepad. */
  get pressed(): boolean {
    return this.grips.size > 0;
  }

  grip(source: string, held: boolean): void {
    if (held) this.grips.add(source);
    else this.grips.delete(source);
  }

  release(): void {
    this.grips.clear();
  }

  /** Continues at the hand's position, so that a seat that is taken does not jump. */
  moveTo(x: Vec3): void {
    this.position = [bound(x[0]), bound(x[1]), bound(x[2])];
  }

  /** @param right,up place on the pad in [-1, 1] */
  pointAt(right: number, up: number): void {
    this.position[0] = bound(right * kReach);
    this.position[this.vertical()] = bound(up * kReach);
  }

  step(axis: Axis, distance_m: number): void {
    this.position[axis] = bound(this.position[axis] + distance_m);
  }

  /** @param sticks deflections to the right, away and up in [-1, 1]; dt_s [s] since the last call */
  stick(sticks: Vec3, dt_s: number): void {
    const dt = Math.min(0.1, Math.max(0, dt_s));
    sticks.forEach((value, axis) => {
      const size = Math.abs(value);
      if (!(size > kDeadZone)) return;
      const rest = Math.sign(value) * ((Math.min(1, size) - kDeadZone) / (1 - kDeadZone));
      this.step(axis as Axis, rest * kStickSpeed * dt);
    });
  }

  /** Returns the place of a position on the pad in [-1, 1], to the right and up. */
  place(x: Vec3): [number, number] {
    return [x[0] / kReach, x[this.vertical()] / kReach];
  }

  private vertical(): 1 | 2 {
    return this.plane === 'front' ? 2 : 1;
  }
}
