import type { Scene, SceneSeat } from '../protocol/messages';

/** Ticks between the announcement of a transfer and its begin. */
export const kAnnouncementTicks = 50;

/** Returns the seats of a scene that may have authority, in the order of the vectors. */
export function mastersOf(scene: Scene | null): SceneSeat[] {
  return scene?.seats.filter((seat) => seat.kind === 'MASTER') ?? [];
}

/** Smallest and largest share of a hand-over [%]. */
export const kShareRange = [5, 100] as const;

/** Returns the share that a person typed in percent, in [0, 1]; null: it is no number in kShareRange. */
export function typedShare(text: string): number | null {
  const percent = text.trim() === '' ? NaN : Number(text);
  return percent >= kShareRange[0] && percent <= kShareRange[1] ? percent / 100 : null;
}

const clamp = (share: number): number => (share >= 0 ? Math.min(1, share) : 0);

/**
 * Returns shares with sum exactly 1 as the gateway checks it (within 1e-9). The largest share takes the rounding error.
 * A vector of zeros or of invalid numbers becomes equal shares.
 */
export function normalized(alpha: readonly number[]): number[] {
  const valid = alpha.map(clamp);
  const sum = valid.reduce((a, b) => a + b, 0);
  if (valid.length === 0) return [];
  const shares = sum > 0 ? valid.map((share) => share / sum) : valid.map(() => 1 / valid.length);
  const rest = 1 - shares.reduce((a, b) => a + b, 0);
  const largest = shares.indexOf(Math.max(...shares));
  return shares.map((share, i) => (i === largest ? clamp(share + rest) : share));
}

/** Returns `alpha` with share `value` for `index`. The others keep their ratio; without one, they get equal shares. */
export function withShare(alpha: readonly number[], index: number, value: number): number[] {
  if (index < 0 || index >= alpha.length) return normalized(alpha);
  if (alpha.length === 1) return [1];
  const own = clamp(value);
  const others = alpha.map((share, i) => (i === index ? 0 : clamp(share)));
  const sum = others.reduce((a, b) => a + b, 0);
  const shares = others.map((share, i) =>
    i === index ? own : sum > 0 ? (share / sum) * (1 - own) : (1 - own) / (alpha.length - 1),
  );
  return normalized(shares);
}

/** All authority for one seat: a demonstration by the instructor, or the evaluation of a trainee. */
export function allTo(masters: number, index: number): number[] {
  return Array.from({ length: masters }, (_, i) => (i === index ? 1 : 0));
}

/** Returns the index of the instructor's seat, or of the first one. */
export function instructorIndex(masters: readonly SceneSeat[]): number {
  return Math.max(
    0,
    masters.findIndex((seat) => seat.role === 'INSTRUCTOR'),
  );
}

/** Seats that an evaluation can be about: trainees, or all but the instructor if the scene names no trainee. */
export function traineeIndices(masters: readonly SceneSeat[]): number[] {
  const indices = masters.map((_, i) => i);
  const trainees = indices.filter((i) => masters[i]?.role === 'TRAINEE');
  return trainees.length > 0 ? trainees : indices.filter((i) => i !== instructorIndex(masters));
}

/** Guidance: half for the instructor, the other half in equal shares for the trainees. */
export function guidance(masters: readonly SceneSeat[]): number[] {
  const instructor = instructorIndex(masters);
  const trainees = traineeIndices(masters).filter((i) => i !== instructor);
  if (trainees.length === 0) return allTo(masters.length, instructor);
  return masters.map((_, i) => (i === instructor ? 0.5 : trainees.includes(i) ? 0.5 / trainees.length : 0));
}

/** Returns whether two vectors are equal within half a percent, the resolution of the display. */
export function sameShares(a: readonly number[] | null, b: readonly number[] | null): boolean {
  if (a === null || b === null || a.length !== b.length) return false;
  return a.every((share, i) => Math.abs(share - (b[i] ?? 0)) < 0.005);
}
