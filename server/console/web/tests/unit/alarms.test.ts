import { describe, expect, it } from 'vitest';

import { AlarmLog, kAlarmsKept } from '../../src/logic/alarms';
import {
  bandOf,
  forceBand,
  forceShare,
  gateBand,
  isClipping,
  kRoundTripLimits,
  linkBand,
  marginBand,
  worst,
} from '../../src/logic/limits';
import type { State } from '../../src/protocol/messages';
import { makeScene, makeSeat, makeState } from './support';

const scene = makeScene();

describe('limits', () => {
  it('are inclusive: 20 ms is green, 100 ms is amber', () => {
    expect(bandOf(20, kRoundTripLimits)).toBe('green');
    expect(bandOf(20.1, kRoundTripLimits)).toBe('amber');
    expect(bandOf(100, kRoundTripLimits)).toBe('amber');
    expect(bandOf(100.1, kRoundTripLimits)).toBe('red');
    expect(bandOf(null, kRoundTripLimits)).toBe('unknown');
    expect(bandOf(NaN, kRoundTripLimits)).toBe('unknown');
  });
  it('judge a link by its worst measure', () => {
    expect(linkBand(makeSeat({ rtt_ms: 5, loss_percent: 0, gap_ms: 60 }))).toBe('red');
    expect(linkBand(makeSeat({ rtt_ms: null, loss_percent: null, gap_ms: null }))).toBe('unknown');
    expect(linkBand(makeSeat({ rtt_ms: null, loss_percent: 0.5, gap_ms: 1 }))).toBe('amber');
    expect(worst([])).toBe('unknown');
  });
  it('compare the size of the force with the limit', () => {
    const seat = makeSeat({ f: [1.98, 2.64, 0] });
    expect(forceShare(seat, scene.seats[0])).toBeCloseTo(1, 12);
    expect(isClipping(seat, scene.seats[0])).toBe(true);
    expect(forceBand(0.8)).toBe('amber');
    expect(forceBand(0.79)).toBe('green');
    expect(forceShare(seat, undefined)).toBeNull();
    expect(isClipping(makeSeat({ f: null }), scene.seats[0])).toBe(false);
  });
  it('know gates and energy', () => {
    expect(gateBand('LATCHED')).toBe('red');
    expect(gateBand('RISING')).toBe('amber');
    expect(marginBand(0)).toBe('red');
    expect(marginBand(0.004)).toBe('amber');
  });
});

describe('AlarmLog', () => {
  const lost = (t: number) => makeState({ t, seats: [makeSeat(), makeSeat({ heard: false })] });
  const calm = (t: number) => makeState({ t });
  /** Hands a state over; the page's clock goes as the session's unless it is given. */
  const see = (log: AlarmLog, state: State, now_ms = state.t * 1000): void => log.update(state, scene, now_ms);

  it('has one line with begin and end per cause', () => {
    const log = new AlarmLog();
    see(log, calm(1));
    see(log, lost(2));
    see(log, lost(3));
    expect(log.list()).toMatchObject([{ kind: 'lost', seat: 'trainee', t: 2, over: false, until: null }]);
    see(log, calm(3.5));
    expect(log.current()).toHaveLength(1);
    see(log, calm(4.2));
    expect(log.list()).toMatchObject([{ kind: 'lost', t: 2, over: true, until: 3 }]);
    expect(log.current()).toHaveLength(0);
  });

  it('does not repeat a flickering cause', () => {
    const log = new AlarmLog();
    for (let i = 0; i < 100; i += 1) see(log, i % 2 === 0 ? lost(i * 0.1) : calm(i * 0.1));
    expect(log.list()).toHaveLength(1);
  });

  it('raises an alarm when a counter grows, not for its first value', () => {
    const log = new AlarmLog();
    see(log, makeState({ seats: [makeSeat({ trips: 4 }), makeSeat()] }));
    expect(log.list()).toEqual([]);
    see(log, makeState({ t: 1, seats: [makeSeat({ trips: 5 }), makeSeat()] }));
    expect(log.list()).toMatchObject([{ kind: 'trip', seat: 'trainer', detail: '5' }]);
  });

  it('reports a stop with person and reason, and a fault as such', () => {
    const log = new AlarmLog();
    const stop = { number: 1, kind: 'STOP', by: 'ina', person: null, why: 'test', yours: true };
    see(log, makeState({ stop }));
    expect(log.list()).toMatchObject([{ kind: 'stopped', level: 'alarm', seat: 'ina', detail: 'test' }]);
    see(log, makeState({ t: 5, stop: { ...stop, kind: 'FAULT' } }));
    expect(log.list()[0]).toMatchObject({ kind: 'fault', level: 'alarm' });
  });

  it('ignores what a free seat reports', () => {
    const log = new AlarmLog();
    see(log, makeState({ seats: [makeSeat({ taken: false, heard: false, gate: 'FAULT' })] }));
    expect(log.list()).toEqual([]);
  });

  it('ends all alarms of the run before when the session time begins again', () => {
    const log = new AlarmLog();
    see(log, lost(100));
    see(log, calm(0), 101_000);
    expect(log.current()).toEqual([]);
    // The end is a time of that run: "until 0:00.0" would be before its begin.
    expect(log.list()).toMatchObject([{ kind: 'lost', t: 100, over: true, until: 100 }]);
  });

  it('begins a new alarm for a cause that the next run of the session has too', () => {
    const log = new AlarmLog();
    see(log, lost(100));
    see(log, lost(0), 101_000);
    expect(log.list()).toMatchObject([
      { t: 0, over: false },
      { t: 100, until: 100 },
    ]);
  });

  it('ends the alarm of a cause that is gone while the clock of a stopped session stands still', () => {
    const log = new AlarmLog();
    see(log, lost(4), 0);
    see(log, calm(4), 900);
    expect(log.current()).toHaveLength(1);
    see(log, calm(4), 1100);
    expect(log.list()).toMatchObject([{ t: 4, over: true, until: 4 }]);
  });

  it('forgets the alarms and counters of another session', () => {
    const log = new AlarmLog();
    const stop = { number: 1, kind: 'STOP', by: 'trainer', person: null, why: '', yours: true };
    log.connection(true, 3, 'WebSocket 1006');
    see(log, makeState({ t: 4, stop, seats: [makeSeat({ trips: 0 }), makeSeat()] }));
    log.beginSession();
    see(log, makeState({ t: 0, seats: [makeSeat({ trips: 3 }), makeSeat()] }), 5000);
    expect(log.list()).toMatchObject([{ kind: 'connection', over: false }]);
  });

  it('keeps the loss of the connection until it is back', () => {
    const log = new AlarmLog();
    log.connection(true, 3, 'WebSocket 1006');
    log.connection(true, 3, 'WebSocket 1006');
    see(log, calm(60));
    expect(log.current()).toHaveLength(1);
    log.connection(false, null, '');
    expect(log.list()).toMatchObject([{ kind: 'connection', t: 3, over: true, until: null }]);
    see(log, calm(61));
    expect(log.list()).toMatchObject([{ kind: 'connection', t: 3, until: 61 }]);
  });

  it('gives a loss of the connection no end that the clock of a new session cannot tell', () => {
    const log = new AlarmLog();
    log.connection(true, null, 'WebSocket 1006');
    log.connection(false, null, '');
    expect(log.list()).toMatchObject([{ t: null, over: true, until: null }]);
    log.connection(true, 50, 'WebSocket 1006');
    log.connection(false, null, '');
    see(log, calm(0));
    expect(log.list()[0]).toMatchObject({ t: 50, over: true, until: null });
  });

  it('is bounded', () => {
    const log = new AlarmLog();
    for (let i = 0; i < 5000; i += 1) see(log, i % 2 === 0 ? lost(i * 10) : calm(i * 10));
    expect(log.list()).toHaveLength(kAlarmsKept);
    expect(log.list()[0]?.number).toBe(2500);
  });
});
