import type { Page } from '@playwright/test';

import { view } from './fixture';
import { LessonPrograms, type Message, type Person } from './lesson_programs';
import { expect, needPrograms, phaseOf, test } from './programs';

needPrograms();
// Several programs and browsers start one after the other.
test.describe.configure({ timeout: 180_000 });

interface Tool {
  wanted: number[];
  applied: number[];
  transfer: { by: string; to: string; alpha: number; ticks: number } | null;
}

const toolOf = (state: Message | undefined): Tool | undefined => (state?.tools as Tool[] | undefined)?.[0];
const states = ({ received }: Person): Message[] => received.filter(({ type }) => type === 'state');
const running = (page: Page): Promise<void> => expect(phaseOf(page)).toHaveAttribute('data-phase', 'RUNNING');

test('the real server: an instructor hands over, the transfer is announced and applied; stop, resume, refusal', async ({
  browser,
  run,
  place,
}) => {
  const lesson = await LessonPrograms.start(run, place, 'contact');
  await lesson.join('trainer');
  await lesson.join('trainee');
  const ina = await lesson.person(browser, 'ina', 'instructor');
  await running(ina.page);
  await view(ina.page, 'instructor');
  const panel = ina.page.locator('.authority-panel');
  await panel.locator('select').last().selectOption({ label: 'trainee' });
  await panel.getByRole('button', { name: 'Hand over' }).click();
  await expect(panel.locator('.share').nth(2).locator('.applied span').last()).toHaveText(/100/);
  await expect(panel.locator('.share').nth(1).locator('.applied span').last()).toHaveText(/^0/);
  // The server announced the transfer for 50 ticks; while it was announced, nothing of it was applied.
  // 50 ms are three states at most, and a busy computer drops states: the transfer is repeated until one was received.
  const announced = (): Message[] => states(ina).filter((state) => toolOf(state)?.transfer);
  for (let i = 0; i < 20 && announced().length === 0; i += 1) {
    for (const [name, alpha] of [
      ['Demonstration', [1, 0]],
      ['Evaluation of trainee', [0, 1]],
    ] as const) {
      await panel.getByRole('button', { name }).click();
      await expect.poll(() => toolOf(states(ina).at(-1))?.applied).toEqual(alpha);
    }
  }
  expect(announced().length).toBeGreaterThan(0);
  for (const tool of announced().map(toolOf)) {
    const gains = tool?.transfer?.to === 'trainee' ? 1 : 0;
    expect(tool?.transfer?.alpha).toBe(1);
    expect(tool?.transfer?.ticks).toBeLessThanOrEqual(50);
    expect(tool?.wanted[gains]).toBe(1);
    expect(tool?.applied[gains]).toBe(0);
  }
  expect(toolOf(states(ina).at(-1))).toMatchObject({ wanted: [0, 1], applied: [0, 1], transfer: null });

  // An order for authority that has changed meanwhile is refused with words.
  const old = await ina.sendByHand({ type: 'order', order: 'authority', tool: 0, version: 0, alpha: [1, 0] });
  expect([old.ok, old.text]).toEqual([false, expect.stringMatching(/another change of authority came first/)]);

  const eva = await lesson.person(browser, 'eva', 'evaluator');
  await eva.page.getByRole('button', { name: 'Pause' }).click();
  await expect(phaseOf(ina.page)).toHaveAttribute('data-phase', 'PAUSED');
  await ina.page.getByRole('button', { name: 'Resume' }).click();
  await running(ina.page);
  await running(eva.page);
});

test('the real server: an evaluator moves no slider, neither by the page nor by a frame sent by hand', async ({
  browser,
  run,
  place,
}) => {
  const lesson = await LessonPrograms.start(run, place, 'contact');
  await lesson.join('trainer');
  await lesson.join('trainee');
  const eva = await lesson.person(browser, 'eva', 'evaluator');
  await running(eva.page);
  await view(eva.page, 'instructor');
  const slider = eva.page.getByRole('slider', { name: 'Authority of trainee' });
  await expect(slider).toBeDisabled();
  await slider.evaluate((node: HTMLInputElement) => {
    node.disabled = false;
    node.value = '100';
    node.dispatchEvent(new Event('input'));
  });
  await eva.page.getByRole('button', { name: 'Apply' }).evaluate((node: HTMLButtonElement) => {
    node.disabled = false;
    node.click();
  });
  await expect(eva.page.getByRole('alert')).toContainText(/evaluator may not move authority/i);
  const version = states(eva).at(-1)?.version;
  const frames: [Record<string, unknown>, RegExp][] = [
    [{ type: 'order', order: 'authority', tool: 0, version, alpha: [0, 1] }, /evaluator may not/i],
    [{ type: 'order', order: 'remove', seat: 'trainee', why: 'x' }, /evaluator may not/i],
    [{ type: 'order', order: 'drain', grace_s: 1 }, /evaluator may not/i],
    [{ type: 'take', seat: 'trainee' }, /seat/],
    [{ type: 'invite' }, /ticket/],
  ];
  for (const [frame, words] of frames) {
    const reply = await eva.sendByHand(frame);
    expect([frame.order ?? frame.type, reply.ok, reply.text]).toEqual([
      frame.order ?? frame.type,
      false,
      expect.stringMatching(words),
    ]);
  }
  const state = states(eva).at(-1);
  expect([toolOf(state)?.wanted, toolOf(state)?.applied, state?.phase]).toEqual([[1, 0], [1, 0], 'RUNNING']);
});

async function fillGoals(page: Page, points: number): Promise<void> {
  await view(page, 'evaluator');
  await page.locator('.sheet-panel select').first().selectOption('GOALS');
  const items = page.locator('fieldset.item');
  await expect(items).toHaveCount(5);
  for (let i = 0; i < 5; i += 1) await items.nth(i).getByLabel(String(points), { exact: true }).check();
}

test('the real server: a second evaluator does not see a sheet before closing the own one', async ({
  browser,
  run,
  place,
}) => {
  const lesson = await LessonPrograms.start(run, place, 'contact');
  const eva = await lesson.person(browser, 'eva', 'evaluator');
  const max = await lesson.person(browser, 'max', 'evaluator');
  await fillGoals(max.page, 2);
  await max.page.getByRole('button', { name: 'Close sheet' }).click();
  await max.page.getByRole('dialog').getByRole('button', { name: 'Close sheet' }).click();
  await expect(max.page.locator('.sheet-panel')).toContainText('This sheet is closed.');
  await fillGoals(eva.page, 4);
  await eva.page.getByRole('button', { name: 'Save draft' }).click();
  const own = (): unknown[] => (eva.received.filter(({ type }) => type === 'notes').at(-1)?.sheets as unknown[]) ?? [];
  await expect.poll(() => own().length).toBe(1);
  await expect(eva.page.locator('.others')).not.toContainText('Total');
  // The scores of the other person did not reach this browser in any message.
  expect(JSON.stringify(eva.received.filter(({ type }) => type !== 'state'))).not.toContain('max');
  await eva.page.getByRole('button', { name: 'Close sheet' }).click();
  await eva.page.getByRole('dialog').getByRole('button', { name: 'Close sheet' }).click();
  await expect(eva.page.locator('.others')).toContainText('Total 10 of 25');
  await expect(max.page.locator('.others')).toContainText('Total 20 of 25');
});

test('the real server: an evaluator who paused sees who may resume, and the page stops when the server is lost', async ({
  browser,
  run,
  place,
}) => {
  const lesson = await LessonPrograms.start(run, place, 'contact');
  await lesson.join('trainer');
  await lesson.join('trainee');
  const { page } = await lesson.person(browser, 'eva', 'evaluator');
  await running(page);
  await page.getByRole('button', { name: 'Pause' }).click();
  await expect(page.locator('.active-stop')).toHaveText(
    /from the console\. Only an instructor or operator may resume\.$/,
  );
  await expect(page.getByRole('button', { name: 'Resume' })).toBeDisabled();
  await view(page, 'evaluator');
  await page.getByRole('button', { name: 'Mark now' }).click();
  await expect(page.locator('.timeline-panel .log li span')).toHaveText('–');
  await lesson.host.end('SIGKILL');
  await expect(phaseOf(page)).toHaveText('unknown', { timeout: 20_000 });
  await expect(page.locator('.server-lost')).toHaveText(/Orders reach nothing/, { timeout: 40_000 });
  const signIn = page.getByRole('link', { name: 'Sign in again with a new ticket' });
  await signIn.click();
  await expect(page).toHaveURL(`${lesson.url}/join`);
});
