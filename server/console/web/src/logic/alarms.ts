import type { Scene, State } from '../protocol/messages';
import { gateBand, isClipping, linkBand, marginBand, temperatureBand } from './limits';

export type AlarmKind =
  | 'stopped'
  | 'fault'
  | 'lost'
  | 'gate'
  | 'clipping'
  | 'link'
  | 'margin'
  | 'trip'
  | 'late'
  | 'hot'
  | 'shed'
  | 'connection';
export type AlarmLevel = 'warning' | 'alarm';

export interface Alarm {
  /** Increases by one with each alarm. */
  number: number;
  kind: AlarmKind;
  level: AlarmLevel;
  /** Seat, or an empty text for the whole session. */
  seat: string;
  /** Session time of the begin [s]; null if no state was known. */
  t: number | null;
  /** Whether the cause is over. */
  over: boolean;
  /** Session time at which the cause was last there [s]; null while it lasts, or if no state tells the time. */
  until: number | null;
  detail: string;
}

export const kAlarmsKept = 200;
/**
 * A cause that was absent for this long ends its alarm, so that a flickering value gives one line [ms]. It is time of the
 * page: the clock of a stopped session stands still.
 */
export const kAlarmHold = 1000;

interface Cause {
  kind: AlarmKind;
  level: AlarmLevel;
  seat: string;
  detail: string;
}

/** Alarms of one session, with begin and end. Bounded: the oldest ones leave first. */
export class AlarmLog {
  private alarms: Alarm[] = [];
  private readonly active = new Map<string, { alarm: Alarm; seen: number | null; seen_ms: number }>();
  /** A loss of the connection that is over; the next state tells the time. */
  private reconnected: Alarm | null = null;
  private readonly counts = new Map<string, number>();
  private next = 1;

  /** Newest first. */
  list(): Alarm[] {
    return [...this.alarms].reverse();
  }

  current(): Alarm[] {
    return [...this.active.values()].map((entry) => entry.alarm);
  }

  /** Forgets the alarms of another session: its clock and its seats are others. */
  beginSession(): void {
    this.alarms = this.alarms.filter(({ kind }) => kind === 'connection');
    for (const [key, { alarm }] of this.active) if (alarm.kind !== 'connection') this.active.delete(key);
    this.counts.clear();
  }

  /**
   * Call for each state, in order.
   * @param now_ms time of the page, monotonic [ms]
   */
  update(state: State, scene: Scene | null, now_ms: number): void {
    if (this.reconnected) {
      const { t } = this.reconnected;
      this.reconnected.until = t === null || state.t >= t ? state.t : null;
      this.reconnected = null;
    }
    const causes = this.causes(state, scene);
    // Session time runs backwards when another run of the session begins: that run has causes of its own.
    for (const [key, { alarm, seen }] of this.active)
      if (alarm.kind !== 'connection' && seen !== null && state.t < seen) this.end(key);
    for (const cause of causes) this.see(cause, state.t, now_ms);
    for (const [key, { alarm, seen_ms }] of this.active)
      if (alarm.kind !== 'connection' && now_ms - seen_ms > kAlarmHold) this.end(key);
  }

  connection(lost: boolean, t: number | null, detail: string): void {
    const key = 'connection:';
    if (lost) return this.see({ kind: 'connection', level: 'alarm', seat: '', detail }, t, 0);
    const entry = this.active.get(key);
    if (!entry) return;
    this.active.delete(key);
    entry.alarm.over = true;
    this.reconnected = entry.alarm;
  }

  private end(key: string): void {
    const entry = this.active.get(key);
    if (!entry) return;
    entry.alarm.over = true;
    entry.alarm.until = entry.seen;
    this.active.delete(key);
  }

  private see(cause: Cause, t: number | null, now_ms: number): void {
    const key = `${cause.kind}:${cause.seat}`;
    const known = this.active.get(key);
    if (known) {
      known.seen = t ?? known.seen;
      known.seen_ms = now_ms;
      known.alarm.detail = cause.detail || known.alarm.detail;
      return;
    }
    const alarm: Alarm = { number: this.next++, ...cause, t, over: false, until: null };
    this.alarms.push(alarm);
    this.active.set(key, { alarm, seen: t, seen_ms: now_ms });
    if (this.alarms.length > kAlarmsKept) this.alarms.shift();
  }

  private causes(state: State, scene: Scene | null): Cause[] {
    const found: Cause[] = [];
    const add = (kind: AlarmKind, level: AlarmLevel, seat: string, detail = ''): void => {
      found.push({ kind, level, seat, detail });
    };
    if (state.stop) {
      const fault = state.stop.kind === 'FAULT';
      add(
        fault ? 'fault' : 'stopped',
        fault || state.stop.kind === 'STOP' ? 'alarm' : 'warning',
        state.stop.person === null ? state.stop.by : `${state.stop.person} (${state.stop.by})`,
        state.stop.why,
      );
    }
    if (state.shed > 0) add('shed', 'warning', '', String(state.shed));
    state.seats.forEach((seat, i) => {
      const known = scene?.seats[i];
      const name = known?.name ?? String(i + 1);
      if (this.increased(`trips:${name}`, seat.trips)) add('trip', 'alarm', name, String(seat.trips));
      if (this.increased(`late:${name}`, seat.late)) add('late', 'warning', name, String(seat.late));
      if (seat.taken !== true) return;
      if (seat.heard === false) return add('lost', 'alarm', name);
      if (gateBand(seat.gate) === 'red') add('gate', 'alarm', name, seat.gate ?? '');
      if (isClipping(seat, known)) add('clipping', 'warning', name);
      if (linkBand(seat) === 'red') add('link', 'alarm', name);
      if (marginBand(seat.margin_j) === 'red') add('margin', 'warning', name);
      if (temperatureBand(seat.temperature_c) === 'red') add('hot', 'alarm', name);
    });
    return found;
  }

  private increased(key: string, value: number | null): boolean {
    if (value === null) return false;
    const before = this.counts.get(key);
    if (this.counts.size < 4 * 24 || before !== undefined) this.counts.set(key, value);
    return before !== undefined && value > before;
  }
}
