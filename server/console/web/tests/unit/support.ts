import type { Scene, SeatState, State } from '../../src/protocol/messages';
import { MockSession } from '../mock/session.mjs';

/** Returns a seat without trouble. */
export function makeSeat(changes: Partial<SeatState> = {}): SeatState {
  return {
    taken: true,
    heard: true,
    person: 'ws-1',
    engaged: true,
    gate: 'ON',
    x: [0, 0, 0],
    f: [0, 0, 0],
    alpha: [0.5],
    rtt_ms: 1,
    loss_percent: 0,
    gap_ms: 1,
    age_ms: 1,
    margin_j: 0.05,
    trips: 0,
    late: 0,
    temperature_c: null,
    ...changes,
  };
}

/** Returns a running state of two seats and one tool. */
export function makeState(changes: Partial<State> = {}): State {
  return {
    type: 'state',
    n: 1,
    dropped: 0,
    wall_us: 0,
    t: 0,
    phase: 'RUNNING',
    stop: null,
    version: 1,
    shed: 0,
    held: '',
    recording: null,
    noRecording: '',
    seats: [makeSeat(), makeSeat({ person: 'ws-2' })],
    tools: [
      {
        x: [0, 0, 0],
        v: [0, 0, 0],
        f: [0, 0, 0],
        depth_m: 0,
        touching: false,
        wanted: [1, 0],
        applied: [1, 0],
        transfer: null,
      },
    ],
    ...changes,
  };
}

export function makeScene(): Scene {
  return new MockSession().scene() as unknown as Scene;
}
