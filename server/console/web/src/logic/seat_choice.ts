import type { Scene, SceneSeat, State } from '../protocol/messages';

/** Roles whose seats may move a tool: right "drive" of server/policy/roles.cpp. */
const kDriving: readonly string[] = ['INSTRUCTOR', 'TRAINEE'];
/** A seat that the page left before a reload becomes free within this time [ms]. */
const kTrialWait_ms = 5000;

/** Returns the master seats that are free, in the order of the scene. */
export function freeSeats(scene: Scene | null, state: State | null): SceneSeat[] {
  return (scene?.seats ?? []).filter((seat, i) => seat.kind === 'MASTER' && state?.seats[i]?.taken === false);
}

/**
 * Returns the name of the free seat to propose; empty: none is free.
 * @param chosen  seat that the person chose; empty: none
 * @param trial   seat of a trial (`play` of hello); null: none
 */
export function proposedSeat(free: readonly SceneSeat[], chosen: string, trial: string | null): string {
  const named = (name: string | null): SceneSeat | undefined => free.find((seat) => seat.name === name);
  const found = named(chosen) ?? named(trial) ?? free.find(({ role }) => kDriving.includes(role)) ?? free[0];
  return found?.name ?? '';
}

/** Takes the seat of a trial once: at once, or when the page before a reload has left it. */
export class TrialSeat {
  private until_ms: number | null = null;
  private over = false;

  /** Whether the page knows of a trial: it shows the seat then. */
  get begun(): boolean {
    return this.until_ms !== null;
  }

  /** The person or the page takes a seat: there is nothing more to take. */
  end(): void {
    this.over = true;
  }

  /**
   * Returns the seat to take now; null: none.
   * @param now_ms time of the page, monotonic [ms]
   */
  next(trial: string, free: readonly SceneSeat[], now_ms: number): string | null {
    if (this.over) return null;
    this.until_ms ??= now_ms + kTrialWait_ms;
    const ready = free.some(({ name }) => name === trial);
    this.over = ready || now_ms >= this.until_ms;
    return ready ? trial : null;
  }
}
