import { spawn } from 'node:child_process';

import { view } from './fixture';
import { addressOf, expect, needPrograms, test, urlOf } from './programs';

needPrograms();

test('the real server: a person joins with the commands of the desk, copied as they are', async ({
  browser,
  run,
  place,
}) => {
  const host = run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0');
  const server = await addressOf(host);
  const gateway = run('tandem-console', '--role', 'operator', '--server', server, '--listen', '127.0.0.1:0');
  const page = await (await browser.newContext()).newPage();
  await page.goto(await urlOf(gateway));
  await view(page, 'desk');
  await page.getByLabel('Scene').fill('contact');
  await expect(page.getByLabel('Seat of person 2')).toHaveValue('trainee');
  await page.getByLabel('Name of the session').fill('monday');
  await page.getByLabel('Name of person 1').fill('ina');
  await page.getByLabel('Name of person 2').fill('ted');
  await page.getByRole('button', { name: 'Add person' }).click();
  await page.keyboard.type('eva');
  await page.getByRole('button', { name: 'Create session' }).click();
  const cards = page.locator('.ticket');
  await expect(cards).toHaveCount(3);

  const commands = await cards.nth(1).locator('pre').allTextContents();
  expect(commands[2]).toBe(
    `tandem-client join --server ${server} --ticket-file ted.ticket --seat trainee --device sim`,
  );
  const path = `${process.env.TANDEM_PROGRAMS}:${process.env.PATH}`;
  const shell = spawn('bash', ['-c', `${commands.slice(0, -1).join('\n')}\nexec ${commands.at(-1)}`], {
    cwd: place,
    env: { ...process.env, PATH: path },
    stdio: ['ignore', 'ignore', 'ignore'],
  });
  await page.locator('header select').first().selectOption({ label: 'monday' });
  await view(page, 'instructor');
  await expect(page.locator('.who-panel tbody tr').nth(1)).toContainText('ted', { timeout: 20_000 });
  shell.kill('SIGINT');
  await new Promise((resolve) => shell.on('exit', resolve));

  // The evaluator's ticket is for browsers at this gateway: link and QR code, and no command.
  await view(page, 'desk');
  await expect(cards.nth(2).locator('pre')).toHaveCount(0);
  await expect(cards.nth(2).getByRole('img')).toBeVisible();
  const other = await (await browser.newContext()).newPage();
  await other.goto((await cards.nth(2).getByRole('link').getAttribute('href')) ?? '');
  await other.getByRole('button', { name: 'Join' }).click();
  await expect(other.locator('.person').first()).toHaveText('eva, evaluator');
});
