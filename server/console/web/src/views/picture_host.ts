import type { Drawn } from '../logic/state_window';
import type { SessionModel } from '../logic/session_model';
import { fixed } from '../logic/format';
import type { CameraChoice } from '../picture/camera_rig';
import type { PictureOptions } from '../picture/hand_ghost';
import type { Picture } from '../picture/picture';
import { t, word } from '../strings/strings';
import { el, setAttribute, setText } from './dom';

/** Three.js is most of the page. It loads while the page builds its controls, so that STOP does not wait for the picture. */
const pictureCode = import('../picture/picture');

/** Entry of the browser's performance timeline at the first picture that shows a state. */
const kFirstPicture = 'first-picture';

/** The picture with its overlay: delay, scale of the arrows, and words when a session does not run. */
export class PictureHost {
  readonly node: HTMLElement;
  picture: Picture | null = null;
  readonly options: PictureOptions = {
    trails: true,
    forces: true,
    names: true,
    forceScale: 0.01,
    reducedMotion: false,
  };
  private camera: CameraChoice = 'free';
  private readonly delay = el('p', { class: 'delay' });
  private readonly scale = el('p', { class: 'scale' });
  private readonly phase = el('p', { class: 'phase-banner' });
  private shownDelay = NaN;
  private begun = false;

  /** @param marks the picture carries marks for tests of its delay */
  constructor(
    private readonly model: SessionModel,
    marks: boolean,
  ) {
    const overlay = el('div', { class: 'overlay' }, this.delay, this.scale, this.phase);
    this.node = el('div', { class: 'picture' }, overlay);
    void pictureCode
      .then((code) => {
        this.picture = new code.Picture(t('picture.label'), this.options, marks);
        this.picture.rig.choose(this.camera);
        this.node.prepend(this.picture.canvas);
        overlay.prepend(this.picture.labels);
      })
      // Without WebGL, or when the code cannot be loaded, the values stay readable in the table of the live view.
      .catch(() => this.node.prepend(el('p', { class: 'no-picture' }, t('picture.none'))));
    const motion = matchMedia('(prefers-reduced-motion: reduce)');
    const follow = (): void => {
      this.options.reducedMotion = motion.matches;
      if (motion.matches) this.options.trails = false;
    };
    motion.addEventListener('change', follow);
    follow();
  }

  /** Chooses the camera, also before the picture is there. */
  look(choice: CameraChoice): void {
    this.camera = choice;
    this.picture?.rig.choose(choice);
  }

  frame(drawn: Drawn | null, now_ms: number): void {
    if (this.node.isConnected && this.picture?.draw(this.model.scene, drawn?.state ?? null, now_ms) && !this.begun) {
      this.begun = true;
      performance.mark(kFirstPicture);
    }
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
    setText(
      this.scale,
      this.picture && this.options.forces ? t('picture.scale', { n: fixed(force, force < 1 ? 1 : 0) }) : '',
    );
    const phase = drawn?.state.phase ?? 'RUNNING';
    setText(this.phase, phase === 'RUNNING' ? '' : word('phase', phase));
    this.phase.hidden = phase === 'RUNNING';
  }
}
