import type {
  GatewayMessage,
  Hello,
  LiveScores,
  Notes,
  Notice,
  OwnSeat,
  Right,
  Scene,
  SessionEvent,
  State,
} from '../protocol/messages';
import { Acknowledgements } from './acknowledgements';
import { AlarmLog } from './alarms';
import { GivenTickets } from './given_tickets';
import { SeatHistory } from './history';
import { Ring } from './ring';
import { StateWindow } from './state_window';

/** Connection of the gateway to the server; `gone`: the gateway does not try again, so the person signs in again. */
export type ServerLink = 'there' | 'lost' | 'gone';
export type Link = 'connecting' | 'open' | 'lost' | 'refused' | 'player';

export const kEventsKept = 500;
export const kNoticesKept = 50;

/** All that the page knows of the watched session. It has neither a socket nor a document; its memory is bounded. */
export class SessionModel {
  link: Link = 'connecting';
  server: ServerLink = 'there';
  hello: Hello | null = null;
  scene: Scene | null = null;
  notes: Notes | null = null;
  ownSeat: OwnSeat | null = null;
  scores: LiveScores | null = null;
  readonly states = new StateWindow();
  readonly acknowledgements = new Acknowledgements();
  readonly alarms = new AlarmLog();
  readonly history = new SeatHistory();
  readonly given = new GivenTickets();
  readonly events = new Ring<SessionEvent>(kEventsKept);
  readonly notices = new Ring<Notice>(kNoticesKept);
  /** Increases when hello, scene or notes change: panels build their controls again. */
  revision = 0;

  get state(): State | null {
    return this.states.newest;
  }

  /** Session time until the session ends by itself [s]; null: it does not, it is over, or that is not known. */
  get left(): number | null {
    const duration = this.scene?.duration_s ?? null;
    const { state } = this;
    return duration === null || !state || state.phase === 'OVER' ? null : Math.max(0, duration - state.t);
  }

  may(right: Right): boolean {
    return this.connectedToServer && this.granted(right);
  }

  /** Whether orders reach the server. */
  get connectedToServer(): boolean {
    return this.link === 'open' && this.server === 'there';
  }

  /** The right without regard to the connection: whether a view is offered. */
  granted(right: Right): boolean {
    return this.hello?.may.includes(right) ?? false;
  }

  /** @param now_ms time of the page, monotonic [ms] */
  apply(message: GatewayMessage, now_ms: number): void {
    switch (message.type) {
      case 'hello':
        this.hello = message;
        this.given.update(message.sessions);
        this.revision += 1;
        break;
      case 'scene':
        if (this.scene?.session !== message.session) this.beginSession();
        // A request for the same session sends the same scene again; drafts in the panels stay.
        if (JSON.stringify(this.scene) === JSON.stringify(message)) break;
        this.scene = message;
        this.revision += 1;
        break;
      case 'state':
        this.states.push(message, now_ms);
        this.acknowledgements.received(message.n, message.dropped);
        this.alarms.update(message, this.scene, now_ms);
        this.history.update(message, this.scene);
        break;
      case 'event':
        if (!this.isRepeated(message)) this.events.push(message);
        break;
      case 'notice':
        if (message.server) this.server = message.server === 'back' ? 'there' : message.server;
        this.notices.push(message);
        break;
      case 'seat':
        this.ownSeat = message.joined && message.ended === null ? message : null;
        if (message.ended !== null && message.ended !== 'left')
          this.notices.push({ type: 'notice', level: 'error', text: `${message.seat}: ${message.ended}` });
        break;
      case 'notes':
        this.notes = message;
        this.revision += 1;
        break;
      case 'tickets':
        this.given.add(message);
        this.given.update(this.hello?.sessions ?? []);
        break;
      case 'scores':
        this.scores = message;
        break;
      case 'reply':
        break;
    }
  }

  connected(): void {
    this.link = 'open';
    this.server = 'there';
    this.states.clear();
    this.acknowledgements.reset();
    this.alarms.connection(false, this.state?.t ?? null, '');
  }

  disconnected(link: 'lost' | 'refused', detail: string): void {
    this.link = link;
    this.ownSeat = null;
    // A gateway that asks for a ticket answers: nothing is lost.
    if (link === 'lost') this.alarms.connection(true, this.state?.t ?? null, detail);
  }

  /** The gateway has no session and plays recordings only. */
  playsOnly(): void {
    this.link = 'player';
  }

  private beginSession(): void {
    this.states.clear();
    this.history.clear();
    this.alarms.beginSession();
    this.events.clear();
    this.notes = null;
    this.ownSeat = null;
    this.scores = null;
  }

  /** After a reconnect the gateway sends the events again. */
  private isRepeated(event: SessionEvent): boolean {
    for (let i = this.events.length - 1; i >= 0; i -= 1) {
      const known = this.events.at(i);
      if (known?.session === event.session && known.number === event.number && known.text === event.text) return true;
    }
    return false;
  }
}
