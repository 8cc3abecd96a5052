import { Color, type WebGLRenderer } from 'three';

import { kMarkCell, kMarkLeft, markCells } from '../logic/sequence_mark';

const kWhite = new Color('#ffffff');
const kBlack = new Color('#000000');

/**
 * Draws the session time of the drawn state as a row of cells. A test reads it from the pixels of the screen, and so learns
 * which state a person saw at which time. Drawn only if the browser's storage has `"marks": true` in its entry `tandem`.
 * @param t_s session time [s]
 * @param height height of the picture [px]
 */
export function drawMark(renderer: WebGLRenderer, t_s: number, height: number): void {
  renderer.setScissorTest(true);
  markCells(Math.max(0, Math.round(t_s * 1000))).forEach((white, i) => {
    renderer.setScissor(kMarkLeft + i * kMarkCell, Math.floor(height / 2), kMarkCell, kMarkCell);
    renderer.setClearColor(white ? kWhite : kBlack, 1);
    renderer.clear();
  });
  renderer.setScissorTest(false);
}
