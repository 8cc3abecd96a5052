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
  /** Session time of the end [s]; null while the cause lasts. */
  until: number | null;
  detail: string;
}

export const kAlarmsKept = 200;
/** A cause that was absent for this long ends its alarm, so that a flickering value gives one line [s]. */
export const kAlarmHold = 1;

interface Cause {
  kind: AlarmKind;
  level: AlarmLevel;
  seat: string;
  detail: string;
}

/** Alarms with begin and end. Bounded: the oldest ones leave first. */
export class AlarmLog {
  private readonly alarms: Alarm[] = [];
  private readonly active = new Map<string, { alarm: Alarm; seen: number }>();
  private readonly counts = new Map<string, number>();
  private next = 1;

  /** Newest first. */
  list(): Alarm[] {
    return [...this.alarms].reverse();
  }

  current(): Alarm[] {
    return [...this.active.values()].map((entry) => entry.alarm);
  }

  /** Call for each state, in order. */
  update(state: State, scene: Scene | null): void {
    const causes = this.causes(state, scene);
    for (const cause of causes) this.see(cause, state.t);
    for (const [key, entry] of this.active) {
      if (entry.alarm.kind === 'connection') continue;
      // Session time runs backwards when another run of the session begins.
      if (state.t - entry.seen > kAlarmHold || state.t < entry.seen) this.end(key, state.t);
    }
  }

  connection(lost: boolean, t: number | null, detail: string): void {
    const key = 'connection:';
    if (lost) this.see({ kind: 'connection', level: 'alarm', seat: '', detail }, t);
    else if (this.active.has(key)) this.end(key, t);
  }

  private end(key: string, t: number | null): void {
    const entry = this.active.get(key);
    if (!entry) return;
    entry.alarm.until = t ?? entry.alarm.t ?? 0;
    this.active.delete(key);
  }

  private see(cause: Cause, t: number | null): void {
    const key = `${cause.kind}:${cause.seat}`;
    const known = this.active.get(key);
    if (known) {
      known.seen = t ?? known.seen;
      known.alarm.detail = cause.detail || known.alarm.detail;
      return;
    }
    const alarm: Alarm = { number: this.next++, ...cause, t, until: null };
    this.alarms.push(alarm);
    this.active.set(key, { alarm, seen: t ?? 0 });
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
        state.stop.by,
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
