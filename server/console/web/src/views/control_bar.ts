import type { Page, View } from '../app/page';
import { sentences, whoResumes } from '../logic/resume';
import type { OrderBody, Right } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { button, el, setDisabled, setText } from './dom';

/** Large STOP, pause and resume, with the stop that is active. Present in all views. */
export class ControlBar implements View {
  readonly node: HTMLElement;
  private readonly stop: HTMLButtonElement;
  private readonly pause: HTMLButtonElement;
  private readonly resume: HTMLButtonElement;
  private readonly active = el('p', { class: 'active-stop', role: 'status' });

  private readonly lostWords = el('span');
  private readonly signIn = el('a', { href: '/join' }, t('server.sign_in'));
  private readonly lost = el('p', { class: 'server-lost', role: 'status' }, this.lostWords, ' ', this.signIn);

  constructor(private readonly page: Page) {
    this.stop = button(t('stop.stop'), () => this.order('stop'), { class: 'stop', 'aria-keyshortcuts': 'S' });
    this.pause = button(t('stop.pause'), () => this.order('pause'), { class: 'pause', 'aria-keyshortcuts': 'P' });
    this.resume = button(t('stop.resume'), () => this.order('resume'), { class: 'resume', 'aria-keyshortcuts': 'R' });
    this.node = el('div', { class: 'control-bar' }, this.stop, this.pause, this.resume, this.active, this.lost);
  }

  /** Sends an order if the role allows it; a key does what the button does. */
  order(order: 'stop' | 'pause' | 'resume'): void {
    const { model } = this.page;
    const what = t(`stop.${order}`);
    if (!model.granted(order)) {
      this.page.report('warning', t('order.refused', { what, why: t('order.not_allowed') }));
      return;
    }
    const stop = model.state?.stop;
    if (order === 'resume' && !stop) return;
    const body: OrderBody = order === 'resume' ? { order, stop: stop?.number ?? 0 } : { order, why: t('stop.why') };
    void this.page.order(what, body);
  }

  update(): void {
    const { model } = this.page;
    const state = model.state;
    const granted = (['stop', 'pause', 'resume'] as Right[]).some((right) => model.granted(right));
    const stop = state?.stop ?? null;
    const lost = model.link === 'open' && model.server !== 'there' ? model.server : null;
    this.node.hidden = !granted && !stop && lost === null;
    for (const [node, right] of [
      [this.stop, 'stop'],
      [this.pause, 'pause'],
      [this.resume, 'resume'],
    ] as const) {
      node.hidden = !model.granted(right);
    }
    const over = state?.phase === 'OVER';
    setDisabled(this.stop, !model.may('stop') || over || stop?.kind === 'STOP');
    setDisabled(this.pause, !model.may('pause') || over || stop !== null);
    setDisabled(this.resume, !model.may('resume') || stop === null || !stop.yours);
    this.node.classList.toggle('stopped', stop !== null);
    const words = stop
      ? t('stop.active', {
          kind: word('stop.kind', stop.kind),
          by: stop.person === null ? stop.by || '–' : `${stop.person} (${stop.by})`,
          why: stop.why || t('stop.no_reason'),
        })
      : '';
    const mayNot = stop !== null && !stop.yours && model.granted('resume');
    setText(this.active, mayNot ? sentences(words, whoResumes(stop, model.scene)) : words);
    this.active.hidden = words === '';
    setText(this.lostWords, lost === null ? '' : t(`server.${lost}`));
    this.lost.hidden = lost === null;
    this.signIn.hidden = lost !== 'gone';
  }
}
