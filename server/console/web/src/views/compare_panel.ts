import { differenceCurve, times } from '../logic/comparison';
import { clock, fixed } from '../logic/format';
import type { ListedRecording, Note, Outline } from '../protocol/recordings';
import { t } from '../strings/strings';
import { el, fillSelect, labelled, panel, select } from './dom';
import { noteText } from './note_text';
import { PlayerChart } from './player_chart';

export type Layout = 'side' | 'overlay';

/** Notes that the alignment offers. */
const kOffered = 200;

function anchorTime(outline: Outline, anchor: string): number {
  return anchor === 'start' ? outline.from_s : (outline.notes[Number(anchor)]?.t ?? outline.from_s);
}

function anchorsOf(outline: Outline): (readonly [string, string])[] {
  const words = (note: Note): string => `${clock(note.t)} ${noteText(note)}`;
  return [
    ['start', t('compare.start')] as const,
    ...outline.notes.slice(0, kOffered).map((note, i) => [String(i), words(note)] as const),
  ];
}

/** Choice of a second recording, how both are aligned, and the distance of the tools over time. */
export class ComparePanel {
  readonly node: HTMLElement;
  layout: Layout = 'side';
  private readonly other: HTMLSelectElement;
  private readonly anchorA: HTMLSelectElement;
  private readonly anchorB: HTMLSelectElement;
  private readonly shift = el('input', { type: 'number', step: 0.01, value: 0, min: -36000, max: 36000 });
  private readonly details = el('div', { class: 'compare-details' });
  private readonly chart: PlayerChart;
  private a: Outline | null = null;
  private b: Outline | null = null;
  private curve: readonly (number | null)[] = [];

  constructor(
    onChoose: (id: string) => void,
    private readonly onChange: () => void,
    onSeek: (t: number) => void,
  ) {
    this.other = select([], '', onChoose);
    const change = (): void => this.align();
    this.anchorA = select([], 'start', change);
    this.anchorB = select([], 'start', change);
    this.shift.addEventListener('input', change);
    const layout = select(
      (['side', 'overlay'] as const).map((value) => [value, t(`compare.${value}`)] as const),
      this.layout,
      (value) => {
        this.layout = value as Layout;
        this.onChange();
      },
    );
    this.chart = new PlayerChart(t('compare.difference'), null, onSeek);
    this.details.append(
      el(
        'div',
        { class: 'row' },
        labelled(t('compare.layout'), layout),
        labelled(t('compare.anchor_a'), this.anchorA),
        labelled(t('compare.anchor_b'), this.anchorB),
        labelled(t('compare.shift'), this.shift),
      ),
      this.chart.node,
      el('p', { class: 'note' }, t('compare.note')),
    );
    this.details.hidden = true;
    this.node = panel(t('compare.title'), 'compare-panel', labelled(t('compare.with'), this.other), this.details);
  }

  /** Time of the second recording minus that of the first one [s]. */
  get offset(): number {
    if (!this.a || !this.b) return 0;
    const shift = Number.isFinite(this.shift.valueAsNumber) ? this.shift.valueAsNumber : 0;
    return anchorTime(this.b, this.anchorB.value) - anchorTime(this.a, this.anchorA.value) + shift;
  }

  offer(rows: readonly ListedRecording[]): void {
    const readable = rows.filter(({ problem }) => problem === null);
    fillSelect(
      this.other,
      [['', t('compare.none')] as const, ...readable.map(({ id, file }) => [id, file] as const)],
      this.b?.id ?? '',
    );
  }

  /** @param b null: nothing is compared */
  setOutlines(a: Outline, b: Outline | null): void {
    this.a = a;
    this.b = b;
    this.other.value = b?.id ?? '';
    this.details.hidden = b === null;
    fillSelect(this.anchorA, anchorsOf(a), 'start');
    fillSelect(this.anchorB, b ? anchorsOf(b) : [], 'start');
    this.shift.value = '0';
    this.align();
  }

  private align(): void {
    const { a, b } = this;
    if (a && b) {
      this.curve = differenceCurve(a, b, 0, this.offset);
      const millimetres = this.curve.map((d) => (d === null ? null : d * 1000));
      const series = { label: 'mm', colour: '#d55e00', values: millimetres };
      this.chart.setData(times(a.from_s, a.curves), [series], a.to_s);
    }
    this.onChange();
  }

  /** @param apart distance of the tools in the states that are shown [m]; null: not known */
  update(time: number, apart: number | null): void {
    if (!this.a || !this.b) return;
    this.chart.update(time, t('compare.now', { mm: fixed(apart === null ? null : apart * 1000, 2, 'mm') }));
  }
}
