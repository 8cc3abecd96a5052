import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial } from 'three';

/** Height of a label in the picture [m]. */
const kHeight = 0.0075;
const kFont = 40;

/** A name that always faces the camera. Draws its texture again only when the text or the colours change. */
export class Label {
  private readonly canvas = document.createElement('canvas');
  private readonly texture = new CanvasTexture(this.canvas);
  readonly sprite: Sprite;
  private shown = '';

  constructor() {
    this.texture.minFilter = LinearFilter;
    this.texture.generateMipmaps = false;
    this.sprite = new Sprite(new SpriteMaterial({ map: this.texture, depthTest: false, transparent: true }));
    this.sprite.renderOrder = 10;
  }

  set(text: string, colour: string, background: string, accent: string): void {
    const key = [text, colour, background, accent].join('\n');
    if (key === this.shown) return;
    this.shown = key;
    const context = this.canvas.getContext('2d');
    if (!context) return;
    const font = `600 ${kFont}px system-ui, sans-serif`;
    context.font = font;
    this.canvas.width = Math.min(1024, Math.ceil(context.measureText(text).width) + 64);
    this.canvas.height = 64;
    context.font = font;
    context.globalAlpha = 0.88;
    context.fillStyle = background;
    context.beginPath();
    context.roundRect(0, 0, this.canvas.width, 64, 14);
    context.fill();
    context.globalAlpha = 1;
    context.fillStyle = accent;
    context.beginPath();
    context.roundRect(10, 12, 14, 40, 7);
    context.fill();
    context.fillStyle = colour;
    context.textBaseline = 'middle';
    context.fillText(text, 36, 34);
    // A texture of another size needs new storage on the graphics processor.
    this.texture.dispose();
    this.texture.needsUpdate = true;
    this.sprite.scale.set((kHeight * this.canvas.width) / 64, kHeight, 1);
  }

  dispose(): void {
    this.texture.dispose();
    this.sprite.material.dispose();
  }
}
