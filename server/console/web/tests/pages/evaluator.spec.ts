import { expect, test, view } from './fixture';
import type { Page } from '@playwright/test';

/** Closes the sheet, which asks first. */
async function close(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Close sheet' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'Close sheet' }).click();
}

async function fill(page: Page, points: number): Promise<void> {
  await view(page, 'evaluator');
  await page.locator('.sheet-panel select').first().selectOption('GOALS');
  const items = page.locator('fieldset.item');
  await expect(items).toHaveCount(5);
  for (let i = 0; i < 5; i += 1) await items.nth(i).getByLabel(String(points), { exact: true }).check();
}

test('an evaluator fills and closes a sheet; scores of others appear after that only', async ({ start, open }) => {
  const gateway = await start();
  const eva = await open(gateway, 'eva', 'EVALUATOR');
  const max = await open(gateway, 'max', 'EVALUATOR');
  await fill(max, 2);
  await max.getByRole('button', { name: 'Close sheet' }).click();
  const dialog = max.getByRole('dialog', { name: 'Close sheet' });
  await expect(dialog).toContainText('A closed sheet is final');
  await expect(dialog.getByRole('button', { name: 'Cancel' })).toBeFocused();
  await max.keyboard.press('Enter');
  await expect(dialog).toHaveCount(0);
  expect(gateway.session.sheets).toEqual([]);
  await close(max);
  await expect(max.locator('.sheet-panel')).toContainText('This sheet is closed.');
  await fill(eva, 4);
  await expect(eva.locator('.total')).toHaveText('Total 20 of 25');
  await eva.getByRole('button', { name: 'Save draft' }).click();
  await expect.poll(() => gateway.session.sheets.length).toBe(2);
  await expect(eva.locator('.others')).not.toContainText('max');
  await close(eva);
  await expect(eva.locator('.others')).toContainText('max: Total 10 of 25');
  await expect(max.locator('.others')).toContainText('eva: Total 20 of 25');
  await expect(eva.getByRole('button', { name: 'Save draft' })).toBeDisabled();
  expect(gateway.session.sheets.map((s: { person: string; closed: boolean }) => [s.person, s.closed])).toEqual([
    ['max', true],
    ['eva', true],
  ]);
});

test('a sheet without all scores cannot be closed; drafts of several sheets stay', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'eva', 'EVALUATOR');
  await view(page, 'evaluator');
  await page.locator('fieldset.item').first().getByLabel('3', { exact: true }).check();
  await expect(page.locator('.total')).toHaveText('Total 3 of 35 · 6 items without a score');
  await expect(page.getByRole('button', { name: 'Close sheet' })).toBeDisabled();
  await page.locator('.sheet-panel select').first().selectOption('CHECKLIST');
  await page.getByLabel('Target reached').check();
  await expect(page.locator('.total')).toHaveText('Total 1 of 6');
  await page.locator('.sheet-panel select').first().selectOption('OSATS');
  await expect(page.locator('fieldset.item').first().getByLabel('3', { exact: true })).toBeChecked();
});

test('a mark has the time when the person began to write', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'eva', 'EVALUATOR');
  await view(page, 'evaluator');
  const begun = gateway.session.t;
  await page.getByLabel('Note').fill('touches the wall hard');
  gateway.session.t += 30;
  await page.keyboard.press('Enter');
  await expect(page.locator('.timeline-panel .log')).toContainText('touches the wall hard');
  const [mark] = gateway.session.marks as { t: number; person: string }[];
  expect(mark?.person).toBe('eva');
  expect(mark?.t).toBeLessThan(begun + 20);
});

test('a mark without words is shown as one', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'eva', 'EVALUATOR');
  await view(page, 'evaluator');
  await page.getByRole('button', { name: 'Mark now' }).click();
  await expect(page.locator('.timeline-panel .log li span')).toHaveText('–');
});

test('an evaluator who moves a slider is refused: the control is off, and the frame as well', async ({
  start,
  open,
}) => {
  const gateway = await start();
  const page = await open(gateway, 'eva', 'EVALUATOR');
  await view(page, 'instructor');
  const slider = page.getByRole('slider', { name: 'Authority of trainee' });
  await expect(slider).toBeDisabled();
  await slider.evaluate((node: HTMLInputElement) => {
    node.disabled = false;
    node.value = '100';
    node.dispatchEvent(new Event('input'));
  });
  await page.getByRole('button', { name: 'Apply' }).evaluate((node: HTMLButtonElement) => {
    node.disabled = false;
    node.click();
  });
  await expect(page.getByRole('alert')).toContainText('role EVALUATOR may not give the order authority');
  expect(gateway.session.wanted).toEqual([1, 0]);
});
