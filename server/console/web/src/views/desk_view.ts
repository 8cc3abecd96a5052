import type { Page, View } from '../app/page';
import { lessonMistakes, type Lesson } from '../logic/lesson';
import type { Tickets } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { button, confirmOrder, el, labelled, panel, setDisabled, setText } from './dom';
import { PersonRows } from './person_rows';
import { ticketCards } from './ticket_cards';

const kNamePattern = '[A-Za-z0-9_\\-]{1,32}';

/** The lesson desk: creates a session with its people and shows a page with ticket and steps per person. */
export class DeskView implements View {
  readonly node: HTMLElement;
  private readonly scene = el('input', {
    type: 'text',
    maxlength: 32,
    list: 'scenes',
    pattern: kNamePattern,
    required: true,
    oninput: () => this.offerSeats(),
  });
  private readonly scenes = el('datalist', { id: 'scenes' });
  private readonly name = el('input', { type: 'text', maxlength: 32, pattern: kNamePattern, required: true });
  private readonly people = new PersonRows(2);
  private readonly fields = el('fieldset', { class: 'plain' });
  private readonly denied = el('p', { class: 'note', id: 'desk-denied', role: 'status' });
  private readonly end: HTMLButtonElement;
  private readonly tickets = el('div', { class: 'tickets' });
  private known: Tickets | null = null;
  private revision = -1;

  constructor(private readonly page: Page) {
    this.end = button(t('desk.end'), () => void this.endSession(), { class: 'danger' });
    this.fields.setAttribute('aria-describedby', this.denied.id);
    this.fields.append(
      el(
        'div',
        { class: 'row' },
        labelled(t('desk.scene'), this.scene),
        this.scenes,
        labelled(t('desk.name'), this.name),
      ),
      el('h3', {}, t('desk.people')),
      el('p', { class: 'note' }, t('desk.proposed')),
      this.people.node,
      el(
        'div',
        { class: 'row' },
        button(t('desk.add'), () => this.people.add().focus()),
        el('button', { type: 'submit', class: 'primary' }, t('desk.create')),
      ),
    );
    const form = el(
      'form',
      {
        onsubmit: (event) => {
          event.preventDefault();
          this.send();
        },
      },
      this.fields,
    );
    this.node = el(
      'div',
      { class: 'view desk-view' },
      panel(
        t('desk.title'),
        'desk-panel',
        this.denied,
        form,
        el('p', { class: 'note' }, t('desk.begins')),
        el('div', { class: 'row' }, this.end),
      ),
      this.tickets,
    );
  }

  update(): void {
    const { model } = this.page;
    const may = model.may('create');
    if (this.fields.disabled === may) this.fields.disabled = !may;
    setDisabled(this.end, !may || !this.session());
    setText(this.denied, this.reason());
    this.denied.hidden = may;
    if (model.revision !== this.revision) {
      this.revision = model.revision;
      this.scenes.replaceChildren(...(model.hello?.scenes ?? []).map((value) => el('option', { value })));
      this.people.setWorkstation(model.hello?.workstation ?? '');
      this.offerSeats();
    }
    if (model.tickets !== this.known) {
      this.known = model.tickets;
      this.tickets.replaceChildren(...(this.known ? [ticketCards(this.known)] : []));
    }
  }

  /** Why the fields are disabled; empty: they are not. */
  private reason(): string {
    const { model } = this.page;
    if (model.may('create')) return '';
    if (model.granted('create') || !model.hello) return t('order.no_connection');
    return t('desk.denied', { role: word('role', model.hello.role) });
  }

  private offerSeats(): void {
    this.people.setSeats(this.page.model.hello?.sceneSeats.get(this.scene.value.trim()) ?? kNoSeats);
  }

  private session(): { id: string; name: string } | undefined {
    const { tickets, scene } = this.page.model;
    if (tickets) return { id: tickets.session, name: tickets.name };
    return scene ? { id: scene.session, name: scene.name } : undefined;
  }

  private async endSession(): Promise<void> {
    const session = this.session();
    if (!session) return;
    const what = t('desk.end');
    const explain = t('desk.end_explain', { name: session.name });
    if (await confirmOrder(what, explain, what, t('who.cancel')))
      void this.page.order(what, { order: 'end', session: session.id });
  }

  private send(): void {
    const lesson: Lesson = {
      scene: this.scene.value.trim(),
      name: this.name.value.trim(),
      people: this.people.people(),
    };
    const mistake = lessonMistakes(lesson)[0];
    if (mistake) {
      const { field: kind, index } = mistake;
      const field =
        kind === 'scene'
          ? this.scene
          : index === null
            ? this.name
            : this.people.field(index, kind === 'seat' || kind === 'workstation' ? kind : 'name');
      field?.focus();
      const label = field?.closest('label')?.textContent ?? t('desk.people');
      this.page.report('error', `${label}: A-Z a-z 0-9 _ -, 1…32`);
      return;
    }
    void this.page.order(t('desk.create'), { order: 'create', ...lesson });
  }
}

const kNoSeats: readonly never[] = [];
