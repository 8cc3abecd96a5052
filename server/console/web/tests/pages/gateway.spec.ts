import { type Page } from '@playwright/test';

import { view } from './fixture';
import { expect, needPrograms, phaseOf, test, urlOf } from './programs';

needPrograms();

/** First coordinate of a row of the live view's values [mm]. */
async function position(page: Page, row: string): Promise<number> {
  const text = await page.locator('.values-panel tbody tr', { hasText: row }).locator('td').first().textContent();
  return Number(/-?[\d.]+/.exec(text ?? '')?.[0] ?? 'NaN');
}

test('two browsers share a tool, and one stops it', async ({ browser, run }) => {
  const first = await (await browser.newContext()).newPage();
  const began = Date.now();
  await first.goto(await urlOf(run('tandem-console', '--play', '--listen', '127.0.0.1:0')));
  await expect(first.locator('.seat-view')).toContainText('You have seat instructor');
  await expect(phaseOf(first)).toHaveAttribute('data-phase', 'RUNNING');
  console.log(`from the URL to a seat in a running session: ${Date.now() - began} ms (asked: <= 5000)`);

  // The server of a trial has no place for recordings, which the page says before the click.
  await expect(first.getByRole('button', { name: 'Record', exact: true })).toHaveAccessibleDescription(
    'this server has no place for recordings; a server that is started by `tandem-server run SCENE --record FOLDER` has one',
  );
  await first.locator('details.settings summary').click();
  await first.getByRole('button', { name: 'Invite another browser' }).click();
  const invitation = first.locator('.settings-box input[readonly]');
  await expect(invitation).toHaveValue(/token=/);
  const second = await (await browser.newContext()).newPage();
  await second.goto(await invitation.inputValue());
  await expect(second.locator('.seat-view')).toBeVisible();
  await second.getByRole('button', { name: 'Take seat' }).click();
  await expect(second.locator('.seat-view')).toContainText('You have seat evaluator1');
  await view(second, 'live');

  // The first person moves the hand to the right; the second one sees hand and tool go there.
  const pad = await first.locator('.seat-view canvas').first().boundingBox();
  if (!pad) throw new Error('the pad is not shown');
  await first.mouse.move(pad.x + pad.width / 2, pad.y + pad.height / 2);
  await first.mouse.down();
  await first.mouse.move(pad.x + pad.width * 0.7, pad.y + pad.height / 2, { steps: 20 });
  await expect.poll(() => position(second, 'tool')).toBeGreaterThan(5);
  await expect.poll(() => position(second, 'instructor')).toBeGreaterThan(5);

  await second.getByRole('button', { name: 'STOP' }).click();
  await expect(phaseOf(first)).toHaveAttribute('data-phase', 'STOPPED');
  await second.getByRole('button', { name: 'Resume' }).click();
  await expect(phaseOf(first)).toHaveAttribute('data-phase', 'RUNNING');

  // A page that is opened again has its seat again; one that leaves it is offered the same seat.
  await first.reload();
  await expect(first.locator('.seat-view')).toContainText('You have seat instructor');
  await first.getByRole('button', { name: 'Leave seat' }).click();
  await expect(first.getByLabel('Free seat')).toHaveValue('instructor');
});

test('the page comes back after the server, and asks for a ticket after a new gateway', async ({ page, run }) => {
  const host = run('tandem-server', 'run', 'one_axis', '--listen', '127.0.0.1:0');
  const address = await host.said(/listening on (\S+)/);
  const gateway = run('tandem-console', '--server', address, '--listen', '127.0.0.1:0');
  const entry = await urlOf(gateway);
  await page.goto(entry);
  await expect(phaseOf(page)).toHaveAttribute('data-phase', 'WAITING');
  await host.end('SIGKILL');
  await expect(page.locator('.messages')).toContainText('the connection to the server was lost');
  run('tandem-server', 'run', 'contact', '--listen', address);
  await expect(page.locator('.messages')).toContainText('the connection to the server is back', { timeout: 30_000 });
  await expect(page.locator('header select').first()).toContainText('contact');

  await gateway.end('SIGKILL');
  await expect(page.locator('[data-link]')).toHaveAttribute('data-link', 'lost');
  run('tandem-console', '--server', address, '--listen', new URL(entry).host);
  await expect(page.locator('.join-view')).toBeVisible({ timeout: 30_000 });
});
