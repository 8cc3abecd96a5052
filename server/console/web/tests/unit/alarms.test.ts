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

  it('has one line with begin and end per cause', () => {
    const log = new AlarmLog();
    log.update(calm(1), scene);
    log.update(lost(2), scene);
    log.update(lost(3), scene);
    expect(log.list()).toMatchObject([{ kind: 'lost', seat: 'trainee', t: 2, until: null }]);
    log.update(calm(3.5), scene);
    expect(log.current()).toHaveLength(1);
    log.update(calm(4.2), scene);
    expect(log.list()).toMatchObject([{ kind: 'lost', t: 2, until: 4.2 }]);
    expect(log.current()).toHaveLength(0);
  });

  it('does not repeat a flickering cause', () => {
    const log = new AlarmLog();
    for (let i = 0; i < 100; i += 1) log.update(i % 2 === 0 ? lost(i * 0.1) : calm(i * 0.1), scene);
    expect(log.list()).toHaveLength(1);
  });

  it('raises an alarm when a counter grows, not for its first value', () => {
    const log = new AlarmLog();
    log.update(makeState({ seats: [makeSeat({ trips: 4 }), makeSeat()] }), scene);
    expect(log.list()).toEqual([]);
    log.update(makeState({ t: 1, seats: [makeSeat({ trips: 5 }), makeSeat()] }), scene);
    expect(log.list()).toMatchObject([{ kind: 'trip', seat: 'trainer', detail: '5' }]);
  });

  it('reports a stop with person and reason, and a fault as such', () => {
    const log = new AlarmLog();
    const stop = { number: 1, kind: 'STOP', by: 'ina', person: null, why: 'test', yours: true };
    log.update(makeState({ stop }), scene);
    expect(log.list()).toMatchObject([{ kind: 'stopped', level: 'alarm', seat: 'ina', detail: 'test' }]);
    log.update(makeState({ t: 5, stop: { ...stop, kind: 'FAULT' } }), scene);
    expect(log.list()[0]).toMatchObject({ kind: 'fault', level: 'alarm' });
  });

  it('ignores what a free seat reports', () => {
    const log = new AlarmLog();
    log.update(makeState({ seats: [makeSeat({ taken: false, heard: false, gate: 'FAULT' })] }), scene);
    expect(log.list()).toEqual([]);
  });

  it('ends all alarms of the run before when the session time begins again', () => {
    const log = new AlarmLog();
    log.update(lost(100), scene);
    log.update(calm(1), scene);
    expect(log.current()).toEqual([]);
  });

  it('keeps the loss of the connection until it is back', () => {
    const log = new AlarmLog();
    log.connection(true, 3, 'WebSocket 1006');
    log.connection(true, 3, 'WebSocket 1006');
    log.update(calm(60), scene);
    expect(log.current()).toHaveLength(1);
    log.connection(false, 61, '');
    expect(log.list()).toMatchObject([{ kind: 'connection', t: 3, until: 61 }]);
  });

  it('is bounded', () => {
    const log = new AlarmLog();
    for (let i = 0; i < 5000; i += 1) log.update(i % 2 === 0 ? lost(i * 10) : calm(i * 10), scene);
    expect(log.list()).toHaveLength(kAlarmsKept);
    expect(log.list()[0]?.number).toBe(2500);
  });
});
