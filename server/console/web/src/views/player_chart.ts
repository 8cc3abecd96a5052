import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';

import { el, setAttribute, setText } from './dom';

const kHeight = 120;

export interface ChartSeries {
  label: string;
  colour: string;
  values: readonly (number | null)[];
  /** The area below the line is filled. */
  filled?: boolean;
}

/** Curves over a whole recording with a cursor at the time that is shown. A gap of the data is a gap of the curve. */
export class PlayerChart {
  readonly node: HTMLElement;
  private readonly area = el('div', { class: 'chart-area', role: 'img' });
  private readonly legend = el('p', { class: 'chart-legend' });
  private readonly cursor = el('div', { class: 'chart-cursor' });
  private plot: uPlot | null = null;
  private times: readonly number[] = [];
  private series: readonly ChartSeries[] = [];
  private built = '';

  /** @param range fixed limits of the values; null: those of the data and 0 */
  constructor(
    private readonly title: string,
    private readonly range: readonly [number, number] | null,
    private readonly onSeek: (t: number) => void,
  ) {
    this.area.append(this.cursor);
    this.area.addEventListener('click', (event) => {
      const over = this.plot?.over.getBoundingClientRect();
      if (this.plot && over) this.onSeek(this.plot.posToVal(event.clientX - over.left, 'x'));
    });
    this.node = el('figure', { class: 'player-chart' }, el('figcaption', {}, title), this.area, this.legend);
  }

  /** @param end  end of the recording: the values of the last point hold until then [s] */
  setData(times: readonly number[], series: readonly ChartSeries[], end: number): void {
    const last = times[times.length - 1];
    const holds = last !== undefined && end > last;
    this.times = holds ? [...times, end] : times;
    this.series = holds
      ? series.map((s) => ({ ...s, values: [...s.values, s.values[times.length - 1] ?? null] }))
      : series;
    this.built = '';
  }

  /** Draws what has changed, and moves the cursor. @param label the values at the cursor in words */
  update(t: number, label: string): void {
    setAttribute(this.area, 'aria-label', `${this.title}. ${label}`);
    setText(this.legend, label);
    const width = Math.floor(this.area.clientWidth);
    if (width < 40 || this.times.length === 0) return;
    const style = getComputedStyle(document.documentElement);
    const text = style.getPropertyValue('--text').trim();
    const key = `${width} ${text}`;
    if (key !== this.built) this.build(width, text, style.getPropertyValue('--border').trim());
    this.built = key;
    const { plot } = this;
    if (!plot) return;
    const ratio = window.devicePixelRatio || 1;
    const left = plot.bbox.left / ratio + plot.valToPos(t, 'x');
    this.cursor.style.transform = `translateX(${left.toFixed(1)}px)`;
  }

  private build(width: number, text: string, grid: string): void {
    this.plot?.destroy();
    const axis = { stroke: text, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 } };
    const end = this.times[this.times.length - 1] ?? 1;
    const begin = this.times[0] ?? 0;
    this.plot = new uPlot(
      {
        width,
        height: kHeight,
        legend: { show: false },
        cursor: { show: false },
        select: { show: false, left: 0, top: 0, width: 0, height: 0 },
        axes: [
          { ...axis, values: (_, splits) => splits.map((s) => `${s}`) },
          { ...axis, size: 44 },
        ],
        scales: {
          x: { time: false, range: [begin, Math.max(end, begin + 1e-3)] },
          y: {
            range: (_, low, high) =>
              this.range ? [...this.range] : [Math.min(0, low ?? 0), Math.max(high ?? 0, 1e-3) * 1.05],
          },
        },
        series: [
          {},
          ...this.series.map((s) => ({
            label: s.label,
            stroke: s.colour,
            width: 1.5,
            points: { show: false },
            ...(s.filled ? { fill: s.colour } : {}),
          })),
        ],
      },
      [[...this.times], ...this.series.map((s) => [...s.values])],
      this.area,
    );
  }
}
