/** The newest `capacity` entries of a sequence, oldest first. Memory is bounded for a lesson of any length. */
export class Ring<T> {
  private entries: T[] = [];
  private begin = 0;

  /** @param capacity largest number of entries, at least 1 */
  constructor(readonly capacity: number) {
    if (!Number.isInteger(capacity) || capacity < 1)
      throw new RangeError(`capacity ${capacity}: allowed are integers >= 1`);
  }

  get length(): number {
    return this.entries.length - this.begin;
  }

  get newest(): T | undefined {
    return this.length > 0 ? this.entries[this.entries.length - 1] : undefined;
  }

  push(entry: T): void {
    this.entries.push(entry);
    if (this.length > this.capacity) this.begin += 1;
    this.compact();
  }

  /** Removes the oldest entries for which `old` holds, up to the first other one. */
  dropWhile(old: (entry: T) => boolean): void {
    for (let first = this.entries[this.begin]; first !== undefined && old(first); first = this.entries[this.begin]) {
      this.begin += 1;
    }
    this.compact();
  }

  at(index: number): T | undefined {
    return index < 0 ? undefined : this.entries[this.begin + index];
  }

  clear(): void {
    this.entries = [];
    this.begin = 0;
  }

  toArray(): T[] {
    return this.entries.slice(this.begin);
  }

  /** Copies at most once per `capacity` entries, so that push costs constant time on average. */
  private compact(): void {
    if (this.begin <= this.capacity) return;
    this.entries = this.entries.slice(this.begin);
    this.begin = 0;
  }
}
