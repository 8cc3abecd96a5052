import type { SeatState, State, ToolState, Vec3 } from '../protocol/messages';

/** One state with the time of the gateway when it was sent, and the time of the page when it arrived [ms]. */
export interface TimedState {
  state: State;
  wall_ms: number;
  received_ms: number;
}

/** Distance above which a motion is a jump, such as a seat that joins again [m]. A jump is not interpolated. */
export const kJump = 0.05;

/** Returns a + (b - a) share, or `b` if one is unknown or the distance is a jump. */
export function mixVector(a: Vec3 | null, b: Vec3 | null, share: number): Vec3 | null {
  if (a === null || b === null) return b;
  const distance = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  if (!(distance <= kJump)) return b;
  return [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share, a[2] + (b[2] - a[2]) * share];
}

/** Forces change quickly in contact, therefore a force of any distance is interpolated. */
function mixForce(a: Vec3 | null, b: Vec3 | null, share: number): Vec3 | null {
  if (a === null || b === null) return b;
  return [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share, a[2] + (b[2] - a[2]) * share];
}

function mixSeat(a: SeatState | undefined, b: SeatState, share: number): SeatState {
  return a === undefined || a.person !== b.person
    ? b
    : { ...b, x: mixVector(a.x, b.x, share), f: mixForce(a.f, b.f, share) };
}

function mixTool(a: ToolState | undefined, b: ToolState, share: number): ToolState {
  return a === undefined ? b : { ...b, x: mixVector(a.x, b.x, share), f: mixForce(a.f, b.f, share) };
}

/** Returns the state at `share` in [0, 1] of the way from `a` to `b`. Words and flags are those of `b`. */
export function mixStates(a: State, b: State, share: number): State {
  if (share >= 1 || a.seats.length !== b.seats.length || a.tools.length !== b.tools.length) return b;
  return {
    ...b,
    t: a.t + (b.t - a.t) * share,
    seats: b.seats.map((seat, i) => mixSeat(a.seats[i], seat, share)),
    tools: b.tools.map((tool, i) => mixTool(a.tools[i], tool, share)),
  };
}
