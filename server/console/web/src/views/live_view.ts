import type { Page, View } from '../app/page';
import { fixed, kUnknown, percent } from '../logic/format';
import { seatColour } from '../logic/seat_colour';
import type { CameraChoice } from '../picture/camera_rig';
import type { Scene, Vec3 } from '../protocol/messages';
import { t } from '../strings/strings';
import { checkbox, el, fillSelect, labelled, panel, select, setText, svg } from './dom';
import type { PictureHost } from './picture_host';

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

/** The picture, its cameras and switches, and the same values as a table. */
export class LiveView implements View {
  readonly node: HTMLElement;
  private readonly slot = el('div', { class: 'slot large' });
  private readonly camera: HTMLSelectElement;
  private readonly rows = el('tbody');
  private cells: HTMLTableCellElement[][] = [];
  private known: Scene | null = null;

  constructor(
    private readonly page: Page,
    host: PictureHost,
  ) {
    this.camera = select([], 'free', (choice) => host.look(choice as CameraChoice));
    const option = (key: 'trails' | 'forces' | 'names'): HTMLLabelElement =>
      checkbox(t(`picture.${key}`), host.options[key], (on) => {
        host.options[key] = on;
      });
    const heads = (['what', 'position', 'force', 'authority'] as const).map((key) =>
      el('th', { scope: 'col' }, t(`values.${key}`)),
    );
    this.node = el(
      'div',
      { class: 'view live-view' },
      this.slot,
      el(
        'div',
        { class: 'side' },
        panel(
          t('picture.camera'),
          'camera-panel',
          labelled(t('picture.camera'), this.camera),
          el('div', { class: 'checks' }, option('trails'), option('forces'), option('names')),
        ),
        panel(
          t('picture.values'),
          'values-panel',
          el(
            'div',
            { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': t('picture.values') },
            el('table', {}, el('thead', {}, el('tr', {}, ...heads)), this.rows),
          ),
        ),
      ),
    );
  }

  shown(): void {
    this.slot.append(this.page.pictureHost);
  }

  update(): void {
    const { scene, state } = this.page.model;
    if (!scene || !state) return;
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
    const masters = scene.seats.flatMap((seat, i) =>
      seat.kind === 'MASTER' ? [[`seat:${i}`, seat.name] as const] : [],
    );
    fillSelect(
      this.camera,
      [
        ['free', t('camera.free')],
        ['front', t('camera.front')],
        ['above', t('camera.above')],
        ...masters.map(([value, seat]) => [value, t('camera.seat', { seat })] as const),
      ],
      this.camera.value || 'free',
    );
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
