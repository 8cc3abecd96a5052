import type { Locator, Page } from '@playwright/test';

import { expect, test } from './fixture';

/** Moves the focus with the Tab key until the control has it. */
async function tabTo(page: Page, control: Locator): Promise<void> {
  for (let i = 0; i < 120; i += 1) {
    if (await control.evaluate((node) => node === document.activeElement)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`the Tab key does not reach ${String(control)}`);
}
async function press(page: Page, control: Locator, key = 'Enter'): Promise<void> {
  await tabTo(page, control);
  await page.keyboard.press(key);
}
async function write(page: Page, control: Locator, text: string): Promise<void> {
  await tabTo(page, control);
  await page.keyboard.press('Control+A');
  await page.keyboard.type(text);
}
/** Chooses an option of a list by its first letters. */
async function pick(page: Page, list: Locator, letters: string, value: string): Promise<void> {
  await tabTo(page, list);
  await page.keyboard.type(letters);
  await expect(list).toHaveValue(value);
}

const button = (page: Page, name: string): Locator => page.getByRole('button', { name, exact: true });
const phase = (page: Page): Locator => page.locator('.badge');

test('an instructor leads a lesson by the keyboard alone', async ({ start, open }) => {
  const gateway = await start({ seats: 3 });
  const page = await open(gateway);
  await press(page, button(page, 'STOP'));
  await expect(phase(page)).toHaveText('stopped');
  await press(page, button(page, 'Resume'));
  await expect(phase(page)).toHaveText('running');
  await press(page, button(page, 'Pause'), 'Space');
  await expect(phase(page)).toHaveText('paused');
  await page.keyboard.press('r');
  await expect(phase(page)).toHaveText('running');

  await press(page, button(page, 'Instructor'));
  await press(page, button(page, 'Evaluation of trainee1'));
  await expect.poll(() => gateway.session.wanted).toEqual([0, 1, 0]);
  await expect(page.locator('.share .draft')).toHaveText([/^0/, /100/, /^0/]);
  const panel = page.locator('.authority-panel');
  await pick(page, panel.locator('select').last(), 'trainer', '0');
  await write(page, panel.locator('input[type=number]'), '40');
  await press(page, button(page, 'Hand over'));
  await expect.poll(() => gateway.session.wanted).toEqual([0.4, 0.6, 0]);
  await tabTo(page, page.getByRole('slider', { name: 'Authority of trainee2' }));
  await page.keyboard.press('Home');
  for (let i = 0; i < 4; i += 1) await page.keyboard.press('ArrowRight');
  await press(page, button(page, 'Apply'));
  await expect.poll(() => Math.round((gateway.session.wanted[2] ?? 0) * 100)).toBe(20);

  await press(page, page.getByRole('button', { name: 'Remove… trainee2' }));
  await page.keyboard.type('device broken');
  await page.keyboard.press('Enter');
  await expect(page.locator('.who-panel tbody tr').nth(2)).toContainText('free');
  await press(page, button(page, 'Record'));
  await press(page, button(page, 'End recording'));
  await press(page, page.getByRole('dialog').getByRole('button', { name: 'End recording' }));
  await expect(page.locator('.recording')).toBeHidden();
  // The keyboard goes on where it was before the dialog.
  await expect(button(page, 'Record')).toBeFocused();
});

test('an evaluator marks, fills and closes a sheet by the keyboard alone', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'eva', 'EVALUATOR');
  await page.keyboard.press('3');
  await write(page, page.getByLabel('Note'), 'touches the wall');
  await page.keyboard.press('Enter');
  await expect(page.locator('.timeline-panel .log')).toContainText('touches the wall');
  await pick(page, page.locator('.sheet-panel select').first(), 'GO', 'GOALS');
  const items = page.locator('fieldset.item');
  await expect(items).toHaveCount(5);
  for (let i = 0; i < 5; i += 1) {
    await tabTo(page, items.nth(i).getByRole('radio').first());
    if (i === 0) {
      await page.keyboard.press('Space');
      for (let n = 1; n < 4; n += 1) await page.keyboard.press('ArrowRight');
    } else {
      // A digit gives points here; it chooses no view.
      await page.keyboard.press('4');
    }
    await expect(items.nth(i).getByLabel('4', { exact: true })).toBeChecked();
    await expect(items.nth(i).getByLabel('4', { exact: true })).toBeFocused();
  }
  await expect(page.locator('[data-view=evaluator]')).toHaveAttribute('aria-current', 'page');
  await expect(page.locator('.total')).toHaveText('Total 20 of 25');
  await press(page, button(page, 'Close sheet'));
  await press(page, page.getByRole('dialog').getByRole('button', { name: 'Close sheet' }));
  await expect(page.locator('.sheet-panel')).toContainText('This sheet is closed.');
});

test('an operator creates and ends a lesson by the keyboard alone', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR', workstation: 'page' });
  const page = await open(gateway);
  await page.keyboard.press('5');
  await write(page, page.getByLabel('Scene'), 'contact');
  await write(page, page.getByLabel('Name of the session'), 'monday');
  await write(page, page.getByLabel('Name of person 1'), 'ina');
  await write(page, page.getByLabel('Name of person 2'), 'ted');
  await press(page, button(page, 'Add person'));
  await page.keyboard.type('eva');
  await pick(page, page.getByLabel('Role of person 3'), 'obs', 'OBSERVER');
  await press(page, button(page, 'Create session'));
  await expect(page.locator('.ticket')).toHaveCount(3);
  await tabTo(page, page.locator('.ticket').nth(2).getByRole('link'));
  await page.keyboard.press('Control+Home');
  await press(page, button(page, 'Show session monday'));
  await press(page, button(page, 'End session monday'));
  await press(page, page.getByRole('dialog').getByRole('button', { name: 'End session monday' }));
  await expect(page.locator('.messages')).toContainText('End session monday: done');
  await press(page, button(page, 'Close the cards of monday'));
  await press(page, page.getByRole('dialog').getByRole('button', { name: 'Close the cards of monday' }));
  await expect(page.locator('.ticket')).toHaveCount(0);
});

test('cameras and switches of the picture follow the keyboard', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await expect(page.locator('.picture canvas')).toBeVisible();
  // Nothing moves but the camera.
  gateway.session.step = () => undefined;
  const canvas = page.locator('.picture canvas');
  const changes = async (act: () => Promise<void>): Promise<void> => {
    await page.waitForTimeout(300);
    const before = (await canvas.screenshot()).toString('base64');
    await act();
    await expect.poll(async () => (await canvas.screenshot()).toString('base64') !== before).toBe(true);
  };
  await tabTo(page, canvas);
  await changes(async () => page.keyboard.press('ArrowRight'));
  await changes(async () => page.keyboard.press('+'));
  await pick(page, page.locator('.camera-panel select'), 'ab', 'above');
  await tabTo(page, page.getByLabel('Names'));
  await changes(async () => page.keyboard.press('Space'));
  await expect(page.getByLabel('Names')).not.toBeChecked();
});
