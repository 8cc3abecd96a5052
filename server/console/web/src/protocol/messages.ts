/** Messages of the gateway, version 1. Quantities are SI unless the name has a suffix; null means unknown. */

import type { Scores } from './scores';

export const kProtocol = 1;
export const kSeatsMax = 24;
export const kToolsMax = 8;
/** Longest text that the page keeps [characters]. */
export const kTextMax = 1000;

export type Vec3 = readonly [number, number, number];
export type Right =
  | 'stop'
  | 'pause'
  | 'resume'
  | 'authority'
  | 'remove'
  | 'drain'
  | 'score'
  | 'create'
  | 'seat'
  | 'invite'
  | 'record'
  | 'recordings';
export type Phase = 'WAITING' | 'RUNNING' | 'HELD' | 'STOPPED' | 'PAUSED' | 'OVER';
export type SheetName = 'OSATS' | 'GEARS' | 'GOALS' | 'CHECKLIST';

export interface SessionName {
  id: string;
  name: string;
  state: string;
}

export interface Hello {
  type: 'hello';
  protocol: number;
  release: string;
  person: string;
  role: string;
  may: readonly string[];
  sessions: readonly SessionName[];
  /** Names of scenes from which this person may create a session; empty if the gateway does not say. */
  scenes: readonly string[];
  /** Seats of those scenes that the server could read, by the name of the scene. */
  sceneSeats: ReadonlyMap<string, readonly SeatOffer[]>;
  /** Session time after which a session of a scene ends by itself [s], of scenes that do. */
  sceneDurations: ReadonlyMap<string, number>;
  /** Name of the gateway's workstation; null: only the server knows it. */
  workstation: string | null;
  /** Seat that the page takes at once; null: none. */
  play: string | null;
}

/** A seat of a scene from which a session may be created. */
export interface SeatOffer {
  name: string;
  role: string;
}

export interface SceneSeat {
  name: string;
  kind: 'MASTER' | 'SLAVE';
  role: string;
  required: boolean | null;
  device: string | null;
  force_limit_n: number | null;
}

/** Half-space that resists: a wall (bone) or tissue. The solid side lies above `at_m` if `from_below`. */
export interface Surface {
  axis: 0 | 1 | 2;
  at_m: number;
  stiffness_n_m: number | null;
  from_below: boolean;
}

export interface SceneTool {
  name: string;
  mass_kg: number | null;
  walls: readonly Surface[];
  tissues: readonly Surface[];
}

export interface Scene {
  type: 'scene';
  session: string;
  name: string;
  tick_hz: number | null;
  dof: number | null;
  law: string | null;
  /** Session time after which the session ends by itself [s]; null: it does not, or that is not known. */
  duration_s: number | null;
  seats: readonly SceneSeat[];
  tools: readonly SceneTool[];
}

export interface StopState {
  number: number;
  kind: string;
  by: string;
  /** Name in the ticket of the person at `by`; null: not named. */
  person: string | null;
  why: string;
  yours: boolean;
}

export interface SeatState {
  taken: boolean | null;
  heard: boolean | null;
  person: string | null;
  engaged: boolean | null;
  gate: string | null;
  x: Vec3 | null;
  f: Vec3 | null;
  alpha: readonly number[];
  rtt_ms: number | null;
  loss_percent: number | null;
  gap_ms: number | null;
  age_ms: number | null;
  margin_j: number | null;
  trips: number | null;
  late: number | null;
  temperature_c: number | null;
}

export interface Transfer {
  by: string;
  to: string;
  alpha: number | null;
  ticks: number | null;
}

export interface ToolState {
  x: Vec3 | null;
  v: Vec3 | null;
  f: Vec3 | null;
  depth_m: number | null;
  touching: boolean | null;
  wanted: readonly number[] | null;
  applied: readonly number[] | null;
  transfer: Transfer | null;
}

/** Recording of the session, as all participants see it. */
export interface Recording {
  by_server: boolean;
  by_recorders: number;
  pseudonyms: boolean;
  dropped: number;
  trouble: string;
}

export interface State {
  type: 'state';
  n: number;
  dropped: number;
  wall_us: number | null;
  t: number;
  phase: Phase;
  stop: StopState | null;
  version: number;
  shed: number;
  held: string;
  recording: Recording | null;
  /** Why the server cannot record the session, and the remedy; empty: it can. */
  noRecording: string;
  seats: readonly SeatState[];
  tools: readonly ToolState[];
}

export interface SessionEvent {
  type: 'event';
  session: string;
  number: number;
  t: number | null;
  text: string;
}

export interface Reply {
  type: 'reply';
  id: number | null;
  ok: boolean;
  text: string;
}

export interface Notice {
  type: 'notice';
  level: 'info' | 'warning' | 'error';
  text: string;
  /** What became of the connection of the gateway to the server; null: the notice is about something else. */
  server?: 'lost' | 'gone' | 'back' | null;
}

/** State of the own browser seat. */
export interface OwnSeat {
  type: 'seat';
  seat: string;
  f: Vec3 | null;
  x: Vec3 | null;
  engaged: boolean | null;
  phase: string;
  /** The server admitted the person. */
  joined: boolean;
  /** Why the seat is over; null: it is not. */
  ended: string | null;
}

export interface Mark {
  t: number | null;
  text: string;
  person: string;
}

export interface Sheet {
  sheet: SheetName;
  of: string;
  person: string;
  /** Whether the person of this page wrote it; null: the gateway does not say. */
  yours: boolean | null;
  scores: Readonly<Record<string, number>>;
  closed: boolean;
}

export interface Notes {
  type: 'notes';
  marks: readonly Mark[];
  sheets: readonly Sheet[];
}

export interface Ticket {
  person: string;
  /** Computer at which the ticket is valid. */
  workstation: string;
  role: string;
  seat: string;
  /** Whether the ticket is for the gateway's workstation, so that a browser can use it. */
  here: boolean;
  ticket: string;
}

export interface Tickets {
  type: 'tickets';
  session: string;
  name: string;
  /** Address of the server, as the gateway reaches it. */
  server: string;
  tickets: readonly Ticket[];
}

/** Scores of the watched session so far, for roles that may score. */
export interface LiveScores {
  type: 'scores';
  session: string;
  scores: Scores;
}

export type GatewayMessage =
  | Hello
  | Scene
  | State
  | SessionEvent
  | Reply
  | Notice
  | OwnSeat
  | Notes
  | Tickets
  | LiveScores;

/** Orders of the lesson: the same commands as `tandem-client control`. */
export type OrderBody =
  | { order: 'stop' | 'pause'; why: string }
  | { order: 'resume'; stop: number }
  | { order: 'authority'; tool: number; version: number; alpha: readonly number[] }
  | { order: 'remove'; seat: string; why: string }
  | { order: 'drain'; grace_s: number }
  | {
      order: 'create';
      scene: string;
      name: string;
      people: readonly { name: string; role: string; seat: string; workstation?: string }[];
    }
  | { order: 'end'; session: string }
  | { order: 'record'; on: boolean };

/** Frames that expect a reply; the connection adds the `id`. */
export type Request =
  | { type: 'watch'; session: string }
  | ({ type: 'order' } & OrderBody)
  | { type: 'mark'; t: number; text: string }
  | { type: 'sheet'; sheet: SheetName; of: string; scores: Readonly<Record<string, number>>; closed: boolean }
  | { type: 'take'; seat: string; ticket?: string }
  | { type: 'leave' }
  | { type: 'invite' };

/** Frames without a reply. */
export type Signal = { type: 'ack'; n: number } | { type: 'pointer'; x: Vec3; pressed: boolean };
