import { describe, expect, it } from 'vitest';

import { clock, fixed, kUnknown, percent } from '../../src/logic/format';
import {
  isForBrowser,
  kPeopleMax,
  lessonMistakes,
  proposeSeats,
  serverAddress,
  stepsOf,
  ticketLink,
  ticketOfHash,
  type LessonMistake,
  type Step,
} from '../../src/logic/lesson';
import { kKeyStep, kReach, kStickSpeed, PointerDevice } from '../../src/logic/pointer_device';
import { spread } from '../../src/picture/label';
import { isName } from '../../src/protocol/names';
import { en } from '../../src/strings/en';
import { fr } from '../../src/strings/fr';
import { preferredLanguage, setLanguage, t, word } from '../../src/strings/strings';

describe('PointerDevice', () => {
  it('maps the pad to the reach, in both planes', () => {
    const device = new PointerDevice();
    device.pointAt(0.5, -0.25);
    expect(device.x).toEqual([0.03, 0, -0.015]);
    device.plane = 'above';
    device.pointAt(-1, 1);
    expect(device.x).toEqual([-kReach, kReach, -0.015]);
    expect(device.place([-kReach, 0.03, 0])).toEqual([-1, 0.5]);
  });
  it('never leaves the reach and takes no invalid number', () => {
    const device = new PointerDevice();
    device.pointAt(50, NaN);
    expect(device.x).toEqual([kReach, 0, 0]);
    for (let i = 0; i < 100; i += 1) device.step(1, kKeyStep);
    expect(device.x[1]).toBe(kReach);
    device.moveTo([Infinity, -9, 0.01]);
    expect(device.x).toEqual([0, -kReach, 0.01]);
  });
  it('moves with a stick beyond the dead zone, for a bounded time per call', () => {
    const device = new PointerDevice();
    device.stick([0.1, -0.1, 0], 1);
    expect(device.x).toEqual([0, 0, 0]);
    device.stick([1, 0, -1], 0.05);
    expect(device.x[0]).toBeCloseTo(kStickSpeed * 0.05, 12);
    expect(device.x[2]).toBeCloseTo(-kStickSpeed * 0.05, 12);
    device.stick([1, 0, 0], 1000);
    expect(device.x[0]).toBeCloseTo(kStickSpeed * 0.15, 12);
  });
  it('is held while one of its sources holds it', () => {
    const device = new PointerDevice();
    device.grip('pointer', true);
    device.grip('key', true);
    device.grip('pointer', false);
    expect(device.pressed).toBe(true);
    device.release();
    expect(device.pressed).toBe(false);
  });
});

describe('format', () => {
  it('shows a dash for what is unknown, and no minus zero', () => {
    expect(fixed(null, 1, 'N')).toBe(kUnknown);
    expect(fixed(NaN, 1)).toBe(kUnknown);
    expect(fixed(-0.001, 1)).toBe('0.0');
    expect(fixed(1.25, 1, 'N')).toBe('1.3\u202fN');
    expect(percent(0.5)).toBe('50\u202f%');
    expect(percent(undefined)).toBe(kUnknown);
  });
  it('shows session times', () => {
    expect(clock(0)).toBe('0:00.0');
    expect(clock(75.38)).toBe('1:15.3');
    expect(clock(3661)).toBe('1:01:01');
    expect(clock(null)).toBe(kUnknown);
    expect(clock(-3)).toBe('0:00.0');
  });
});

describe('lesson', () => {
  const people = [
    { name: 'ina', role: 'INSTRUCTOR', seat: 'trainer' },
    { name: 'ted', role: 'TRAINEE', seat: 'trainee' },
  ];
  it('has no mistake if names follow the rule and seats differ', () => {
    expect(lessonMistakes({ scene: 'contact', name: 'monday-1', people })).toEqual([]);
  });
  it('names all mistakes', () => {
    const lesson = { scene: '', name: 'a b', people: [...people, { name: 'ina', role: 'TRAINEE', seat: 'trainee' }] };
    expect(lessonMistakes(lesson)).toEqual([
      { field: 'scene', index: null, why: 'name' },
      { field: 'name', index: null, why: 'name' },
      { field: 'person', index: 2, why: 'twice' },
      { field: 'seat', index: 2, why: 'twice' },
    ]);
    const crowd = Array.from({ length: kPeopleMax + 1 }, (_, i) => ({ name: `p${i}`, role: 'OBSERVER', seat: '' }));
    expect(lessonMistakes({ scene: 'contact', name: 'm', people: crowd })).toEqual([
      { field: 'people', index: null, why: 'many' },
    ]);
    expect(isName('x'.repeat(33))).toBe(false);
  });
  it('may name the workstation of a person', () => {
    const [ina] = people;
    const lesson = (workstation: string): LessonMistake[] =>
      lessonMistakes({ scene: 'contact', name: 'm', people: ina ? [{ ...ina, workstation }] : [] });
    expect(lesson('desk-1')).toEqual([]);
    expect(lesson('desk 1')).toEqual([{ field: 'workstation', index: 0, why: 'name' }]);
  });
  it('has three steps for each ticket, by seat, role and workstation', () => {
    const ticket = { person: 'ann', workstation: 'w', role: '', seat: '', here: false, ticket: 'ticket:1' };
    const steps = (role: string, seat: string, here = false): readonly Step[] =>
      stepsOf({ ...ticket, role, seat, here }, 'lab:7000');
    for (const here of [false, true])
      expect(steps('TRAINEE', 'trainee', here)).toEqual([
        { key: 'desk.device', command: 'tandem-client doctor' },
        { key: 'desk.save', command: "(umask 077; echo 'ticket:1' > ann.ticket)" },
        {
          key: 'desk.join',
          command: 'tandem-client join --server lab:7000 --ticket-file ann.ticket --seat trainee --device sim',
        },
      ]);
    for (const role of ['TRAINEE', 'OBSERVER', 'RECORDER'])
      expect(steps(role, '')[2]?.command).toBe('tandem-client watch --server lab:7000 --ticket-file ann.ticket');
    for (const role of ['INSTRUCTOR', 'EVALUATOR'])
      expect(steps(role, '')[2]?.command).toBe('tandem-client control --server lab:7000 --ticket-file ann.ticket');
    expect(steps('EVALUATOR', '', true).map(({ key }) => key)).toEqual(['desk.open', 'desk.sign_in', 'desk.look']);
    // A browser takes no seat with a ticket, and cannot use tickets of other workstations.
    expect(isForBrowser({ ...ticket, here: true })).toBe(true);
    expect(isForBrowser({ ...ticket, here: true, seat: 'trainee' })).toBe(false);
    expect(isForBrowser(ticket)).toBe(false);
  });
  it('names the server as other computers reach it', () => {
    expect(serverAddress('127.0.0.1:7000', 'lab-server')).toBe('lab-server:7000');
    expect(serverAddress('[::1]:7000', 'lab-server')).toBe('lab-server:7000');
    expect(serverAddress('127.0.0.1:7000', '127.0.0.1')).toBe('127.0.0.1:7000');
    expect(serverAddress('10.0.0.7:7000', 'page-host')).toBe('10.0.0.7:7000');
    expect(serverAddress('', 'page-host')).toBe('');
  });
  it('proposes the first free seat of the scene, of the wished role', () => {
    const seats = [
      { name: 'trainer', role: 'INSTRUCTOR' },
      { name: 'trainee1', role: 'TRAINEE' },
      { name: 'trainee2', role: 'TRAINEE' },
    ];
    const none = { role: null, seat: null };
    expect(proposeSeats(seats, [none, none])).toEqual([
      { seat: 'trainer', role: 'INSTRUCTOR' },
      { seat: 'trainee1', role: 'TRAINEE' },
    ]);
    expect(proposeSeats(seats, [none, none, none, none])[3]).toEqual({ seat: '', role: 'EVALUATOR' });
    expect(proposeSeats(seats, [{ role: 'TRAINEE', seat: null }, none])).toEqual([
      { seat: 'trainee1', role: 'TRAINEE' },
      { seat: 'trainer', role: 'INSTRUCTOR' },
    ]);
    // A chosen seat is free for no other row, and the scene gives its role.
    expect(proposeSeats(seats, [none, { role: null, seat: 'trainer' }])).toEqual([
      { seat: 'trainee1', role: 'TRAINEE' },
      { seat: 'trainer', role: 'INSTRUCTOR' },
    ]);
    expect(proposeSeats(seats, [{ role: 'OBSERVER', seat: null }])).toEqual([{ seat: '', role: 'OBSERVER' }]);
    expect(proposeSeats([], [none])).toEqual([{ seat: '', role: 'EVALUATOR' }]);
  });
  it('keeps the ticket behind # of its link', () => {
    const ticket = { person: 'a&b', workstation: 'w', role: '', seat: '', here: true, ticket: 'x+/=' };
    const link = ticketLink('http://127.0.0.1:1', ticket);
    const url = new URL(link);
    expect(url.search).toBe('');
    expect(ticketOfHash(url.hash)).toEqual({ ticket: 'x+/=', name: 'a&b' });
    expect(ticketOfHash('#main')).toBeNull();
    expect(ticketOfHash('')).toBeNull();
  });
});

describe('labels', () => {
  it('never cover each other', () => {
    const placed = spread(Array.from({ length: 24 }, () => ({ x: 100, y: 300 })));
    expect(new Set(placed.map((place) => place.y)).size).toBe(24);
    expect(placed[0]).toEqual({ x: 100, y: 300 });
    expect(
      spread([
        { x: 0, y: 0 },
        { x: 200, y: 0 },
      ])[1],
    ).toEqual({ x: 200, y: 0 });
  });
});

describe('strings', () => {
  const words = (text: string): string[] => (text.match(/\{\w+\}/g) ?? []).sort();
  it('have the same keys and the same words in braces in both languages', () => {
    expect(Object.keys(fr).sort()).toEqual(Object.keys(en).sort());
    for (const key of Object.keys(en) as (keyof typeof en)[]) {
      expect([key, words(fr[key])]).toEqual([key, words(en[key])]);
      expect(fr[key].trim()).not.toBe('');
    }
  });
  it('replace words, and show an unknown word of a newer gateway as it is', () => {
    setLanguage('fr');
    expect(t('authority.evaluation', { seat: 'x' })).toBe('Évaluation de x');
    setLanguage('en');
    expect(t('stop.active', { kind: 'Stop' })).toBe('Stop by {by}: {why}');
    expect(word('gate', 'SOMETHING')).toBe('SOMETHING');
    expect(word('gate', null)).toBe('–');
  });
  it('follow the browser', () => {
    expect(preferredLanguage(['de-DE', 'fr-CH', 'en'])).toBe('fr');
    expect(preferredLanguage(['de'])).toBe('en');
  });
});
