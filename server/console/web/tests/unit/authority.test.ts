import { describe, expect, it } from 'vitest';

import {
  allTo,
  guidance,
  mastersOf,
  normalized,
  sameShares,
  traineeIndices,
  typedShare,
  withShare,
} from '../../src/logic/authority';
import { makeScene } from './support';

const sum = (shares: readonly number[]): number => shares.reduce((a, b) => a + b, 0);
const seat = (role: string) => ({
  name: role,
  kind: 'MASTER' as const,
  role,
  required: null,
  device: null,
  force_limit_n: null,
});

describe('withShare', () => {
  it('keeps the ratio of the others', () => {
    expect(withShare([0.2, 0.2, 0.6], 0, 0.6)).toEqual([0.6, expect.closeTo(0.1, 12), expect.closeTo(0.3, 12)]);
  });
  it('gives equal shares to others that had none', () => {
    expect(withShare([1, 0, 0], 0, 0.5)).toEqual([0.5, 0.25, 0.25]);
  });
  it('leaves all authority with a single master', () => {
    expect(withShare([1], 0, 0.2)).toEqual([1]);
  });
  it('ignores an index that does not exist', () => {
    expect(withShare([0.5, 0.5], 7, 1)).toEqual([0.5, 0.5]);
  });
  it('returns shares in [0, 1] with the sum 1 for any input', () => {
    for (let seed = 1; seed <= 200; seed += 1) {
      let random = seed;
      const next = (): number => (random = (random * 48271) % 2147483647) / 2147483647;
      const n = 1 + Math.floor(next() * 16);
      const alpha = Array.from({ length: n }, () => (next() < 0.2 ? NaN : next() * 3 - 1));
      const shares = withShare(alpha, Math.floor(next() * n), next() * 2 - 0.5);
      expect(shares).toHaveLength(n);
      expect(Math.abs(sum(shares) - 1)).toBeLessThan(1e-12);
      for (const share of shares) expect(share >= 0 && share <= 1).toBe(true);
    }
  });
});

describe('typedShare', () => {
  it('refuses what is no number from 5 to 100', () => {
    expect(['5', '42.5', ' 100 '].map(typedShare)).toEqual([0.05, 0.425, 1]);
    expect(['', ' ', '4.9', '-5', '150', '1e400', 'NaN', 'half'].map(typedShare)).toEqual(Array(8).fill(null));
  });
});

describe('normalized', () => {
  it('makes equal shares of zeros and of invalid numbers', () => {
    expect(normalized([0, 0])).toEqual([0.5, 0.5]);
    expect(normalized([NaN, -1])).toEqual([0.5, 0.5]);
    expect(normalized([])).toEqual([]);
  });
});

describe('presets', () => {
  it('give all to one seat, or half to the instructor', () => {
    const masters = mastersOf(makeScene());
    expect(allTo(2, 1)).toEqual([0, 1]);
    expect(guidance(masters)).toEqual([0.5, 0.5]);
  });
  it('share half among three trainees', () => {
    const masters = [seat('TRAINEE'), seat('INSTRUCTOR'), seat('TRAINEE'), seat('TRAINEE')];
    expect(guidance(masters)).toEqual([0.5 / 3, 0.5, 0.5 / 3, 0.5 / 3]);
  });
  it('need no trainee in the scene', () => {
    expect(traineeIndices([seat('INSTRUCTOR'), seat('OPERATOR')])).toEqual([1]);
    expect(guidance([seat('INSTRUCTOR')])).toEqual([1]);
  });
});

describe('sameShares', () => {
  it('compares at the resolution of the display', () => {
    expect(sameShares([0.5, 0.5], [0.502, 0.498])).toBe(true);
    expect(sameShares([0.5, 0.5], [0.51, 0.49])).toBe(false);
    expect(sameShares([1], [0.5, 0.5])).toBe(false);
    expect(sameShares(null, [1])).toBe(false);
  });
});
