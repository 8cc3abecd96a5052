import { expect, test, view } from './fixture';

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
  await page.getByRole('button', { name: 'End session' }).click();
  await expect(page.getByRole('dialog')).toContainText('Session contact ends for all participants');
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.getByRole('button', { name: 'End session' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'End session' }).click();
  await expect(page.locator('.messages')).toContainText('End session: done');
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
