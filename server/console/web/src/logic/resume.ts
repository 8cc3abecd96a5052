import type { Scene, StopState } from '../protocol/messages';
import { t } from '../strings/strings';

/**
 * Says who may end a stop that this person may not end, as server/session/stop_latch.h decides it: an instructor or
 * operator; in a scene without an instructor's seat, the seats that paused may withdraw their pause, too.
 */
export function whoResumes(stop: StopState, scene: Scene | null): string {
  const seats = scene?.seats ?? [];
  const bySeat = seats.some(({ name }) => name === stop.by);
  const led = seats.some(({ role }) => role === 'INSTRUCTOR');
  return t(stop.kind === 'PAUSE' && bySeat && !led ? 'stop.not_yours_seats' : 'stop.not_yours');
}

/** Returns two sentences as one text: words of a person rarely end with a full stop. */
export function sentences(first: string, second: string): string {
  return /[.!?…]$/.test(first) ? `${first} ${second}` : `${first}. ${second}`;
}
