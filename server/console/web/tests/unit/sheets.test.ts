import { describe, expect, it } from 'vitest';

import { formOf, kForms, othersSheets, ownSheet, totalOf, validScores } from '../../src/logic/sheets';
import type { Notes, Sheet } from '../../src/protocol/messages';

const all = (name: 'OSATS' | 'GEARS' | 'GOALS' | 'CHECKLIST', points: number): Record<string, number> =>
  Object.fromEntries(formOf(name).items.map((item) => [item.id, points]));

describe('forms', () => {
  it('have the items of the published scales', () => {
    expect(kForms.map((form) => [form.name, form.items.length])).toEqual([
      ['OSATS', 7],
      ['GEARS', 6],
      ['GOALS', 5],
      ['CHECKLIST', 6],
    ]);
    expect(totalOf(formOf('OSATS'), all('OSATS', 5))).toEqual({ points: 35, of: 35, missing: [] });
    expect(totalOf(formOf('GOALS'), all('GOALS', 3))).toEqual({ points: 15, of: 25, missing: [] });
  });
  it('count an optional item only if it has a score', () => {
    const { autonomy, ...required } = all('GEARS', 4);
    expect(autonomy).toBe(4);
    expect(totalOf(formOf('GEARS'), required)).toEqual({ points: 20, of: 25, missing: [] });
    expect(totalOf(formOf('GEARS'), all('GEARS', 4))).toEqual({ points: 24, of: 30, missing: [] });
  });
  it('name what is missing', () => {
    expect(totalOf(formOf('GOALS'), { autonomy: 2 }).missing).toEqual([
      'depth_perception',
      'bimanual_dexterity',
      'efficiency',
      'tissue_handling',
    ]);
  });
  it('refuse scores that are no integers of the range, and unknown items', () => {
    const scores = {
      autonomy: 6,
      efficiency: 0,
      depth_perception: 2.5,
      tissue_handling: NaN,
      other: 3,
      bimanual_dexterity: 5,
    };
    expect(validScores(formOf('GOALS'), scores)).toEqual({ bimanual_dexterity: 5 });
    expect(() => formOf('NASA' as 'GOALS')).toThrow(RangeError);
  });
});

describe('sheets of others', () => {
  const sheet = (person: string, closed: boolean): Sheet => ({
    sheet: 'GOALS',
    of: 'trainee',
    person,
    yours: null,
    scores: {},
    closed,
  });
  const notes = (...sheets: Sheet[]): Notes => ({ type: 'notes', marks: [], sheets });

  it('are hidden until the own sheet is closed', () => {
    const open = notes(sheet('eva', false), sheet('max', true));
    expect(othersSheets(open, 'eva', 'GOALS', 'trainee')).toEqual([]);
    const closed = notes(sheet('eva', true), sheet('max', true), sheet('kim', false));
    expect(othersSheets(closed, 'eva', 'GOALS', 'trainee').map((s) => s.person)).toEqual(['max']);
    expect(othersSheets(notes(sheet('max', true)), 'eva', 'GOALS', 'trainee')).toEqual([]);
    expect(othersSheets(null, 'eva', 'GOALS', 'trainee')).toEqual([]);
  });
  it('are told from the own one by the gateway, because two persons may have one name', () => {
    const mine = { ...sheet('eva', false), yours: true };
    const theirs = { ...sheet('eva', true), yours: false };
    expect(ownSheet(notes(theirs, mine), 'eva', 'GOALS', 'trainee')).toBe(mine);
    expect(othersSheets(notes(theirs, mine), 'eva', 'GOALS', 'trainee')).toEqual([]);
    const closed = { ...mine, closed: true };
    expect(othersSheets(notes(theirs, closed), 'eva', 'GOALS', 'trainee')).toEqual([theirs]);
  });
  it('belong to one scale and one person', () => {
    const closed = notes(
      sheet('eva', true),
      { ...sheet('max', true), sheet: 'OSATS' },
      { ...sheet('kim', true), of: 'b' },
    );
    expect(othersSheets(closed, 'eva', 'GOALS', 'trainee')).toEqual([]);
    expect(ownSheet(closed, 'eva', 'GOALS', 'trainee')?.closed).toBe(true);
    expect(ownSheet(closed, 'eva', 'OSATS', 'trainee')).toBeNull();
  });
});
