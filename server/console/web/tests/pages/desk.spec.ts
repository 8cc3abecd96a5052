import { expect, test, view } from './fixture';

test('the lesson desk creates a session and shows a page with ticket, QR code and steps per person', async ({
  start,
  open,
  browser,
}) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  await page.getByLabel('Scene').fill('contact');
  await page.getByLabel('Name of the session').fill('monday');
  await page.getByLabel('Name of person 1').fill('ina');
  await page.getByLabel('Name of person 2').fill('ted');
  await page.getByRole('button', { name: 'Add person' }).click();
  await page.getByLabel('Name of person 3').fill('eva');
  await page.getByLabel('Role of person 3').selectOption('EVALUATOR');
  await page.getByRole('button', { name: 'Create session' }).click();
  const tickets = page.locator('.ticket');
  await expect(tickets).toHaveCount(3);
  await expect(tickets.nth(1).locator('li')).toHaveCount(3);
  await expect(tickets.nth(1)).toContainText('--seat trainee');
  await expect(tickets.nth(2).getByRole('img', { name: 'QR code of the link for eva' })).toBeVisible();
  const link = await tickets.nth(2).getByRole('link').getAttribute('href');
  const context = await browser.newContext();
  const other = await context.newPage();
  await other.goto(link ?? '');
  await other.getByRole('button', { name: 'Join' }).click();
  await expect(other.locator('.person').first()).toHaveText('eva, evaluator');
  await context.close();
});

test('a lesson with the same seat twice is not sent', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'desk');
  await page.getByLabel('Scene').fill('contact');
  await page.getByLabel('Name of the session').fill('monday');
  await page.getByLabel('Name of person 1').fill('ina');
  await page.getByLabel('Name of person 2').fill('ted');
  await page.getByLabel(/Seat of person 2/).fill('trainer');
  await page.getByRole('button', { name: 'Create session' }).click();
  await expect(page.getByRole('alert')).toContainText('Seat of person 2');
  await expect(page.getByLabel(/Seat of person 2/)).toBeFocused();
  await expect(page.locator('.ticket')).toHaveCount(0);
});
