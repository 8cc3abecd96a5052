import type { Drawn } from '../logic/state_window';
import type { SessionModel } from '../logic/session_model';
import { fixed } from '../logic/format';
import { Picture } from '../picture/picture';
import { t, word } from '../strings/strings';
import { el, setAttribute, setText } from './dom';

/** The picture with its overlay: delay, scale of the arrows, and words when a session does not run. */
export class PictureHost {
  readonly node: HTMLElement;
  readonly picture: Picture | null;
  private readonly delay = el('p', { class: 'delay' });
  private readonly scale = el('p', { class: 'scale' });
  private readonly phase = el('p', { class: 'phase-banner' });
  private shownDelay = NaN;

  constructor(private readonly model: SessionModel) {
    let picture: Picture | null = null;
    try {
      picture = new Picture(t('picture.label'));
    } catch {
      // The values stay readable in the table of the live view.
    }
    this.picture = picture;
    this.node = el('div', { class: 'picture' }, picture?.canvas ?? el('p', { class: 'no-picture' }, t('picture.none')));
    this.node.append(el('div', { class: 'overlay' }, picture?.labels ?? null, this.delay, this.scale, this.phase));
    const motion = matchMedia('(prefers-reduced-motion: reduce)');
    const follow = (): void => {
      if (!picture) return;
      picture.options.reducedMotion = motion.matches;
      if (motion.matches) picture.options.trails = false;
    };
    motion.addEventListener('change', follow);
    follow();
  }

  frame(drawn: Drawn | null, now_ms: number): void {
    if (this.node.isConnected) this.picture?.draw(this.model.scene, drawn?.state ?? null, now_ms);
    if (drawn) {
      const share = Number.isNaN(this.shownDelay) ? 1 : 0.1;
      this.shownDelay = (Number.isNaN(this.shownDelay) ? 0 : this.shownDelay * (1 - share)) + drawn.delay_ms * share;
    }
  }

  update(drawn: Drawn | null): void {
    const { dropped } = this.model.acknowledgements;
    const { skipped } = this.model.states;
    const old = drawn?.outOfDate ?? false;
    if (old || !drawn) this.shownDelay = NaN;
    setText(
      this.delay,
      !drawn
        ? t('delay.none')
        : old
          ? t('delay.old', { s: fixed(drawn.silence_ms / 1000, 1, 's') })
          : t('delay.value', { ms: fixed(this.shownDelay, 0, 'ms') }),
    );
    setAttribute(this.delay, 'title', t('delay.help', { dropped, skipped }));
    this.node.classList.toggle('out-of-date', old);
    const force = this.picture?.forceOf10mm ?? 0;
    setText(this.scale, this.picture?.options.forces ? t('picture.scale', { n: fixed(force, force < 1 ? 1 : 0) }) : '');
    const phase = drawn?.state.phase ?? 'RUNNING';
    setText(this.phase, phase === 'RUNNING' ? '' : word('phase', phase));
    this.phase.hidden = phase === 'RUNNING';
  }
}
