import { clock } from '../logic/format';
import { kSpeeds, type PlayerClock } from '../logic/player_clock';
import { t } from '../strings/strings';
import { button, el, labelled, select, setAttribute, setText } from './dom';

/** Step of the arrow keys and the slider [s]. */
export const kStep_s = 0.1;

/** Play, pause, speed, steps and the slider of a player. */
export class PlayerControls {
  readonly node: HTMLElement;
  private clock: PlayerClock | null = null;
  private state_s = 1 / 60;
  private readonly play = button('', () => this.clock?.toggle(), { class: 'primary', 'aria-keyshortcuts': 'Space' });
  private readonly slider = el('input', { type: 'range', step: kStep_s, 'aria-label': t('player.position') });
  private readonly time = el('output', { class: 'player-time' });
  private readonly speed: HTMLSelectElement;
  private dragged = false;

  constructor() {
    const step = (text: string, by: () => number, label: string, keys: string): HTMLButtonElement =>
      button(text, () => this.clock?.step(by()), { 'aria-label': label, 'aria-keyshortcuts': keys });
    this.slider.addEventListener('input', () => this.clock?.seek(Number(this.slider.value)));
    this.slider.addEventListener('pointerdown', () => (this.dragged = true));
    for (const end of ['pointerup', 'pointercancel', 'blur'])
      this.slider.addEventListener(end, () => (this.dragged = false));
    this.speed = select(
      kSpeeds.map((s) => [String(s), `${s}×`] as const),
      '1',
      (value) => {
        if (this.clock) this.clock.speed = Number(value);
      },
    );
    this.node = el(
      'div',
      { class: 'player-controls' },
      el(
        'div',
        { class: 'row' },
        this.play,
        step('−0.1 s', () => -kStep_s, t('player.back'), 'ArrowLeft'),
        step('‹', () => -this.state_s, t('player.state_back'), ','),
        step('›', () => this.state_s, t('player.state_on'), '.'),
        step('+0.1 s', () => kStep_s, t('player.on'), 'ArrowRight'),
        labelled(t('player.speed'), this.speed),
        this.time,
      ),
      this.slider,
      el('p', { class: 'note' }, t('player.keys')),
    );
  }

  setClock(clock: PlayerClock, rate_hz: number): void {
    clock.speed = Number(this.speed.value);
    this.clock = clock;
    this.state_s = 1 / rate_hz;
    this.slider.min = String(clock.from);
    this.slider.max = String(clock.to);
  }

  /** Gives the keyboard to the button that plays, so that space plays what was opened. */
  focus(): void {
    this.play.focus({ preventScroll: true });
  }

  /** Handles a key. @return whether it had a meaning */
  key(event: KeyboardEvent): boolean {
    const { clock } = this;
    const target = event.target;
    if (!clock || !(target instanceof HTMLElement)) return false;
    const steps: Record<string, () => void> = {
      ' ': () => clock.toggle(),
      ',': () => clock.step(-this.state_s),
      '.': () => clock.step(this.state_s),
      arrowleft: () => clock.step(event.shiftKey ? -1 : -kStep_s),
      arrowright: () => clock.step(event.shiftKey ? 1 : kStep_s),
      home: () => clock.seek(clock.from),
      end: () => clock.seek(clock.to),
    };
    const act = steps[event.key.toLowerCase()];
    if (!act) return false;
    // Controls keep the keys that they understand: buttons the space bar, the slider and the camera the arrows.
    if (event.key === ' ' && target.closest('button, summary, a, [type=checkbox]')) return false;
    if (event.key !== ' ' && event.key.length > 1 && target.matches('input[type=range], canvas, .scroll')) return false;
    act();
    return true;
  }

  update(): void {
    const { clock: player } = this;
    if (!player) return;
    setText(this.play, player.playing ? t('player.pause') : t('player.play'));
    setText(this.time, `${exactClock(player.t)} / ${clock(player.to)}`);
    setAttribute(this.slider, 'aria-valuetext', exactClock(player.t));
    if (!this.dragged) this.slider.value = String(player.t);
  }
}

/** Session time with hundredths of a second, so that a step of one state is seen. */
function exactClock(t: number): string {
  const hundredth = Math.floor(((t * 100) % 10) + 1e-6);
  return t >= 3600 ? clock(t) : `${clock(t)}${hundredth}`;
}
