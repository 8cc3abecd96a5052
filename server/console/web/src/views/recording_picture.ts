import { SessionModel } from '../logic/session_model';
import { emptyState, type Moment } from '../logic/recorded_states';
import type { Scene } from '../protocol/messages';
import { t } from '../strings/strings';
import { el, setText } from './dom';
import { PictureHost } from './picture_host';

/** A change of the shown time above which trails begin again [s]. */
const kJump_s = 0.5;
/** Moves the time of a state before all others, so that the trails begin again. */
const kLongAgo_s = 1e6;

/** The live picture, fed with the moments of a recording. A gap shows no hand and no tool. */
export class RecordingPicture {
  readonly node: HTMLElement;
  readonly host: PictureHost;
  private readonly model = new SessionModel();
  private readonly banner = el('p', { class: 'moment-banner', role: 'status' });
  private shown = NaN;
  private broken = true;

  private readonly label = el('figcaption');

  constructor() {
    this.host = new PictureHost(this.model, false);
    this.host.node.append(this.banner);
    this.node = el('figure', { class: 'recording-picture' }, this.label, this.host.node);
  }

  setLabel(text: string): void {
    setText(this.label, text);
  }

  setScene(scene: Scene): void {
    this.model.scene = scene;
    this.broken = true;
  }

  /** @param time session time of the moment [s] */
  draw(moment: Moment, time: number, now_ms: number): void {
    setText(this.banner, this.bannerOf(moment));
    this.banner.hidden = moment.kind === 'state';
    const { scene } = this.model;
    const state = moment.kind === 'state' ? moment.state : scene && emptyState(scene, time);
    // A trail must not join what lies before and behind a gap or a jump.
    const jump = !(Math.abs(time - this.shown) <= kJump_s) || moment.kind !== 'state';
    this.broken ||= jump;
    this.shown = time;
    const drawn = state && (this.broken ? { ...state, t: state.t - kLongAgo_s } : state);
    if (moment.kind === 'state') this.broken = false;
    this.host.frame(drawn && { state: drawn, delay_ms: 0, silence_ms: 0, outOfDate: false }, now_ms);
  }

  private bannerOf(moment: Moment): string {
    if (moment.kind === 'gap') return t('player.gap');
    if (moment.kind === 'loading') return t('player.loading');
    return moment.kind === 'failed' ? moment.why : '';
  }
}
