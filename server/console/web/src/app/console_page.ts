import type { SessionModel } from '../logic/session_model';
import { ticketOfHash } from '../logic/lesson';
import { freeSeats, TrialSeat } from '../logic/seat_choice';
import type { Notice, OrderBody, Reply, Request } from '../protocol/messages';
import { setLanguage, t } from '../strings/strings';
import { ControlBar } from '../views/control_bar';
import { DeskView } from '../views/desk_view';
import { el } from '../views/dom';
import { EvaluatorView } from '../views/evaluator_view';
import { InstructorView } from '../views/instructor_view';
import { JoinView } from '../views/join_view';
import { LiveView } from '../views/live_view';
import { Messages } from '../views/messages';
import { PictureHost } from '../views/picture_host';
import { RecordingsView } from '../views/recordings_view';
import { SeatView } from '../views/seat_view';
import { kViews, TopBar } from '../views/top_bar';
import type { Connection } from './connection';
import type { Page, View, ViewName } from './page';
import { loadSettings, saveSettings, type Settings } from './settings';
import { Sound } from './sound';

const kUpdatePeriod = 100;

/** Builds the page, chooses the view and runs the frames of the screen. */
export class ConsolePage implements Page {
  readonly sound = new Sound();
  private settings: Settings = loadSettings();
  private messages = new Messages();
  private host: PictureHost;
  private bar: TopBar | null = null;
  private control: ControlBar | null = null;
  private views = new Map<ViewName, View>();
  private recordings: RecordingsView | null = null;
  private current: ViewName = 'live';
  private main = el('main', { id: 'main', tabindex: -1 });
  private join: JoinView | null = null;
  private prefilled = ticketOfHash(location.hash);
  private lastNotice: Notice | null = null;
  private updated_ms = 0;
  private readonly trial = new TrialSeat();
  private readonly dark = matchMedia('(prefers-color-scheme: dark)');

  constructor(
    readonly model: SessionModel,
    readonly connection: Connection,
    private readonly root: HTMLElement,
  ) {
    // The ticket must not stay in the address or in the history of the browser.
    if (this.prefilled) history.replaceState(null, '', '/');
    setLanguage(this.settings.language);
    this.host = new PictureHost(model, this.settings.marks);
    connection.onChange = () => this.onChange();
    this.dark.addEventListener('change', () => this.paint());
    // Tickets come once: the browser asks before it leaves a page whose cards are still shown.
    window.addEventListener('beforeunload', (event) => {
      if (model.given.open) event.preventDefault();
    });
    document.addEventListener('keydown', (event) => this.onKey(event));
    document.addEventListener('pointerdown', ({ target }) => this.bar?.pointed(target));
    this.build();
    requestAnimationFrame((now) => this.onFrame(now));
    // A hidden page gets no frames; its alarms still go on.
    setInterval(() => {
      if (document.hidden) this.update();
    }, 1000);
  }

  get pictureHost(): HTMLElement {
    return this.host.node;
  }

  order(what: string, body: OrderBody): Promise<Reply> {
    return this.request(what, { type: 'order', ...body });
  }

  async request(what: string, body: Request): Promise<Reply> {
    if (body.type === 'take') this.trial.end();
    const reply = await this.send(body);
    if (reply.ok) this.report('info', t('order.sent', { what }));
    else this.report('error', t('order.refused', { what, why: reply.text }));
    return reply;
  }

  /** Sends a request. What only the server can do is refused at once while the gateway has lost it. */
  private send(body: Request): Promise<Reply> {
    const local = body.type === 'watch' || body.type === 'leave' || body.type === 'invite';
    if (local || this.model.link !== 'open' || this.model.server === 'there') return this.connection.request(body);
    return Promise.resolve({ type: 'reply', id: null, ok: false, text: t(`server.${this.model.server}`) });
  }

  report(level: Notice['level'], text: string): void {
    this.messages.show(level, text);
  }

  private build(): void {
    document.documentElement.lang = this.settings.language;
    this.messages = new Messages();
    this.bar = new TopBar(this, this.settings, {
      choose: (view) => this.choose(view),
      change: (settings) => this.change(settings),
    });
    this.control = new ControlBar(this);
    const recordings = new RecordingsView(this);
    this.recordings = recordings;
    this.views = new Map<ViewName, View>([
      ['live', new LiveView(this, this.host)],
      ['instructor', new InstructorView(this)],
      ['evaluator', new EvaluatorView(this)],
      ['seat', new SeatView(this)],
      ['desk', new DeskView(this)],
      ['recordings', recordings],
    ]);
    this.main = el('main', { id: 'main', tabindex: -1 });
    this.root.replaceChildren(
      el('a', { class: 'skip', href: '#main' }, t('nav.skip')),
      this.bar.node,
      this.control.node,
      this.main,
      this.messages.node,
    );
    this.paint();
    this.choose(this.current);
    this.onChange();
  }

  private change(settings: Partial<Settings>): void {
    this.settings = { ...this.settings, ...settings };
    saveSettings(this.settings);
    if (settings.language) {
      setLanguage(settings.language);
      this.host.picture?.canvas.setAttribute('aria-label', t('picture.label'));
      this.join = null;
      this.build();
    }
    this.paint();
  }

  private paint(): void {
    const { theme } = this.settings;
    document.documentElement.dataset.theme = theme === 'auto' ? (this.dark.matches ? 'dark' : 'light') : theme;
    this.host.picture?.recolour();
    this.recordings?.recolour();
  }

  private choose(view: ViewName): void {
    this.views.get(this.current)?.hidden?.();
    this.current = view;
    const shown = this.views.get(view);
    if (!shown) return;
    this.main.replaceChildren(shown.node);
    shown.shown?.();
    this.bar?.choose(view);
    this.update();
  }

  private onChange(): void {
    const { model } = this;
    if (model.link === 'player' && this.current !== 'recordings') this.choose('recordings');
    this.root.classList.toggle('player-only', model.link === 'player');
    if (model.link === 'refused') {
      this.join ??= new JoinView(this.prefilled, () => this.connection.reconnect());
      if (!this.join.node.isConnected) this.main.replaceChildren(this.join.node);
    } else if (model.link === 'open' && this.join) {
      this.join = null;
      this.prefilled = null;
      this.choose(this.current);
    }
    const fresh = model.notices.newest;
    if (fresh && fresh !== this.lastNotice) {
      this.lastNotice = fresh;
      this.messages.show(fresh.level, fresh.text, fresh.server ? 'server' : '');
    }
    this.update();
  }

  /** Takes the seat of a trial if it is free; the person may leave it and take another one. */
  private play(): void {
    const { hello, scene, state } = this.model;
    if (!hello?.play || !scene || !state || !this.model.may('seat')) return;
    const { begun } = this.trial;
    const seat = this.trial.next(hello.play, freeSeats(scene, state), performance.now());
    if (!begun && this.trial.begun) this.choose('seat');
    if (seat !== null) void this.request(t('seat.take'), { type: 'take', seat });
  }

  private update(): void {
    this.play();
    this.bar?.update();
    this.control?.update();
    this.host.update(this.model.states.sample(performance.now()));
    if (!this.join) this.views.get(this.current)?.update();
  }

  private onFrame(now_ms: number): void {
    requestAnimationFrame((next) => this.onFrame(next));
    const now = performance.now();
    const drawn = this.model.states.sample(now);
    this.host.frame(drawn, now_ms);
    this.connection.acknowledge();
    if (drawn) this.sound.update(drawn.state, this.model.scene, now);
    if (!this.join) this.views.get(this.current)?.frame?.(drawn, now);
    if (now - this.updated_ms >= kUpdatePeriod) {
      this.updated_ms = now;
      this.update();
    }
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key === 'Escape' && this.bar?.escape()) return event.preventDefault();
    if (!this.settings.keys || event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.target;
    const writes =
      target instanceof HTMLElement &&
      (target.matches('input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select') ||
        target.closest('dialog') !== null);
    if (writes || this.join) return;
    const key = event.key.toLowerCase();
    const view = kViews[Number(key) - 1];
    if (this.current === 'recordings' && this.recordings?.key(event)) return event.preventDefault();
    if (event.repeat || this.model.link === 'player') return;
    if (key === 's') this.control?.order('stop');
    else if (key === 'p') this.control?.order('pause');
    else if (key === 'r') this.control?.order('resume');
    else if (key === 'm') (this.views.get('evaluator') as EvaluatorView | undefined)?.timeline.mark();
    else if (view) this.choose(view);
    else return;
    event.preventDefault();
  }
}
