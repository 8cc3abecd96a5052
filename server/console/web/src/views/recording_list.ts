import { clock, fixed } from '../logic/format';
import type { ListedRecording, RecordingList } from '../protocol/recordings';
import { currentLanguage, t } from '../strings/strings';
import { button, el, panel } from './dom';

function beginOf(row: ListedRecording): string {
  return row.start_s === null ? '–' : new Date(row.start_s * 1000).toLocaleString(currentLanguage());
}

/** A cell; on narrow screens, where a row is a card, it begins with the title of its column. */
function fact(column: 'begin' | 'duration' | 'persons' | 'state', value: string): HTMLElement {
  return el('td', { 'data-label': t(`recordings.${column}`) }, value);
}

/** Recordings that the gateway may show, the newest first. */
export class RecordingListPanel {
  readonly node: HTMLElement;
  private readonly status = el('p', { class: 'note', role: 'status' });
  private readonly rows = el('tbody');

  constructor(
    private readonly onOpen: (row: ListedRecording) => void,
    onReload: () => void,
  ) {
    const heads = (['action', 'session', 'begin', 'duration', 'persons', 'state'] as const).map((key) =>
      el('th', { scope: 'col' }, t(`recordings.${key}`)),
    );
    this.node = panel(
      t('recordings.title'),
      'recordings-panel',
      el('div', { class: 'row' }, button(t('recordings.reload'), onReload), this.status),
      el(
        'div',
        { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': t('recordings.title') },
        el('table', { class: 'recordings' }, el('thead', {}, el('tr', {}, ...heads)), this.rows),
      ),
    );
  }

  say(text: string): void {
    this.status.textContent = text;
  }

  show(list: RecordingList): void {
    const words = [
      list.problem ?? '',
      list.to_read > 0 ? t('recordings.reading', { n: list.read, of: list.to_read }) : '',
      list.unfinished > 0 ? t('recordings.unfinished', { n: list.unfinished }) : '',
      list.left_out > 0 ? t('recordings.left_out', { n: list.left_out }) : '',
    ];
    if (list.recordings.length === 0 && !words.some(Boolean)) words.push(t('recordings.empty'));
    this.say(words.filter(Boolean).join(' '));
    this.rows.replaceChildren(...list.recordings.map((row) => this.row(row)));
  }

  private row(row: ListedRecording): HTMLTableRowElement {
    const name = row.session && row.session !== row.file ? `${row.session} (${row.file})` : row.file;
    if (row.problem !== null) {
      const why = t('recordings.skipped', { why: row.problem });
      return el(
        'tr',
        { class: 'damaged' },
        el('td', {}, ''),
        el('th', { scope: 'row' }, row.file),
        el('td', { class: 'why', colspan: 4 }, why),
      );
    }
    const state = [
      row.files > 1 ? t('recordings.files', { n: row.files }) : '',
      row.parts_problem ?? (row.complete ? '' : t('recordings.incomplete')),
      row.missing_ticks > 0 ? t('recordings.missing', { n: row.missing_ticks }) : '',
      fixed(row.bytes / 1e6, 1, 'MB'),
    ];
    return el(
      'tr',
      {},
      el(
        'td',
        {},
        button(t('recordings.open'), () => this.onOpen(row), { 'aria-label': t('recordings.open_of', { name }) }),
      ),
      el('th', { scope: 'row' }, name),
      fact('begin', beginOf(row)),
      fact('duration', clock(row.duration_s)),
      fact('persons', row.persons.join(', ') || '–'),
      fact('state', state.filter(Boolean).join(', ')),
    );
  }
}
