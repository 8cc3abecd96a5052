import type { Page, View } from '../app/page';
import { clock } from '../logic/format';
import type { Notes } from '../protocol/messages';
import { t } from '../strings/strings';
import { button, el, labelled, panel, setAttribute, setDisabled, setText, svg } from './dom';

const kWidth = 1000;
/** Marks that are listed; older ones stay on the line. */
const kListed = 100;

/** Marks of evaluators on the time of the session, each with a note. */
export class Timeline implements View {
  readonly node: HTMLElement;
  private readonly note = el('input', { type: 'text', maxlength: 300, placeholder: t('marks.placeholder') });
  private readonly add: HTMLButtonElement;
  private readonly ticks = svg('g');
  private readonly line: SVGSVGElement;
  private readonly list = el('ol', { class: 'log' });
  private known: Notes | null = null;
  private end = 0;
  /** Time when the person began to write, so that the mark is where the event was. */
  private begun: number | null = null;

  constructor(private readonly page: Page) {
    this.add = button(t('marks.add'), () => this.mark(), { class: 'primary', 'aria-keyshortcuts': 'M' });
    this.line = svg(
      'svg',
      { class: 'timeline', viewBox: `0 0 ${kWidth} 40`, preserveAspectRatio: 'none', role: 'img' },
      svg('rect', { x: 0, y: 19, width: kWidth, height: 2, class: 'line' }),
      this.ticks,
    );
    this.note.addEventListener('input', () => {
      if (this.note.value === '') this.begun = null;
      else this.begun ??= this.page.model.state?.t ?? null;
    });
    const form = el(
      'form',
      {
        class: 'row',
        onsubmit: (event) => {
          event.preventDefault();
          this.mark();
        },
      },
      labelled(t('marks.note'), this.note),
      this.add,
    );
    this.node = panel(
      t('marks.title'),
      'timeline-panel',
      this.line,
      form,
      el('div', { class: 'scroll log-box', tabindex: 0, role: 'group', 'aria-label': t('marks.title') }, this.list),
    );
  }

  mark(): void {
    const at = this.begun ?? this.page.model.state?.t;
    if (at === undefined || !this.page.model.may('score')) return;
    const text = this.note.value.trim();
    void this.page.request(t('marks.add'), { type: 'mark', t: Math.round(at * 1000) / 1000, text }).then((reply) => {
      if (!reply.ok || this.note.value.trim() !== text) return;
      this.note.value = '';
      this.begun = null;
    });
  }

  update(): void {
    const { model } = this.page;
    setDisabled(this.add, !model.may('score'));
    setDisabled(this.note, !model.may('score'));
    setText(this.add, this.begun === null ? t('marks.add') : t('marks.at', { t: clock(this.begun) }));
    const now = model.state?.t ?? 0;
    // The scale doubles, so that marks stay in place for a while.
    const end = 60 * 2 ** Math.max(0, Math.ceil(Math.log2(Math.max(1, now / 60))));
    setAttribute(this.line, 'aria-label', t('marks.timeline', { t: clock(now) }));
    if (model.notes === this.known && end === this.end) return;
    this.known = model.notes;
    this.end = end;
    const marks = model.notes?.marks ?? [];
    this.ticks.replaceChildren(
      ...marks.map((mark) => {
        const x = Math.min(1, Math.max(0, (mark.t ?? 0) / end)) * (kWidth - 6);
        return svg(
          'rect',
          { x, y: 6, width: 6, height: 28, rx: 2 },
          svg('title', {}, `${clock(mark.t)} ${mark.text || '–'}`),
        );
      }),
    );
    const rows = [...marks].sort((a, b) => (b.t ?? 0) - (a.t ?? 0)).slice(0, kListed);
    this.list.replaceChildren(
      ...(rows.length > 0
        ? rows.map((m) =>
            el('li', {}, el('time', {}, clock(m.t)), el('span', {}, m.text || '–'), el('small', {}, m.person)),
          )
        : [el('li', { class: 'empty' }, t('marks.none'))]),
    );
  }
}
