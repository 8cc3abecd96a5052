import { FrameBudget } from '../logic/acknowledgements';
import { Backoff, PendingRequests } from '../logic/orders';
import type { SessionModel } from '../logic/session_model';
import type { Reply, Request, Signal } from '../protocol/messages';
import { parseMessage } from '../protocol/parse';
import { t } from '../strings/strings';

/** Frames that stay free for orders when acknowledgements and pointer use up the rate. */
const kReserve = 10;
/** Close code of the gateway for a browser without a valid cookie. */
const kSignIn = 4401;
/** Close code of a gateway that plays recordings and has no session. */
const kPlayer = 4404;
/** Time between two measurements of the round trip [ms]. */
const kMeasurePeriod = 10_000;

/** The WebSocket of the page: connects again after a loss, acknowledges states and matches replies. */
export class Connection {
  private socket: WebSocket | null = null;
  private readonly pending = new PendingRequests();
  private readonly backoff = new Backoff();
  private readonly budget = new FrameBudget();
  private retry: ReturnType<typeof setTimeout> | undefined;
  /** Called after each change of the link and each message except state. */
  onChange: () => void = () => undefined;

  constructor(private readonly model: SessionModel) {
    setInterval(() => this.measure(), kMeasurePeriod);
    setInterval(() => {
      this.pending.expire(performance.now(), t('order.unanswered'));
      // A hidden page draws no frames; it still acknowledges a few states per second for its alarms.
      if (document.hidden) this.acknowledge();
    }, 250);
    window.addEventListener('online', () => this.connect());
  }

  connect(): void {
    clearTimeout(this.retry);
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/live`);
    this.socket = socket;
    let opened = false;
    socket.onopen = () => {
      opened = true;
      this.backoff.reset();
      this.model.connected();
      this.onChange();
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === 'string') this.onFrame(data);
    };
    socket.onclose = ({ code, reason }) => void this.onClose(socket, opened, code, reason);
  }

  /** Ends the connection and connects again at once, for example with a new cookie. */
  reconnect(): void {
    this.backoff.reset();
    const socket = this.socket;
    this.socket = null;
    socket?.close();
    this.connect();
  }

  /** Sends a request. The promise always ends: without a connection or without an answer by a reply that is not ok. */
  request(body: Request): Promise<Reply> {
    return new Promise((resolve) => {
      const refuse = (text: string): void => resolve({ type: 'reply', id: null, ok: false, text });
      if (this.socket?.readyState !== WebSocket.OPEN) return refuse(t('order.no_connection'));
      if (!this.budget.take(performance.now())) return refuse(t('order.too_many'));
      const id = this.pending.add(performance.now(), (reply, roundTrip) => {
        if (body.type === 'watch') this.model.states.addRoundTrip(roundTrip);
        resolve(reply);
      });
      if (id === null) return refuse(t('order.too_many'));
      this.socket.send(JSON.stringify({ ...body, id }));
    });
  }

  /** Sends a frame without reply. Drops it when the rate is used up: the next one is newer. */
  signal(body: Signal, urgent = false): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    if (!this.budget.take(performance.now(), urgent ? 0 : kReserve)) return;
    this.socket.send(JSON.stringify(body));
  }

  /** Acknowledges the newest state; called once per drawn frame. */
  acknowledge(): void {
    if (this.socket?.readyState !== WebSocket.OPEN || !this.model.acknowledgements.due) return;
    if (!this.budget.take(performance.now(), kReserve)) return;
    const n = this.model.acknowledgements.next();
    if (n !== null) this.socket.send(JSON.stringify({ type: 'ack', n }));
  }

  private onFrame(frame: string): void {
    const message = parseMessage(frame);
    if (!message) return;
    const now = performance.now();
    const watched = this.model.scene?.session;
    this.model.apply(message, now);
    if (message.type === 'reply' && !this.pending.reply(message, now) && !message.ok) {
      this.model.apply({ type: 'notice', level: 'error', text: message.text }, now);
    }
    if (message.type === 'hello') this.watchAgain(watched);
    if (message.type !== 'state' && message.type !== 'seat') this.onChange();
  }

  /** Watches the same session as before a reconnect; the reply also measures the round trip. */
  private watchAgain(watched: string | undefined): void {
    const sessions = this.model.hello?.sessions ?? [];
    const session = sessions.find(({ id }) => id === watched) ?? sessions[0];
    if (session) void this.request({ type: 'watch', session: session.id });
    // The first round trip contains the start of the page; the smallest one counts.
    setTimeout(() => this.measure(), 1500);
  }

  /** Watches the same session again: the gateway answers by itself, so the reply measures the transport. */
  private measure(): void {
    const session = this.model.scene?.session;
    if (session && this.model.link === 'open' && !document.hidden) void this.request({ type: 'watch', session });
  }

  private async onClose(socket: WebSocket, opened: boolean, code: number, reason: string): Promise<void> {
    if (this.socket !== socket) return;
    this.socket = null;
    this.pending.failAll(t('order.no_connection'));
    const detail = reason || `WebSocket ${code}`;
    if (code === kPlayer) {
      this.model.playsOnly();
      return this.onChange();
    }
    const refused = code === kSignIn || (!opened && (await gatewayAnswers()));
    this.model.disconnected(refused ? 'refused' : 'lost', detail);
    this.onChange();
    if (this.model.link === 'lost') this.retry = setTimeout(() => this.connect(), this.backoff.next(Math.random()));
  }
}

/** A WebSocket that is refused gives no reason. If the gateway answers, the browser has no valid cookie. */
async function gatewayAnswers(): Promise<boolean> {
  try {
    return (await fetch('/join', { cache: 'no-store' })).ok;
  } catch {
    return false;
  }
}
