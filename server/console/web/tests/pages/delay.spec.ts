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

declare global {
  interface Window {
    /** Frames that the page drew since the list was set: time of the page after the frame was drawn [ms], cells of the mark. */
    drawn: { at: number; cells: boolean[] }[] | undefined;
  }
}

/** Runs before the code of the page: reads the mark of each frame back from the canvas, after the page drew it. */
function probe({ left, cell, count }: { left: number; cell: number; count: number }): void {
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    request((time) => {
      callback(time);
      const canvas = document.querySelector<HTMLCanvasElement>('.picture canvas');
      const context = window.drawn && canvas?.getContext('webgl2');
      if (!window.drawn || !canvas || !context) return;
      const scale = canvas.width / canvas.clientWidth;
      const row = new Uint8Array(4 * Math.ceil(count * cell * scale));
      const y = Math.round((Math.floor(canvas.clientHeight / 2) + cell / 2) * scale);
      // This waits until the picture is drawn.
      context.readPixels(Math.round(left * scale), y, row.length / 4, 1, context.RGBA, context.UNSIGNED_BYTE, row);
      const cells = Array.from({ length: count }, (_, i) => (row[4 * Math.floor((i + 0.5) * cell * scale)] ?? 0) > 127);
      window.drawn.push({ at: performance.now(), cells });
    });
}

/** Difference of the monotonic clock and the clock of the page [ms], from the quickest of many readings. */
async function pageClock(page: Page): Promise<number> {
  let best = { span: Infinity, difference: NaN };
  for (let i = 0; i < 100; i += 1) {
    const before = monotonic();
    const now = await page.evaluate(() => performance.now());
    const span = monotonic() - before;
    if (span < best.span) best = { span, difference: before + span / 2 - now };
  }
  return best.difference;
}

/** Frames as the page drew them, read back from its canvas. */
async function drawnFrames(page: Page, seconds: number): Promise<Seen[]> {
  const difference = await pageClock(page);
  await page.evaluate(() => (window.drawn = []));
  await page.waitForTimeout(seconds * 1000);
  const drawn = await page.evaluate(() => {
    const found = window.drawn ?? [];
    window.drawn = undefined;
    return found;
  });
  return drawn.flatMap(({ at, cells }) => {
    const mark = readMark(cells);
    return mark === null ? [] : [{ mark, at: at + difference }];
  });
}

/** Frames of the screen as the compositor hands them out, with the time of each [ms]. Nothing of the page takes part. */
async function screencast(page: Page, seconds: number): Promise<{ at: number; data: string }[]> {
  const devtools: CDPSession = await page.context().newCDPSession(page);
  const frames: { at: number; data: string }[] = [];
  devtools.on('Page.screencastFrame', ({ data, metadata, sessionId }) => {
    frames.push({ at: (metadata.timestamp ?? NaN) * 1000, data });
    devtools.send('Page.screencastFrameAck', { sessionId }).catch(() => undefined); // the page may be closed
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
  await context.addInitScript(probe, { left: kMarkLeft, cell: kMarkCell, count: kMarkBits + 3 });
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
  const began = received.length;
  const drawn = await drawnFrames(page, kSeconds);
  const estimate = await page.locator('.delay').textContent();
  const between = received.length;
  const frames = await screencast(page, kSeconds);
  const ended = received.length;
  const size = await page
    .locator('.picture canvas')
    .evaluate((node: HTMLCanvasElement) => `${node.width} x ${node.height}`);
  const box = (await page.locator('.picture canvas').boundingBox())!;
  const top = box.y + box.height - Math.floor(box.height / 2) - kMarkCell;
  const shown = await readFrames(browser, frames, [Math.round(box.x) + kMarkLeft, Math.round(top)]);
  await context.close();

  // Ticks have a fixed period, so an offset leads from session time to the monotonic clock. The datagram that took the
  // shortest way to the gateway gives it: its way (some 0.1 ms on this computer) is not in the delay. A server that stood
  // still does not repeat the ticks it missed, therefore the offset of a mark is that of the second around it.
  const offsetAt = (mark: number): number =>
    Math.min(...received.flatMap((state) => (Math.abs(state.mark - mark) < 500 ? [state.arrived - state.mark] : [])));
  /** Time from the tick of each received state to the first frame that shows it or a newer one [ms]. */
  const delaysOf = (seen: Seen[], marks: typeof received): number[] =>
    marks.flatMap(({ mark }) => {
      const first = seen.find((frame) => frame.mark >= mark - 0.5);
      return first && mark >= (seen[0]?.mark ?? Infinity) ? [first.at - (mark + offsetAt(mark))] : [];
    });
  const measured = [
    ['drawn (read back from the canvas)', drawn, delaysOf(drawn, received.slice(began, between))],
    [
      'on the screen (frames of the compositor, whose recording costs time)',
      shown,
      delaysOf(shown, received.slice(between, ended)),
    ],
  ] as const;
  for (const [what, seen, delays] of measured) {
    console.log(
      `tick of the server to the picture ${what}: ${delays.length} marks, median ${median(delays).toFixed(1)} ms, ` +
        `95 % below ${quantile(delays, 0.95).toFixed(1)} ms (asked: median <= 80); ${(seen.length / kSeconds).toFixed(0)} frames/s`,
    );
    expect(delays.length).toBeGreaterThanOrEqual(60); // a slow computer draws fewer; some 8 s of 30 Hz have 240
    // Frames show states in their order, and none before its tick.
    expect(seen.every((frame, i) => i === 0 || frame.mark >= (seen[i - 1]?.mark ?? 0))).toBe(true);
    expect(Math.min(...delays)).toBeGreaterThan(0);
  }
  console.log(`the page's own estimate: ${estimate}; picture of ${size} pixels in a window of 1280 x 720`);
});
