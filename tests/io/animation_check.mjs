// Runs the script of a report in a page of stubs, moves its slider, and compares the shown values with the trace.
// Usage: node animation_check.mjs report.html trace.csv; exit 0 if all frames agree.
import {readFileSync} from 'node:fs';

const [page, csv] = process.argv.slice(2).map(name => readFileSync(name, 'utf8'));
const script = page.slice(page.indexOf('<script>') + 8, page.indexOf('</script>'));
const first_run = /<option value="([^"]+)"/.exec(page)[1];

let drawn = 0;
const pen = new Proxy({}, {get: (_, name) => name === 'fillStyle' ? '' : () => { drawn++; }, set: () => true});
const elements = new Map();
const element = id => {
  if (!elements.has(id)) {
    const listeners = {};
    elements.set(id, {
      value: id === 'player-run' ? first_run : 0, style: {}, clientWidth: 800, getContext: () => pen, listeners,
      addEventListener: (name, f) => { listeners[name] = f; }, setAttribute() {},
    });
  }
  return elements.get(id);
};
const stubs = {
  document: {getElementById: element, documentElement: {}},
  window: {addEventListener() {}, matchMedia: () => ({addEventListener() {}}), devicePixelRatio: 1},
  getComputedStyle: () => ({getPropertyValue: () => '#000'}), performance, requestAnimationFrame() {},
};
new Function(...Object.keys(stubs), script)(...Object.values(stubs));

const [head, ...lines] = csv.trim().split('\n');
const names = head.split(',').map(name => name.replace(/\[.*/, ''));
const rows = lines.map(line => line.split(',').map(Number));
const column = name => names.indexOf(name);
const number = (text, pattern) => Number(pattern.exec(text)[1]);
let checked = 0;
for (let k = 0; k <= Number(element('player-time').max); k += 25) {
  element('player-time').value = k;
  const before = drawn;
  element('player-time').listeners.input();
  const text = element('player-text').textContent, t = number(text, /t = ([\d.]+) s/);
  const row = rows.find(r => r[column('t_s')] >= t - 1e-6);
  const apart = seat => 1e3 * Math.hypot(...['x', 'y', 'z'].map(a => row[column(`${seat}.${a}`)] - row[column(`tool.${a}`)]));
  const force = seat => Math.hypot(...['x', 'y', 'z'].map(a => row[column(`${seat}.f_out_${a}`)]));
  const pairs = [[t, k / 50, 0.006], [number(text, /tool: trainer ([\d.]+) mm/), apart('trainer'), 0.3],
                 [number(text, /mm, trainee ([\d.]+) mm/), apart('trainee'), 0.3],
                 [number(text, /Force: trainer ([\d.]+) N/), force('trainer'), 0.011],
                 [number(text, /N, trainee ([\d.]+) N/), force('trainee'), 0.011],
                 [number(text, /Authority: trainer ([\d.]+)/), row[column('trainer.alpha')], 0.006]];
  for (const [shown, true_value, within] of pairs)
    if (!(Math.abs(shown - true_value) <= within)) {
      console.log(`frame ${k}: "${text}" shows ${shown}, the trace has ${true_value}`);
      process.exit(1);
    }
  if (drawn - before < 20) {
    console.log(`frame ${k}: nothing was drawn`);
    process.exit(1);
  }
  checked++;
}
console.log(`checked ${checked} frames`);
process.exit(checked > 30 ? 0 : 1);
