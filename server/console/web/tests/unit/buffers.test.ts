import { describe, expect, it } from 'vitest';

import { Acknowledgements, FrameBudget, kFramesPerSecond } from '../../src/logic/acknowledgements';
import { kHistoryRate, kHistorySeconds, SeatHistory } from '../../src/logic/history';
import { Backoff, kPendingMax, kReplyTimeout, PendingRequests } from '../../src/logic/orders';
import { Ring } from '../../src/logic/ring';
import { kTrailPoints, Trail } from '../../src/logic/trail';
import type { Reply } from '../../src/protocol/messages';
import { makeScene, makeSeat, makeState } from './support';

describe('Ring', () => {
  it('equals the last entries of a list for any capacity', () => {
    for (const capacity of [1, 2, 3, 7, 100]) {
      const ring = new Ring<number>(capacity);
      const all: number[] = [];
      for (let i = 0; i < 500; i += 1) {
        ring.push(i);
        all.push(i);
        expect(ring.toArray()).toEqual(all.slice(-capacity));
        expect(ring.newest).toBe(i);
        expect(ring.at(0)).toBe(all.slice(-capacity)[0]);
      }
    }
  });
  it('drops old entries and knows its ends', () => {
    const ring = new Ring<number>(5);
    expect(ring.newest).toBeUndefined();
    [1, 2, 3].forEach((n) => ring.push(n));
    ring.dropWhile((n) => n < 3);
    expect(ring.toArray()).toEqual([3]);
    expect(ring.at(-1)).toBeUndefined();
    expect(ring.at(1)).toBeUndefined();
    ring.dropWhile(() => true);
    expect(ring.length).toBe(0);
  });
  it('refuses a capacity without an entry', () => {
    expect(() => new Ring(0)).toThrow(RangeError);
    expect(() => new Ring(1.5)).toThrow(RangeError);
  });
});

describe('Acknowledgements', () => {
  it('acknowledge the newest state once', () => {
    const acknowledgements = new Acknowledgements();
    expect(acknowledgements.next()).toBeNull();
    acknowledgements.received(1, 0);
    acknowledgements.received(2, 4);
    expect(acknowledgements.next()).toBe(2);
    expect(acknowledgements.next()).toBeNull();
    expect(acknowledgements.dropped).toBe(4);
  });
  it('begin again with a new connection or another run of the gateway', () => {
    const acknowledgements = new Acknowledgements();
    acknowledgements.received(900, 0);
    acknowledgements.next();
    acknowledgements.received(1, 0);
    expect(acknowledgements.next()).toBe(1);
    acknowledgements.reset();
    acknowledgements.received(1, 0);
    expect(acknowledgements.next()).toBe(1);
  });
});

describe('FrameBudget', () => {
  it('never allows more frames than the limit within one second', () => {
    const budget = new FrameBudget();
    const allowed: number[] = [];
    for (let now = 0; now < 5000; now += 3) if (budget.take(now)) allowed.push(now);
    for (const from of allowed) {
      expect(allowed.filter((at) => at >= from && at < from + 1000).length).toBeLessThanOrEqual(kFramesPerSecond);
    }
    expect(allowed.length).toBeGreaterThan(4 * kFramesPerSecond);
  });
  it('keeps a reserve for orders', () => {
    const budget = new FrameBudget(5);
    for (let i = 0; i < 10; i += 1) budget.take(0, 2);
    expect(budget.take(0, 2)).toBe(false);
    expect([budget.take(0), budget.take(0), budget.take(0)]).toEqual([true, true, false]);
  });
});

describe('SeatHistory', () => {
  it('keeps one minute at a bounded rate, with the extreme of each interval', () => {
    const history = new SeatHistory();
    const scene = makeScene();
    for (let i = 0; i < 60 * 300; i += 1) {
      const t = i / 60;
      const force = i % 15 === 7 ? 2 : 1;
      history.update(makeState({ t, seats: [makeSeat({ f: [force, 0, 0], margin_j: 1 / force }), makeSeat()] }), scene);
    }
    const [times, values] = history.series(0, 'force');
    expect(history.samples).toBe(kHistorySeconds * kHistoryRate);
    expect(times[times.length - 1]).toBe(0);
    expect(times[0]).toBeGreaterThanOrEqual(-kHistorySeconds);
    expect(new Set(values.slice(0, -1))).toEqual(new Set([2]));
    expect(history.series(0, 'margin')[1][0]).toBe(0.5);
  });
  it('begins again when the session time runs backwards, and ignores a state of another scene', () => {
    const history = new SeatHistory();
    history.update(makeState({ t: 50 }), null);
    history.update(makeState({ t: 1 }), null);
    expect(history.samples).toBe(1);
    history.update(makeState({ t: 2, seats: [] }), makeScene());
    expect(history.samples).toBe(1);
    expect(history.series(9, 'rtt')[1]).toEqual([null]);
  });
});

describe('Trail', () => {
  it('has at most 3 s of points, and fades with age', () => {
    const trail = new Trail();
    for (let i = 0; i <= 1000; i += 1) trail.push(i / 60, [i, 0, 0]);
    const positions = new Float32Array(3 * kTrailPoints);
    const shares = new Float32Array(kTrailPoints);
    const n = trail.write(positions, shares, 1000 / 60);
    expect(n).toBeLessThanOrEqual(kTrailPoints);
    expect(n).toBeGreaterThan(kTrailPoints - 3);
    expect(positions[3 * (n - 1)]).toBe(1000);
    expect(shares[n - 1]).toBe(1);
    expect(shares[0]).toBeLessThan(0.02);
  });
  it('begins again when time runs backwards, and skips unknown places', () => {
    const trail = new Trail();
    trail.push(5, [1, 2, 3]);
    trail.push(5.1, null);
    expect(trail.length).toBe(1);
    trail.push(1, [0, 0, 0]);
    expect(trail.length).toBe(1);
  });
});

describe('PendingRequests', () => {
  const reply = (id: number | null, ok = true): Reply => ({ type: 'reply', id, ok, text: '' });
  it('end once, with the round trip', () => {
    const pending = new PendingRequests();
    const ends: [boolean, number][] = [];
    const id = pending.add(100, (r, ms) => ends.push([r.ok, ms]));
    expect(pending.reply(reply(id), 130)).toBe(true);
    expect(pending.reply(reply(id), 131)).toBe(false);
    expect(pending.reply(reply(null), 131)).toBe(false);
    expect(ends).toEqual([[true, 30]]);
  });
  it('end by time and by the end of the connection', () => {
    const pending = new PendingRequests();
    const texts: string[] = [];
    pending.add(0, (r) => texts.push(r.text));
    pending.add(4000, (r) => texts.push(r.text));
    pending.expire(kReplyTimeout + 1, 'late');
    pending.failAll('lost');
    expect(texts).toEqual(['late', 'lost']);
    expect(pending.length).toBe(0);
  });
  it('are bounded', () => {
    const pending = new PendingRequests();
    const ids = Array.from({ length: kPendingMax + 1 }, () => pending.add(0, () => undefined));
    expect(ids[kPendingMax]).toBeNull();
  });
});

describe('Backoff', () => {
  it('doubles up to five seconds and spreads', () => {
    const backoff = new Backoff();
    const waits = Array.from({ length: 12 }, () => backoff.next(0.5));
    expect(waits.slice(0, 3)).toEqual([250, 500, 1000]);
    expect(Math.max(...waits)).toBe(5000);
    backoff.reset();
    expect(backoff.next(0)).toBe(187.5);
  });
});
