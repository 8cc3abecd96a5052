import { clock, fixed, kUnknown } from '../logic/format';
import type { ScoreCell, Scores } from '../protocol/scores';
import { t, word } from '../strings/strings';
import { el } from './dom';

function cellNode(cell: ScoreCell | undefined): HTMLElement {
  if (!cell) return el('td', {}, kUnknown);
  const shown = cell.text ?? (cell.trust === 'withheld' ? t('scores.withheld') : kUnknown);
  const flagged = cell.trust === 'flagged' ? ' !' : '';
  return el('td', { class: cell.trust, title: cell.reason || undefined }, shown + flagged);
}

/** Reasons against full trust, each once. */
function reasonsOf(scores: Scores): string[] {
  const found = new Set<string>();
  for (const { seat, parts } of scores.seats) {
    for (const { title, cells } of parts) {
      for (const { trust, reason } of cells) {
        if (reason && (trust === 'flagged' || trust === 'withheld')) found.add(`${seat}, ${title}: ${reason}`);
      }
    }
  }
  return [...found];
}

/** A wide table scrolls in a frame of its own, also by the keyboard. */
function frame(title: string, table: HTMLElement): HTMLElement {
  return el('div', { class: 'scroll table-frame', tabindex: 0, role: 'group', 'aria-label': title }, table);
}

/** Returns tables of main scores, one per seat, with a column per part; flags have their reasons below. */
export function scoreTables(scores: Scores): HTMLElement[] {
  const head = (text: string): HTMLElement => el('th', { scope: 'col' }, text);
  const tables = scores.seats.map(({ seat, person, parts }) => {
    const title = person ? `${seat} (${person})` : seat;
    const table = el(
      'table',
      { class: 'scores' },
      el('caption', {}, title),
      el(
        'thead',
        {},
        el('tr', {}, head(t('scores.metric')), ...parts.map(({ part, title }) => head(partTitle(part, title)))),
      ),
      el(
        'tbody',
        {},
        ...scores.metrics.map(({ key, title, unit }, i) => {
          const name = word('metric', key) === key ? title : word('metric', key);
          return el(
            'tr',
            {},
            el('th', { scope: 'row' }, unit ? `${name} (${unit})` : name),
            ...parts.map(({ cells }) => cellNode(cells[i])),
          );
        }),
      ),
    );
    return frame(title, table);
  });
  const reasons = reasonsOf(scores);
  return [
    el(
      'p',
      { class: 'note' },
      t('scores.range', {
        from: clock(scores.from_s),
        to: clock(scores.to_s),
        hz: fixed(scores.rate_hz, 0, 'Hz'),
      }),
    ),
    ...(tables.length > 0 ? tables : [el('p', { class: 'note' }, t('scores.none'))]),
    ...(reasons.length > 0
      ? [
          el('p', { class: 'note' }, t('scores.flags')),
          el('ul', { class: 'note' }, ...reasons.map((r) => el('li', {}, r))),
        ]
      : []),
    ...scores.notes.map((note) => el('p', { class: 'note' }, note)),
  ];
}

function partTitle(part: string, title: string): string {
  if (part === 'whole') return t('scores.whole');
  if (part === 'shared') return t('scores.shared');
  return part.startsWith('held:') ? t('scores.held', { seat: part.slice(5) }) : title;
}
