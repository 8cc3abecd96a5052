import { describe, expect, it } from 'vitest';

import { GivenTickets, kGivenMax } from '../../src/logic/given_tickets';
import type { SessionName, Tickets } from '../../src/protocol/messages';

const made = (session: string): Tickets => ({ type: 'tickets', session, name: session, server: 's:1', tickets: [] });
const listed = (...ids: string[]): SessionName[] => ids.map((id) => ({ id, name: id, state: 'RUNNING' }));
const names = (given: GivenTickets): string[] => given.list().map(({ tickets }) => tickets.session);

describe('GivenTickets', () => {
  it('keeps the cards of all sessions until they are closed', () => {
    const given = new GivenTickets();
    expect(given.open).toBe(false);
    given.add(made('a'));
    given.add(made('b'));
    expect(names(given)).toEqual(['b', 'a']);
    given.close('b');
    expect(given.open).toBe(true);
    given.close('a');
    expect(given.open).toBe(false);
    // The sessions are not over: the page may still show and end them.
    expect(names(given)).toEqual(['b', 'a']);
    given.ended('a');
    expect(names(given)).toEqual(['b']);
  });

  it('knows a session as over once the gateway lists it no more', () => {
    const given = new GivenTickets();
    given.add(made('a'));
    given.update(listed('x'));
    expect(given.list()[0]).toMatchObject({ listed: false, over: false });
    given.update(listed('x', 'a'));
    const before = given.revision;
    given.update(listed('x', 'a'));
    expect(given.revision).toBe(before);
    given.update(listed('x'));
    // Open cards stay, so that nothing vanishes while a person reads it.
    expect(given.list()[0]).toMatchObject({ open: true, over: true });
    given.close('a');
    expect(names(given)).toEqual([]);
  });

  it('is bounded', () => {
    const given = new GivenTickets();
    for (let i = 0; i <= kGivenMax; i += 1) given.add(made(`s${i}`));
    expect(given.list()).toHaveLength(kGivenMax);
    expect(names(given)[0]).toBe(`s${kGivenMax}`);
  });
});
