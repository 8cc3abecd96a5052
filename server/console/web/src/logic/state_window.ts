import type { State } from '../protocol/messages';
import { mixStates, type TimedState } from './interpolation';
import { Ring } from './ring';

/** States that the page keeps: some 130 ms at 60 Hz. */
export const kStatesKept = 8;
/** Interval that is assumed before two states arrived [ms]. */
const kPeriod = 1000 / 60;
/** The page draws at most this long behind the newest state [ms]. */
const kHoldMax = 60;
/** Drift between both clocks that the page follows: 100 µs per second. */
const kDrift = 1e-4;
/** Without a new state for this long, the picture is out of date [ms]. */
export const kOutOfDate = 500;

export interface Drawn {
  state: State;
  /** Age of what is drawn: transport, waiting and interpolation [ms]. */
  delay_ms: number;
  /** Time since the newest state arrived [ms]. */
  silence_ms: number;
  outOfDate: boolean;
}

/**
 * The newest states and the one to draw now. The page draws a little behind the newest state and interpolates between two.
 * Clocks of gateway and page differ by an unknown offset; the smallest difference seen is transport time zero plus half of
 * the smallest round trip of a request.
 */
export class StateWindow {
  private readonly states = new Ring<TimedState>(kStatesKept);
  private offset: number | null = null;
  private offsetAt = 0;
  private interval = kPeriod;
  private roundTrip = 0;
  private roundTripKnown = false;
  /** States that were never drawn because a newer one came before the next frame of the screen. */
  skipped = 0;
  received = 0;
  private drawn = -1;

  get newest(): State | null {
    return this.states.newest?.state ?? null;
  }

  clear(): void {
    this.states.clear();
    this.offset = null;
    this.interval = kPeriod;
    this.drawn = -1;
  }

  /** Round trip of a request that the gateway answers by itself [ms]. */
  addRoundTrip(ms: number): void {
    if (!(ms >= 0)) return;
    this.roundTrip = this.roundTripKnown ? Math.min(this.roundTrip, ms) : ms;
    this.roundTripKnown = true;
  }

  /** @param now_ms time of the page, monotonic [ms] */
  push(state: State, now_ms: number): void {
    this.received += 1;
    const last = this.states.newest;
    // Another run of the gateway counts from the beginning again.
    if (last && state.n <= last.state.n) this.clear();
    const previous = this.states.newest;
    if (previous && previous.state.n > this.drawn) this.skipped += 1;
    const wall_ms = state.wall_us === null ? now_ms : state.wall_us / 1000;
    const difference = now_ms - wall_ms;
    if (this.offset === null) this.offset = difference;
    else this.offset = Math.min(difference, this.offset + Math.max(0, now_ms - this.offsetAt) * kDrift);
    this.offsetAt = now_ms;
    if (previous) {
      const step = wall_ms - previous.wall_ms;
      if (step > 0 && step < 1000) this.interval += (step - this.interval) * 0.1;
    }
    this.states.push({ state, wall_ms, received_ms: now_ms });
  }

  /** Returns what to draw now, or null before the first state. */
  sample(now_ms: number): Drawn | null {
    const newest = this.states.newest;
    if (newest === undefined || this.offset === null) return null;
    this.drawn = newest.state.n;
    const gatewayNow = now_ms - this.offset;
    const playhead = gatewayNow - Math.min(kHoldMax, this.interval * 1.2);
    const [state, wall_ms] = this.stateAt(playhead, newest);
    const silence_ms = Math.max(0, now_ms - newest.received_ms);
    return {
      state,
      delay_ms: Math.max(0, gatewayNow - wall_ms) + this.roundTrip / 2,
      silence_ms,
      outOfDate: silence_ms > kOutOfDate,
    };
  }

  /** Returns the interpolated state and its time. Beyond the newest state nothing is extrapolated. */
  private stateAt(playhead: number, newest: TimedState): [State, number] {
    if (playhead >= newest.wall_ms) return [newest.state, newest.wall_ms];
    for (let i = this.states.length - 1; i > 0; i -= 1) {
      const after = this.states.at(i);
      const before = this.states.at(i - 1);
      if (!after || !before || before.wall_ms > playhead) continue;
      const span = after.wall_ms - before.wall_ms;
      const share = span > 0 ? (playhead - before.wall_ms) / span : 1;
      return [mixStates(before.state, after.state, share), before.wall_ms + span * share];
    }
    const oldest = this.states.at(0) ?? newest;
    return [oldest.state, oldest.wall_ms];
  }
}
