import type { Scene, State } from '../protocol/messages';
import type { Outline } from '../protocol/recordings';
import { mixStates } from './interpolation';

/** Pieces that are kept: more than a minute at 10 s each. */
export const kPiecesKept = 8;
/** Pieces that are read ahead of the one that is shown. */
const kAhead = 1;

export type Moment =
  | { kind: 'state'; state: State }
  | { kind: 'gap' }
  | { kind: 'loading' }
  | { kind: 'failed'; why: string };

type Piece = { states: readonly State[] } | { failed: string };

/**
 * States of a recording in pieces. The number `n` of a state is that of its period, from 1: a period without a state is a
 * gap, and states are interpolated only between neighbouring periods.
 */
export class RecordedStates {
  private readonly pieces = new Map<number, Piece>();
  private readonly asked = new Set<number>();

  constructor(private readonly outline: Outline) {}

  get size(): number {
    return this.pieces.size;
  }

  /** Returns the pieces to ask for now, and remembers that they were asked for. */
  wanted(t: number): number[] {
    const first = Math.floor(this.periodAt(t) / this.outline.per_piece);
    const found: number[] = [];
    for (let k = first; k <= first + kAhead && k < this.outline.pieces; k += 1) {
      if (!this.pieces.has(k) && !this.asked.has(k)) found.push(k);
    }
    found.forEach((k) => this.asked.add(k));
    return found;
  }

  add(piece: number, states: readonly State[]): void {
    this.keep(piece, { states });
  }

  /** The piece could not be read; it is asked for again after a `retry`. */
  fail(piece: number, why: string): void {
    this.keep(piece, { failed: why });
  }

  /** Forgets failures, so that their pieces are asked for again. */
  retry(): void {
    for (const [k, piece] of this.pieces) if ('failed' in piece) this.pieces.delete(k);
  }

  /** Returns what the recording shows at a session time [s]. */
  at(t: number): Moment {
    const period = this.periodAt(t);
    const piece = this.pieceOf(period);
    if (!piece) return { kind: 'loading' };
    if ('failed' in piece) return { kind: 'failed', why: piece.failed };
    const state = this.stateOf(period);
    if (!state) return { kind: 'gap' };
    const next = this.stateOf(period + 1);
    const span = next ? next.t - state.t : 0;
    if (!next || !(span > 0) || t <= state.t) return { kind: 'state', state };
    return { kind: 'state', state: mixStates(state, next, Math.min(1, (t - state.t) / span)) };
  }

  /** Period that has a session time, from 0. The end of the recording belongs to the last one. */
  private periodAt(t: number): number {
    const { from_s, to_s, rate_hz } = this.outline;
    const last = Math.max(0, Math.ceil((to_s - from_s) * rate_hz - 1e-6) - 1);
    return Math.min(last, Math.max(0, Math.floor((t - from_s) * rate_hz + 1e-6)));
  }

  private pieceOf(period: number): Piece | undefined {
    const k = Math.floor(period / this.outline.per_piece);
    const piece = this.pieces.get(k);
    if (piece) {
      this.pieces.delete(k);
      this.pieces.set(k, piece); // the one used last is kept for longest
    }
    return piece;
  }

  private stateOf(period: number): State | undefined {
    const piece = this.pieces.get(Math.floor(period / this.outline.per_piece));
    if (!piece || 'failed' in piece) return undefined;
    let [low, high] = [0, piece.states.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((piece.states[middle]?.n ?? 0) < period + 1) low = middle + 1;
      else high = middle;
    }
    const found = piece.states[low];
    return found?.n === period + 1 ? found : undefined;
  }

  private keep(k: number, piece: Piece): void {
    this.asked.delete(k);
    this.pieces.delete(k);
    this.pieces.set(k, piece);
    for (const oldest of this.pieces.keys()) {
      if (this.pieces.size <= kPiecesKept) break;
      this.pieces.delete(oldest);
    }
  }
}

/** Returns a state in which nothing is known: what a gap shows. */
export function emptyState(scene: Scene, t: number): State {
  const unknownSeat = {
    taken: null,
    heard: null,
    person: null,
    engaged: null,
    gate: null,
    x: null,
    f: null,
    alpha: [],
    rtt_ms: null,
    loss_percent: null,
    gap_ms: null,
    age_ms: null,
    margin_j: null,
    trips: null,
    late: null,
    temperature_c: null,
  };
  const unknownTool = {
    x: null,
    v: null,
    f: null,
    depth_m: null,
    touching: null,
    wanted: null,
    applied: null,
    transfer: null,
  };
  return {
    type: 'state',
    n: 0,
    dropped: 0,
    wall_us: null,
    t,
    phase: 'RUNNING',
    stop: null,
    version: 0,
    shed: 0,
    held: '',
    recording: null,
    noRecording: '',
    seats: scene.seats.map(() => unknownSeat),
    tools: scene.tools.map(() => unknownTool),
  };
}
