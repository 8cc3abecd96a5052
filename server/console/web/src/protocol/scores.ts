import { isObject, list, number, object, text, textOrNull, texts } from './json';

/** Main scores of a lesson, as `tandem-netsim score` computes them. */

export type Trust = 'good' | 'flagged' | 'withheld' | 'absent';

export interface ScoreCell {
  /** Value in the unit of the metric; null: withheld or absent. */
  text: string | null;
  trust: Trust;
  reason: string;
}

export interface Scores {
  rate_hz: number | null;
  from_s: number | null;
  to_s: number | null;
  metrics: readonly { key: string; title: string; unit: string }[];
  seats: readonly {
    seat: string;
    person: string;
    parts: readonly { part: string; title: string; cells: readonly ScoreCell[] }[];
  }[];
  notes: readonly string[];
}

const kTrusts: readonly Trust[] = ['good', 'flagged', 'withheld', 'absent'];

/** Returns scores, or null if the value has none. */
export function readScores(value: unknown): Scores | null {
  if (!isObject(value) || !Array.isArray(value.metrics)) return null;
  return {
    rate_hz: number(value.rate_hz),
    from_s: number(value.from_s),
    to_s: number(value.to_s),
    metrics: list(value.metrics, 64)
      .map(object)
      .map((row) => ({ key: text(row.key), title: text(row.title), unit: text(row.unit) })),
    seats: list(value.seats, 24)
      .map(object)
      .map((seat) => ({
        seat: text(seat.seat),
        person: text(seat.person),
        parts: list(seat.parts, 64)
          .map(object)
          .map((part) => ({
            part: text(part.part),
            title: text(part.title),
            cells: list(part.cells, 64)
              .map(object)
              .map((cell) => ({
                text: textOrNull(cell.text),
                trust: kTrusts.find((known) => known === cell.trust) ?? 'absent',
                reason: text(cell.reason),
              })),
          })),
      })),
    notes: texts(value.notes),
  };
}
