import type { Page, View, ViewName } from '../app/page';
import type { Settings } from '../app/settings';
import { clock } from '../logic/format';
import type { Hello } from '../protocol/messages';
import { kLanguages, setLanguage, t, word, currentLanguage, type Language } from '../strings/strings';
import { RecordingMark } from './recording_mark';
import { button, checkbox, el, fillSelect, labelled, select, setAttribute, setDisabled, setText } from './dom';

export const kViews: readonly ViewName[] = ['live', 'instructor', 'evaluator', 'seat', 'desk', 'recordings'];

export interface TopBarActions {
  choose(view: ViewName): void;
  change(settings: Partial<Settings>): void;
}

function languageName(language: Language): string {
  const now = currentLanguage();
  setLanguage(language);
  const name = t('language.name');
  setLanguage(now);
  return name;
}

/** Name, session, phase, connection and the choice of views. */
export class TopBar implements View {
  readonly node: HTMLElement;
  private readonly session: HTMLSelectElement;
  private readonly phase = el('span', { class: 'badge' });
  private readonly time = el('span', { class: 'time' });
  private readonly left = el('span', { class: 'left note' });
  private readonly link = el('span', { class: 'link', role: 'status' });
  private readonly person = el('span', { class: 'person' });
  private readonly tabs: readonly HTMLButtonElement[];
  private readonly invite = button(t('bar.invite'), () => void this.askInvitation());
  private readonly invitation = el('input', { type: 'text', readonly: true, 'aria-label': t('bar.invitation') });
  private known: Hello | null = null;
  private readonly settings: HTMLDetailsElement;
  private readonly recording: RecordingMark;

  constructor(
    private readonly page: Page,
    settings: Settings,
    actions: TopBarActions,
  ) {
    this.recording = new RecordingMark(page);
    this.session = select([], '', (session) => {
      void page.request(t('bar.session'), { type: 'watch', session });
    });
    this.tabs = kViews.map((view, i) =>
      button(t(`nav.${view}`), () => actions.choose(view), { 'data-view': view, 'aria-keyshortcuts': String(i + 1) }),
    );
    const language = select(
      (Object.keys(kLanguages) as Language[]).map((known) => [known, languageName(known)] as const),
      settings.language,
      (value) => actions.change({ language: value as Language }),
    );
    const theme = select(
      (['auto', 'light', 'dark'] as const).map((value) => [value, t(`theme.${value}`)] as const),
      settings.theme,
      (value) => actions.change({ theme: value as Settings['theme'] }),
    );
    this.settings = el(
      'details',
      { class: 'settings' },
      el('summary', {}, t('bar.settings')),
      el(
        'div',
        { class: 'settings-box' },
        labelled(t('bar.language'), language),
        labelled(t('bar.theme'), theme),
        checkbox(t('bar.keys'), settings.keys, (keys) => actions.change({ keys })),
        el('p', { class: 'note' }, t('bar.keys_help')),
        this.invite,
        this.invitation,
      ),
    );
    this.invitation.hidden = true;
    const sound = checkbox(t('bar.sound'), page.sound.on, (on) => page.sound.switch(on));
    this.node = el(
      'header',
      { class: 'top-bar' },
      el(
        'div',
        { class: 'identity' },
        el('h1', {}, 'Tandem'),
        labelled(t('bar.session'), this.session),
        this.phase,
        this.time,
        this.left,
        this.recording.node,
        this.link,
        this.person,
        sound,
        this.settings,
      ),
      el('nav', { 'aria-label': t('nav.label') }, ...this.tabs),
    );
  }

  /** Shows a URL for another browser. It works once, so that each click gives a new one. */
  private async askInvitation(): Promise<void> {
    const reply = await this.page.connection.request({ type: 'invite' });
    if (!reply.ok) return this.page.report('error', t('order.refused', { what: t('bar.invite'), why: reply.text }));
    this.invitation.value = location.origin + reply.text;
    this.invitation.hidden = false;
    this.invitation.select();
  }

  /** Closes the settings if the person pointed elsewhere. */
  pointed(target: EventTarget | null): void {
    if (!(target instanceof Node) || !this.settings.contains(target)) this.settings.open = false;
  }

  /** Closes the settings by the key Escape; the focus stays at them. @return false: they are closed already */
  escape(): boolean {
    if (!this.settings.open) return false;
    if (this.settings.contains(document.activeElement)) this.settings.querySelector('summary')?.focus();
    this.settings.open = false;
    return true;
  }

  choose(view: ViewName): void {
    for (const tab of this.tabs) setAttribute(tab, 'aria-current', tab.dataset.view === view ? 'page' : null);
  }

  update(): void {
    const { model } = this.page;
    const { hello, state } = model;
    if (hello && hello !== this.known) {
      this.known = hello;
      fillSelect(
        this.session,
        hello.sessions.map((session) => [session.id, session.name] as const),
        model.scene?.session ?? '',
      );
      setText(this.person, t('bar.person', { person: hello.person, role: word('role', hello.role) }));
    }
    if (model.scene && document.activeElement !== this.session && this.session.value !== model.scene.session) {
      this.session.value = model.scene.session;
    }
    // Without the server the last phase may be old.
    const phase = state && (model.connectedToServer ? state.phase : 'UNKNOWN');
    setText(this.phase, phase ? word('phase', phase) : '');
    setAttribute(this.phase, 'data-phase', phase);
    setAttribute(this.phase, 'title', phase === 'HELD' && state ? state.held : null);
    setText(this.time, state ? clock(state.t) : '');
    setText(this.left, model.left === null ? '' : t('bar.left', { t: clock(model.left) }));
    this.recording.update();
    const link = model.link !== 'open' || model.server === 'there' ? model.link : (`server_${model.server}` as const);
    setText(this.link, t(`link.${link}`));
    setAttribute(this.link, 'data-link', link);
    setDisabled(this.invite, !model.may('invite'));
    const right = {
      live: null,
      instructor: null,
      evaluator: 'score',
      seat: 'seat',
      desk: 'create',
      recordings: 'recordings',
    } as const;
    for (const tab of this.tabs) {
      const needed = right[tab.dataset.view as ViewName];
      tab.classList.toggle('denied', needed !== null && !model.granted(needed));
      tab.hidden = model.link === 'player' && tab.dataset.view !== 'recordings';
    }
  }
}
