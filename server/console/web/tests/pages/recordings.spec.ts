import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

import type { Locator, Page } from '@playwright/test';

import { view } from './fixture';
import { addressOf, expect, needPrograms, test, urlOf, type Program } from './programs';

needPrograms();

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
type Run = (name: string, ...args: string[]) => Program;

/** Records some seconds of a session of real programs. */
async function record(run: Run, file: string): Promise<void> {
  const seats = ['trainer', 'trainee'];
  const host = run('tandem-server', 'run', 'contact', '--listen', '127.0.0.1:0', '--duration', '6', '--record', file);
  const address = await addressOf(host);
  const clients = seats.map((seat) =>
    run('tandem-client', 'join', '--server', address, '--seat', seat, '--device', 'sim'),
  );
  await expect.poll(() => host.child.exitCode, { timeout: 40_000 }).not.toBeNull();
  for (const client of clients) await client.end('SIGINT');
}

/** Records a session in virtual time. */
async function simulate(run: Run, file: string, seed: string): Promise<void> {
  const words = ['run', 'contact', '--duration', '8', '--seed', seed, '--quiet', '--record', file];
  const simulation = run('tandem-netsim', ...words);
  await expect.poll(() => simulation.child.exitCode, { timeout: 40_000 }).not.toBeNull();
}

const shown = (page: Page): Locator => page.locator('.player-time');
/** Session time that the player shows [s]. */
async function time(page: Page): Promise<number> {
  const found = /(\d+):([\d.]+) \//.exec((await shown(page).textContent()) ?? '');
  return Number(found?.[1]) * 60 + Number(found?.[2]);
}
/** First coordinate of a row of the values [mm]. */
async function position(page: Page, row: string): Promise<number> {
  const cell = page.locator('.player-values-panel tbody tr', { hasText: row }).locator('td').first();
  return Number(/-?[\d.]+/.exec((await cell.textContent()) ?? '')?.[0] ?? 'NaN');
}

test('a recording of a server is played, scrubbed, stepped by keys, and jumped in', async ({ page, run, place }) => {
  test.setTimeout(120_000);
  const file = join(place, 'lesson.mcap');
  await record(run, file);
  await page.goto(await urlOf(run('tandem-console', 'play', file, '--listen', '127.0.0.1:0')));
  await expect(page.locator('.recordings-panel')).toContainText('lesson.mcap');
  await expect(page.getByRole('button', { name: 'STOP' })).toBeHidden();
  await page.getByRole('button', { name: /^Open/ }).click();
  await expect(page.locator('.player')).toBeVisible();
  await expect(page.locator('.stage canvas')).toBeAttached();
  await expect(page.locator('.moment-banner')).toBeHidden();
  expect(await time(page)).toBeLessThan(1);

  // The keyboard is at Play: space plays at once, and does not press Open again.
  await expect(page.getByRole('button', { name: 'Play' })).toBeFocused();
  await page.keyboard.press('Space');
  await expect.poll(() => time(page)).toBeGreaterThan(0.2);
  await page.keyboard.press('Space');
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
  await page.keyboard.press('Home');

  // Space plays in the time of the session, and pauses.
  await page.locator('.player-values-panel .scroll').focus();
  await page.keyboard.press('Space');
  await expect.poll(() => time(page)).toBeGreaterThan(1);
  await page.keyboard.press('Space');
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
  const paused = await time(page);
  await page.waitForTimeout(300);
  expect(await time(page)).toBe(paused);

  // The buttons and keys step exactly; focus is on no control that has arrow keys of its own.
  await page.getByRole('button', { name: 'On by 0.1 s' }).click();
  await expect.poll(() => time(page)).toBeCloseTo(paused + 0.1, 1);
  const before = await time(page);
  await page.keyboard.press('Shift+ArrowRight');
  await expect.poll(() => time(page)).toBeCloseTo(before + 1, 1);
  await page.keyboard.press(',');
  await expect.poll(() => time(page)).toBeLessThan(before + 1);
  await page.keyboard.press('Home');
  await expect(shown(page)).toHaveText(/^0:0/);

  // The slider shows the values of its time: the trainee's hand presses the tool to the wall later on.
  const slider = page.getByLabel('Time of the recording');
  const start = await position(page, 'tool');
  await slider.fill('4');
  await expect.poll(() => time(page)).toBeCloseTo(4, 1);
  await expect(page.locator('.moment-banner')).toBeHidden();
  expect(Number.isFinite(start)).toBe(true);
  expect(Number.isFinite(await position(page, 'tool'))).toBe(true);

  // An event of the timeline says what happened in plain words, and jumps.
  await expect(page.locator('.jumps li', { hasText: /^\d+:[\d.]+\S+ \(trainer\) joins/ })).toHaveCount(1);
  await expect(page.locator('.jumps')).not.toContainText('tick');
  const jump = page.locator('.jumps button').first();
  const at = /(\d+):([\d.]+)/.exec((await jump.textContent()) ?? '');
  await jump.click();
  await expect.poll(() => time(page)).toBeCloseTo(Number(at?.[1]) * 60 + Number(at?.[2]), 1);
  await expect(page.locator('table.scores').first()).toContainText('Path length');
});

test('two recordings on one clock: side by side, overlaid, shifted, with their distance', async ({
  page,
  run,
  place,
}) => {
  test.setTimeout(120_000);
  const [first, second] = [join(place, 'a.mcap'), join(place, 'b.mcap')];
  await simulate(run, first, '1');
  copyFileSync(first, second);
  await page.goto(await urlOf(run('tandem-console', 'play', first, second, '--listen', '127.0.0.1:0')));
  await page.getByRole('button', { name: /Open .*a.mcap/ }).click();
  await page.getByLabel('Second recording').selectOption({ label: second });
  await expect(page.locator('.stage canvas')).toHaveCount(2);
  await page.getByLabel('Time of the recording').fill('3');
  // Equal recordings are never apart; with a shift they are.
  await expect(page.locator('.compare-panel .chart-legend')).toHaveText(/: 0\.00/);
  await page.getByLabel('Further shift (s)').fill('1.5');
  await expect(page.locator('.compare-panel .chart-legend')).not.toHaveText(/: (0\.00|–)/);
  await page.getByLabel('Shown').selectOption('overlay');
  await expect(page.locator('.stage canvas')).toHaveCount(1);
  await expect(page.locator('.stage .labels')).toContainText('trainer (2)');
  await page.getByLabel('Second recording').selectOption('');
  await expect(page.locator('.compare-panel .chart-legend')).toBeHidden();
  await page.evaluate(kAxe);
  for (const theme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme: theme });
    await page.getByLabel('Second recording').selectOption({ label: second });
    const found = await page.evaluate(async () => {
      const { axe } = window as unknown as {
        axe: { run: () => Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
      };
      return (await axe.run()).violations.map(({ id, nodes }) => [id, ...nodes.map(({ html }) => html)]);
    });
    expect([theme, found]).toEqual([theme, []]);
  }
  for (const width of [320, 390, 768, 1440]) {
    await page.setViewportSize({ width, height: 900 });
    await page.waitForTimeout(200);
    expect([width, await page.evaluate(() => document.documentElement.scrollWidth)]).toEqual([width, width]);
  }
  await page.screenshot({ path: 'screenshots/recordings-1440.png', fullPage: true });
});

test('the gateway shows a folder, names damaged files, and says how to allow recordings', async ({
  browser,
  run,
  place,
}) => {
  test.setTimeout(120_000);
  await simulate(run, join(place, 'good.mcap'), '1');
  const whole = readFileSync(join(place, 'good.mcap'));
  writeFileSync(join(place, 'cut.mcap'), whole.subarray(0, whole.length / 2));
  writeFileSync(join(place, 'foreign.mcap'), 'no recording');
  const server = await addressOf(run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0'));
  const open = async (...words: string[]): Promise<Page> => {
    const gateway = run('tandem-console', '--server', server, '--listen', '127.0.0.1:0', ...words);
    const page = await (await browser.newContext()).newPage();
    await page.goto(await urlOf(gateway));
    await expect(page.locator('.badge[data-phase]')).toHaveAttribute('data-phase', 'WAITING');
    await view(page, 'recordings');
    return page;
  };
  const page = await open('--recordings', place);
  await expect(page.locator('.recordings-panel tr.damaged')).toContainText('foreign.mcap');
  await expect(page.locator('.recordings-panel tr', { hasText: 'cut.mcap' })).toContainText('without end');
  await page.getByRole('button', { name: /Open .*good.mcap/ }).click();
  await expect(page.locator('.player h2').first()).toContainText('good.mcap');
  const without = await open();
  await expect(without.locator('.recordings-panel')).toContainText('--recordings DIR');
});

test('scores of the running session come to the instructor, with their flags', async ({ page, run }) => {
  const server = await addressOf(run('tandem-server', 'run', 'contact', '--listen', '127.0.0.1:0'));
  for (const seat of ['trainer', 'trainee'])
    run('tandem-client', 'join', '--server', server, '--seat', seat, '--device', 'sim');
  await page.goto(await urlOf(run('tandem-console', '--server', server, '--listen', '127.0.0.1:0')));
  for (const name of ['instructor', 'evaluator']) {
    await view(page, name);
    const scores = page.locator('.live-scores-panel');
    await expect(scores.locator('table.scores').first()).toContainText('Path length', { timeout: 20_000 });
    await expect(scores).toContainText('jerk needs every tick');
    await expect(scores).toContainText('59 Hz');
  }
});

/** Whether a box lies in the window, with its full width. */
async function inSight(page: Page, node: Locator): Promise<boolean> {
  const box = await node.boundingBox();
  const width = page.viewportSize()?.width ?? 0;
  return box !== null && box.width > 0 && box.x >= 0 && box.x + box.width <= width;
}

test('the list shows whole rows, more of them in a taller window, and its buttons at each width', async ({
  page,
  run,
  place,
}) => {
  await simulate(run, join(place, 'lesson-00.mcap'), '1');
  const copies = Array.from({ length: 30 }, (_, i) => join(place, `lesson-${String(i + 1).padStart(2, '0')}.mcap`));
  for (const copy of copies) copyFileSync(join(place, 'lesson-00.mcap'), copy);
  await page.goto(await urlOf(run('tandem-console', 'play', ...copies, '--listen', '127.0.0.1:0')));
  const rows = page.locator('table.recordings tbody tr');
  await expect(rows).toHaveCount(copies.length);
  const shown: number[] = [];
  for (const height of [500, 720, 1000, 1400]) {
    await page.setViewportSize({ width: 1440, height });
    const [frame, head, row] = await page.evaluate(() =>
      ['.recordings-panel .scroll', 'table.recordings thead', 'table.recordings tbody tr'].map((name) => {
        const node = document.querySelector(name);
        return name.endsWith('.scroll') ? (node?.clientHeight ?? 0) : (node?.getBoundingClientRect().height ?? 0);
      }),
    );
    const whole = ((frame ?? 0) - (head ?? 0)) / (row ?? 1);
    expect(Math.abs(whole - Math.round(whole)) * (row ?? 1)).toBeLessThan(3);
    shown.push(Math.round(whole));
  }
  expect(shown[0]).toBeGreaterThanOrEqual(3);
  expect(shown[3]).toBeGreaterThan((shown[0] ?? 0) + 5);
  for (const width of [1440, 768, 390, 320]) {
    await page.setViewportSize({ width, height: 900 });
    expect([width, await inSight(page, rows.first().getByRole('button', { name: /^Open/ }))]).toEqual([width, true]);
    expect([width, await page.evaluate(() => document.documentElement.scrollWidth)]).toEqual([width, width]);
    await page.screenshot({ path: `screenshots/recordings-list-${width}.png` });
  }
});

test('curves end with their last value, and all columns of the scores can be reached', async ({ page, run, place }) => {
  const file = join(place, 'a.mcap');
  await simulate(run, file, '1');
  await page.goto(await urlOf(run('tandem-console', 'play', file, '--listen', '127.0.0.1:0')));
  await page.getByRole('button', { name: /^Open/ }).click();
  await expect(page.getByRole('button', { name: 'Play' })).toBeFocused();
  // The tick with which the session ends has no authority; the last step has.
  await page.keyboard.press('End');
  await expect(page.locator('.player-chart', { hasText: 'Authority' }).locator('.chart-legend')).toContainText(
    'trainer 100',
  );
  await expect(page.locator('.player-chart', { hasText: 'Force' }).locator('.chart-legend')).toContainText(
    'trainer 2.6',
  );
  await expect(page.locator('table.scores').first()).toContainText('Path length');
  for (const width of [1440, 768, 390]) {
    await page.setViewportSize({ width, height: 900 });
    await page.waitForTimeout(200);
    await page.locator('.scores-panel').screenshot({ path: `screenshots/scores-${width}.png` });
    await page.screenshot({ path: `screenshots/player-${width}.png`, fullPage: true });
    // The keyboard scrolls the frame of each table to its last column.
    for (const frame of await page.locator('.scores-panel .table-frame').all()) {
      await frame.focus();
      for (let i = 0; i < 40; i += 1) await page.keyboard.press('ArrowRight');
      await expect
        .poll(() => frame.evaluate((node) => node.scrollLeft + node.clientWidth - node.scrollWidth))
        .toBeGreaterThan(-2);
      expect(await inSight(page, frame.locator('thead th').last())).toBe(true);
    }
    expect(await time(page)).toBeGreaterThan(7.9);
  }
});
