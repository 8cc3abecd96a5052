import { describe, expect, it } from 'vitest';

import { sentences, whoResumes } from '../../src/logic/resume';
import type { Scene, StopState } from '../../src/protocol/messages';
import { makeScene } from './support';

const stop = (kind: string, by: string): StopState => ({ number: 1, kind, by, person: null, why: '', yours: false });
const led = makeScene();
const equals: Scene = { ...led, seats: led.seats.map((seat) => ({ ...seat, role: 'TRAINEE' })) };

describe('whoResumes', () => {
  const bosses = 'Only an instructor or operator may resume.';
  it('names instructor and operator, whether a console or a seat of a scene with an instructor stopped', () => {
    expect(whoResumes(stop('PAUSE', 'desk'), led)).toBe(bosses);
    expect(whoResumes(stop('PAUSE', 'trainee'), led)).toBe(bosses);
    expect(whoResumes(stop('STOP', 'trainee'), equals)).toBe(bosses);
    expect(whoResumes(stop('PAUSE', 'desk'), equals)).toBe(bosses);
    expect(whoResumes(stop('PAUSE', 'desk'), null)).toBe(bosses);
  });
  it('names the seats that paused where no seat is an instructor', () => {
    expect(whoResumes(stop('PAUSE', 'trainee'), equals)).toContain('or the seats that paused');
  });
});

describe('sentences', () => {
  it('adds one full stop where none is', () => {
    expect(sentences('Pause by eva: from the console', 'Wait.')).toBe('Pause by eva: from the console. Wait.');
    expect(sentences('Why?', 'Wait.')).toBe('Why? Wait.');
    expect(sentences('Torn.', 'Wait.')).toBe('Torn. Wait.');
  });
});
