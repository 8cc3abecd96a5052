import { describe, expect, it } from 'vitest';

import { freeSeats, proposedSeat, TrialSeat } from '../../src/logic/seat_choice';
import type { Scene, SceneSeat } from '../../src/protocol/messages';
import { makeScene, makeSeat, makeState } from './support';

const seat = (name: string, role: string, kind: SceneSeat['kind'] = 'MASTER'): SceneSeat => ({
  name,
  kind,
  role,
  required: null,
  device: null,
  force_limit_n: null,
});
const demo: Scene = {
  ...makeScene(),
  seats: [
    seat('evaluator1', 'EVALUATOR'),
    seat('robot', 'TRAINEE', 'SLAVE'),
    seat('instructor', 'INSTRUCTOR'),
    seat('trainee', 'TRAINEE'),
  ],
};
const names = (taken: readonly (boolean | null)[]): string[] =>
  freeSeats(demo, makeState({ seats: taken.map((each) => makeSeat({ taken: each })) })).map(({ name }) => name);

describe('freeSeats', () => {
  it('has master seats that are known to be free, in the order of the scene', () => {
    expect(names([false, false, false, false])).toEqual(['evaluator1', 'instructor', 'trainee']);
    expect(names([true, false, false, null])).toEqual(['instructor']);
    expect(freeSeats(null, null)).toEqual([]);
    expect(freeSeats(demo, null)).toEqual([]);
  });
});

describe('proposedSeat', () => {
  const free = freeSeats(demo, makeState({ seats: demo.seats.map(() => makeSeat({ taken: false })) }));
  it('prefers the choice of the person, then the trial, then a seat that moves a tool', () => {
    expect(proposedSeat(free, 'evaluator1', 'trainee')).toBe('evaluator1');
    expect(proposedSeat(free, 'gone', 'trainee')).toBe('trainee');
    expect(proposedSeat(free, '', 'gone')).toBe('instructor');
    expect(proposedSeat(free, '', null)).toBe('instructor');
    expect(proposedSeat(free.slice(0, 1), '', null)).toBe('evaluator1');
    expect(proposedSeat([], 'trainee', 'trainee')).toBe('');
  });
});

describe('TrialSeat', () => {
  const trainer = [seat('trainer', 'INSTRUCTOR')];
  it('takes a free seat once', () => {
    const trial = new TrialSeat();
    expect(trial.begun).toBe(false);
    expect(trial.next('trainer', trainer, 0)).toBe('trainer');
    expect(trial.begun).toBe(true);
    expect(trial.next('trainer', trainer, 1)).toBeNull();
  });
  it('waits 5 s for a seat that was left, and no longer', () => {
    const soon = new TrialSeat();
    expect(soon.next('trainer', [], 1000)).toBeNull();
    expect(soon.next('trainer', trainer, 5999)).toBe('trainer');
    const late = new TrialSeat();
    expect(late.next('trainer', [], 1000)).toBeNull();
    expect(late.next('trainer', [], 6000)).toBeNull();
    expect(late.next('trainer', trainer, 6001)).toBeNull();
  });
  it('takes nothing after the person chose a seat', () => {
    const trial = new TrialSeat();
    expect(trial.next('trainer', [], 0)).toBeNull();
    trial.end();
    expect(trial.next('trainer', trainer, 1)).toBeNull();
  });
});
