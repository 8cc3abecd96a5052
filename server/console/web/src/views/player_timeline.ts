import { clock, fixed } from '../logic/format';
import type { Note, Outline } from '../protocol/recordings';
import { t } from '../strings/strings';
import { button, el, panel, setAttribute, svg } from './dom';
import { noteText } from './note_text';

const kWidth = 1000;
/** Buttons that are listed; all notes are on the line. */
const kListed = 200;

/** Marks, events and gaps of a recording on its time. A click jumps. */
export class PlayerTimeline {
  readonly node: HTMLElement;
  private readonly line = svg('svg', {
    class: 'timeline player-timeline',
    viewBox: `0 0 ${kWidth} 40`,
    preserveAspectRatio: 'none',
    role: 'img',
  });
  private readonly now = svg('rect', { class: 'now', y: 0, width: 2, height: 40 });
  private readonly list = el('ol', { class: 'log jumps' });
  private outline: Outline | null = null;

  constructor(private readonly onSeek: (t: number) => void) {
    this.line.addEventListener('click', (event) => {
      const box = this.line.getBoundingClientRect();
      const { outline } = this;
      if (!outline || box.width < 1) return;
      onSeek(outline.from_s + ((event.clientX - box.left) / box.width) * (outline.to_s - outline.from_s));
    });
    this.node = panel(
      t('player.timeline'),
      'player-timeline-panel',
      this.line,
      el('div', { class: 'scroll log-box', tabindex: 0, role: 'group', 'aria-label': t('player.notes') }, this.list),
    );
  }

  setOutline(outline: Outline): void {
    this.outline = outline;
    const x = (time: number): number =>
      (Math.min(1, Math.max(0, (time - outline.from_s) / (outline.to_s - outline.from_s))) * kWidth) | 0;
    this.line.replaceChildren(
      svg('rect', { x: 0, y: 19, width: kWidth, height: 2, class: 'line' }),
      ...outline.gaps.map(([from, to]) =>
        svg(
          'rect',
          { x: x(from), y: 12, width: Math.max(2, x(to) - x(from)), height: 16, class: 'gap' },
          svg('title', {}, t('player.gap_of', { t: clock(from), s: fixed(to - from, 3, 's') })),
        ),
      ),
      ...outline.notes.map((note) =>
        svg(
          'rect',
          {
            x: Math.min(kWidth - 4, x(note.t)),
            y: note.kind === 'mark' ? 2 : 26,
            width: 4,
            height: 12,
            class: note.kind,
          },
          svg('title', {}, `${clock(note.t)} ${noteText(note)}`),
        ),
      ),
      this.now,
    );
    setAttribute(
      this.line,
      'aria-label',
      t('player.timeline_label', { t: clock(outline.to_s), notes: outline.notes.length, gaps: outline.gap_count }),
    );
    const rows = outline.notes.slice(0, kListed).map((note) => this.row(note));
    const left = outline.notes.length - rows.length + outline.notes_left_out;
    if (left > 0) rows.push(el('li', { class: 'empty' }, t('player.notes_left_out', { n: left })));
    if (rows.length === 0) rows.push(el('li', { class: 'empty' }, t('player.no_notes')));
    this.list.replaceChildren(...rows);
  }

  update(time: number): void {
    const { outline } = this;
    if (!outline) return;
    const share = Math.min(1, Math.max(0, (time - outline.from_s) / (outline.to_s - outline.from_s)));
    setAttribute(this.now, 'x', (share * (kWidth - 2)).toFixed(1));
  }

  private row(note: Note): HTMLLIElement {
    const text = noteText(note);
    const jump = button(clock(note.t), () => this.onSeek(note.t), {
      'aria-label': t('player.jump', { t: clock(note.t), text }),
    });
    // The words of an event name its person.
    const by = note.kind === 'mark' ? note.person : '';
    return el('li', { class: note.kind }, jump, el('span', {}, text || '–'), el('small', {}, by));
  }
}
