import type { Page, View } from '../app/page';
import { fixed } from '../logic/format';
import { kQuantities, type Quantity } from '../logic/history';
import {
  bandOf,
  forceBand,
  forceMagnitude,
  forceShare,
  gateBand,
  kAgeLimits,
  kGapLimits,
  kLossLimits,
  kRoundTripLimits,
  linkBand,
  marginBand,
  temperatureBand,
  worst,
  type Band,
} from '../logic/limits';
import type { Scene, SceneSeat, SeatState } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { el, labelled, panel, select, setAttribute, setText } from './dom';
import { swatch } from './value_table';
import { Sparkline } from './sparkline';

const kRows = ['gate', 'force', 'rtt', 'loss', 'gap', 'age', 'margin', 'trips', 'late', 'temperature', 'link'] as const;
type RowName = (typeof kRows)[number];

interface Value {
  text: string;
  band: Band;
}

/** Returns the texts and bands of one card. */
function valuesOf(seat: SeatState, scene: SceneSeat | undefined): Record<RowName, Value> {
  const force = forceMagnitude(seat);
  const limit = scene?.force_limit_n ?? null;
  return {
    gate: { text: word('gate', seat.gate), band: gateBand(seat.gate) },
    force: {
      text: t('cards.of_limit', { f: fixed(force, 2, 'N'), limit: fixed(limit, 1, 'N') }),
      band: forceBand(forceShare(seat, scene)),
    },
    rtt: { text: fixed(seat.rtt_ms, 1, 'ms'), band: bandOf(seat.rtt_ms, kRoundTripLimits) },
    loss: { text: fixed(seat.loss_percent, 1, '%'), band: bandOf(seat.loss_percent, kLossLimits) },
    gap: { text: fixed(seat.gap_ms, 1, 'ms'), band: bandOf(seat.gap_ms, kGapLimits) },
    age: { text: fixed(seat.age_ms, 1, 'ms'), band: bandOf(seat.age_ms, kAgeLimits) },
    margin: {
      text: fixed(seat.margin_j === null ? null : seat.margin_j * 1000, 1, 'mJ'),
      band: marginBand(seat.margin_j),
    },
    trips: { text: fixed(seat.trips, 0), band: seat.trips === null ? 'unknown' : seat.trips > 0 ? 'amber' : 'green' },
    late: { text: fixed(seat.late, 0), band: seat.late === null ? 'unknown' : seat.late > 0 ? 'amber' : 'green' },
    temperature: { text: fixed(seat.temperature_c, 0, '°C'), band: temperatureBand(seat.temperature_c) },
    link: { text: t(`band.${linkBand(seat)}`), band: linkBand(seat) },
  };
}

interface Card {
  node: HTMLElement;
  person: HTMLElement;
  meter: HTMLMeterElement;
  cells: Record<RowName, HTMLElement>;
  spark: Sparkline;
}

/** A card per seat: values with their bands, force against its limit, and the last minute of one quantity. */
export class SeatCards implements View {
  readonly node: HTMLElement;
  private readonly grid = el('div', { class: 'cards' });
  private quantity: Quantity = 'force';
  private cards: Card[] = [];
  private known: Scene | null = null;
  private sparkAt = 0;

  constructor(private readonly page: Page) {
    const quantities = select(
      kQuantities.map((quantity) => [quantity, t(`quantity.${quantity}`)] as const),
      'force',
      (value) => {
        this.quantity = value as Quantity;
        this.sparkAt = 0;
      },
    );
    this.node = panel(
      t('cards.title'),
      'cards-panel',
      el('div', { class: 'row' }, labelled(t('cards.quantity'), quantities)),
      this.grid,
    );
  }

  update(): void {
    const { scene, state } = this.page.model;
    if (!scene) return;
    if (scene !== this.known) this.adopt(scene);
    const now = performance.now();
    const sparks = now - this.sparkAt > 500;
    if (sparks) this.sparkAt = now;
    this.cards.forEach((card, i) => {
      const seat = state?.seats[i];
      if (!seat) return;
      const values = valuesOf(seat, scene.seats[i]);
      const bands = kRows.map((name) => values[name].band);
      const taken = seat.taken !== false;
      setAttribute(card.node, 'data-band', !taken ? 'unknown' : seat.heard === false ? 'red' : worst(bands));
      card.node.classList.toggle('free', !taken);
      setText(card.person, taken ? (seat.person ?? '') : t('who.free'));
      card.meter.value = Math.min(1, forceShare(seat, scene.seats[i]) ?? 0);
      for (const name of kRows) {
        setText(card.cells[name], values[name].text);
        setAttribute(card.cells[name], 'data-band', values[name].band);
        setAttribute(card.cells[name], 'title', t(`level.${values[name].band}`));
      }
      if (sparks) this.drawSpark(card, i, scene.seats[i]);
    });
  }

  private drawSpark(card: Card, index: number, seat: SceneSeat | undefined): void {
    const [times, values] = this.page.model.history.series(index, this.quantity);
    const limit = { force: seat?.force_limit_n ?? null, rtt: null, loss: null, margin: null }[this.quantity];
    const label = t('cards.spark', {
      quantity: t(`quantity.${this.quantity}`),
      seat: seat?.name ?? '',
      value: fixed(values[values.length - 1], 2),
    });
    card.spark.draw(times, values, limit, label);
  }

  private adopt(scene: Scene): void {
    this.known = scene;
    this.cards = scene.seats.map((seat, i) => {
      const cells = Object.fromEntries(kRows.map((name) => [name, el('dd')])) as Record<RowName, HTMLElement>;
      const person = el('span', { class: 'person' });
      const meter = el('meter', {
        min: 0,
        max: 1,
        low: 0.8,
        high: 0.999,
        optimum: 0,
        'aria-label': `${seat.name}: ${t('cards.force')}`,
      });
      const spark = new Sparkline();
      const rows = kRows.map((name) => el('div', {}, el('dt', {}, t(`cards.${name}`)), cells[name]));
      const node = el(
        'article',
        { class: 'card', 'aria-label': seat.name },
        el('h3', {}, swatch(i), seat.name, person),
        meter,
        spark.node,
        el('dl', {}, ...rows),
      );
      return { node, person, meter, cells, spark };
    });
    this.sparkAt = 0;
    this.grid.replaceChildren(...this.cards.map((card) => card.node));
  }
}
