import type { Browser, CDPSession, Page } from '@playwright/test';

import { kMarkBits, kMarkCell, kMarkLeft, readMark } from '../../src/logic/sequence_mark';
import { addressOf, expect, needPrograms, phaseOf, test, urlOf } from './programs';
import { median, quantile } from './statistics';

needPrograms();

/** Time of this process [ms]; the same monotonic clock as `wall_us` of the gateway. */
const monotonic = (): number => Number(process.hrtime.bigint()) / 1e6;
const kSeconds = 8;

/** A mark that was seen: session time of the drawn state, and monotonic time of the frame [ms]. */
interface Seen {
  mark: number;
  at: number;
}

/** Frames of the screen as the compositor hands them out, with the time of each [ms]. Nothing of the page takes part. */
async function screencast(page: Page, seconds: number): Promise<{ at: number; data: string }[]> {
  const devtools: CDPSession = await page.context().newCDPSession(page);
  const frames: { at: number; data: string }[] = [];
  devtools.on('Page.screencastFrame', ({ data, metadata, sessionId }) => {
    frames.push({ at: (metadata.timestamp ?? NaN) * 1000, data });
    void devtools.send('Page.screencastFrameAck', { sessionId });
  });
  // The time of a frame is a time of day. Of several readings of both clocks, the closest pair counts.
  const pairs = Array.from({ length: 200 }, () => {
    const before = monotonic();
    const day = performance.timeOrigin + performance.now();
    return { span: monotonic() - before, difference: before - day };
  }).sort((a, b) => a.span - b.span);
  await devtools.send('Page.startScreencast', { format: 'jpeg', quality: 60, everyNthFrame: 1 });
  await page.waitForTimeout(seconds * 1000);
  await devtools.send('Page.stopScreencast');
  await devtools.detach();
  return frames.map(({ at, data }) => ({ at: at + (pairs[0]?.difference ?? NaN), data }));
}

/** Reads the marks of frames, in a page of its own after the measurement. */
async function readFrames(
  browser: Browser,
  frames: { at: number; data: string }[],
  at: [number, number],
): Promise<Seen[]> {
  const reader = await browser.newPage();
  const seen: Seen[] = [];
  for (const frame of frames) {
    const cells = await reader.evaluate(
      async ({ data, left, top, cell, count }) => {
        const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
        const image = await createImageBitmap(new Blob([bytes], { type: 'image/jpeg' }));
        const context = new OffscreenCanvas(count * cell, cell).getContext('2d');
        if (!context) return [];
        context.drawImage(image, -left, -top);
        image.close();
        const { data: pixels, width } = context.getImageData(0, 0, count * cell, cell);
        return Array.from({ length: count }, (_, i) => {
          const pixel = 4 * ((cell / 2) * width + i * cell + cell / 2);
          return (pixels[pixel] ?? 0) > 127;
        });
      },
      { data: frame.data, left: at[0], top: at[1], cell: kMarkCell, count: kMarkBits + 3 },
    );
    const mark = readMark(cells);
    if (mark !== null) seen.push({ mark, at: frame.at });
  }
  await reader.close();
  return seen;
}

test('delay from the tick of the server to the picture, by marks', async ({ browser, run }) => {
  test.setTimeout(120_000);
  const host = run('tandem-server', 'run', 'contact', '--listen', '127.0.0.1:0', '--duration', '600');
  const server = await addressOf(host);
  const gateway = run('tandem-console', '--server', server, '--listen', '127.0.0.1:0');
  for (const seat of ['trainer', 'trainee'])
    run('tandem-client', 'join', '--server', server, '--seat', seat, '--device', 'sim');
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  await context.addInitScript(() => localStorage.setItem('tandem', JSON.stringify({ marks: true })));
  const page = await context.newPage();
  // What the page received: session time, and monotonic time at which the datagram with it reached the gateway [ms].
  const received: { mark: number; arrived: number }[] = [];
  page.on('websocket', (socket) =>
    socket.on('framereceived', ({ payload }) => {
      const state = JSON.parse(String(payload)) as { type: string; t: number; wall_us: number; age_ms: number | null };
      if (state.type === 'state' && state.age_ms !== null)
        received.push({ mark: state.t * 1000, arrived: state.wall_us / 1000 - state.age_ms });
    }),
  );
  await page.goto(await urlOf(gateway));
  await expect(phaseOf(page)).toHaveAttribute('data-phase', 'RUNNING');
  await expect(page.locator('.picture canvas')).toBeVisible();
  // The picture adapts its resolution within seconds.
  await page.waitForTimeout(4000);
  const begun = received.length;
  const frames = await screencast(page, kSeconds);
  const ended = received.length;
  const estimate = await page.locator('.delay').textContent();
  const box = (await page.locator('.picture canvas').boundingBox())!;
  const top = box.y + box.height - Math.floor(box.height / 2) - kMarkCell;
  const seen = await readFrames(browser, frames, [Math.round(box.x) + kMarkLeft, Math.round(top)]);
  await context.close();

  // Ticks have a fixed period, so one offset leads from session time to the monotonic clock. The datagram that took the
  // shortest way to the gateway gives it: its way (some 0.1 ms on this computer) is not in the delay.
  const offset = Math.min(...received.map(({ mark, arrived }) => arrived - mark));
  const age = seen.map(({ mark, at }) => at - (mark + offset));
  const delays = received.slice(begun, ended).flatMap(({ mark }) => {
    const first = seen.find((frame) => frame.mark >= mark - 0.5);
    return first && mark >= (seen[0]?.mark ?? Infinity) ? [first.at - (mark + offset)] : [];
  });
  console.log(
    `delay of ${delays.length} marks from the tick of the server to the screen: median ${median(delays).toFixed(1)} ms, ` +
      `95 % below ${quantile(delays, 0.95).toFixed(1)} ms (asked: median <= 80); age of the picture in ${seen.length} ` +
      `frames: median ${median(age).toFixed(1)} ms; the page's own estimate: ${estimate}`,
  );
  expect(delays.length).toBeGreaterThanOrEqual(200);
  // Frames show states in their order, and none before its tick.
  expect(seen.every((frame, i) => i === 0 || frame.mark >= (seen[i - 1]?.mark ?? 0))).toBe(true);
  expect(Math.min(...delays)).toBeGreaterThan(0);
});
