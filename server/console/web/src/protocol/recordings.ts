import type { Scene, State } from './messages';
import { count, list, number, object, text, textOrNull, texts } from './json';
import { readMessage } from './parse';

/** Replies of the gateway about recordings. Quantities are SI; null means unknown. Bytes of the network are checked here. */

/** Longest list of points of a curve; the gateway sends at most 6000. */
const kPointsMax = 10_000;
const kNotesMax = 2000;
const kPieceMax = 2000;

export interface ListedRecording {
  id: string;
  /** Name of the first file. */
  file: string;
  /** Number of files of a long session. */
  files: number;
  /** Size of all files. */
  bytes: number;
  /** Which file of it is missing; null: none. */
  parts_problem: string | null;
  /** Why it cannot be read; null: it can. */
  problem: string | null;
  session: string;
  scene: string;
  /** Begin, seconds since 1970. */
  start_s: number | null;
  duration_s: number | null;
  missing_ticks: number;
  complete: boolean;
  persons: readonly string[];
}

export interface RecordingList {
  recordings: readonly ListedRecording[];
  left_out: number;
  /** Files of the folder that are read, while more are to be read. */
  read: number;
  to_read: number;
  unfinished: number;
  problem: string | null;
}

/** Mark or event on the timeline. */
export interface Note {
  kind: 'mark' | 'event';
  /** Session time [s]. */
  t: number;
  /** Word of the audit log; empty: a mark. */
  what: string;
  /** Seat of the event; empty: none. */
  seat: string;
  text: string;
  person: string;
}

export type Curve = readonly (number | null)[];

export interface Curves {
  step_s: number;
  /** Force on the hand per seat [N]. */
  seats: readonly Curve[];
  tools: readonly { force: Curve; x: readonly Curve[]; alpha: readonly Curve[] }[];
}

export interface Outline {
  id: string;
  file: string;
  files: number;
  parts_problem: string | null;
  scene: Scene;
  from_s: number;
  to_s: number;
  rate_hz: number;
  per_piece: number;
  pieces: number;
  complete: boolean;
  missing_ticks: number;
  gap_count: number;
  /** The longest gaps, begin and end [s]. */
  gaps: readonly (readonly [number, number])[];
  /** Marks and events in the order of time. */
  notes: readonly Note[];
  notes_left_out: number;
  curves: Curves;
}

const curve = (value: unknown): Curve => list(value, kPointsMax).map(number);

export function readList(value: unknown): RecordingList {
  const from = object(value);
  return {
    recordings: list(from.recordings)
      .map(object)
      .map((row) => ({
        id: text(row.id),
        file: text(row.file),
        files: Math.max(1, count(row.files)),
        bytes: count(row.bytes),
        parts_problem: textOrNull(row.parts_problem),
        problem: textOrNull(row.problem),
        session: text(row.session),
        scene: text(row.scene),
        start_s: number(row.start_s),
        duration_s: number(row.duration_s),
        missing_ticks: count(row.missing_ticks),
        complete: row.complete !== false,
        persons: texts(row.persons),
      })),
    left_out: count(from.left_out),
    read: count(from.read),
    to_read: count(from.to_read),
    unfinished: count(from.unfinished),
    problem: textOrNull(from.problem),
  };
}

function notes(value: unknown, kind: Note['kind']): Note[] {
  return list(value, kNotesMax)
    .map(object)
    .flatMap((row) => {
      const t = number(row.t);
      return t === null
        ? []
        : [{ kind, t, what: text(row.what), seat: text(row.seat), text: text(row.text), person: text(row.person) }];
    });
}

function curves(value: unknown): Curves {
  const from = object(value);
  return {
    step_s: Math.max(1e-6, number(from.step_s) ?? 0.1),
    seats: list(from.seats, 24).map((seat) => curve(object(seat).force)),
    tools: list(from.tools, 8)
      .map(object)
      .map((tool) => ({
        force: curve(tool.force),
        x: list(tool.x, 3).map(curve),
        alpha: list(tool.alpha, 24).map(curve),
      })),
  };
}

/** Returns an outline, or null if the reply is none. */
export function readOutline(value: unknown): Outline | null {
  const from = object(value);
  const scene = readMessage(from.scene);
  const [from_s, to_s, rate_hz] = [number(from.from_s), number(from.to_s), number(from.rate_hz)];
  const per_piece = count(from.per_piece);
  if (scene?.type !== 'scene' || from_s === null || to_s === null || rate_hz === null) return null;
  if (!(rate_hz > 0) || !(to_s > from_s) || per_piece < 1) return null;
  return {
    id: text(from.id),
    file: text(from.file),
    files: Math.max(1, count(from.files)),
    parts_problem: textOrNull(from.parts_problem),
    scene,
    from_s,
    to_s,
    rate_hz,
    per_piece,
    pieces: count(from.pieces),
    complete: from.complete === true,
    missing_ticks: count(from.missing_ticks),
    gap_count: count(from.gap_count),
    gaps: list(from.gaps).flatMap((gap) => {
      const [begin, end] = list(gap, 2).map(number);
      return typeof begin === 'number' && typeof end === 'number' && end > begin ? [[begin, end] as const] : [];
    }),
    notes: [...notes(from.events, 'event'), ...notes(from.marks, 'mark')].sort((a, b) => a.t - b.t),
    notes_left_out: count(from.notes_left_out),
    curves: curves(from.curves),
  };
}

/** Returns the states of a piece in the order of time. */
export function readPiece(value: unknown): State[] {
  return list(object(value).states, kPieceMax).flatMap((entry) => {
    const state = readMessage(entry);
    return state?.type === 'state' ? [state] : [];
  });
}
