import {
  kSeatsMax,
  kToolsMax,
  type GatewayMessage,
  type Phase,
  type Recording,
  type SceneSeat,
  type SceneTool,
  type SeatOffer,
  type SeatState,
  type SheetName,
  type State,
  type StopState,
  type Surface,
  type ToolState,
  type Vec3,
} from './messages';
import { count, flag, isObject, kListMax, list, number, object, text, textOrNull, texts, type Json } from './json';
import { readScores } from './scores';

/** Longest frame that the page parses [characters]; a state of 24 seats needs some 12000. */
export const kFrameMax = 1 << 20;
const kPhases: readonly Phase[] = ['WAITING', 'RUNNING', 'HELD', 'STOPPED', 'PAUSED', 'OVER'];
const kServerWords = ['lost', 'gone', 'back'] as const;
const kSheets: readonly SheetName[] = ['OSATS', 'GEARS', 'GOALS', 'CHECKLIST'];

/** Returns three finite numbers, or null: one unknown component makes the vector unknown. */
function vec3(value: unknown): Vec3 | null {
  const [x, y, z] = list(value, 3).map(number);
  return x === undefined || x === null || y === undefined || y === null || z === undefined || z === null
    ? null
    : [x, y, z];
}

/** Returns shares in [0, 1], or null if one is missing or out of range. */
function shares(value: unknown): number[] | null {
  if (!Array.isArray(value)) return null;
  const found: number[] = [];
  for (const entry of list(value, kSeatsMax)) {
    const share = number(entry);
    if (share === null || share < 0 || share > 1) return null;
    found.push(share);
  }
  return found;
}

function surface(value: unknown): Surface[] {
  const from = object(value);
  const at = number(from.at_m);
  const axis = from.axis;
  if (at === null || (axis !== 0 && axis !== 1 && axis !== 2)) return [];
  return [{ axis, at_m: at, stiffness_n_m: number(from.stiffness_n_m), from_below: from.from_below === true }];
}

function sceneSeat(value: unknown): SceneSeat {
  const from = object(value);
  return {
    name: text(from.name),
    kind: from.kind === 'SLAVE' ? 'SLAVE' : 'MASTER',
    role: text(from.role),
    required: flag(from.required),
    device: textOrNull(from.device),
    force_limit_n: number(from.force_limit_n),
  };
}

function sceneTool(value: unknown): SceneTool {
  const from = object(value);
  return {
    name: text(from.name),
    mass_kg: number(from.mass_kg),
    walls: list(from.walls, 16).flatMap(surface),
    tissues: list(from.tissues, 16).flatMap(surface),
  };
}

function seatState(value: unknown): SeatState {
  const from = object(value);
  return {
    taken: flag(from.taken),
    heard: flag(from.heard),
    person: textOrNull(from.person),
    engaged: flag(from.engaged),
    gate: textOrNull(from.gate),
    x: vec3(from.x),
    f: vec3(from.f),
    alpha: shares(from.alpha) ?? [],
    rtt_ms: number(from.rtt_ms),
    loss_percent: number(from.loss_percent),
    gap_ms: number(from.gap_ms),
    age_ms: number(from.age_ms),
    margin_j: number(from.margin_j),
    trips: number(from.trips),
    late: number(from.late),
    temperature_c: number(from.temperature_c),
  };
}

function toolState(value: unknown): ToolState {
  const from = object(value);
  const transfer = isObject(from.transfer) ? from.transfer : null;
  return {
    x: vec3(from.x),
    v: vec3(from.v),
    f: vec3(from.f),
    depth_m: number(from.depth_m),
    touching: flag(from.touching),
    wanted: shares(from.wanted),
    applied: shares(from.applied),
    transfer: transfer && {
      by: text(transfer.by),
      to: text(transfer.to),
      alpha: number(transfer.alpha),
      ticks: number(transfer.ticks),
    },
  };
}

function stopState(value: unknown): StopState | null {
  if (!isObject(value)) return null;
  return {
    number: count(value.number),
    kind: text(value.kind),
    by: text(value.by),
    person: textOrNull(value.person),
    why: text(value.why),
    yours: value.yours === true,
  };
}

function recording(value: unknown): Recording | null {
  if (!isObject(value)) return null;
  return {
    by_server: value.by_server === true,
    by_recorders: count(value.by_recorders),
    pseudonyms: value.pseudonyms === true,
    dropped: count(value.dropped),
    trouble: text(value.trouble),
  };
}

function state(from: Json): State | null {
  const n = number(from.n);
  if (n === null || n < 0 || !Number.isSafeInteger(n)) return null;
  return {
    type: 'state',
    n,
    dropped: count(from.dropped),
    wall_us: number(from.wall_us),
    t: number(from.t) ?? 0,
    phase: kPhases.find((phase) => phase === from.phase) ?? 'WAITING',
    stop: stopState(from.stop),
    version: count(from.version),
    shed: count(from.shed),
    held: text(from.held),
    recording: recording(from.recording),
    noRecording: text(from.no_recording),
    seats: list(from.seats, kSeatsMax).map(seatState),
    tools: list(from.tools, kToolsMax).map(toolState),
  };
}

function scores(value: unknown): Record<string, number> {
  const found: Record<string, number> = Object.create(null) as Record<string, number>;
  for (const [key, entry] of Object.entries(object(value)).slice(0, 64)) {
    const score = number(entry);
    if (score !== null) found[text(key)] = score;
  }
  return found;
}

function sceneSeats(value: unknown): Map<string, SeatOffer[]> {
  return new Map(
    Object.entries(object(value))
      .slice(0, kListMax)
      .map(([scene, seats]) => [
        text(scene),
        list(seats, kSeatsMax)
          .map(object)
          .map((seat) => ({ name: text(seat.name), role: text(seat.role) })),
      ]),
  );
}

function sceneDurations(value: unknown): Map<string, number> {
  const found = new Map<string, number>();
  for (const [scene, entry] of Object.entries(object(value)).slice(0, kListMax)) {
    const duration = number(entry);
    if (duration !== null && duration > 0) found.set(text(scene), duration);
  }
  return found;
}

const kReaders: Record<string, (from: Json) => GatewayMessage | null> = {
  state,
  hello: (from) => ({
    type: 'hello',
    protocol: count(from.protocol),
    release: text(from.release),
    person: text(from.person),
    role: text(from.role),
    may: texts(from.may),
    sessions: list(from.sessions)
      .map(object)
      .map((session) => ({ id: text(session.id), name: text(session.name), state: text(session.state) })),
    scenes: texts(from.scenes),
    sceneSeats: sceneSeats(from.scene_seats),
    sceneDurations: sceneDurations(from.scene_durations_s),
    workstation: textOrNull(from.workstation),
    play: textOrNull(from.play),
  }),
  scene: (from) => ({
    type: 'scene',
    session: text(from.session),
    name: text(from.name),
    tick_hz: number(from.tick_hz),
    dof: number(from.dof),
    law: textOrNull(from.law),
    duration_s: number(from.duration_s),
    seats: list(from.seats, kSeatsMax).map(sceneSeat),
    tools: list(from.tools, kToolsMax).map(sceneTool),
  }),
  event: (from) => ({
    type: 'event',
    session: text(from.session),
    number: count(from.number),
    t: number(from.t),
    text: text(from.text),
  }),
  reply: (from) => ({ type: 'reply', id: number(from.id), ok: from.ok === true, text: text(from.text) }),
  notice: (from) => ({
    type: 'notice',
    level: from.level === 'error' || from.level === 'warning' ? from.level : 'info',
    text: text(from.text),
    server: kServerWords.find((known) => known === from.server) ?? null,
  }),
  seat: (from) => ({
    type: 'seat',
    seat: text(from.seat),
    f: vec3(from.f),
    x: vec3(from.x),
    engaged: flag(from.engaged),
    phase: text(from.phase),
    joined: from.joined !== false,
    ended: textOrNull(from.ended) ?? (text(from.seat) === '' ? 'left' : null),
  }),
  notes: (from) => ({
    type: 'notes',
    marks: list(from.marks)
      .map(object)
      .map((mark) => ({ t: number(mark.t), text: text(mark.text), person: text(mark.person) })),
    sheets: list(from.sheets)
      .map(object)
      .flatMap((sheet) => {
        const name = kSheets.find((known) => known === sheet.sheet);
        return name === undefined
          ? []
          : [
              {
                sheet: name,
                of: text(sheet.of),
                person: text(sheet.person),
                yours: typeof sheet.yours === 'boolean' ? sheet.yours : null,
                scores: scores(sheet.scores),
                closed: sheet.closed === true,
              },
            ];
      }),
  }),
  scores: (from) => {
    const scores = readScores(from);
    return scores && { type: 'scores', session: text(from.session), scores };
  },
  tickets: (from) => ({
    type: 'tickets',
    session: text(from.session),
    name: text(from.name),
    server: text(from.server),
    tickets: list(from.tickets, kSeatsMax * 2)
      .map(object)
      .map((ticket) => ({
        person: text(ticket.person),
        workstation: text(ticket.workstation),
        role: text(ticket.role),
        seat: text(ticket.seat),
        here: ticket.here === true,
        ticket: text(ticket.ticket),
      })),
  }),
};

/** Returns the message of one frame, or null if it is none that the page knows. Never throws. */
export function parseMessage(frame: string): GatewayMessage | null {
  if (frame.length > kFrameMax) return null;
  let parsed: unknown;
  try {
    parsed = JSON.parse(frame);
  } catch {
    return null;
  }
  return readMessage(parsed);
}

/** Returns a message from parsed JSON, or null if it is none that the page knows. Never throws. */
export function readMessage(parsed: unknown): GatewayMessage | null {
  if (!isObject(parsed) || typeof parsed.type !== 'string') return null;
  const reader = Object.prototype.hasOwnProperty.call(kReaders, parsed.type) ? kReaders[parsed.type] : undefined;
  return reader ? reader(parsed) : null;
}
