import { expect, test, view } from './fixture';

test('the instructor hands over: the transfer is announced, then applied', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  const panel = page.locator('.authority-panel');
  await panel.locator('select').last().selectOption({ label: 'trainee' });
  await panel.getByRole('button', { name: 'Hand over' }).click();
  await expect.poll(() => gateway.session.wanted).toEqual([0, 1]);
  await expect(page.locator('.events-panel')).toContainText('ina gives the tool to trainee (100 %)');
  await expect(panel.locator('.share').nth(2).locator('.applied span').last()).toHaveText(/100/);
  expect(gateway.session.orders.at(-1)).toMatchObject({ order: 'authority', tool: 0, version: 1, alpha: [0, 1] });
});

test('an announced transfer is shown with its ticks', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  gateway.session.transfer = { by: 'trainer', to: 'trainee', alpha: 0.5, ticks: 5000 };
  await expect(page.locator('.transfer')).toHaveText(/trainer gives 50.% to trainee\. Begins in \d+ ticks\./);
  await expect(page.locator('.transfer')).toHaveClass(/announced/);
});

test('sliders keep the sum and are sent with Apply only', async ({ start, open }) => {
  const gateway = await start({ seats: 3 });
  const page = await open(gateway);
  await view(page, 'instructor');
  await page.getByRole('slider', { name: 'Authority of trainer' }).focus();
  for (let i = 0; i < 8; i += 1) await page.keyboard.press('ArrowLeft');
  await expect(page.locator('.share .draft')).toHaveText([/60/, /20/, /20/]);
  expect(gateway.session.wanted).toEqual([1, 0, 0]);
  await page.getByRole('button', { name: 'Apply' }).click();
  await expect
    .poll(() => gateway.session.wanted.map((share: number) => Math.round(share * 1e6) / 1e6))
    .toEqual([0.6, 0.2, 0.2]);
});

test('presets give authority for demonstration, guidance and evaluation', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  for (const [name, alpha] of [
    ['Evaluation of trainee', [0, 1]],
    ['Guidance', [0.5, 0.5]],
    ['Demonstration', [1, 0]],
  ] as const) {
    await page.getByRole('button', { name }).click();
    await expect.poll(() => gateway.session.wanted).toEqual(alpha);
    await expect(page.locator('.share .number').nth(0)).toHaveText(new RegExp(`${alpha[0] * 100}`));
  }
});

test('a share out of its range is refused with words, and the field keeps it', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  const panel = page.locator('.authority-panel');
  const share = panel.getByLabel('Share (%)');
  for (const wrong of ['150', '-5', '', '4']) {
    await share.fill(wrong);
    await panel.getByRole('button', { name: 'Hand over' }).click();
    await expect(page.getByRole('alert')).toHaveText(
      /Hand over was refused: the share must be a number from 5 to 100 \(%\)\. Correct the field\./,
    );
    await expect(share).toHaveValue(wrong);
    await expect(share).toBeFocused();
    await expect(share).toHaveAttribute('aria-invalid', 'true');
    await page.getByRole('button', { name: 'Dismiss' }).click();
  }
  expect(gateway.session.orders).toEqual([]);
  await share.fill('100');
  await expect(share).not.toHaveAttribute('aria-invalid');
  await panel.getByRole('button', { name: 'Hand over' }).click();
  await expect.poll(() => gateway.session.wanted).toEqual([0, 1]);
});

test('STOP by button and resume; pause by key and resume by key', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await page.getByRole('button', { name: 'STOP' }).click();
  await expect(page.locator('.active-stop')).toHaveText('Stop by ina: from the console');
  await expect(page.locator('.badge')).toHaveText('stopped');
  expect(gateway.session.phase).toBe('STOPPED');
  await page.getByRole('button', { name: 'Resume' }).click();
  await expect(page.locator('.badge')).toHaveText('running');
  await page.locator('main').focus();
  await page.keyboard.press('p');
  await expect(page.locator('.badge')).toHaveText('paused');
  await page.keyboard.press('r');
  await expect(page.locator('.badge')).toHaveText('running');
  await page.keyboard.press('s');
  await expect(page.locator('.badge')).toHaveText('stopped');
});

test('keys do nothing while the person writes, or when they are switched off', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'evaluator');
  await page.getByLabel('Note').pressSequentially('stop press 1');
  await expect(page.locator('[data-view=evaluator]')).toHaveAttribute('aria-current', 'page');
  await page.getByText('Settings').click();
  await page.getByRole('checkbox', { name: 'Keys' }).uncheck();
  await page.locator('main').focus();
  await page.keyboard.press('s');
  await page.keyboard.press('1');
  await expect(page.locator('[data-view=evaluator]')).toHaveAttribute('aria-current', 'page');
  expect(gateway.session.orders).toEqual([]);
});

test('a refusal is shown with its reason', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  gateway.session.setAuthority = () => 'the authority has version 7, not 1; look at the new values and repeat';
  await page.getByRole('button', { name: 'Guidance' }).click();
  await expect(page.getByRole('alert')).toHaveText(/Presets was refused: the authority has version 7, not 1/);
  await page.getByRole('button', { name: 'Dismiss' }).click();
  await expect(page.getByRole('alert')).toHaveCount(0);
});

test('a trainee cannot end the stop of the instructor', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'ted', 'TRAINEE');
  gateway.session.order({ order: 'stop', why: 'tissue torn' }, 'ina', 'INSTRUCTOR');
  await expect(page.locator('.active-stop')).toHaveText(
    'Stop by ina: tissue torn. Only an instructor or operator may resume.',
  );
  await expect(page.getByRole('button', { name: 'Resume' })).toBeDisabled();
  await view(page, 'instructor');
  await expect(page.getByRole('slider', { name: 'Authority of trainer' })).toBeDisabled();
  await expect(page.getByRole('button', { name: 'Guidance' })).toBeDisabled();
  await expect(page.getByRole('button', { name: 'Remove… trainer' })).toBeHidden();
});

test('an observer has no control that works', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway, 'otto', 'OBSERVER');
  for (const name of ['live', 'instructor', 'evaluator', 'seat', 'desk']) {
    await view(page, name);
    await expect(page.locator('button.stop')).toBeHidden();
    await expect(page.getByRole('button', { name: 'Take seat' })).toHaveCount(0);
    // The pad and its view of the plane move nothing without a seat; lists and cameras only choose what is shown.
    const enabled = page.locator('main button:enabled:not([type=submit]), main input[type=range]:enabled');
    const names = await enabled.evaluateAll((nodes) => nodes.map((node) => node.textContent));
    expect(names.filter((text) => text !== 'Add person' && text !== '✕')).toEqual([]);
  }
  await page.keyboard.press('s');
  expect(gateway.session.orders).toEqual([]);
});

test('remove and drain ask first, and cancel sends nothing', async ({ start, open }) => {
  const gateway = await start({ role: 'OPERATOR' });
  const page = await open(gateway);
  await view(page, 'instructor');
  await page.getByRole('button', { name: 'Remove… trainee' }).click();
  await page.getByRole('button', { name: 'Cancel' }).click();
  expect(gateway.session.orders).toEqual([]);
  await page.getByRole('button', { name: 'Remove… trainee' }).click();
  await page.getByLabel('Reason').fill('device broken');
  await page.keyboard.press('Enter');
  await expect(page.locator('.who-panel tbody tr').nth(1)).toContainText('free');
  await page.getByRole('button', { name: 'Drain…' }).click();
  await page.getByLabel('Grace time (s)').fill('3600');
  await page.getByRole('button', { name: 'Drain', exact: true }).click();
  await expect
    .poll(() => gateway.session.orders.map((order: { order: string }) => order.order))
    .toEqual(['remove', 'drain']);
  expect(gateway.session.orders).toMatchObject([{ seat: 'trainee', why: 'device broken' }, { grace_s: 3600 }]);
});

test('alarms are listed in words with their time', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  const seat = gateway.session.seats[1]!;
  seat.heard = false;
  await expect(page.locator('.alarms-panel')).toContainText('Seat trainee: no data from the device.');
  await expect(page.locator('.alarms-panel time').first()).toHaveText(/^\d+:\d\d\.\d$/);
  await expect(page.locator('.card').nth(1)).toHaveAttribute('data-band', 'red');
  seat.heard = true;
  seat.rtt = 250;
  await expect(page.locator('.alarms-panel')).toContainText('Seat trainee: link quality red.');
  await expect(page.locator('.card').nth(1)).toContainText('red: outside the limits for force feedback');
});

test('a recording starts and ends by the button; all see a red dot with words', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await expect(page.locator('.recording')).toBeHidden();
  await page.getByRole('button', { name: 'Record', exact: true }).click();
  await expect(page.locator('.recording')).toHaveText('Recorded by the server');
  await expect(page.locator('.recording-dot')).toBeVisible();
  gateway.session.recording = { by_server: true, by_recorders: 0, pseudonyms: false, dropped: 12, trouble: '' };
  await expect(page.locator('.recording')).toHaveText('Recorded by the server. Ticks dropped so far: 12');
  await page.getByRole('button', { name: 'End recording' }).click();
  const dialog = page.getByRole('dialog', { name: 'End recording' });
  await expect(dialog.getByRole('button', { name: 'Cancel' })).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(dialog).toHaveCount(0);
  await page.getByRole('button', { name: 'End recording' }).click();
  await page.keyboard.press('Escape');
  expect(gateway.session.orders.at(-1)).toMatchObject({ order: 'record', on: true });
  await page.getByRole('button', { name: 'End recording' }).click();
  await dialog.getByRole('button', { name: 'End recording' }).click();
  await expect(page.locator('.recording')).toBeHidden();
  expect(gateway.session.orders.at(-1)).toMatchObject({ order: 'record', on: false });
});

test('a server without a place for recordings: the button says why, and orders nothing', async ({ start, open }) => {
  const gateway = await start();
  gateway.session.noRecording = 'this server has no place for recordings; restart it with --record';
  const page = await open(gateway);
  const record = page.getByRole('button', { name: 'Record', exact: true });
  await expect(record).toHaveAttribute('aria-disabled', 'true');
  await expect(record).toHaveAccessibleDescription(/restart it with --record/);
  await record.focus();
  await page.keyboard.press('Enter');
  await expect(page.locator('.messages')).toContainText('this server has no place for recordings');
  expect(gateway.session.orders).toEqual([]);
});

test('another session is watched: alarms of the one before are gone', async ({ start, open }) => {
  const gateway = await start();
  const page = await open(gateway);
  await view(page, 'instructor');
  gateway.session.t = 40;
  gateway.session.order({ order: 'stop', why: 'tissue torn' }, 'ina', 'INSTRUCTOR');
  await expect(page.locator('.alarms-panel')).toContainText('Session stopped by ina. tissue torn');
  await expect(page.locator('.alarms-panel')).toContainText('lasting');
  // A session that has not begun: its clock shows 0:00.0.
  // The page asks for its session again 1.5 s after it has connected, so the gateway has only this one from now on.
  const { session } = gateway;
  const other = { id: 'f'.repeat(32), name: 'other' };
  session.step = () => undefined;
  Object.assign(session, { t: 0, stop: null });
  gateway.sessions = [other];
  for (const socket of gateway.pages) {
    socket.watched = other;
    socket.sendScene();
  }
  await expect(page.locator('.time').first()).toHaveText('0:00.0');
  await expect(page.locator('.alarms-panel')).toContainText('No alarm so far.');
  // The same session begins again while a stop lasts: the alarm ends at a time of its own run.
  Object.assign(session, { t: 30 });
  session.order({ order: 'stop', why: 'again' }, 'ina', 'INSTRUCTOR');
  await expect(page.locator('.alarms-panel')).toContainText('lasting');
  Object.assign(session, { t: 0, stop: null });
  await expect(page.locator('.alarms-panel')).toContainText('until 0:30.0');
  await expect(page.locator('.alarms-panel')).not.toContainText('until 0:00.0');
});
