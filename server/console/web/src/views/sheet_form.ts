import type { Page, View } from '../app/page';
import { mastersOf, traineeIndices } from '../logic/authority';
import { formOf, kForms, othersSheets, ownSheet, totalOf, validScores } from '../logic/sheets';
import type { Notes, Scene, SheetName } from '../protocol/messages';
import { t, word, type StringKey } from '../strings/strings';
import { button, confirmOrder, el, fillSelect, labelled, panel, select, setDisabled, setText } from './dom';

const itemText = (id: string): string => t(`item.${id}` as StringKey);

/** A rating sheet: items with points, total, draft and closing. Sheets of others appear after the own one is closed. */
export class SheetForm implements View {
  readonly node: HTMLElement;
  private readonly of = select([], '', () => this.open());
  private readonly items = el('div', { class: 'items' });
  private readonly total = el('p', { class: 'total', role: 'status' });
  private readonly save: HTMLButtonElement;
  private readonly close: HTMLButtonElement;
  private readonly note = el('p', { class: 'note' });
  private readonly others = el('div', { class: 'others' });
  private name: SheetName = 'OSATS';
  private scores: Record<string, number> = {};
  private closed = false;
  /** Points that were changed but not saved; drafts of other sheets wait here. */
  private readonly drafts = new Map<string, Record<string, number>>();
  private knownScene: Scene | null = null;
  private knownNotes: Notes | null = null;

  constructor(private readonly page: Page) {
    const kinds = select(
      kForms.map((form) => [form.name, t(`sheet.${form.name}`)] as const),
      this.name,
      (value) => {
        this.name = value as SheetName;
        this.open();
      },
    );
    this.save = button(t('sheet.save'), () => this.send(false));
    this.close = button(t('sheet.close'), () => void this.finish(), { class: 'primary' });
    this.node = panel(
      t('sheet.title'),
      'sheet-panel',
      el('div', { class: 'row' }, labelled(t('sheet.kind'), kinds), labelled(t('sheet.of'), this.of)),
      this.items,
      el('div', { class: 'row' }, this.total, this.save, this.close),
      this.note,
      el('h3', {}, t('sheet.others')),
      this.others,
    );
  }

  update(): void {
    const { model } = this.page;
    if (model.scene && model.scene !== this.knownScene) {
      this.knownScene = model.scene;
      const masters = mastersOf(model.scene);
      const first = masters[traineeIndices(masters)[0] ?? 0]?.name ?? '';
      fillSelect(
        this.of,
        masters.map((seat) => [seat.name, seat.name] as const),
        this.of.value || first,
      );
      if (!this.of.value) this.of.value = first;
      this.open();
    }
    if (model.notes !== this.knownNotes) {
      this.knownNotes = model.notes;
      this.open();
    }
    const form = formOf(this.name);
    const total = totalOf(form, this.scores);
    const missing = total.missing.length;
    const words = form.name === 'CHECKLIST' || missing === 0 ? '' : ` · ${t('sheet.missing', { n: missing })}`;
    setText(this.total, t('sheet.total', { points: total.points, of: total.of }) + words);
    const may = model.may('score') && !this.closed;
    setDisabled(this.save, !may);
    setDisabled(this.close, !may || (form.name !== 'CHECKLIST' && missing > 0));
    for (const input of this.items.querySelectorAll('input')) setDisabled(input, !may);
    const denied =
      model.hello && !model.granted('score') ? t('score.denied', { role: word('role', model.hello.role) }) : '';
    setText(
      this.note,
      denied !== '' ? denied : this.closed ? t('sheet.closed') : missing > 0 ? t('sheet.closed_as_draft') : '',
    );
  }

  private key(): string {
    return `${this.name} ${this.of.value}`;
  }

  /** Shows the chosen sheet with its own draft, or with what the gateway has. */
  private open(): void {
    const { model } = this.page;
    const form = formOf(this.name);
    const person = model.hello?.person ?? '';
    const own = ownSheet(model.notes, person, this.name, this.of.value);
    const before = this.key();
    this.closed = own?.closed ?? false;
    this.scores = { ...validScores(form, own?.scores ?? {}), ...(this.closed ? {} : this.drafts.get(before)) };
    const focused = document.activeElement?.id;
    this.items.replaceChildren(
      el('p', { class: 'note' }, t(form.name === 'CHECKLIST' ? 'sheet.done' : 'sheet.low')),
      ...form.items.map((item) =>
        form.name === 'CHECKLIST' ? this.tick(item.id) : this.points(item.id, item.optional === true),
      ),
    );
    if (focused?.startsWith('item-')) document.getElementById(focused)?.focus();
    this.showOthers(person);
  }

  private showOthers(person: string): void {
    const form = formOf(this.name);
    const sheets = othersSheets(this.page.model.notes, person, this.name, this.of.value);
    this.others.replaceChildren(
      ...(sheets.length > 0
        ? sheets.map((sheet) => {
            const { points, of } = totalOf(form, sheet.scores);
            const each = form.items.map(({ id }) => `${itemText(id)} ${sheet.scores[id] ?? '–'}`).join(' · ');
            return el(
              'details',
              {},
              el('summary', {}, `${sheet.person}: ${t('sheet.total', { points, of })}`),
              el('p', {}, each),
            );
          })
        : [el('p', { class: 'note' }, t(this.closed ? 'sheet.no_others' : 'sheet.hidden'))]),
    );
  }

  private set(id: string, score: number): void {
    this.scores[id] = score;
    this.drafts.set(this.key(), this.scores);
    this.update();
  }

  private points(id: string, optional: boolean): HTMLElement {
    const form = formOf(this.name);
    const buttons: HTMLElement[] = [];
    for (let points = form.range[0]; points <= form.range[1]; points += 1) {
      const input = el('input', {
        type: 'radio',
        name: `item-${this.name}-${id}`,
        id: `item-${this.name}-${id}-${points}`,
        onchange: () => this.set(id, points),
      });
      input.checked = this.scores[id] === points;
      buttons.push(el('label', { class: 'point' }, input, el('span', {}, String(points))));
    }
    const legend = itemText(id) + (optional ? ` (${t('sheet.optional')})` : '');
    // A digit chooses points here; elsewhere it chooses a view.
    const onDigit = (event: Event): void => {
      const { key, ctrlKey, altKey, metaKey } = event as KeyboardEvent;
      const input = document.getElementById(`item-${this.name}-${id}-${key}`);
      if (ctrlKey || altKey || metaKey || !(input instanceof HTMLInputElement) || input.disabled) return;
      event.preventDefault();
      event.stopPropagation();
      input.focus();
      input.checked = true;
      this.set(id, Number(key));
    };
    return el(
      'fieldset',
      { class: 'item', onkeydown: onDigit },
      el('legend', {}, legend),
      el('div', { class: 'points' }, ...buttons),
    );
  }

  private tick(id: string): HTMLElement {
    const input = el('input', {
      type: 'checkbox',
      id: `item-${this.name}-${id}`,
      onchange: () => this.set(id, input.checked ? 1 : 0),
    });
    input.checked = this.scores[id] === 1;
    return el('label', { class: 'check item' }, input, el('span', {}, itemText(id)));
  }

  /** A closed sheet is final, so the page asks first. */
  private async finish(): Promise<void> {
    const { points, of } = totalOf(formOf(this.name), this.scores);
    const words = { sheet: t(`sheet.${this.name}`), seat: this.of.value, points, of };
    const what = t('sheet.close');
    if (await confirmOrder(what, t('sheet.close_explain', words), what, t('who.cancel'))) this.send(true);
  }

  private send(closed: boolean): void {
    const scores = validScores(formOf(this.name), this.scores);
    const key = this.key();
    const [sheet, of] = [this.name, this.of.value];
    void this.page
      .request(t(closed ? 'sheet.close' : 'sheet.save'), { type: 'sheet', sheet, of, scores, closed })
      .then((reply) => {
        if (reply.ok) this.drafts.delete(key);
      });
  }
}
