import type { Reply } from '../protocol/messages';

/** A request without a reply for this long is reported as unanswered [ms]. */
export const kReplyTimeout = 5000;
/** Requests that wait for a reply. */
export const kPendingMax = 32;

interface Pending {
  sent_ms: number;
  done: (reply: Reply, round_trip_ms: number) => void;
}

/** Matches replies to requests. Each request ends exactly once: by its reply, by time or by the end of the connection. */
export class PendingRequests {
  private readonly pending = new Map<number, Pending>();
  private next = 1;

  get length(): number {
    return this.pending.size;
  }

  /** Returns the id of a new request, or null if too many wait. */
  add(now_ms: number, done: Pending['done']): number | null {
    if (this.pending.size >= kPendingMax) return null;
    const id = this.next++;
    this.pending.set(id, { sent_ms: now_ms, done });
    return id;
  }

  /** Returns whether the reply belongs to a request. */
  reply(reply: Reply, now_ms: number): boolean {
    const found = reply.id === null ? undefined : this.pending.get(reply.id);
    if (!found || reply.id === null) return false;
    this.pending.delete(reply.id);
    found.done(reply, now_ms - found.sent_ms);
    return true;
  }

  expire(now_ms: number, text: string): void {
    for (const [id, entry] of this.pending) if (now_ms - entry.sent_ms > kReplyTimeout) this.fail(id, text);
  }

  failAll(text: string): void {
    for (const id of [...this.pending.keys()]) this.fail(id, text);
  }

  private fail(id: number, text: string): void {
    const entry = this.pending.get(id);
    this.pending.delete(id);
    entry?.done({ type: 'reply', id, ok: false, text }, NaN);
  }
}

/** Waiting times between attempts to connect [ms]: doubles from 250 ms up to 5 s. */
export class Backoff {
  private attempts = 0;

  /** @param random in [0, 1); spreads the attempts of many pages after the gateway restarts */
  next(random: number): number {
    const base = Math.min(5000, 250 * 2 ** this.attempts);
    this.attempts = Math.min(this.attempts + 1, 10);
    return base * (0.75 + 0.5 * random);
  }

  reset(): void {
    this.attempts = 0;
  }
}
