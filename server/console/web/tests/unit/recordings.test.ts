import { describe, expect, it } from 'vitest';

import {
  differenceCurve,
  distance,
  overlaidMoment,
  overlaidScene,
  overlaidState,
  placeAt,
  pointAt,
} from '../../src/logic/comparison';
import { PlayerClock } from '../../src/logic/player_clock';
import { emptyState, kPiecesKept, RecordedStates } from '../../src/logic/recorded_states';
import type { Scene, State } from '../../src/protocol/messages';
import { readList, readOutline, readPiece, type Outline } from '../../src/protocol/recordings';
import { readScores } from '../../src/protocol/scores';
import { noteText } from '../../src/views/note_text';

/** Words of server/report/audit_event.h. */
const kAuditWords = [
  'join',
  'leave',
  'loss',
  'back',
  'quarantined',
  'cleared',
  'forbidden',
  'authority',
  'stop',
  'pause',
  'resume',
  'local-stop',
  'local-resume',
  'fault',
  'instructor-away',
  'restored',
  'all-back',
  'flood',
  'removed',
  'overload',
  'overload-cleared',
  'authority-refused',
  'authority-canceled',
  'authority-deferred',
  'lease-doubtful',
  'lease-renewed',
];

const kScene: Scene = {
  type: 'scene',
  session: 'ab',
  name: 'contact',
  tick_hz: 1000,
  dof: 3,
  law: 'REPLICA',
  duration_s: null,
  seats: ['trainer', 'trainee'].map((name) => ({
    name,
    kind: 'MASTER',
    role: 'TRAINEE',
    required: true,
    device: null,
    force_limit_n: 3,
  })),
  tools: [{ name: 'tool', mass_kg: 1, walls: [], tissues: [] }],
};

/** 20 s from second 5 on; the tool moves by 1 mm per point of the curve. */
function outline(more: Partial<Outline> = {}): Outline {
  const x = Array.from({ length: 200 }, (_, i) => i * 0.001);
  const zero = x.map(() => 0);
  return {
    id: 'ab',
    file: 'a.mcap',
    files: 1,
    parts_problem: null,
    scene: kScene,
    from_s: 5,
    to_s: 25,
    rate_hz: 60,
    per_piece: 600,
    pieces: 2,
    complete: true,
    missing_ticks: 0,
    gap_count: 0,
    gaps: [],
    notes: [],
    notes_left_out: 0,
    curves: { step_s: 0.1, seats: [zero, zero], tools: [{ force: zero, x: [x, zero, zero], alpha: [zero, zero] }] },
    ...more,
  };
}

/** State of period `n`, with the tool at x = n mm. */
function stateOf(n: number): State {
  const empty = emptyState(kScene, 5 + (n - 1) / 60);
  return {
    ...empty,
    n,
    tools: empty.tools.map((tool) => ({ ...tool, x: [n * 0.001, 0, 0] as const, applied: [1, 0] })),
  };
}

const range = (from: number, to: number): State[] => Array.from({ length: to - from }, (_, i) => stateOf(from + i));
const toolX = (states: RecordedStates, t: number): number | null => {
  const moment = states.at(t);
  return moment.kind === 'state' ? (moment.state.tools[0]?.x?.[0] ?? null) : null;
};

describe('PlayerClock', () => {
  it('advances by the time of the screen and the speed, and stops at the end', () => {
    const clock = new PlayerClock(5, 6);
    clock.advance(1000, false);
    clock.advance(1100, false);
    expect(clock.t).toBe(5);
    clock.toggle();
    clock.speed = 4;
    clock.advance(1200, false);
    expect(clock.t).toBeCloseTo(5.4, 9);
    clock.advance(1300, true);
    expect(clock.t).toBeCloseTo(5.4, 9);
    clock.advance(1500, false);
    expect([clock.t, clock.playing]).toEqual([6, false]);
    clock.toggle();
    expect([clock.t, clock.playing]).toEqual([5, true]);
  });

  it('steps and seeks within the recording only', () => {
    const clock = new PlayerClock(5, 6);
    clock.step(0.25);
    expect(clock.t).toBe(5.25);
    clock.seek(99);
    expect(clock.t).toBe(6);
    clock.seek(-1);
    expect(clock.t).toBe(5);
    clock.seek(NaN);
    expect(clock.t).toBe(5);
  });
});

describe('RecordedStates', () => {
  it('asks for the shown piece and the next one, each once', () => {
    const states = new RecordedStates(outline());
    expect(states.wanted(5)).toEqual([0, 1]);
    expect(states.wanted(5)).toEqual([]);
    expect(states.at(5)).toEqual({ kind: 'loading' });
    states.fail(0, 'cut');
    expect(states.at(5)).toEqual({ kind: 'failed', why: 'cut' });
    states.retry();
    expect(states.wanted(24.99)).toEqual([]);
    expect(states.wanted(5)).toEqual([0]);
  });

  it('interpolates between neighbouring periods only: a missing period is a gap', () => {
    const states = new RecordedStates(outline());
    states.add(0, [...range(1, 31), ...range(34, 601)]);
    states.add(1, range(601, 1201));
    expect(toolX(states, 5)).toBe(0.001);
    expect(toolX(states, 5 + 0.5 / 60)).toBeCloseTo(0.0015, 9);
    expect(toolX(states, 5 + 29.9 / 60)).toBe(0.03); // its neighbour is missing: held, not drawn towards period 34
    for (const n of [30, 31.5, 32.9]) expect(states.at(5 + n / 60)).toEqual({ kind: 'gap' });
    expect(toolX(states, 5 + 33 / 60)).toBeCloseTo(0.034, 9);
    expect(toolX(states, 5 + 599.5 / 60)).toBeCloseTo(0.6005, 9); // over the border of two pieces
    expect(toolX(states, 25)).toBe(1.2); // the end belongs to the last period
  });

  it('keeps a bounded number of pieces, the ones used last', () => {
    const states = new RecordedStates(outline({ to_s: 1005, pieces: 100 }));
    for (let k = 0; k < 50; k += 1) {
      states.add(k, range(600 * k + 1, 600 * k + 601));
      expect(states.at(5).kind).toBe('state');
    }
    expect(states.size).toBe(kPiecesKept);
  });
});

describe('comparison', () => {
  it('joins seats, tools and authority of two scenes', () => {
    const scene = overlaidScene(kScene, kScene, '(2)');
    expect(scene.seats.map(({ name }) => name)).toEqual(['trainer', 'trainee', 'trainer (2)', 'trainee (2)']);
    const state = overlaidState(stateOf(1), stateOf(2), kScene, kScene);
    expect(state.tools.map(({ applied }) => applied)).toEqual([
      [1, 0, 0, 0],
      [0, 0, 1, 0],
    ]);
  });

  it('shows the side that has data, and waits for both', () => {
    const a = { kind: 'state', state: stateOf(5) } as const;
    const both = overlaidMoment(a, { kind: 'gap' }, kScene, kScene, 7);
    expect(both.kind === 'state' && both.state.tools.map(({ x }) => x)).toEqual([[0.005, 0, 0], null]);
    expect(overlaidMoment(a, { kind: 'loading' }, kScene, kScene, 7).kind).toBe('loading');
    expect(overlaidMoment({ kind: 'gap' }, { kind: 'gap' }, kScene, kScene, 7).kind).toBe('gap');
  });

  it('computes the distance of the tools with an offset, never over a gap', () => {
    const a = outline();
    expect(placeAt(a, 0, 5.05)?.[0]).toBeCloseTo(0.0005, 9);
    expect(differenceCurve(a, a, 0, 0).every((d) => d === 0)).toBe(true);
    const shifted = differenceCurve(a, a, 0, 0.2);
    expect(shifted[0]).toBeCloseTo(0.002, 9);
    expect(shifted.slice(-2)).toEqual([null, null]); // the second one has ended
    const x = a.curves.tools[0]?.x[0]?.map((value, i) => (i === 10 ? null : value)) ?? [];
    const holed = outline({
      curves: { ...a.curves, tools: [{ force: [], x: [x, x.map(() => 0), x.map(() => 0)], alpha: [] }] },
    });
    expect(placeAt(holed, 0, 5.95)).toBeNull();
    expect(placeAt(holed, 0, 6)).toBeNull();
    expect(placeAt(holed, 0, 6.05)).toBeNull();
    expect(placeAt(holed, 0, 6.1)?.[0]).toBeCloseTo(0.011, 9);
    expect(distance([0, 0, 0], [0.003, 0.004, 0])).toBeCloseTo(0.005, 12);
  });
});

describe('replies about recordings', () => {
  it('survive any JSON', () => {
    for (const junk of [
      null,
      3,
      'x',
      [],
      {},
      { states: 7, recordings: [null], metrics: 'm', scene: { type: 'state' } },
    ]) {
      expect(readPiece(junk)).toEqual([]);
      expect(readOutline(junk)).toBeNull();
      expect(readScores(junk)).toBeNull();
      expect(readList(junk).recordings.length).toBeLessThanOrEqual(1);
    }
    expect(readOutline({ ...outline(), to_s: 5, events: [], marks: [] })).toBeNull();
  });

  it('have the number of files, and which one is missing', () => {
    const [long, old] = readList({
      recordings: [{ id: '1', file: 'a.mcap', files: 3, parts_problem: 'part 2 is missing' }, { id: '2' }],
    }).recordings;
    expect([long?.files, long?.parts_problem]).toEqual([3, 'part 2 is missing']);
    expect([old?.files, old?.parts_problem]).toEqual([1, null]);
    const raw = { ...outline(), scene: kScene, events: [], marks: [] };
    expect(readOutline({ ...raw, files: 3, parts_problem: 'part 2 is missing' })?.parts_problem).toBe(
      'part 2 is missing',
    );
    expect(readOutline({ ...raw, files: undefined })?.files).toBe(1);
  });

  it('sort marks and events by time', () => {
    const found = readOutline({
      ...outline(),
      marks: [{ t: 9, text: 'late', person: 'eva' }],
      events: [
        { t: 7, what: 'stop', text: '' },
        { t: null, text: 'no time' },
      ],
    });
    expect(found?.notes.map(({ kind, t, what, text }) => [kind, t, what, text])).toEqual([
      ['event', 7, 'stop', ''],
      ['mark', 9, '', 'late'],
    ]);
  });

  it('hold the values of the last point until the end', () => {
    const point = (t: number): number => pointAt(outline(), t);
    expect([5, 5.05, 5.1, 24.9, 25, 99].map(point)).toEqual([0, 0, 1, 199, 199, 199]);
    expect(pointAt(outline({ curves: { step_s: 0.1, seats: [], tools: [] } }), 9)).toBe(0);
  });

  it('keep flags and reasons of scores', () => {
    const scores = readScores({
      rate_hz: 60,
      metrics: [{ key: 'sparc', title: 'Smoothness', unit: '' }],
      seats: [{ seat: 's', parts: [{ part: 'whole', cells: [{ text: null, trust: 'withheld', reason: 'gap' }] }] }],
    });
    expect(scores?.seats[0]?.parts[0]?.cells[0]).toEqual({ text: null, trust: 'withheld', reason: 'gap' });
  });
});

describe('events of a recording', () => {
  const words = (what: string, text: string, seat = '', person = ''): string =>
    noteText({ kind: 'event', t: 0, what, seat, person, text });
  // The lines are those of tests/server/session/stop_latch_test.cpp.
  it('say who did what in plain words', () => {
    expect(words('join', 'trainer tick 0', 'trainer')).toBe('trainer joins');
    expect(words('stop', 'trainee tick 7', 'trainee', 'ted')).toBe('ted (trainee) stops the session');
    expect(words('resume', 'console version 3 tick 900')).toBe('a console resumes the session');
    expect(words('resume', 'console version 3 tick 900', '', 'olga')).toBe('olga (a console) resumes the session');
    expect(words('overload', 'session tick 900')).toBe('The server is too slow, so all hands are released');
  });
  it('name the shares that change, and a stale link', () => {
    const shares =
      'timeline tool version 3 tick 500: trainer 1.000 to 0.250, trainee 0.000 to 0.750, eva 0.000 to 0.000';
    expect(words('authority', shares)).toBe(
      'the plan of the scene changes the authority over tool: trainer from 100\u202f% to 25\u202f%, trainee from 0\u202f% to 75\u202f%',
    );
    expect(words('authority-refused', `${shares}; the link of trainee is stale`)).toMatch(
      /^A change of the authority over tool by the plan of the scene is rejected: .*\. The connection of trainee is lost\.$/,
    );
  });
  it('keep words of a newer server, and marks as they were written', () => {
    expect(words('teleported', 'trainer tick 3', 'trainer')).toBe('teleported: trainer tick 3');
    expect(words('stop', 'by hand')).toBe('stop: by hand');
    expect(words('stop', '')).toBe('stop');
    expect(noteText({ kind: 'mark', t: 0, what: '', seat: '', person: 'eva', text: 'good $& tick 3' })).toBe(
      'good $& tick 3',
    );
  });
  it('have words for all events of the audit log', () => {
    for (const what of kAuditWords) expect(words(what, 'trainer tick 0', 'trainer')).not.toContain('tick');
  });
});
