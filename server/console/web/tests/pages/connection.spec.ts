import { request as httpRequest } from 'node:http';

import { expect, test, view } from './fixture';
import { startMock } from '../mock/gateway.mjs';

test('a page without a cookie asks for a ticket; a wrong ticket is refused, a ticket joins once', async ({
  start,
  page,
}) => {
  const gateway = await start();
  await page.goto(gateway.url);
  await expect(page.getByRole('heading', { name: 'Join the session' })).toBeVisible();
  await page.getByLabel('Ticket').fill('wrong');
  await page.getByLabel('Your name').fill('Eva');
  await page.getByRole('button', { name: 'Join' }).click();
  await expect(page.getByRole('alert')).toHaveText(
    'the ticket is wrong, used or expired; ask the operator for a new one',
  );
  await page.getByLabel('Ticket').fill('ticket-eva');
  await page.getByRole('button', { name: 'Join' }).click();
  await expect(page.locator('.person').first()).toHaveText('eva, evaluator');
  await expect(page.locator('.delay')).toContainText('Delay');
  expect(gateway.tickets.has('ticket-eva')).toBe(false);
});

test('a ticket behind # fills the form and leaves the address', async ({ start, page }) => {
  const gateway = await start();
  await page.goto(`${gateway.url}/#ticket=ticket-ted&name=Ted`);
  await expect(page.getByLabel('Ticket')).toHaveValue('ticket-ted');
  await expect(page.getByLabel('Your name')).toHaveValue('Ted');
  expect(page.url()).toBe(`${gateway.url}/`);
  await page.getByRole('button', { name: 'Join' }).click();
  await expect(page.locator('.person').first()).toHaveText('ted, trainee');
});

test('a token of the URL is valid once', async ({ start, page }) => {
  const gateway = await start();
  const entry = gateway.entry();
  expect((await page.goto(entry))?.status()).toBe(200);
  expect(page.url()).toBe(`${gateway.url}/`);
  expect((await page.goto(entry))?.status()).toBe(403);
  expect((await page.goto(`${gateway.url}/?token=guess`))?.status()).toBe(403);
});

test('a foreign origin gets no socket', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  const [cookie] = await page.context().cookies();
  expect(cookie).toMatchObject({ httpOnly: true, sameSite: 'Strict' });
  const status = (origin: string): Promise<number> =>
    new Promise((resolve) => {
      const headers = {
        Connection: 'Upgrade',
        Upgrade: 'websocket',
        'Sec-WebSocket-Version': '13',
        'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==',
        Origin: origin,
        Cookie: `tandem=${cookie?.value}`,
      };
      const sent = httpRequest(`${gateway.url}/live`, { headers });
      sent.on('upgrade', (_, socket) => {
        socket.destroy();
        resolve(101);
      });
      sent.on('response', (response) => resolve(response.statusCode ?? 0));
      sent.end();
    });
  expect(await status('http://elsewhere.example')).toBe(403);
  expect(await status(gateway.url)).toBe(101);
});

test('a stalled socket: the page says that its picture is old, and recovers', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  gateway.silent = true;
  await expect(page.locator('.delay')).toHaveText(/No new state for \d+\.\d.s/);
  await expect(page.locator('.picture')).toHaveClass(/out-of-date/);
  gateway.silent = false;
  await expect(page.locator('.delay')).toHaveText(/Delay/);
});

test('a page that stands still gets no queue of old states', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await page.evaluate(() => {
    const end = performance.now() + 1500;
    while (performance.now() < end);
  });
  const [socket] = [...gateway.pages];
  await expect.poll(() => socket?.dropped).toBeGreaterThan(40);
  expect((socket?.n ?? 0) - (socket?.acknowledged ?? 0)).toBeLessThanOrEqual(3);
  await expect(page.locator('.delay')).toHaveText(/Delay/);
  await expect(page.locator('.delay')).toHaveAttribute('title', /States dropped: [1-9]/);
});

test('the page connects again after the gateway was killed, with its view and its rights', async ({ open }) => {
  const first = await startMock();
  const page = await open(first);
  await view(page, 'instructor');
  await first.stop();
  await expect(page.locator('.link')).toHaveText('connection lost, trying again');
  await expect(page.getByRole('button', { name: 'STOP' })).toBeDisabled();
  await expect(page.locator('.alarms-panel')).toContainText('No connection to the gateway.');
  const second = await startMock({ port: first.port });
  second.cookies = first.cookies;
  await expect(page.locator('.link')).toHaveText('connected');
  await expect(page.locator('.delay')).toHaveText(/Delay/);
  await expect(page.locator('[data-view=instructor]')).toHaveAttribute('aria-current', 'page');
  await page.getByRole('button', { name: 'STOP' }).click();
  await expect(page.locator('.badge')).toHaveText('stopped');
  await second.stop();
});

test('a lost server: no order, no live phase, and the message leaves when the server is back', async ({
  start,
  open,
}) => {
  const gateway = await start();
  const page = await open(gateway);
  gateway.silent = true;
  gateway.tellServer('lost');
  const badge = page.locator('.badge');
  await expect(badge).toHaveText('unknown');
  await expect(page.locator('.link')).toHaveText('server lost, trying again');
  for (const name of ['STOP', 'Pause', 'Record'])
    await expect(page.getByRole('button', { name, exact: true })).toBeDisabled();
  await expect(page.locator('.server-lost')).toHaveText(/can give no order/);
  await expect(page.getByRole('link', { name: 'Sign in again' })).toBeHidden();
  await expect(page.locator('.messages')).toContainText('trying again');
  await page.locator('main').focus();
  await page.keyboard.press('s');
  await expect(page.locator('.messages')).toContainText('STOP was refused: The gateway has lost the server');
  expect(gateway.session.orders).toEqual([]);
  gateway.silent = false;
  gateway.tellServer('back');
  await expect(badge).toHaveText('running');
  await expect(page.locator('.link')).toHaveText('connected');
  await expect(page.locator('.server-lost')).toBeHidden();
  await expect(page.locator('.messages')).not.toContainText('the connection to the server was lost');
  await page.getByRole('button', { name: 'STOP' }).click();
  await expect(badge).toHaveText('stopped');

  gateway.tellServer('gone');
  await expect(page.locator('.link')).toHaveText('server lost');
  await expect(page.getByRole('link', { name: 'Sign in again with a new ticket' })).toHaveAttribute('href', '/join');
});

test('a gateway that forgot the cookie makes the page ask for a ticket', async ({ open }) => {
  const first = await startMock();
  const page = await open(first);
  await first.stop();
  const second = await startMock({ port: first.port });
  await expect(page.getByRole('heading', { name: 'Join the session' })).toBeVisible();
  await second.stop();
});

test('frames that are no message change nothing', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  for (const socket of gateway.pages) {
    for (const frame of ['', '{', '[]', '{"type":"state","n":"x"}', '{"type":"event","text":"<img src=x>"}']) {
      (socket as unknown as { socket: { send: (text: string) => void } }).socket.send(frame);
    }
  }
  await view(page, 'instructor');
  await expect(page.locator('.events-panel')).toContainText('<img src=x>');
  expect(await page.locator('.events-panel img').count()).toBe(0);
  await expect(page.locator('.link')).toHaveText('connected');
});
