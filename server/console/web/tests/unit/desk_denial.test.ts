import { describe, expect, it } from 'vitest';

import { deskDenial } from '../../src/logic/desk_denial';

describe('deskDenial', () => {
  it('advises nothing to an observer that an observer cannot do', () => {
    expect(deskDenial({ role: 'OBSERVER', may: [] })).toBe('desk.denied_watch');
  });
  it('advises the person of the gateway to start it with another role', () => {
    expect(deskDenial({ role: 'INSTRUCTOR', may: ['invite', 'stop'] })).toBe('desk.denied_gateway');
    expect(deskDenial({ role: 'OBSERVER', may: ['invite'] })).toBe('desk.denied_gateway');
  });
  it('advises others to ask for a ticket', () => {
    expect(deskDenial({ role: 'EVALUATOR', may: ['score'] })).toBe('desk.denied_ticket');
  });
});
