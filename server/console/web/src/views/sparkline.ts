import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';

import { kHistorySeconds } from '../logic/history';
import { el } from './dom';

const kHeight = 56;

/** A curve of the last minute without axes; the numbers stand beside it. */
export class Sparkline {
  readonly node = el('div', { class: 'spark', role: 'img' });
  private plot: uPlot | null = null;
  private colours = '';
  private width = 0;

  /** @param limit level of the dashed line, in the unit of the values, or null */
  draw(times: number[], values: (number | null)[], limit: number | null, label: string): void {
    this.node.setAttribute('aria-label', label);
    const width = Math.floor(this.node.clientWidth);
    if (width < 20) return;
    const style = getComputedStyle(document.documentElement);
    const colour = style.getPropertyValue('--accent').trim();
    const red = style.getPropertyValue('--red').trim();
    if (this.plot === null || this.colours !== colour) this.build(width, colour, red);
    else if (this.width !== width) this.plot.setSize({ width, height: kHeight });
    this.width = width;
    this.plot?.setData([times, values, times.map(() => limit)]);
  }

  private build(width: number, colour: string, red: string): void {
    this.plot?.destroy();
    this.colours = colour;
    this.plot = new uPlot(
      {
        width,
        height: kHeight,
        padding: [4, 0, 4, 0],
        legend: { show: false },
        cursor: { show: false },
        select: { show: false, left: 0, top: 0, width: 0, height: 0 },
        axes: [{ show: false }, { show: false }],
        scales: {
          x: { time: false, range: [-kHistorySeconds, 0] },
          y: { range: (_, low, high) => [Math.min(0, low ?? 0), Math.max(high ?? 0, 1e-3) * 1.1] },
        },
        series: [
          {},
          { stroke: colour, width: 1.5, points: { show: false } },
          { stroke: red, width: 1, dash: [4, 4], points: { show: false } },
        ],
      },
      [[], [], []],
      this.node,
    );
  }
}
