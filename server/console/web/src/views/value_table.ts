import { fixed, kUnknown, percent } from '../logic/format';
import { seatColour } from '../logic/seat_colour';
import type { Scene, State, Vec3 } from '../protocol/messages';
import { t } from '../strings/strings';
import { el, setText, svg } from './dom';

const millimetres = (x: Vec3 | null): string =>
  x === null ? kUnknown : x.map((component) => fixed(component * 1000, 1)).join(' ');
const newtons = (f: Vec3 | null): string => (f === null ? kUnknown : fixed(Math.hypot(...f), 2));

/** Returns a small coloured square: the colour of a seat. Decorative, the name stands beside it. */
export function swatch(index: number): SVGElement {
  return svg(
    'svg',
    { class: 'swatch', viewBox: '0 0 10 10', 'aria-hidden': 'true' },
    svg('rect', { width: 10, height: 10, rx: 3, fill: seatColour(index) }),
  );
}

/** Positions, forces and authority of a state as a table. */
export class ValueTable {
  readonly node: HTMLElement;
  private readonly rows = el('tbody');
  private cells: HTMLTableCellElement[][] = [];
  private known: Scene | null = null;

  constructor() {
    const heads = (['what', 'position', 'force', 'authority'] as const).map((key) =>
      el('th', { scope: 'col' }, t(`values.${key}`)),
    );
    this.node = el(
      'div',
      { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': t('picture.values') },
      el('table', {}, el('thead', {}, el('tr', {}, ...heads)), this.rows),
    );
  }

  update(scene: Scene, state: State): void {
    if (scene !== this.known) this.adopt(scene);
    const masters = scene.seats.flatMap((seat, i) => (seat.kind === 'MASTER' ? [i] : []));
    state.seats.forEach((seat, i) => {
      const master = masters.indexOf(i);
      const shares = master < 0 ? [] : state.tools.map((tool) => percent(tool.applied?.[master]));
      this.set(i, [millimetres(seat.x), newtons(seat.f), shares.join(' · ') || kUnknown]);
    });
    state.tools.forEach((tool, i) => {
      const depth = tool.touching ? t('values.depth', { mm: fixed((tool.depth_m ?? NaN) * 1000, 1, 'mm') }) : '';
      this.set(scene.seats.length + i, [millimetres(tool.x), newtons(tool.f), depth]);
    });
  }

  private set(row: number, texts: readonly string[]): void {
    texts.forEach((text, i) => {
      const cell = this.cells[row]?.[i];
      if (cell) setText(cell, text);
    });
  }

  private adopt(scene: Scene): void {
    this.known = scene;
    const names = [
      ...scene.seats.map((seat, i) => [swatch(i), seat.name] as const),
      ...scene.tools.map((tool) => [null, tool.name] as const),
    ];
    this.cells = names.map(() => [el('td'), el('td'), el('td')]);
    this.rows.replaceChildren(
      ...names.map(([mark, name], i) => el('tr', {}, el('th', { scope: 'row' }, mark, name), ...(this.cells[i] ?? []))),
    );
  }
}
