import { describe, expect, it } from 'vitest';

import { kMarkBits, markCells, readMark } from '../../src/logic/sequence_mark';

describe('markCells', () => {
  it('has two cells to find it, the bits of the time and their parity', () => {
    const cells = markCells(5);
    expect(cells).toHaveLength(kMarkBits + 3);
    expect(cells.map(Number).join('')).toBe('10' + '000000000000000000000101' + '0');
    expect(markCells(7).at(-1)).toBe(true);
  });

  it('is read back for each time', () => {
    for (let ms = 0; ms < 2 ** kMarkBits; ms += 7919) expect(readMark(markCells(ms))).toBe(ms);
    expect(readMark(markCells(2 ** kMarkBits - 1))).toBe(2 ** kMarkBits - 1);
  });

  it('is not read with one wrong, missing or additional cell', () => {
    const cells = markCells(123456);
    for (let i = 0; i < cells.length; i += 1) {
      expect(readMark(cells.map((cell, k) => (k === i ? !cell : cell)))).toBeNull();
      expect(readMark(cells.filter((_, k) => k !== i))).toBeNull();
    }
    expect(readMark([...cells, false])).toBeNull();
    expect(readMark([])).toBeNull();
  });
});
