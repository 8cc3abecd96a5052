import type { LoadedRecording } from '../app/loaded_recording';
import { fetchScores } from '../app/recording_client';
import { distance, overlaidMoment, overlaidScene, pointAt, times } from '../logic/comparison';
import { clock, fixed, percent } from '../logic/format';
import { PlayerClock } from '../logic/player_clock';
import type { Moment } from '../logic/recorded_states';
import { seatColour } from '../logic/seat_colour';
import type { Curve, ListedRecording, Outline } from '../protocol/recordings';
import { t } from '../strings/strings';
import { ComparePanel } from './compare_panel';
import { el, panel, setText } from './dom';
import { PlayerChart, type ChartSeries } from './player_chart';
import { PlayerControls } from './player_controls';
import { PlayerTimeline } from './player_timeline';
import { RecordingPicture } from './recording_picture';
import { scoreTables } from './score_table';
import { ValueTable } from './value_table';

const kToolColour = '#8a8f98';

function forceSeries({ scene, curves }: Outline): ChartSeries[] {
  const seats = scene.seats.flatMap(({ name, kind }, i) =>
    kind === 'MASTER' ? [{ label: name, colour: seatColour(i), values: curves.seats[i] ?? [] }] : [],
  );
  const tools = scene.tools.map(({ name }, j) => ({
    label: name,
    colour: kToolColour,
    values: curves.tools[j]?.force ?? [],
  }));
  return [...seats, ...tools];
}

/** Authority over the first tool as a band: the masters' shares above each other, the largest sum first. */
function authoritySeries({ scene, curves }: Outline): ChartSeries[] {
  const masters = scene.seats.flatMap(({ kind }, i) => (kind === 'MASTER' ? [i] : []));
  let below: Curve | null = null;
  const bands = masters.map((seat, k) => {
    const share: Curve = curves.tools[0]?.alpha[k] ?? [];
    const base: Curve | null = below;
    const sum = share.map((value, i) => (value === null ? null : value + (base?.[i] ?? 0)));
    below = sum;
    return { label: scene.seats[seat]?.name ?? '', colour: seatColour(seat), values: sum, filled: true };
  });
  return bands.reverse();
}

/** Plays one recording, or two on one clock. */
export class PlayerView {
  readonly node: HTMLElement;
  readonly compare: ComparePanel;
  private readonly title = el('h2', { id: 'player-title' });
  private readonly facts = el('p', { class: 'note' });
  private readonly stage = el('div', { class: 'stage' });
  private readonly controls = new PlayerControls();
  private readonly timeline: PlayerTimeline;
  private readonly force: PlayerChart;
  private readonly authority: PlayerChart;
  private readonly values = new ValueTable();
  private readonly scores = el('div', { class: 'score-tables' });
  private readonly pictures: [RecordingPicture | null, RecordingPicture | null] = [null, null];
  private clock = new PlayerClock(0, 1);
  private a: LoadedRecording | null = null;
  private b: LoadedRecording | null = null;
  private apart: number | null = null;
  private moment: Moment = { kind: 'loading' };

  constructor(onCompare: (id: string) => void) {
    const seek = (time: number): void => this.clock.seek(time);
    this.timeline = new PlayerTimeline(seek);
    this.force = new PlayerChart(t('player.force'), null, seek);
    this.authority = new PlayerChart(t('player.authority'), [0, 1], seek);
    this.compare = new ComparePanel(onCompare, () => this.arrange(), seek);
    this.node = el(
      'section',
      { class: 'player', 'aria-labelledby': this.title.id },
      this.title,
      this.facts,
      this.stage,
      this.controls.node,
      el(
        'div',
        { class: 'player-parts' },
        el('div', { class: 'column' }, this.timeline.node, this.force.node, this.authority.node, this.compare.node),
        el(
          'div',
          { class: 'column' },
          panel(t('player.values'), 'player-values-panel', this.values.node),
          panel(t('scores.title'), 'scores-panel', this.scores),
        ),
      ),
    );
    this.node.hidden = true;
  }

  open(a: LoadedRecording): void {
    const { outline } = a;
    this.a = a;
    this.b = null;
    this.clock = new PlayerClock(outline.from_s, outline.to_s);
    this.controls.setClock(this.clock, outline.rate_hz);
    this.timeline.setOutline(outline);
    const at = times(outline.from_s, outline.curves);
    this.force.setData(at, forceSeries(outline), outline.to_s);
    this.authority.setData(at, authoritySeries(outline), outline.to_s);
    setText(this.title, outline.scene.name === '' ? outline.file : `${outline.scene.name} · ${outline.file}`);
    const whole = outline.complete || outline.parts_problem !== null;
    const facts = [
      t(whole ? 'player.facts' : 'player.facts_incomplete', {
        t: clock(outline.to_s - outline.from_s),
        missing: outline.missing_ticks,
        gaps: outline.gap_count,
      }),
      outline.files > 1 ? t('player.facts_files', { n: outline.files }) : '',
      outline.parts_problem ?? '',
    ];
    setText(this.facts, facts.filter(Boolean).join(' '));
    this.node.hidden = false;
    this.compare.setOutlines(outline, null);
    void this.loadScores(outline);
  }

  focus(): void {
    this.controls.focus();
  }

  /** @param b null: no comparison */
  setOther(b: LoadedRecording | null): void {
    if (!this.a) return;
    this.b = b;
    this.compare.setOutlines(this.a.outline, b?.outline ?? null);
  }

  offer(rows: readonly ListedRecording[]): void {
    this.compare.offer(rows);
  }

  recolour(): void {
    for (const picture of this.pictures) picture?.host.picture?.recolour();
  }

  key(event: KeyboardEvent): boolean {
    return !this.node.hidden && this.controls.key(event);
  }

  update(): void {
    const { a } = this;
    if (!a) return;
    this.controls.update();
    this.timeline.update(this.clock.t);
    const { scene, curves } = a.outline;
    const point = pointAt(a.outline, this.clock.t);
    const masters = scene.seats.flatMap(({ name, kind }, i) => (kind === 'MASTER' ? [{ name, i }] : []));
    const forces = masters.map(({ name, i }) => `${name} ${fixed(curves.seats[i]?.[point], 2, 'N')}`);
    this.force.update(this.clock.t, forces.join(', '));
    const shares = masters.map(({ name }, k) => `${name} ${percent(curves.tools[0]?.alpha[k]?.[point])}`);
    this.authority.update(this.clock.t, shares.join(', '));
    this.compare.update(this.clock.t, this.apart);
    if (this.moment.kind === 'state') this.values.update(scene, this.moment.state);
    for (const picture of this.pictures) picture?.host.update(null);
  }

  frame(now_ms: number): void {
    const { a, b } = this;
    if (!a) return;
    const before = this.clock.t;
    const offset = this.compare.offset;
    const shown = (time: number): [Moment, Moment | null] => [a.at(time), b ? b.at(time + offset) : null];
    this.clock.advance(
      now_ms,
      shown(before).some((moment) => moment?.kind === 'loading'),
    );
    const time = this.clock.t;
    const [first, second] = shown(time);
    this.moment = first;
    this.apart = distanceOf(first, second);
    if (b && second && this.compare.layout === 'overlay') {
      const both = overlaidMoment(first, second, a.outline.scene, b.outline.scene, time);
      this.pictures[0]?.draw(both, time, now_ms);
      return;
    }
    this.pictures[0]?.draw(first, time, now_ms);
    if (second) this.pictures[1]?.draw(second, time + offset, now_ms);
  }

  /** Shows one picture, or two side by side. */
  private arrange(): void {
    const { a, b } = this;
    if (!a) return;
    const [first, second] = [a.outline, b?.outline];
    const overlay = second !== undefined && this.compare.layout === 'overlay';
    const pictures = [this.picture(0)];
    if (second && !overlay) pictures.push(this.picture(1));
    pictures[0]?.setScene(overlay ? overlaidScene(first.scene, second.scene, '(2)') : first.scene);
    if (second && !overlay) pictures[1]?.setScene(second.scene);
    pictures[0]?.setLabel(overlay ? `${first.file} + ${second.file} (2)` : first.file);
    if (second) pictures[1]?.setLabel(second.file);
    this.stage.classList.toggle('two', pictures.length > 1);
    this.stage.replaceChildren(...pictures.map(({ node }) => node));
  }

  private picture(i: 0 | 1): RecordingPicture {
    const found = this.pictures[i] ?? new RecordingPicture();
    this.pictures[i] = found;
    return found;
  }

  private async loadScores(outline: Outline): Promise<void> {
    this.scores.replaceChildren(el('p', { class: 'note' }, t('scores.computing')));
    let shown: HTMLElement[];
    try {
      shown = scoreTables(await fetchScores(outline.id));
    } catch (error) {
      shown = [el('p', { class: 'note' }, error instanceof Error ? error.message : String(error))];
    }
    if (this.a?.outline === outline) this.scores.replaceChildren(...shown);
  }
}

/** Distance of the first tools of two moments [m]. */
function distanceOf(a: Moment, b: Moment | null): number | null {
  if (a.kind !== 'state' || b?.kind !== 'state') return null;
  return distance(a.state.tools[0]?.x ?? null, b.state.tools[0]?.x ?? null);
}
