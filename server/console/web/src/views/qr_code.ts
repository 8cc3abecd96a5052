import qrcode from 'qrcode-generator';

import { svg } from './dom';

/** Light border that readers of QR codes need [modules]. */
const kBorder = 4;

/** Returns a QR code as SVG, dark on light in both colour schemes because readers need that. */
export function qrCode(text: string, label: string): SVGSVGElement {
  const code = qrcode(0, 'M');
  code.addData(text, 'Byte');
  code.make();
  const n = code.getModuleCount();
  let path = '';
  for (let row = 0; row < n; row += 1) {
    for (let column = 0; column < n; column += 1) {
      if (code.isDark(row, column)) path += `M${column + kBorder} ${row + kBorder}h1v1h-1z`;
    }
  }
  const size = n + 2 * kBorder;
  return svg(
    'svg',
    { class: 'qr', viewBox: `0 0 ${size} ${size}`, role: 'img', 'aria-label': label },
    svg('rect', { width: size, height: size, fill: '#ffffff' }),
    svg('path', { d: path, fill: '#000000' }),
  );
}
