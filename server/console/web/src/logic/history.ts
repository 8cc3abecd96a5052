import type { Scene, SeatState, State } from '../protocol/messages';
import { forceMagnitude } from './limits';
import { Ring } from './ring';

/** Length of a sparkline [s] and its samples per second. */
export const kHistorySeconds = 60;
export const kHistoryRate = 4;

export const kQuantities = ['force', 'rtt', 'loss', 'margin'] as const;
export type Quantity = (typeof kQuantities)[number];

const kValue: Record<Quantity, (seat: SeatState) => number | null> = {
  force: forceMagnitude,
  rtt: (seat) => seat.rtt_ms,
  loss: (seat) => seat.loss_percent,
  margin: (seat) => seat.margin_j,
};

/** Values of each seat in the last minute. Each sample is the largest value of its quarter of a second (smallest margin). */
export class SeatHistory {
  private rows: { t: number; seats: Record<Quantity, number | null>[] } | null = null;
  private ring = new Ring<{ t: number; seats: Record<Quantity, number | null>[] }>(kHistorySeconds * kHistoryRate);

  clear(): void {
    this.ring.clear();
    this.rows = null;
  }

  update(state: State, scene: Scene | null): void {
    if (scene && scene.seats.length !== state.seats.length) return;
    const slot = Math.floor(state.t * kHistoryRate);
    if (this.rows && (slot < Math.floor(this.rows.t * kHistoryRate) || this.rows.seats.length !== state.seats.length)) {
      this.clear(); // another run of the session
    }
    if (this.rows && Math.floor(this.rows.t * kHistoryRate) === slot) {
      const rows = this.rows;
      state.seats.forEach((seat, i) => {
        const row = rows.seats[i];
        if (row)
          for (const quantity of kQuantities) row[quantity] = extreme(quantity, row[quantity], kValue[quantity](seat));
      });
      return;
    }
    this.rows = {
      t: state.t,
      seats: state.seats.map((seat) => ({
        force: kValue.force(seat),
        rtt: kValue.rtt(seat),
        loss: kValue.loss(seat),
        margin: kValue.margin(seat),
      })),
    };
    this.ring.push(this.rows);
    this.ring.dropWhile((row) => state.t - row.t > kHistorySeconds);
  }

  get samples(): number {
    return this.ring.length;
  }

  /** Returns times before now [s] (negative, ascending) and values of one seat. */
  series(seat: number, quantity: Quantity): [number[], (number | null)[]] {
    const now = this.ring.newest?.t ?? 0;
    const rows = this.ring.toArray();
    return [rows.map((row) => row.t - now), rows.map((row) => row.seats[seat]?.[quantity] ?? null)];
  }
}

function extreme(quantity: Quantity, a: number | null, b: number | null): number | null {
  if (a === null || b === null) return a ?? b;
  return quantity === 'margin' ? Math.min(a, b) : Math.max(a, b);
}
