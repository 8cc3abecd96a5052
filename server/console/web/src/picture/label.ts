/** Vertical distance of two labels that would cover each other [px]. */
const kRow = 26;
const kWidth = 90;

/** One name at a place of the picture. An element stays sharp when the picture lowers its resolution. */
export class Label {
  readonly node = document.createElement('span');
  private readonly swatch = document.createElement('i');
  private readonly words = document.createElement('span');

  constructor(colour: string) {
    this.node.className = 'name-label';
    this.swatch.style.background = colour;
    this.node.append(this.swatch, this.words);
  }

  set(text: string, alarm: boolean): void {
    if (this.words.textContent !== text) this.words.textContent = text;
    this.node.classList.toggle('alarm', alarm);
  }

  show(shown: boolean): void {
    if (this.node.hidden === shown) this.node.hidden = !shown;
  }

  place(x: number, y: number): void {
    this.node.style.transform = `translate(-50%, -100%) translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }
}

export interface Place {
  x: number;
  y: number;
}

/** Moves labels up until none covers another. At most 24 labels, therefore the quadratic search is cheap. */
export function spread(places: readonly Place[]): Place[] {
  const free: Place[] = [];
  for (const wanted of places) {
    const covers = (y: number): boolean =>
      free.some((other) => Math.abs(other.x - wanted.x) < kWidth && Math.abs(other.y - y) < kRow);
    let y = wanted.y;
    // Each label that is placed blocks at most two rows.
    for (let tries = 0; tries < 2 * places.length && covers(y); tries += 1) y -= kRow;
    free.push({ x: wanted.x, y });
  }
  return free;
}
