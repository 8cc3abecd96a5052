import { kTextMax } from './messages';

/** Readers of parsed JSON of the network. None of them throws. */

/** Parsed JSON of the network; nothing is known of its members. */
export type Json = Record<string, unknown>;

/** Largest length of a list without a limit of its own. */
export const kListMax = 1000;
export const isObject = (value: unknown): value is Json =>
  typeof value === 'object' && value !== null && !Array.isArray(value);
export const object = (value: unknown): Json => (isObject(value) ? value : {});
export const list = (value: unknown, max = kListMax): unknown[] => (Array.isArray(value) ? value.slice(0, max) : []);
export const number = (value: unknown): number | null =>
  typeof value === 'number' && Number.isFinite(value) ? value : null;
export const count = (value: unknown): number => {
  const found = number(value);
  return found !== null && found >= 0 ? Math.floor(found) : 0;
};
export const flag = (value: unknown): boolean | null => (typeof value === 'boolean' ? value : null);
// Control characters could change the direction or the lines of a text on the page.
// eslint-disable-next-line no-control-regex
const kControl = /[\u0000-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069]/g;
export const text = (value: unknown): string =>
  typeof value === 'string' ? value.slice(0, kTextMax).replace(kControl, ' ') : '';
export const textOrNull = (value: unknown): string | null => (typeof value === 'string' ? text(value) : null);
export const texts = (value: unknown): string[] =>
  list(value)
    .filter((v) => typeof v === 'string')
    .map(text);
