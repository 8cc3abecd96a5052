import type { Page, View } from '../app/page';
import type { CameraChoice } from '../picture/camera_rig';
import type { Scene } from '../protocol/messages';
import { t } from '../strings/strings';
import { checkbox, el, fillSelect, labelled, panel, select } from './dom';
import type { PictureHost } from './picture_host';
import { ValueTable } from './value_table';

/** The picture, its cameras and switches, and the same values as a table. */
export class LiveView implements View {
  readonly node: HTMLElement;
  private readonly slot = el('div', { class: 'slot large' });
  private readonly camera: HTMLSelectElement;
  private readonly values = new ValueTable();
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
        panel(t('picture.values'), 'values-panel', this.values.node),
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
    this.values.update(scene, state);
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
  }
}
