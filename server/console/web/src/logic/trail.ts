import type { Vec3 } from '../protocol/messages';
import { Ring } from './ring';

/** Length of a trail [s]. */
export const kTrailSeconds = 3;
/** Points of one trail: at most 60 per second. */
export const kTrailPoints = 180;

/** The last 3 s of one point's path. */
export class Trail {
  private readonly points = new Ring<{ t: number; x: Vec3 }>(kTrailPoints);

  get length(): number {
    return this.points.length;
  }

  clear(): void {
    this.points.clear();
  }

  /** @param t session time [s]; a time before the newest one begins a new trail */
  push(t: number, x: Vec3 | null): void {
    const newest = this.points.newest;
    if (newest && t < newest.t) this.clear();
    this.points.dropWhile((point) => t - point.t > kTrailSeconds);
    if (x === null) return;
    if (newest && t - newest.t < kTrailSeconds / kTrailPoints - 1e-9 && this.points.length > 0) return;
    this.points.push({ t, x });
  }

  /** Writes positions (3 numbers per point) and fading shares (1 per point, 0 old, 1 new). Returns the number of points. */
  write(positions: Float32Array, shares: Float32Array, now: number): number {
    const n = Math.min(this.points.length, shares.length, Math.floor(positions.length / 3));
    for (let i = 0; i < n; i += 1) {
      const point = this.points.at(i);
      if (!point) continue;
      positions.set(point.x, 3 * i);
      shares[i] = Math.max(0, 1 - (now - point.t) / kTrailSeconds);
    }
    return n;
  }
}
