import { describe, expect, it } from 'vitest';

import { kAlarmsKept } from '../../src/logic/alarms';
import { kEventsKept, kNoticesKept, SessionModel } from '../../src/logic/session_model';
import { kStatesKept } from '../../src/logic/state_window';
import type { GatewayMessage, Hello } from '../../src/protocol/messages';
import { parseMessage } from '../../src/protocol/parse';
import { MockSession } from '../mock/session.mjs';
import { makeScene, makeState } from './support';

const hello: Hello = {
  type: 'hello',
  protocol: 1,
  release: '1',
  person: 'ina',
  role: 'INSTRUCTOR',
  may: ['stop'],
  sessions: [],
  scenes: [],
  sceneSeats: new Map(),
  sceneDurations: new Map(),
  workstation: null,
  play: null,
};

/** Entries of all arrays and maps below an object: what could grow. */
function entriesBelow(root: unknown, seen = new Set<unknown>()): number {
  if (typeof root !== 'object' || root === null || seen.has(root)) return 0;
  seen.add(root);
  const children = root instanceof Map ? [...root.values()] : Object.values(root as object);
  return children.reduce((sum: number, child) => sum + 1 + entriesBelow(child, seen), 0);
}

describe('SessionModel', () => {
  it('allows only what the gateway grants, and nothing without a connection', () => {
    const model = new SessionModel();
    expect(model.may('stop')).toBe(false);
    model.connected();
    model.apply(hello, 0);
    expect([model.may('stop'), model.may('authority')]).toEqual([true, false]);
    model.disconnected('lost', 'WebSocket 1006');
    expect([model.may('stop'), model.granted('stop')]).toEqual([false, true]);
    expect(model.alarms.current()).toMatchObject([{ kind: 'connection' }]);
    model.connected();
    expect(model.alarms.current()).toEqual([]);
  });

  it('allows nothing while the gateway has lost the server', () => {
    const model = new SessionModel();
    model.connected();
    model.apply(hello, 0);
    const tell = (server?: string): void => {
      const message = parseMessage(JSON.stringify({ type: 'notice', level: 'info', text: 'x', server }));
      if (message) model.apply(message, 0);
    };
    const seen = ['lost', undefined, 'odd', 'back', 'gone'].map((server) => {
      tell(server);
      return [model.server, model.may('stop'), model.granted('stop')];
    });
    expect(seen).toEqual([
      ['lost', false, true],
      ['lost', false, true],
      ['lost', false, true],
      ['there', true, true],
      ['gone', false, true],
    ]);
    // A gateway tells a new page of a lost server again.
    model.connected();
    expect(model.may('stop')).toBe(true);
  });

  it('raises no alarm when the gateway asks for a ticket', () => {
    const model = new SessionModel();
    model.disconnected('refused', 'sign in');
    expect(model.link).toBe('refused');
    model.connected();
    expect(model.alarms.list()).toEqual([]);
    // A loss that began before lasts until the page is connected again.
    model.disconnected('lost', 'WebSocket 1006');
    model.disconnected('refused', 'sign in');
    expect(model.alarms.current()).toMatchObject([{ kind: 'connection', over: false }]);
  });

  it('knows the time left of a session that ends by itself', () => {
    const model = new SessionModel();
    const left = (duration_s: number | null, t: number, phase: 'RUNNING' | 'OVER' = 'RUNNING'): number | null => {
      model.apply({ ...makeScene(), duration_s }, 0);
      model.apply(makeState({ t, phase }), 0);
      return model.left;
    };
    expect(left(20, 12.5)).toBe(7.5);
    expect(left(20, 20.1)).toBe(0);
    expect(left(20, 20, 'OVER')).toBeNull();
    expect(left(null, 3)).toBeNull();
  });

  it('takes events once, though a gateway sends them again after a reconnect', () => {
    const model = new SessionModel();
    const event = (number: number): GatewayMessage => ({
      type: 'event',
      session: 's',
      number,
      t: 1,
      text: `event ${number}`,
    });
    [1, 2, 1, 2, 3].forEach((n) => model.apply(event(n), 0));
    expect(model.events.toArray().map((e) => e.number)).toEqual([1, 2, 3]);
  });

  it('keeps drafts when the same scene is sent again, and forgets them with another session', () => {
    const model = new SessionModel();
    model.apply(makeScene(), 0);
    const first = model.scene;
    model.apply(makeState(), 0);
    model.apply(makeScene(), 1);
    expect(model.scene).toBe(first);
    expect(model.state).not.toBeNull();
    model.apply({ ...makeScene(), session: 'other' }, 2);
    expect(model.state).toBeNull();
    expect(model.history.samples).toBe(0);
  });

  it('stays bounded for a lesson of 12 hours with trouble', { timeout: 120_000 }, () => {
    const session = new MockSession({ seats: 8 });
    const model = new SessionModel();
    model.connected();
    model.apply(hello, 0);
    model.apply(makeSceneOf(session), 0);
    const kStates = 12 * 3600 * 5;
    let afterAnHour = 0;
    for (let n = 1; n <= kStates; n += 1) {
      session.step(0.2);
      const seat = session.seats[n % 8];
      if (seat && n % 37 === 0) seat.trips += 1;
      if (seat && n % 50 === 0) seat.heard = !seat.heard;
      if (n % 20 === 0) session.event(`event ${n}`);
      // Most states have the same shape; each tenth as a message keeps the test short.
      const message = n % 10 === 0 ? parseMessage(JSON.stringify(session.state(n, 0, 'ina', 'INSTRUCTOR'))) : null;
      if (message) model.apply(message, n * 200);
      const event = session.events[session.events.length - 1];
      if (event && n % 20 === 0) model.apply({ ...event, number: n } as GatewayMessage, n * 200);
      if (n % 100 === 0) model.apply({ type: 'notice', level: 'warning', text: `notice ${n}` }, n * 200);
      model.states.sample(n * 200);
      model.acknowledgements.next();
      if (n === kStates / 12) afterAnHour = entriesBelow(model);
    }
    expect(model.events.length).toBe(kEventsKept);
    expect(model.notices.length).toBe(kNoticesKept);
    expect(model.alarms.list()).toHaveLength(kAlarmsKept);
    expect(kStatesKept).toBe(8);
    expect(afterAnHour).toBeGreaterThan(1000);
    expect(entriesBelow(model)).toBeLessThanOrEqual(1.2 * afterAnHour);
  });
});

function makeSceneOf(session: MockSession): GatewayMessage {
  const scene = parseMessage(JSON.stringify(session.scene()));
  if (!scene) throw new Error('the scene of the mock is no message');
  return scene;
}
