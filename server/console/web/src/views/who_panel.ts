import type { Page, View } from '../app/page';
import { kUnknown } from '../logic/format';
import type { Scene, SeatState } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { ask, button, el, panel, setDisabled, setText } from './dom';
import { swatch } from './value_table';

function stateWords(seat: SeatState | undefined): string {
  if (!seat || seat.taken === null) return kUnknown;
  if (!seat.taken) return t('who.free');
  if (seat.heard === false) return t('who.silent');
  return seat.engaged === null ? kUnknown : t(seat.engaged ? 'who.engaged' : 'who.released');
}

/** The seats with their persons; removes a participant and drains the server. */
export class WhoPanel implements View {
  readonly node: HTMLElement;
  private readonly rows = el('tbody');
  private readonly drain: HTMLButtonElement;
  private cells: { person: HTMLElement; state: HTMLElement; remove: HTMLButtonElement }[] = [];
  private known: Scene | null = null;

  constructor(private readonly page: Page) {
    this.drain = button(t('stop.drain'), () => void this.askDrain());
    const heads = (['seat', 'person', 'role', 'device', 'state'] as const).map((key) =>
      el('th', { scope: 'col' }, t(`who.${key}`)),
    );
    this.node = panel(
      t('who.title'),
      'who-panel',
      el(
        'div',
        { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': t('who.title') },
        el('table', {}, el('thead', {}, el('tr', {}, ...heads, el('td'))), this.rows),
      ),
      el('div', { class: 'row' }, this.drain),
    );
  }

  update(): void {
    const { model } = this.page;
    if (model.scene && model.scene !== this.known) this.adopt(model.scene);
    this.cells.forEach((cell, i) => {
      const seat = model.state?.seats[i];
      setText(cell.person, seat?.person ?? kUnknown);
      setText(cell.state, stateWords(seat));
      cell.state.classList.toggle('bad', seat?.taken === true && seat.heard === false);
      setDisabled(cell.remove, !model.may('remove') || seat?.taken !== true);
      cell.remove.hidden = !model.granted('remove');
    });
    this.drain.hidden = !model.granted('drain');
    setDisabled(this.drain, !model.may('drain'));
  }

  private adopt(scene: Scene): void {
    this.known = scene;
    this.cells = scene.seats.map((seat) => ({
      person: el('td'),
      state: el('td'),
      remove: button(t('stop.remove'), () => void this.askRemove(seat.name), {
        'aria-label': `${t('stop.remove')} ${seat.name}`,
      }),
    }));
    this.rows.replaceChildren(
      ...scene.seats.map((seat, i) => {
        const cell = this.cells[i];
        return el(
          'tr',
          {},
          el('th', { scope: 'row' }, swatch(i), seat.name),
          cell?.person ?? null,
          el('td', {}, word('role', seat.role)),
          el('td', {}, seat.device ?? kUnknown),
          cell?.state ?? null,
          el('td', { class: 'end' }, cell?.remove ?? null),
        );
      }),
    );
  }

  private async askRemove(seat: string): Promise<void> {
    const reason = el('input', { type: 'text', maxlength: 200 });
    const what = t('who.remove_title', { seat });
    const why = await ask(what, '', reason, t('who.reason'), t('stop.remove').replace('…', ''), t('who.cancel'));
    if (why !== null) void this.page.order(what, { order: 'remove', seat, why: why || t('stop.why') });
  }

  private async askDrain(): Promise<void> {
    const grace = el('input', { type: 'number', min: 0, max: 3600, step: 1, value: '30', required: true });
    const what = t('drain.title');
    const go = t('stop.drain').replace('…', '');
    const seconds = await ask(what, t('drain.explain'), grace, t('drain.grace'), go, t('who.cancel'));
    if (seconds !== null) void this.page.order(what, { order: 'drain', grace_s: Math.round(Number(seconds)) });
  }
}
