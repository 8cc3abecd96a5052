import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';

import { addressOf, expect, needPrograms, phaseOf, test, urlOf } from './programs';

needPrograms();

test('the real gateway: a wrong token and a used token open nothing', async ({ browser, page, run }) => {
  const host = run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0');
  const entry = await urlOf(run('tandem-console', '--server', await addressOf(host), '--listen', '127.0.0.1:0'));
  const { origin, searchParams } = new URL(entry);
  const token = searchParams.get('token') ?? '';
  for (const wrong of ['0'.repeat(token.length), token.slice(1), `${token}0`]) {
    expect((await page.goto(`${origin}/?token=${wrong}`))?.status()).toBe(403);
    expect(await page.context().cookies()).toEqual([]);
  }
  expect((await page.goto(entry))?.status()).toBe(200);
  expect(page.url()).toBe(`${origin}/`);
  await expect(phaseOf(page)).toHaveAttribute('data-phase', 'WAITING');
  const other = await browser.newPage();
  expect((await other.goto(entry))?.status()).toBe(403);
  // Without a cookie the page itself has no session and asks for a ticket.
  await other.goto(origin);
  await expect(other.getByRole('heading', { name: 'Join the session' })).toBeVisible();
  await other.close();
});

test('the real gateway: a page of another origin in the same browser gets neither socket nor session', async ({
  page,
  run,
}) => {
  const host = run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0');
  const entry = await urlOf(run('tandem-console', '--server', await addressOf(host), '--listen', '127.0.0.1:0'));
  await page.goto(entry);
  await expect(phaseOf(page)).toHaveAttribute('data-phase', 'WAITING');
  // A page at another port is of the same site, so that the browser sends the cookie along: only the Origin tells.
  const foreign = createServer((_, response) => response.end('<!doctype html><title>foreign</title>'));
  await new Promise<void>((resolve) => foreign.listen(0, '127.0.0.1', resolve));
  const evil = await page.context().newPage();
  await evil.goto(`http://127.0.0.1:${(foreign.address() as AddressInfo).port}/`);
  const statuses: number[] = [];
  evil.on('response', (response) => statuses.push(response.status()));
  const result = await evil.evaluate(async (gateway) => {
    const socket = new WebSocket(`${gateway.replace('http', 'ws')}/live`);
    const opened = await new Promise<string>((resolve) => {
      socket.onopen = () => resolve('opened');
      socket.onmessage = () => resolve('message');
      socket.onclose = ({ code }) => resolve(`closed ${code}`);
    });
    await fetch(`${gateway}/join`, { method: 'POST', mode: 'no-cors', body: 'ticket=x' }).catch(() => undefined);
    const read = await fetch(gateway).then(
      () => 'read',
      () => 'blocked',
    );
    return [opened, read];
  }, new URL(entry).origin);
  expect(result).toEqual(['closed 1006', 'blocked']);
  expect(statuses).toContain(403);
  await evil.close();
  await new Promise((resolve) => foreign.close(resolve));
  await expect(page.locator('[data-link]')).toHaveAttribute('data-link', 'open');
});

test('the real gateway: stopped, the page says that its picture is old; continued, it recovers', async ({
  page,
  run,
}) => {
  const host = run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0');
  const gateway = run('tandem-console', '--server', await addressOf(host), '--listen', '127.0.0.1:0');
  await page.goto(await urlOf(gateway));
  await expect(page.locator('.delay')).toHaveText(/Delay/);
  gateway.child.kill('SIGSTOP');
  await expect(page.locator('.delay')).toHaveText(/No new state for \d+\.\d.s/);
  await expect(page.locator('.picture')).toHaveClass(/out-of-date/);
  gateway.child.kill('SIGCONT');
  await expect(page.locator('.delay')).toHaveText(/Delay/);
  // A page that stands still gets no queue of old states: at most three wait, further ones are counted.
  await page.evaluate(() => {
    const end = performance.now() + 1500;
    while (performance.now() < end);
  });
  await expect(page.locator('.delay')).toHaveAttribute('title', /States dropped: [1-9]\d/);
  await expect(page.locator('.delay')).toHaveText(/Delay/);
});
