import { describe, expect, it } from 'vitest';

import { kSeatsMax, type Hello, type State, type Tickets } from '../../src/protocol/messages';
import { kFrameMax, parseMessage } from '../../src/protocol/parse';
import { MockSession } from '../mock/session.mjs';

const state = (): Record<string, unknown> =>
  JSON.parse(JSON.stringify(new MockSession().state(7, 2, 'ina', 'INSTRUCTOR'))) as Record<string, unknown>;

describe('parseMessage', () => {
  it('reads a state of the gateway', () => {
    const parsed = parseMessage(JSON.stringify(state())) as State;
    expect(parsed).toMatchObject({ type: 'state', n: 7, dropped: 2, phase: 'RUNNING' });
    expect(parsed.seats).toHaveLength(2);
    expect(parsed.tools[0]?.wanted).toEqual([1, 0]);
  });

  it('reads the phase of a session that is held', () => {
    const parsed = parseMessage('{"type":"state","n":1,"phase":"HELD","seats":[],"tools":[]}') as State;
    expect(parsed.phase).toBe('HELD');
  });

  it('keeps what is unknown unknown', () => {
    const parsed = parseMessage('{"type":"state","n":1,"seats":[{"taken":true,"rtt_ms":null}],"tools":[{}]}') as State;
    expect(parsed.seats[0]).toMatchObject({ taken: true, rtt_ms: null, x: null, gate: null, heard: null });
    expect(parsed.tools[0]).toMatchObject({ x: null, touching: null, wanted: null, transfer: null });
  });

  it('rejects what is no message', () => {
    for (const frame of [
      '',
      '{',
      'null',
      '1',
      '[]',
      '"x"',
      '{}',
      '{"type":1}',
      '{"type":"nothing"}',
      '{"type":"__proto__"}',
    ]) {
      expect(parseMessage(frame)).toBeNull();
    }
    expect(parseMessage('{"type":"state"}')).toBeNull();
    expect(parseMessage('{"type":"state","n":-1}')).toBeNull();
    expect(parseMessage('{"type":"state","n":1e300}')).toBeNull();
    expect(parseMessage(`{"type":"event","text":"${'a'.repeat(kFrameMax)}"}`)).toBeNull();
  });

  it('bounds lists and texts, and removes control characters', () => {
    const many = { type: 'state', n: 1, seats: Array.from({ length: 1000 }, () => ({})), tools: [] };
    expect((parseMessage(JSON.stringify(many)) as State).seats).toHaveLength(kSeatsMax);
    const event = parseMessage(JSON.stringify({ type: 'event', text: `a\u202eb\u0007${'x'.repeat(5000)}` }));
    expect(event).toMatchObject({ type: 'event' });
    expect((event as { text: string }).text.startsWith('a b x')).toBe(true);
    expect((event as { text: string }).text).toHaveLength(1000);
  });

  it('refuses shares out of range and vectors with a missing component', () => {
    const parsed = parseMessage(
      '{"type":"state","n":1,"seats":[{"x":[1,2],"f":[1,null,3]}],"tools":[{"wanted":[2],"applied":[0.5,"x"]}]}',
    ) as State;
    expect(parsed.seats[0]).toMatchObject({ x: null, f: null });
    expect(parsed.tools[0]).toMatchObject({ wanted: null, applied: null });
  });

  it('survives each prefix and each changed value of a state', () => {
    const text = JSON.stringify(state());
    for (let end = 0; end < text.length; end += 7) expect(parseMessage(text.slice(0, end))).toBeNull();
    const hostile = [null, -1, 1e308, 'x', [], {}, true, [[[]]], { x: 1 }];
    for (const key of Object.keys(state())) {
      for (const value of hostile) {
        const parsed = parseMessage(JSON.stringify({ ...state(), [key]: value }));
        if (parsed?.type === 'state') expect(Array.isArray(parsed.seats) && Number.isFinite(parsed.t)).toBe(true);
      }
    }
  });

  it('gives scores no way into the prototype', () => {
    const notes = parseMessage(
      '{"type":"notes","marks":[],"sheets":[{"sheet":"GOALS","of":"a","person":"b","scores":{"__proto__":3,"autonomy":"5","efficiency":4},"closed":1},{"sheet":"OTHER"}]}',
    );
    expect(notes).toMatchObject({ sheets: [{ sheet: 'GOALS', closed: false }] });
    expect(({} as Record<string, unknown>).autonomy).toBeUndefined();
    expect(notes?.type === 'notes' && Object.keys(notes.sheets[0]?.scores ?? {})).toEqual(['__proto__', 'efficiency']);
  });

  it('reads walls on three axes only', () => {
    const scene = parseMessage(
      '{"type":"scene","tools":[{"name":"a","walls":[{"axis":0,"at_m":0.01},{"axis":3,"at_m":0},{"axis":1}]}]}',
    );
    expect(scene).toMatchObject({
      tools: [{ walls: [{ axis: 0, at_m: 0.01, from_below: false, stiffness_n_m: null }] }],
    });
  });

  it('reads the seats of scenes, and which tickets a browser can use', () => {
    const hello = parseMessage(
      '{"type":"hello","scene_seats":{"contact":[{"name":"trainer","role":"INSTRUCTOR"},7],"bad":3,"__proto__":[{"name":"x"}]},"workstation":"local"}',
    ) as Hello;
    expect(hello.sceneSeats.get('contact')).toEqual([
      { name: 'trainer', role: 'INSTRUCTOR' },
      { name: '', role: '' },
    ]);
    expect(hello.sceneSeats.get('bad')).toEqual([]);
    expect(hello.workstation).toBe('local');
    const durations = parseMessage(
      '{"type":"hello","scene_durations_s":{"contact":20,"lesson":0,"bad":"9","worse":-1,"__proto__":5}}',
    ) as Hello;
    expect([...durations.sceneDurations]).toEqual([
      ['contact', 20],
      ['__proto__', 5],
    ]);
    expect((parseMessage('{"type":"hello"}') as Hello).sceneSeats.size).toBe(0);
    const tickets = parseMessage(
      '{"type":"tickets","server":"lab:7000","tickets":[{"here":true},{"here":"yes"}]}',
    ) as Tickets;
    expect(tickets.server).toBe('lab:7000');
    expect(tickets.tickets.map(({ here }) => here)).toEqual([true, false]);
  });
});
