import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

import { expect, test, view } from './fixture';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kNames = ['live', 'instructor', 'evaluator', 'seat', 'desk', 'recordings'];

interface Violation {
  id: string;
  nodes: { html: string; failureSummary: string }[];
}

for (const scheme of ['light', 'dark'] as const) {
  test(`axe finds no violation, ${scheme}`, async ({ start, open }) => {
    test.setTimeout(180_000);
    const gateway = await start({ role: 'OPERATOR', freeSeat: true });
    const page = await open(gateway);
    await page.emulateMedia({ colorScheme: scheme });
    gateway.session.order({ order: 'pause', why: 'axe' }, 'ina', 'INSTRUCTOR');
    gateway.session.marks.push({ t: 1, text: 'mark', person: 'eva' });
    gateway.session.seats[0]!.heard = false;
    await page.evaluate(kAxe);
    const violations = (): Promise<unknown> =>
      page.evaluate(async () => {
        const { axe } = window as unknown as { axe: { run: () => Promise<{ violations: Violation[] }> } };
        return (await axe.run()).violations.map((v) => [v.id, v.nodes.map((n) => `${n.html} ${n.failureSummary}`)]);
      });
    // The desk with tickets of all kinds, and a dialog that asks for a confirmation.
    await view(page, 'desk');
    await page.getByLabel('Scene').fill('contact');
    await page.getByLabel('Name of the session').fill('monday');
    for (const n of [1, 2, 3]) {
      if (n === 3) await page.getByRole('button', { name: 'Add person' }).click();
      await page.getByLabel(`Name of person ${n}`).fill(`p${n}`);
    }
    await page.getByLabel('Workstation of person 3').fill('page');
    await page.getByRole('button', { name: 'Create session' }).click();
    await expect(page.locator('.ticket')).toHaveCount(3);
    await page.getByRole('button', { name: 'End session contact' }).click();
    await expect(page.getByRole('dialog')).toBeVisible();
    expect(['dialog', await violations()]).toEqual(['dialog', []]);
    await page.keyboard.press('Escape');
    // A field that is wrong, and a server that is lost.
    await view(page, 'instructor');
    await page.getByLabel('Share (%)').fill('150');
    await page.getByRole('button', { name: 'Hand over' }).click();
    gateway.tellServer('gone');
    await expect(page.locator('.server-lost')).toBeVisible();
    expect(['lost', await violations()]).toEqual(['lost', []]);
    gateway.tellServer('back');
    const sizes = [
      [1280, 'en'],
      [390, 'en'],
      [320, 'fr'],
      [3840, 'fr'],
    ] as const;
    for (const [width, language] of sizes) {
      const settings = page.locator('details.settings');
      const show = (opened: boolean): Promise<void> =>
        settings.evaluate((node: HTMLDetailsElement, value) => void (node.open = value), opened);
      await show(true);
      await page.locator('.settings-box select').first().selectOption(language);
      await expect(page.locator('html')).toHaveAttribute('lang', language);
      await page.setViewportSize({ width, height: 844 });
      await show(true);
      expect([scheme, width, language, 'settings', await violations()]).toEqual([
        scheme,
        width,
        language,
        'settings',
        [],
      ]);
      await show(false);
      for (const name of kNames) {
        await view(page, name);
        await page.waitForTimeout(100);
        const found = await violations();
        expect([scheme, width, language, name, found]).toEqual([scheme, width, language, name, []]);
      }
    }
  });

  for (const width of [1440, 768, 390]) {
    test(`screenshots, ${width} px, ${scheme}`, async ({ start, open }) => {
      const gateway = await start({ role: 'OPERATOR', freeSeat: true });
      const page = await open(gateway);
      await page.emulateMedia({ colorScheme: scheme });
      await page.setViewportSize({ width, height: 900 });
      for (const name of kNames) {
        await view(page, name);
        await page.waitForTimeout(400);
        const path = `screenshots/${name}-${width}-${scheme}.png`;
        const picture = await page.screenshot({ path, fullPage: true });
        expect(picture.length).toBeGreaterThan(5000);
      }
    });
  }
}

test('no view is wider than the window from 320 px to 4K', async ({ start, open }) => {
  const gateway = await start({ seats: 8, role: 'OPERATOR' });
  const page = await open(gateway);
  for (const width of [320, 390, 600, 768, 1000, 1440, 2000, 3840]) {
    await page.setViewportSize({ width, height: 900 });
    for (const name of kNames) {
      await view(page, name);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      expect([name, width, wide]).toEqual([name, width, width]);
    }
  }
});

test('settings close with Escape and with a click elsewhere, not with one inside', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  const settings = page.locator('details.settings');
  const summary = settings.locator('summary');
  await summary.click();
  await page.getByRole('checkbox', { name: 'Keys' }).click();
  await expect(settings).toHaveAttribute('open');
  await page.keyboard.press('Escape');
  await expect(settings).not.toHaveAttribute('open');
  await expect(summary).toBeFocused();
  await summary.click();
  await page.locator('.control-bar').click({ position: { x: 900, y: 5 } });
  await expect(settings).not.toHaveAttribute('open');
});

test('the table of values shows all its columns from 1000 px', async ({ start, open }) => {
  const gateway = await start({ seats: 8 });
  gateway.session.seats.forEach((seat, i) => (seat.name = `evaluator${i}`));
  const page = await open(gateway);
  await page.getByText('Settings').click();
  await page.getByLabel('Language').selectOption('fr');
  const table = page.locator('.values-panel .scroll');
  for (const width of [1000, 1280, 1440, 1920]) {
    await page.setViewportSize({ width, height: 900 });
    const [seen, all] = await table.evaluate((node) => [node.clientWidth, node.scrollWidth]);
    expect([width, all]).toEqual([width, seen]);
  }
});

test('messages cover no sheet', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'eva', 'EVALUATOR');
  await view(page, 'evaluator');
  await page.getByRole('button', { name: 'Save draft' }).click();
  await expect(page.locator('.message')).toBeVisible();
  for (const width of [1000, 1440, 3840]) {
    await page.setViewportSize({ width, height: 900 });
    const [message, sheet] = [
      await page.locator('.messages').boundingBox(),
      await page.locator('.sheet-panel').boundingBox(),
    ];
    expect((message?.x ?? 0) + (message?.width ?? 0)).toBeLessThanOrEqual(sheet?.x ?? 0);
  }
});

test('French: all texts change, and the choice stays', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await page.getByText('Settings').click();
  await page.getByLabel('Language').selectOption('fr');
  await expect(page.locator('html')).toHaveAttribute('lang', 'fr');
  await expect(page.getByRole('button', { name: 'ARRÊT' })).toBeVisible();
  await expect(page.locator('.delay')).toHaveText(/Retard/);
  await page.reload();
  await expect(page.getByRole('button', { name: 'ARRÊT' })).toBeVisible();
});

test('dark colours by choice, whatever the system has', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await page.emulateMedia({ colorScheme: 'light' });
  await page.getByText('Settings').click();
  await page.getByLabel('Colours').selectOption('dark');
  expect(await page.evaluate(() => getComputedStyle(document.body).color)).toBe('rgb(232, 237, 242)');
});

test('reduced motion switches the trails off', async ({ start, browser }) => {
  const gateway = await start();
  const context = await browser.newContext({ reducedMotion: 'reduce' });
  const page = await context.newPage();
  await page.goto(gateway.entry());
  await expect(page.getByLabel('Trails of 3 s')).not.toBeChecked();
  await context.close();
});

test('the keyboard reaches all controls: tab order, camera, views', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  const reached = new Set<string>();
  for (let i = 0; i < 40; i += 1) {
    await page.keyboard.press('Tab');
    reached.add(
      await page.evaluate(() => document.activeElement?.textContent || document.activeElement?.tagName || ''),
    );
  }
  for (const name of ['Skip to content', 'STOP', 'Pause', 'Live', 'Lesson desk', 'Settings', 'CANVAS']) {
    expect([...reached]).toContain(name);
  }
  await page.locator('[data-view=live]').focus(); // keys are letters in fields
  await page.keyboard.press('5');
  await expect(page.locator('[data-view=desk]')).toHaveAttribute('aria-current', 'page');
});
