import { percent } from '../logic/format';
import { readEventText, type EventFacts } from '../logic/recorded_event';
import type { Note } from '../protocol/recordings';
import { t, word } from '../strings/strings';

/** Person and seat, or what else gave the event. */
function origin({ seat, person }: Note, facts: EventFacts): string {
  const by = word('event.by', facts.origin);
  if (seat === '') return person === '' ? by : `${person} (${by})`;
  return person === '' ? seat : `${person} (${seat})`;
}

/** Returns a mark as it was written, and an event in plain words: who, what, and the shares that change. */
export function noteText(note: Note): string {
  if (note.kind === 'mark') return note.text;
  const facts = readEventText(note.text);
  const known = word('event', note.what);
  // An event of a newer server has the words of that server.
  if (!facts || known === note.what) return [note.what, note.text].filter(Boolean).join(': ');
  const shares = facts.shares
    .filter(({ before, after }) => before !== after)
    .map(({ seat, before, after }) => t('event.share', { seat, before: percent(before), after: percent(after) }));
  const what = known.replace('{who}', () => origin(note, facts)).replace('{tool}', () => facts.tool);
  const changes = shares.length > 0 ? `${what}: ${shares.join(', ')}` : what;
  return facts.stale === '' ? changes : `${changes}. ${t('event.stale', { seat: facts.stale })}`;
}
