import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';

import { LessonPrograms } from './lesson_programs';
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

test('the real gateway: its form at /join signs a person in, and needs no script', async ({ page, run, place }) => {
  const lesson = await LessonPrograms.start(run, place, 'one_axis');
  const errors: string[] = [];
  // A violation of the content security policy is an error of the console as well.
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  expect((await page.goto(`${lesson.url}/join`))?.status()).toBe(200);
  const ticket = page.getByLabel('Ticket from the operator');
  await ticket.fill('ticket:AAAA');
  const refused = page.waitForResponse((response) => response.request().method() === 'POST');
  await page.getByRole('button', { name: 'Sign in' }).click();
  expect((await refused).status()).toBe(400);
  await expect(page.getByRole('alert')).not.toBeEmpty();
  expect(await page.context().cookies()).toEqual([]);
  expect(errors.splice(0)).toEqual([expect.stringContaining('400')]);

  await ticket.fill(await lesson.ticket('--role', 'instructor'));
  await page.getByLabel('Name for others to see').fill('ann_1');
  const accepted = page.waitForResponse((response) => response.request().method() === 'POST');
  await page.getByRole('button', { name: 'Sign in' }).click();
  expect((await accepted).status()).toBe(303);
  await expect(page.locator('.person').first()).toHaveText('ann_1, instructor');
  await expect(phaseOf(page)).toHaveAttribute('data-phase', 'WAITING');
  expect(page.url()).toBe(`${lesson.url}/`);
  const [cookie] = await page.context().cookies();
  expect(cookie).toMatchObject({ name: 'tandem', httpOnly: true, sameSite: 'Strict' });
  expect(errors).toEqual([]);
});

test('the real gateway: both forms to sign in and the gateway itself have one rule for names', async ({
  page,
  run,
  place,
}) => {
  const { url } = await LessonPrograms.start(run, place, 'one_axis');
  const names = { '': true, 'ann_1-B': true, ['x'.repeat(32)]: true, 'Ann Lee': false, Jürgen: false, 'a.b': false };
  const ruleOf = (node: Element): (string | null)[] =>
    ['maxlength', 'pattern', 'required'].map((name) => node.getAttribute(name));
  const rules: unknown[] = [];
  for (const [path, label] of [
    ['/', 'Your name'],
    ['/join', 'Name for others to see'],
  ] as const) {
    await page.goto(`${url}${path}`);
    const field = page.getByLabel(label);
    rules.push([await field.evaluate(ruleOf), await page.getByLabel('Ticket').evaluate(ruleOf)]);
    for (const [name, allowed] of Object.entries(names)) {
      await field.fill(name);
      expect(await field.evaluate((node: HTMLInputElement) => node.checkValidity()), `${path} ${name}`).toBe(allowed);
    }
    await field.fill('');
    await field.pressSequentially('x'.repeat(33));
    await expect(field).toHaveValue('x'.repeat(32));
  }
  expect(rules[0]).toEqual(rules[1]);
  const answerTo = (name: string): Promise<string> =>
    page.evaluate(async (sent) => {
      const headers = { 'Content-Type': 'application/json' };
      const body = JSON.stringify({ ticket: 'ticket:AAAA', name: sent });
      return (await fetch('/join', { method: 'POST', headers, body })).text();
    }, name);
  // The ticket is wrong in any case; a wrong name is refused before.
  for (const [name, allowed] of Object.entries({ ...names, ['x'.repeat(33)]: false }))
    expect((await answerTo(name)).includes('\\"name\\" must be'), name).toBe(!allowed);
});

test('the real gateway: gives browsers its icon, which its content security policy allows', async ({ page, run }) => {
  const host = run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0');
  const entry = await urlOf(run('tandem-console', '--server', await addressOf(host), '--listen', '127.0.0.1:0'));
  const { origin } = new URL(entry);
  for (const path of ['/', '/join']) {
    await page.goto(`${origin}${path}`);
    const icon = await page.locator('link[rel=icon]').getAttribute('href');
    // Browsers without a window fetch no icon by themselves.
    for (const source of [icon ?? '', '/favicon.ico']) {
      const width = await page.evaluate(async (from) => {
        const image = new Image();
        image.src = from;
        await image.decode();
        return image.naturalWidth;
      }, source);
      expect(width, `${path} ${source}`).toBeGreaterThan(0);
    }
  }
});
