/** Bits of the session time in a mark: 2^24 ms are more than four hours. */
export const kMarkBits = 24;
/** Side of a cell, and place of the first cell from the left edge of the picture; the row is at half of its height [px]. */
export const kMarkCell = 8;
export const kMarkLeft = 16;

const isOdd = (bits: readonly boolean[]): boolean => bits.filter(Boolean).length % 2 === 1;

/** Returns the cells of a mark: white, black, the bits of `ms` (highest first), and their parity. True is white. */
export function markCells(ms: number): boolean[] {
  const bits = Array.from({ length: kMarkBits }, (_, i) => Math.floor(ms / 2 ** (kMarkBits - 1 - i)) % 2 === 1);
  return [true, false, ...bits, isOdd(bits)];
}

/** Returns the time of a mark [ms], or null if the cells are no mark. */
export function readMark(cells: readonly boolean[]): number | null {
  const bits = cells.slice(2, 2 + kMarkBits);
  const whole = cells.length === kMarkBits + 3 && cells[0] === true && cells[1] === false;
  if (!whole || isOdd(bits) !== cells[kMarkBits + 2]) return null;
  return bits.reduce((ms, bit) => 2 * ms + (bit ? 1 : 0), 0);
}
