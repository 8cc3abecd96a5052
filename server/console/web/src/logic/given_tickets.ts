import type { SessionName, Tickets } from '../protocol/messages';

/** Sessions whose tickets are kept; beyond it the oldest ones leave. */
export const kGivenMax = 16;

/** A session that this page created. */
export interface GivenSession {
  readonly tickets: Tickets;
  /** Whether its cards are shown. They come once, so that a closed card is lost. */
  open: boolean;
  /** Whether the gateway lists the session, so that the page can show it. */
  listed: boolean;
  over: boolean;
}

/** Sessions that this page created, the newest first, until their cards are closed and they are over. */
export class GivenTickets {
  private given: GivenSession[] = [];
  /** Increases when cards come or are closed, and when a session is over. */
  revision = 0;

  list(): readonly GivenSession[] {
    return this.given;
  }

  /** Whether a reload of the page would lose tickets. */
  get open(): boolean {
    return this.given.some(({ open }) => open);
  }

  add(tickets: Tickets): void {
    this.given = [{ tickets, open: true, listed: false, over: false }, ...this.given].slice(0, kGivenMax);
    this.revision += 1;
  }

  close(session: string): void {
    this.change(session, (given) => (given.open = false));
  }

  ended(session: string): void {
    this.change(session, (given) => (given.over = true));
  }

  /** Call with each list of the gateway: a session that it listed and lists no more is over. */
  update(sessions: readonly SessionName[]): void {
    for (const given of this.given) {
      const { tickets, listed, over } = given;
      given.listed = sessions.some(({ id }) => id === tickets.session);
      if (listed && !given.listed && !over) this.ended(tickets.session);
    }
  }

  private change(session: string, act: (given: GivenSession) => void): void {
    this.given.filter(({ tickets }) => tickets.session === session).forEach(act);
    this.given = this.given.filter(({ open, over }) => open || !over);
    this.revision += 1;
  }
}
