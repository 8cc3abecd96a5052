import { RecordedStates, type Moment } from '../logic/recorded_states';
import type { Outline } from '../protocol/recordings';
import { fetchPiece } from './recording_client';

/** Time until a piece that could not be read is asked for again [ms]. */
const kRetry_ms = 2000;

/** A recording that is open in the page, with the pieces around the time that is shown. */
export class LoadedRecording {
  readonly states: RecordedStates;

  constructor(readonly outline: Outline) {
    this.states = new RecordedStates(outline);
  }

  /** Returns what is shown at a session time, and asks the gateway for pieces that are missing. */
  at(t: number): Moment {
    const { from_s, to_s, id } = this.outline;
    if (t < from_s || t > to_s) return { kind: 'gap' };
    for (const piece of this.states.wanted(t)) {
      fetchPiece(id, piece).then(
        (states) => this.states.add(piece, states),
        (error: unknown) => {
          this.states.fail(piece, error instanceof Error ? error.message : String(error));
          setTimeout(() => this.states.retry(), kRetry_ms);
        },
      );
    }
    return this.states.at(t);
  }
}
