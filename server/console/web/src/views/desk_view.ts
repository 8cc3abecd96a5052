import type { Page, View } from '../app/page';
import { kRoles, lessonMistakes, stepsOf, ticketLink, type Lesson } from '../logic/lesson';
import type { Tickets } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { button, el, labelled, panel, select, setDisabled } from './dom';
import { qrCode } from './qr_code';

interface PersonRow {
  node: HTMLElement;
  name: HTMLInputElement;
  role: HTMLSelectElement;
  seat: HTMLInputElement;
  workstation: HTMLInputElement;
}

/** The lesson desk: creates a session with its people and shows a page with ticket and steps per person. */
export class DeskView implements View {
  readonly node: HTMLElement;
  private readonly scene: HTMLInputElement;
  private readonly scenes = el('datalist', { id: 'scenes' });
  private readonly name = el('input', {
    type: 'text',
    maxlength: 32,
    pattern: '[A-Za-z0-9_\\-]{1,32}',
    required: true,
  });
  private readonly people = el('div', { class: 'people' });
  private readonly create = el('button', { type: 'submit', class: 'primary' }, t('desk.create'));
  private readonly end: HTMLButtonElement;
  private readonly tickets = el('div', { class: 'tickets' });
  private rows: PersonRow[] = [];
  private known: Tickets | null = null;
  private revision = -1;

  constructor(private readonly page: Page) {
    this.scene = el('input', {
      type: 'text',
      maxlength: 32,
      list: 'scenes',
      pattern: '[A-Za-z0-9_\\-]{1,32}',
      required: true,
    });
    this.end = button(t('desk.end'), () => this.endSession(), { class: 'danger' });
    const form = el(
      'form',
      {
        onsubmit: (event) => {
          event.preventDefault();
          this.send();
        },
      },
      el(
        'div',
        { class: 'row' },
        labelled(t('desk.scene'), this.scene),
        this.scenes,
        labelled(t('desk.name'), this.name),
      ),
      el('h3', {}, t('desk.people')),
      this.people,
      el(
        'div',
        { class: 'row' },
        button(t('desk.add'), () => this.add('TRAINEE', '')),
        this.create,
      ),
    );
    this.node = el(
      'div',
      { class: 'view desk-view' },
      panel(
        t('desk.title'),
        'desk-panel',
        form,
        el('p', { class: 'note' }, t('desk.begins')),
        el('div', { class: 'row' }, this.end),
      ),
      this.tickets,
    );
    this.add('INSTRUCTOR', 'trainer');
    this.add('TRAINEE', 'trainee');
  }

  update(): void {
    const { model } = this.page;
    const may = model.may('create');
    setDisabled(this.create, !may);
    setDisabled(this.end, !may || !this.session());
    if (model.revision !== this.revision) {
      this.revision = model.revision;
      this.scenes.replaceChildren(...(model.hello?.scenes ?? []).map((value) => el('option', { value })));
    }
    if (model.tickets !== this.known) {
      this.known = model.tickets;
      this.showTickets();
    }
  }

  private session(): string | undefined {
    return this.page.model.tickets?.session ?? this.page.model.scene?.session;
  }

  private endSession(): void {
    const session = this.session();
    if (session) void this.page.order(t('desk.end'), { order: 'end', session });
  }

  private add(role: string, seat: string): void {
    const n = this.rows.length + 1;
    const name = el('input', { type: 'text', maxlength: 32, pattern: '[A-Za-z0-9_\\-]{1,32}', required: true });
    const seatInput = el('input', { type: 'text', maxlength: 32, pattern: '[A-Za-z0-9_\\-]{0,32}' });
    seatInput.value = seat;
    const workstation = el('input', { type: 'text', maxlength: 32, pattern: '[A-Za-z0-9_\\-]{0,32}' });
    const roles = select(
      kRoles.map((known) => [known, word('role', known)] as const),
      role,
      () => undefined,
    );
    const drop = button('✕', () => this.drop(row), { 'aria-label': t('desk.drop', { n }), class: 'quiet' });
    const node = el(
      'div',
      { class: 'row person' },
      labelled(t('desk.person', { n }), name),
      labelled(t('desk.role', { n }), roles),
      labelled(t('desk.seat', { n }), seatInput),
      labelled(t('desk.workstation', { n }), workstation),
      drop,
    );
    const row: PersonRow = { node, name, role: roles, seat: seatInput, workstation };
    this.rows.push(row);
    this.people.append(node);
  }

  private drop(row: PersonRow): void {
    this.rows = this.rows.filter((other) => other !== row);
    row.node.remove();
  }

  private send(): void {
    const lesson: Lesson = {
      scene: this.scene.value.trim(),
      name: this.name.value.trim(),
      people: this.rows.map((row) => ({
        name: row.name.value.trim(),
        role: row.role.value,
        seat: row.seat.value.trim(),
        ...(row.workstation.value.trim() === '' ? {} : { workstation: row.workstation.value.trim() }),
      })),
    };
    const mistake = lessonMistakes(lesson)[0];
    if (mistake) {
      const row = mistake.index === null ? undefined : this.rows[mistake.index];
      const field =
        mistake.field === 'scene'
          ? this.scene
          : mistake.field === 'seat' || mistake.field === 'workstation'
            ? row?.[mistake.field]
            : (row?.name ?? this.name);
      field?.focus();
      const label = field?.closest('label')?.textContent ?? t('desk.people');
      this.page.report('error', `${label}: A-Z a-z 0-9 _ -, 1…32`);
      return;
    }
    void this.page.order(t('desk.create'), { order: 'create', ...lesson });
  }

  private showTickets(): void {
    const tickets = this.known;
    if (!tickets) return this.tickets.replaceChildren();
    const cards = tickets.tickets.map((ticket) => {
      const link = ticketLink(location.origin, ticket);
      const steps = stepsOf(ticket).map((key) => t(key, { seat: ticket.seat, role: ticket.role.toLowerCase() }));
      return el(
        'article',
        { class: 'ticket', 'aria-label': t('desk.ticket_of', { person: ticket.person }) },
        el(
          'h3',
          {},
          ticket.person,
          ' ',
          el('small', {}, [word('role', ticket.role), ticket.seat].filter(Boolean).join(', ')),
        ),
        qrCode(link, t('desk.qr', { person: ticket.person })),
        el('p', {}, el('a', { href: link }, t('desk.link'))),
        el('p', {}, t('desk.at', { workstation: ticket.workstation || ticket.person })),
        el('h4', {}, t(ticket.seat === '' ? 'desk.steps_console' : 'desk.steps')),
        el('ol', {}, ...steps.map((step) => el('li', {}, step))),
        el('p', { class: 'note' }, t('desk.ticket_of', { person: ticket.person }), ': ', el('code', {}, ticket.ticket)),
      );
    });
    this.tickets.replaceChildren(
      panel(
        t('desk.tickets', { name: tickets.name }),
        'tickets-panel',
        el('p', { class: 'note' }, t('desk.single_use')),
        el(
          'div',
          { class: 'row no-print' },
          button(t('desk.print'), () => window.print()),
        ),
        el('div', { class: 'ticket-grid' }, ...cards),
      ),
    );
  }
}
