import { readFileSync } from 'node:fs';

import { expect, test, view } from './fixture';
import { fastLessonScript, type FastLesson } from './fast_lesson';

const kHours = 12;
const kRate = 60;
const kWhole = process.env.TANDEM_WEB_WHOLE === 'yes';
/** Minutes of each virtual hour of which states are handed to the page: all with `check --whole`. */
const kMinutes = kWhole ? 60 : 1;
/** States of each such minute: at 60 Hz all, otherwise those of its first 20 s. */
const kStates = kRate * (kWhole ? 60 : 20);

declare global {
  interface Window {
    lesson: FastLesson;
  }
}

test('twelve hours of a lesson in one page at 60 Hz: memory stays bounded', async ({ start, browser }) => {
  test.setTimeout(kWhole ? 7_200_000 : 600_000);
  const gateway = await start();
  const context = await browser.newContext();
  await context.addInitScript({ content: fastLessonScript() });
  const page = await context.newPage();
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(gateway.entry());
  await expect(page.locator('.person').first()).toHaveText('ina, operator');
  await expect(page.locator('.picture canvas')).toBeAttached();
  const devtools = await context.newCDPSession(page);
  const system = await browser.newBrowserCDPSession();
  const memory = async (): Promise<{ heap: number; nodes: number; process: number }> => {
    await page.waitForTimeout(500);
    for (let i = 0; i < 3; i += 1) await devtools.send('HeapProfiler.collectGarbage');
    const { usedSize } = await devtools.send('Runtime.getHeapUsage');
    const { nodes } = await devtools.send('Memory.getDOMCounters');
    // The largest renderer is the one with this page: resident memory, with everything outside of the heap.
    const { processInfo } = await system.send('SystemInfo.getProcessInfo');
    const resident = processInfo
      .filter(({ type }) => type === 'renderer')
      .map(({ id }) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))?.[1] ?? 0) / 1000);
    return { heap: usedSize / 1e6, nodes, process: Math.max(...resident) };
  };
  const names = ['instructor', 'live', 'evaluator', 'seat', 'desk'];
  const measured: Awaited<ReturnType<typeof memory>>[] = [];
  for (let hour = 0; hour < kHours; hour += 1) {
    for (let minute = 0; minute < kMinutes; minute += 1) {
      if (minute % 10 === 0) await view(page, names[(hour + minute / 10) % names.length] ?? 'live');
      await page.evaluate(
        async ({ states, text, marks }) => {
          window.lesson.trouble(text);
          if (marks) window.lesson.mark(`mark ${text}`);
          await window.lesson.run(states);
        },
        { states: kStates, text: `event ${hour}:${minute}`, marks: minute % 10 === 0 },
      );
    }
    await page.evaluate((seconds) => window.lesson.skip(seconds), 3600 - (kMinutes * kStates) / kRate);
    await view(page, 'instructor');
    await page.evaluate(() => window.lesson.run(60));
    measured.push(await memory());
  }
  const done = await page.evaluate(() => ({ states: window.lesson.states, acknowledged: window.lesson.acknowledged }));
  const [first, last] = [measured[0]!, measured.at(-1)!];
  const [heap, nodes, process_] = (['heap', 'nodes', 'process'] as const).map((key) => last[key] / first[key]);
  console.log(
    `12 h at 60 Hz, ${done.states} of ${kHours * 3600 * kRate} states: heap ${first.heap.toFixed(2)} MB after 1 h, ` +
      `${last.heap.toFixed(2)} MB after 12 h (${heap!.toFixed(3)} x; asked: <= 1.2); ${last.nodes} nodes ` +
      `(${nodes!.toFixed(2)} x); resident memory ${last.process.toFixed(0)} MB (${process_!.toFixed(2)} x)`,
  );
  expect(done.states).toBe(kHours * (kMinutes * kStates + 60));
  // Frames went on to the end: the newest state has its acknowledgement, but for the limit of frames per second.
  expect(done.acknowledged).toBeGreaterThan(done.states - 60);
  await expect(page.locator('.time').first()).toHaveText(/^12:/);
  expect(last.heap).toBeLessThanOrEqual(1.2 * first.heap);
  expect(errors).toEqual([]);
  await context.close();
});
