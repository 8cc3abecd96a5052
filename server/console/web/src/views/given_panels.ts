import type { Page, View } from '../app/page';
import type { GivenSession } from '../logic/given_tickets';
import { t } from '../strings/strings';
import { button, confirmOrder, el, panel, setDisabled, setText } from './dom';
import { endSession } from './session_end';
import { ticketCards } from './ticket_cards';

/** One session that this page created: its buttons, and its cards until they are closed. */
class GivenPanel {
  readonly node: HTMLElement;
  private readonly show: HTMLButtonElement;
  private readonly end: HTMLButtonElement;
  private readonly note = el('p', { class: 'note' });
  private readonly session: string;

  constructor(
    private readonly page: Page,
    private readonly given: GivenSession,
    className: string,
  ) {
    const { session, name } = given.tickets;
    this.session = session;
    this.show = button(
      t('desk.show', { name }),
      () => void page.request(t('desk.show', { name }), { type: 'watch', session }),
    );
    this.end = button(t('desk.end_of', { name }), () => void endSession(page, session, name), { class: 'danger' });
    const print = button(t('desk.print'), () => window.print());
    const close = button(t('desk.close_of', { name }), () => void this.close());
    this.node = panel(
      t(given.open ? 'desk.tickets' : 'desk.created', { name }),
      className,
      given.open ? el('p', { class: 'caution no-print' }, t('desk.single_use')) : null,
      el('div', { class: 'row no-print' }, this.show, this.end, ...(given.open ? [print, close] : [])),
      this.note,
      given.open ? ticketCards(given.tickets) : null,
    );
  }

  update(): void {
    const { model } = this.page;
    const { given, session } = this;
    const shown = model.scene?.session === session;
    const { listed, tickets } = given;
    const { name } = tickets;
    this.show.hidden = shown || given.over;
    setDisabled(this.show, !listed || model.link !== 'open');
    // The button of the session that the page shows is above.
    this.end.hidden = shown || given.over;
    setDisabled(this.end, !model.may('create'));
    setText(
      this.note,
      given.over
        ? t('desk.over', { name })
        : shown
          ? t('desk.shown', { name })
          : t(listed ? 'desk.not_shown' : 'desk.not_listed', { name, shown: model.scene?.name ?? '–' }),
    );
  }

  private async close(): Promise<void> {
    const { name } = this.given.tickets;
    const what = t('desk.close_of', { name });
    if (await confirmOrder(what, t('desk.close_explain', { name }), what, t('who.cancel')))
      this.page.model.given.close(this.session);
  }
}

/** Sessions that this page created, the newest first. */
export class GivenPanels implements View {
  readonly node = el('div', { class: 'tickets' });
  private panels: readonly GivenPanel[] = [];
  private revision = 0;

  constructor(private readonly page: Page) {}

  update(): void {
    const { given } = this.page.model;
    if (given.revision !== this.revision) {
      this.revision = given.revision;
      this.panels = given.list().map((session, i) => new GivenPanel(this.page, session, `tickets-panel-${i}`));
      this.node.replaceChildren(...this.panels.map(({ node }) => node));
    }
    for (const shown of this.panels) shown.update();
  }
}
