import { kKeyStep, kReach, type Axis, type PointerDevice } from '../logic/pointer_device';
import type { OwnSeat, Vec3 } from '../protocol/messages';
import { t } from '../strings/strings';
import { el } from './dom';

const kKeys: Readonly<Record<string, [number, number, number]>> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowDown: [0, -1, 0],
  ArrowUp: [0, 1, 0],
  PageDown: [0, 0, -1],
  PageUp: [0, 0, 1],
};

/** The area where mouse, touch screen and keys move the intended hand. Shows stretch and force. */
export class SeatPad {
  readonly canvas: HTMLCanvasElement;

  constructor(private readonly device: PointerDevice) {
    this.canvas = el('canvas', { class: 'pad', tabindex: 0, role: 'application', 'aria-label': t('seat.pad') });
    const move = (event: PointerEvent): void => {
      const box = this.canvas.getBoundingClientRect();
      const half = Math.min(box.width, box.height) / 2;
      device.pointAt(
        (event.clientX - box.left - box.width / 2) / half,
        -(event.clientY - box.top - box.height / 2) / half,
      );
    };
    // One pointer has the hand until it ends: further fingers and buttons change nothing.
    let holder: number | null = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      if (holder !== null || event.button !== 0) return;
      holder = event.pointerId;
      this.canvas.setPointerCapture(event.pointerId);
      device.grip('pointer', true);
      move(event);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.pointerId === holder) move(event);
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      this.canvas.addEventListener(end, (event) => {
        if ((event as PointerEvent).pointerId !== holder) return;
        holder = null;
        device.grip('pointer', false);
      });
    }
    this.canvas.addEventListener('keydown', (event) => this.onKey(event));
  }

  /** @param share force in shares of the limit, or null if unknown */
  draw(own: OwnSeat | null, share: number | null): void {
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (width < 2 || height < 2) return;
    if (this.canvas.width !== Math.round(width * ratio)) this.canvas.width = Math.round(width * ratio);
    if (this.canvas.height !== Math.round(height * ratio)) this.canvas.height = Math.round(height * ratio);
    const context = this.canvas.getContext('2d');
    if (!context) return;
    const style = getComputedStyle(this.canvas);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const half = Math.min(width, height) / 2;
    const place = (x: Vec3): [number, number] => {
      const [right, up] = this.device.place(x);
      return [width / 2 + right * half, height / 2 - up * half];
    };
    this.grid(context, width, height, half, colour('--picture-grid'));
    const wanted = place(this.device.x);
    const actual = own?.x ? place(own.x) : null;
    const level = share ?? 0;
    const band = level >= 0.999 ? '--red' : level >= 0.8 ? '--amber' : '--accent';
    if (actual) {
      context.strokeStyle = colour(band);
      context.lineWidth = 3 + 5 * Math.min(1, level);
      context.beginPath();
      context.moveTo(...wanted);
      context.lineTo(...actual);
      context.stroke();
      context.fillStyle = colour(band);
      context.beginPath();
      context.arc(...actual, 12, 0, 2 * Math.PI);
      context.fill();
    }
    context.strokeStyle = colour('--text');
    context.lineWidth = 2;
    context.setLineDash(this.device.pressed ? [] : [5, 5]);
    context.beginPath();
    context.arc(...wanted, 18, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
  }

  private grid(context: CanvasRenderingContext2D, width: number, height: number, half: number, colour: string): void {
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.beginPath();
    const step = (0.02 / kReach) * half;
    for (let i = -Math.ceil(width / 2 / step); i <= width / 2 / step; i += 1) {
      context.moveTo(width / 2 + i * step, 0);
      context.lineTo(width / 2 + i * step, height);
    }
    for (let i = -Math.ceil(height / 2 / step); i <= height / 2 / step; i += 1) {
      context.moveTo(0, height / 2 + i * step);
      context.lineTo(width, height / 2 + i * step);
    }
    context.stroke();
  }

  private onKey(event: KeyboardEvent): void {
    const direction = kKeys[event.key];
    if (event.key === ' ') {
      if (!event.repeat) this.device.grip('key', !this.device.pressed);
    } else if (direction) {
      const axes: [Axis, Axis, Axis] = this.device.plane === 'front' ? [0, 2, 1] : [0, 1, 2];
      direction.forEach((sign, i) => this.device.step(axes[i] ?? 0, sign * kKeyStep));
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
}
