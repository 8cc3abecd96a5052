import { describe, expect, it } from 'vitest';

import { mixStates, mixVector } from '../../src/logic/interpolation';
import { StateWindow } from '../../src/logic/state_window';
import type { State } from '../../src/protocol/messages';
import { makeState } from './support';

const at = (n: number, wall_ms: number, x: number): State => {
  const state = makeState({ n, t: wall_ms / 1000, wall_us: wall_ms * 1000 });
  return { ...state, tools: state.tools.map((tool) => ({ ...tool, x: [x, 0, 0] as const })) };
};

describe('mixVector', () => {
  it('interpolates each component', () => {
    expect(mixVector([0, 0, 0], [0.01, -0.02, 0.03], 0.5)).toEqual([0.005, -0.01, 0.015]);
  });
  it('takes the newer one if one is unknown, or if the distance is a jump', () => {
    expect(mixVector(null, [1, 2, 3], 0.5)).toEqual([1, 2, 3]);
    expect(mixVector([0, 0, 0], null, 0.5)).toBeNull();
    expect(mixVector([0, 0, 0], [0.06, 0, 0], 0.5)).toEqual([0.06, 0, 0]);
  });
});

describe('mixStates', () => {
  it('takes words and flags of the newer state', () => {
    const a = makeState({ n: 1, phase: 'RUNNING' });
    const b = makeState({ n: 2, phase: 'STOPPED' });
    expect(mixStates(a, b, 0.1).phase).toBe('STOPPED');
  });
  it('does not mix states with another number of seats', () => {
    const a = makeState({ n: 1 });
    const b = { ...makeState({ n: 2 }), seats: [] };
    expect(mixStates(a, b, 0.5)).toBe(b);
  });
});

describe('StateWindow', () => {
  it('draws between two states and states its delay', () => {
    const window = new StateWindow();
    // The clocks differ by 1000 ms; states come every 20 ms without transport time.
    for (let i = 0; i <= 4; i += 1) window.push(at(i + 1, i * 20, i * 0.01), 1000 + i * 20);
    const drawn = window.sample(1085);
    // Gateway time 85 ms. The mean interval is 16.67 + (20 - 16.67)(1 - 0.9^4) = 17.81 ms, so the playhead is at 63.6 ms.
    expect(drawn?.state.tools[0]?.x?.[0]).toBeCloseTo(0.0318, 4);
    expect(drawn?.delay_ms).toBeCloseTo(21.38, 2);
    expect(drawn?.outOfDate).toBe(false);
  });

  it('adds half of the smallest round trip to the delay', () => {
    const window = new StateWindow();
    window.push(at(1, 0, 0), 500);
    window.addRoundTrip(40);
    window.addRoundTrip(12);
    window.addRoundTrip(NaN);
    expect(window.sample(510)?.delay_ms).toBeCloseTo(16, 9);
  });

  it('never extrapolates and reports silence', () => {
    const window = new StateWindow();
    window.push(at(1, 0, 0), 0);
    window.push(at(2, 20, 0.01), 20);
    const drawn = window.sample(2020);
    expect(drawn?.state.tools[0]?.x?.[0]).toBe(0.01);
    expect(drawn?.silence_ms).toBe(2000);
    expect(drawn?.outOfDate).toBe(true);
  });

  it('is empty before the first state', () => {
    expect(new StateWindow().sample(0)).toBeNull();
  });

  it('begins again when the numbers begin again', () => {
    const window = new StateWindow();
    window.push(at(50, 9000, 0.01), 9000);
    window.push(at(1, 3, 0.02), 9100);
    expect(window.sample(9100)?.state.n).toBe(1);
    expect(window.sample(9100)?.delay_ms).toBe(0);
  });

  it('counts states that a newer one replaced before they were drawn', () => {
    const window = new StateWindow();
    window.push(at(1, 0, 0), 0);
    window.sample(1);
    window.push(at(2, 16, 0), 16);
    window.push(at(3, 32, 0), 32);
    window.push(at(4, 48, 0), 48);
    window.sample(50);
    expect(window.skipped).toBe(2);
    expect(window.received).toBe(4);
  });

  it('stays within the two neighbouring states for any jitter', () => {
    for (let seed = 1; seed <= 50; seed += 1) {
      let random = seed;
      const next = (): number => (random = (random * 48271) % 2147483647) / 2147483647;
      const window = new StateWindow();
      let now = 0;
      for (let i = 1; i <= 300; i += 1) {
        now += next() * 40;
        window.push(at(i, i * 16, Math.sin(i / 10) * 0.02), now);
        const drawn = window.sample(now + next() * 10);
        expect(Math.abs(drawn?.state.tools[0]?.x?.[0] ?? 1)).toBeLessThanOrEqual(0.02);
        expect(drawn?.delay_ms).toBeGreaterThanOrEqual(0);
      }
    }
  });

  it('works without the clock of the gateway', () => {
    const window = new StateWindow();
    window.push({ ...at(1, 0, 0), wall_us: null }, 100);
    expect(window.sample(110)?.delay_ms).toBe(10);
  });
});
