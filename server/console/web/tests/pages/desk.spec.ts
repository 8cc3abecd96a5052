import type { Page } from '@playwright/test';

import { expect, test, view } from './fixture';

/** Fills the form for two persons and creates the session. */
async function create(page: Page, name: string): Promise<void> {
  await page.getByLabel('Scene').fill('contact');
  await page.getByLabel('Name of the session').fill(name);
  await page.getByLabel('Name of person 1').fill('ina');
  await page.getByLabel('Name of person 2').fill('ted');
  await page.getByRole('button', { name: 'Create session' }).click();
}

test('the lesson desk creates a session and shows a page with ticket, QR code and steps per person', async ({
  start,
  open,
  browser,
}) => {
  const gateway = await start({ role: 'OPERATOR', workstation: 'page' });
  const page = await open(gateway);
  await view(page, 'desk');
  await page.getByLabel('Scene').fill('contact');
  // Each row has the first free seat of the scene with its role, and the workstation of the gateway.
  for (const [n, seat, role] of [
    [1, 'trainer', 'INSTRUCTOR'],
    [2, 'trainee', 'TRAINEE'],
  ] as const) {
    await expect(page.getByLabel(`Seat of person ${n}`)).toHaveValue(seat);
    await expect(page.getByLabel(`Role of person ${n}`)).toHaveValue(role);
    await expect(page.getByLabel(`Workstation of person ${n}`)).toHaveValue('page');
  }
  await page.getByLabel('Name of the session').fill('monday');
  await page.getByLabel('Name of person 1').fill('ina');
  await page.getByLabel('Name of person 2').fill('ted');
  await page.getByRole('button', { name: 'Add person' }).click();
  await expect(page.getByLabel('Seat of person 3')).toHaveValue('');
  await page.getByLabel('Name of person 3').fill('eva');
  await page.getByRole('button', { name: 'Add person' }).click();
  await page.getByLabel('Name of person 4').fill('oda');
  await page.getByLabel('Role of person 4').selectOption('OBSERVER');
  await page.getByLabel('Workstation of person 4').fill('desk-4');
  await page.getByRole('button', { name: 'Create session' }).click();
  const tickets = page.locator('.ticket');
  await expect(tickets).toHaveCount(4);
  // A seat and another workstation have commands with the address of the server, and neither link nor QR code.
  for (const [n, command] of [
    [1, /tandem-client join --server 127\.0\.0\.1:7000 --ticket-file ted\.ticket --seat trainee --device sim/],
    [3, /tandem-client watch --server 127\.0\.0\.1:7000 --ticket-file oda\.ticket/],
  ] as const) {
    await expect(tickets.nth(n).locator('li')).toHaveCount(3);
    await expect(tickets.nth(n)).toContainText(command);
    await expect(tickets.nth(n).getByRole('link')).toHaveCount(0);
    await expect(tickets.nth(n).getByRole('img')).toHaveCount(0);
  }
  await expect(tickets.nth(3)).toContainText('Valid at workstation desk-4');
  await expect(tickets.nth(2).locator('li')).toHaveCount(3);
  await expect(tickets.nth(2).getByRole('img', { name: 'QR code of the link for eva' })).toBeVisible();
  const link = await tickets.nth(2).getByRole('link').getAttribute('href');
  const context = await browser.newContext();
  const other = await context.newPage();
  await other.goto(link ?? '');
  await other.getByRole('button', { name: 'Join' }).click();
  await expect(other.locator('.person').first()).toHaveText('eva, evaluator');
  // The page had no access before, and lost no connection.
  await view(other, 'evaluator');
  await expect(other.locator('.alarms-panel')).toContainText('No alarm so far.');
  await context.close();
});

test('a row follows the scene until its seat is chosen; removed rows free their seat', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  const seat = (n: number): ReturnType<typeof page.getByLabel> => page.getByLabel(`Seat of person ${n}`);
  await page.getByLabel('Scene').fill('evaluation');
  await expect(seat(2)).toHaveValue('trainee2');
  await seat(1).fill('trainee2');
  await expect(seat(2)).toHaveValue('trainee1');
  await page.getByRole('button', { name: 'Remove person 1' }).click();
  await expect(page.getByLabel('Name of person 1')).toBeFocused();
  await expect(page.getByLabel('Name of person 2')).toHaveCount(0);
  await page.getByRole('button', { name: 'Add person' }).click();
  await expect(page.getByLabel('Name of person 2')).toBeFocused();
  await expect(seat(2)).toHaveValue('trainee2');
  await page.getByLabel('Scene').fill('unknown');
  await expect(seat(1)).toHaveValue('');
});

test('the end of a session asks first', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  const ended: unknown[] = [];
  const answer = gateway.onOrder.bind(gateway);
  gateway.onOrder = (socket, frame) => {
    if (frame.order === 'end') ended.push(frame);
    return answer(socket, frame);
  };
  await page.getByRole('button', { name: 'End session contact' }).click();
  await expect(page.getByRole('dialog')).toContainText('Session contact ends for all participants');
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.getByRole('button', { name: 'End session contact' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'End session contact' }).click();
  await expect(page.locator('.messages')).toContainText('End session contact: done');
  expect(ended).toHaveLength(1);
});

test('what a role may not do says why, in each view', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'otto', 'OBSERVER');
  for (const [name, words] of [
    ['instructor', 'Your role (observer) moves no authority.'],
    ['evaluator', 'Your role (observer) writes no marks and sheets.'],
    ['seat', 'The gateway or your role does not allow browser seats.'],
    ['desk', 'Only operators create and end sessions; your role is observer.'],
  ] as const) {
    await view(page, name);
    await expect(page.locator('main')).toContainText(words);
  }
  await expect(page.locator('main')).not.toContainText('--role operator'); // an observer cannot do that
  await expect(page.getByLabel('Name of the session')).toBeDisabled();
  await expect(page.getByRole('button', { name: 'Create session' })).toBeDisabled();
});

test('a lesson with the same seat twice is not sent', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  await page.getByLabel('Scene').fill('contact');
  await page.getByLabel('Name of the session').fill('monday');
  await page.getByLabel('Name of person 1').fill('ina');
  await page.getByLabel('Name of person 2').fill('ted');
  await page.getByLabel(/Seat of person 1/).fill('trainer');
  await page.getByLabel(/Seat of person 2/).fill('trainer');
  await page.getByRole('button', { name: 'Create session' }).click();
  await expect(page.getByRole('alert')).toContainText('Seat of person 2');
  await expect(page.getByLabel(/Seat of person 2/)).toBeFocused();
  await expect(page.locator('.ticket')).toHaveCount(0);
});

test('a name that the server would refuse is named with the rule, beside the field too', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  const rule = 'A-Z a-z 0-9 _ -';
  for (const label of [
    'Scene',
    'Name of the session',
    'Name of person 1',
    'Seat of person 2',
    'Workstation of person 2',
  ])
    await expect(page.getByLabel(label)).toHaveAccessibleDescription(new RegExp(`1 to 32 characters of ${rule}`));
  for (const [label, value, right] of [
    ['Name of the session', 'monday morning', 'monday'],
    ['Name of person 2', 'Jürgen', 'ted'],
    ['Workstation of person 1', 'desk.1', 'desk-1'],
    ['Seat of person 2', 'a b', 'trainee'],
  ] as const) {
    await page.getByLabel('Scene').fill('contact');
    for (const [field, text] of [
      ['Name of the session', 'monday'],
      ['Name of person 1', 'ina'],
      ['Name of person 2', 'ted'],
    ] as const)
      await page.getByLabel(field).fill(text);
    await page.getByLabel(label).fill(value);
    await page.getByRole('button', { name: 'Create session' }).click();
    await expect(page.locator('#desk-problem')).toContainText(`${label}`);
    await expect(page.locator('#desk-problem')).toContainText(`“${value}” is no name. A name has 1 to 32`);
    await expect(page.getByRole('alert').last()).toContainText(rule);
    await expect(page.getByLabel(label)).toBeFocused();
    await expect(page.getByLabel(label)).toHaveAttribute('aria-invalid', 'true');
    await page.getByLabel(label).fill(right);
  }
  await page.getByRole('button', { name: 'Create session' }).click();
  await expect(page.locator('.ticket')).toHaveCount(2);
  await expect(page.locator('#desk-problem')).toBeHidden();
  await expect(page.locator('[aria-invalid]')).toHaveCount(0);
});

test('the desk says when a scene and the shown session end by themselves', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR', duration: 600 });
  const page = await open(gateway);
  await expect(page.locator('.left')).toHaveText(/^9:5\d\.\d left$/);
  await view(page, 'desk');
  await expect(page.locator('#scenes option[value=contact]')).toHaveAttribute(
    'label',
    'contact: ends by itself after 0:20.0',
  );
  await expect(page.locator('#scenes option[value=evaluation]')).toHaveAttribute('label', /lasts until it is ended/);
  await page.getByLabel('Scene').fill('contact');
  await expect(page.locator('#scene-end')).toHaveText('contact: ends by itself after 0:20.0');
  await page.getByLabel('Scene').fill('unknown');
  await expect(page.locator('#scene-end')).toHaveText('');
  await expect(page.locator('#shown-session')).toHaveText(
    /^This page shows session contact, running, 9:\d\d\.\d left$/,
  );
});

test('each button of the desk names its session, and the page shows a created one on demand', async ({
  start,
  open,
}) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  await create(page, 'monday');
  const panel = page.locator('.tickets .panel').first();
  await expect(panel).toContainText('This page still shows session contact.');
  await expect(page.locator('.shown-panel').getByRole('button')).toHaveText('End session contact');
  await panel.getByRole('button', { name: 'Show session monday' }).click();
  await expect(page.locator('header select').first().locator('option:checked')).toHaveText('monday');
  await expect(page.locator('.shown-panel').getByRole('button')).toHaveText('End session monday');
  await expect(panel.getByRole('button', { name: 'End session monday' })).toBeHidden();
  await expect(panel.getByRole('button', { name: 'Show session monday' })).toBeHidden();
  await page.getByRole('button', { name: 'End session monday' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'End session monday' }).click();
  await expect(panel).toContainText('Session monday is over.');
});

test('a gateway with a ticket says why the page cannot show the new session', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR', listsAll: false });
  const page = await open(gateway);
  await view(page, 'desk');
  await create(page, 'monday');
  const panel = page.locator('.tickets .panel').first();
  await expect(panel.getByRole('button', { name: 'Show session monday' })).toBeDisabled();
  await expect(panel).toContainText('lists the session of its ticket only');
  await panel.getByRole('button', { name: 'End session monday' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'End session monday' }).click();
  await expect(panel).toContainText('Session monday is over.');
});

test('the browser asks before it leaves a page with cards that were not closed', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  const asked: string[] = [];
  page.on('dialog', (dialog) => {
    asked.push(dialog.type());
    void dialog.dismiss();
  });
  await create(page, 'monday');
  await expect(page.locator('.tickets')).toContainText('The tickets are shown once');
  await create(page, 'tuesday');
  await expect(page.locator('.ticket')).toHaveCount(4);
  // A reload would wait for a page that never comes, because the person stays.
  await page.evaluate(() => setTimeout(() => location.reload()));
  await expect.poll(() => asked).toEqual(['beforeunload']);
  await expect(page.locator('.ticket')).toHaveCount(4);
  for (const name of ['tuesday', 'monday']) {
    await page.getByRole('button', { name: `Close the cards of ${name}` }).click();
    await page
      .getByRole('dialog')
      .getByRole('button', { name: `Close the cards of ${name}` })
      .click();
  }
  await expect(page.locator('.ticket')).toHaveCount(0);
  await page.reload();
  await expect(page.locator('.delay')).toContainText('Delay');
  expect(asked).toEqual(['beforeunload']);
});
