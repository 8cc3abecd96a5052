import type { Notes, Sheet, SheetName } from '../protocol/messages';

export interface SheetItem {
  id: string;
  /** May be left out without making the sheet incomplete. */
  optional?: true;
}

export interface SheetForm {
  name: SheetName;
  /** Smallest and largest score of an item; a checklist has 0 (not done) and 1 (done). */
  range: readonly [number, number];
  items: readonly SheetItem[];
}

/**
 * Rating scales. Sources: Martin et al. 1997 (OSATS, global rating), Goh et al. 2012 (GEARS), Vassiliou et al. 2005 (GOALS).
 * Each item has 1 to 5 points.
 */
export const kForms: readonly SheetForm[] = [
  {
    name: 'OSATS',
    range: [1, 5],
    items: [
      { id: 'respect_for_tissue' },
      { id: 'time_and_motion' },
      { id: 'instrument_handling' },
      { id: 'knowledge_of_instruments' },
      { id: 'use_of_assistants' },
      { id: 'flow_and_forward_planning' },
      { id: 'knowledge_of_procedure' },
    ],
  },
  {
    name: 'GEARS',
    range: [1, 5],
    items: [
      { id: 'depth_perception' },
      { id: 'bimanual_dexterity' },
      { id: 'efficiency' },
      { id: 'force_sensitivity' },
      { id: 'robotic_control' },
      { id: 'autonomy', optional: true },
    ],
  },
  {
    name: 'GOALS',
    range: [1, 5],
    items: [
      { id: 'depth_perception' },
      { id: 'bimanual_dexterity' },
      { id: 'efficiency' },
      { id: 'tissue_handling' },
      { id: 'autonomy' },
    ],
  },
  {
    name: 'CHECKLIST',
    range: [0, 1],
    items: [
      { id: 'device_checked' },
      { id: 'task_explained' },
      { id: 'contact_gentle' },
      { id: 'target_reached' },
      { id: 'no_force_limit' },
      { id: 'hand_over_clear' },
    ],
  },
];

export function formOf(name: SheetName): SheetForm {
  const form = kForms.find((known) => known.name === name);
  if (!form) throw new RangeError(`sheet ${name}: allowed are OSATS, GEARS, GOALS and CHECKLIST`);
  return form;
}

/** Returns the scores of known items that are integers in the range. */
export function validScores(form: SheetForm, scores: Readonly<Record<string, number>>): Record<string, number> {
  const valid: Record<string, number> = {};
  for (const { id } of form.items) {
    const score = Object.prototype.hasOwnProperty.call(scores, id) ? scores[id] : undefined;
    if (score !== undefined && Number.isInteger(score) && score >= form.range[0] && score <= form.range[1])
      valid[id] = score;
  }
  return valid;
}

export interface Total {
  points: number;
  /** Largest total of all required items and of the optional ones that have a score. */
  of: number;
  missing: string[];
}

export function totalOf(form: SheetForm, scores: Readonly<Record<string, number>>): Total {
  const valid = validScores(form, scores);
  const values = Object.values(valid);
  return {
    points: values.reduce((a, b) => a + b, 0),
    of: form.items.filter((item) => !item.optional || valid[item.id] !== undefined).length * form.range[1],
    missing: form.items.filter((item) => !item.optional && valid[item.id] === undefined).map((item) => item.id),
  };
}

/** Names can be chosen freely, so the gateway's word comes first. */
function isOwn(sheet: Sheet, person: string): boolean {
  return sheet.yours ?? sheet.person === person;
}

/** A sheet of an evaluator that is not sent yet, or that the gateway returned. */
export function ownSheet(notes: Notes | null, person: string, name: SheetName, of: string): Sheet | null {
  return notes?.sheets.find((s) => isOwn(s, person) && s.sheet === name && s.of === of) ?? null;
}

/**
 * Returns the closed sheets of other evaluators, and none before the own sheet is closed: raters must not influence each
 * other. The gateway holds them back as well; the page does not rely on that.
 */
export function othersSheets(notes: Notes | null, person: string, name: SheetName, of: string): Sheet[] {
  if (!ownSheet(notes, person, name, of)?.closed) return [];
  return notes?.sheets.filter((s) => !isOwn(s, person) && s.sheet === name && s.of === of && s.closed) ?? [];
}
