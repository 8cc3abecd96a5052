/** Frames that the page sends within one second; the gateway closes the connection above 120. */
export const kFramesPerSecond = 110;

/** Limits the frames of the page within each sliding second. */
export class FrameBudget {
  private sent: number[] = [];

  constructor(private readonly limit = kFramesPerSecond) {}

  /** Returns whether `reserve` further frames would be left after one frame at `now_ms`, and counts that frame if so. */
  take(now_ms: number, reserve = 0): boolean {
    this.sent = this.sent.filter((at) => now_ms - at < 1000);
    if (this.sent.length + reserve >= this.limit) return false;
    this.sent.push(now_ms);
    return true;
  }
}

/**
 * Acknowledges states. The gateway stops after three states without acknowledgement; therefore the page acknowledges the
 * newest one, once per frame of the screen. A page that cannot draw gets fewer states and never a queue of old ones.
 */
export class Acknowledgements {
  private newest = 0;
  private acknowledged = 0;
  /** States that the gateway did not send to this page, as it counts them. */
  dropped = 0;

  received(n: number, dropped: number): void {
    // A smaller number means another run of the gateway.
    if (n < this.newest) this.acknowledged = 0;
    this.newest = n;
    this.dropped = dropped;
  }

  /** Whether the newest state is not acknowledged yet. */
  get due(): boolean {
    return this.newest !== this.acknowledged;
  }

  /** Returns the number to acknowledge now, or null if the newest state is acknowledged. */
  next(): number | null {
    if (!this.due) return null;
    this.acknowledged = this.newest;
    return this.newest;
  }

  /** A new connection begins with state 1. */
  reset(): void {
    this.newest = 0;
    this.acknowledged = 0;
    this.dropped = 0;
  }
}
