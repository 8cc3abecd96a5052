import { expect, test, view } from './fixture';

test('two browsers share a tool and see each other', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const trainee = await open(gateway, 'ted', 'TRAINEE');
  const instructor = await open(gateway);
  await view(trainee, 'seat');
  await trainee.getByRole('button', { name: 'Take seat' }).click();
  await expect(trainee.locator('.seat-panel')).toContainText('You have seat trainee.');
  await view(instructor, 'instructor');
  await expect(instructor.locator('.who-panel tbody tr').nth(1)).toContainText('ted');
  await instructor.getByRole('button', { name: 'Evaluation of trainee' }).click();
  const pad = trainee.locator('.pad');
  const box = (await pad.boundingBox())!;
  await trainee.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await trainee.mouse.down();
  await trainee.mouse.move(box.x + box.width / 2 - box.height / 3, box.y + box.height / 2, { steps: 5 });
  // A third of the height is two thirds of the reach of 60 mm.
  await expect.poll(() => Math.round((gateway.session.tool.x[0] ?? 0) * 1000)).toBeLessThanOrEqual(-38);
  await view(instructor, 'live');
  const row = instructor.locator('.values-panel tbody tr');
  await expect(row.nth(1).locator('td').first()).toHaveText(/^-(39|40)\.\d /);
  await expect(row.nth(2).locator('td').first()).toHaveText(/^-(39|40)\.\d /);
  await trainee.mouse.up();
  await expect.poll(() => gateway.session.seats[1]?.pressed).toBe(false);
  await trainee.getByRole('button', { name: 'Leave seat' }).click();
  await expect(trainee.getByRole('button', { name: 'Take seat' })).toBeEnabled();
  expect(gateway.framesMax).toBeLessThanOrEqual(120);
});

test('keys move and hold the hand', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const page = await open(gateway, 'ted', 'TRAINEE');
  await view(page, 'seat');
  await page.getByRole('button', { name: 'Take seat' }).click();
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainee.');
  await page.locator('.pad').focus();
  await page.keyboard.press('Space');
  await expect.poll(() => gateway.session.seats[1]?.pressed).toBe(true);
  // The intention begins at the place of the hand.
  const begin = [...gateway.session.seats[1]!.wish];
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('PageUp');
  await expect
    .poll(() => gateway.session.seats[1]?.wish.map((x: number, i: number) => Math.round((x - begin[i]!) * 1000)))
    .toEqual([10, 5, 5]);
  await page.keyboard.press('Space');
  await expect.poll(() => gateway.session.seats[1]?.pressed).toBe(false);
});

test('a hand is released when the view changes', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const page = await open(gateway, 'ted', 'TRAINEE');
  await view(page, 'seat');
  await page.getByRole('button', { name: 'Take seat' }).click();
  await page.getByRole('button', { name: 'Hold' }).click();
  await expect.poll(() => gateway.session.seats[1]?.pressed).toBe(true);
  await page.keyboard.press('1');
  await expect.poll(() => gateway.session.seats[1]?.pressed).toBe(false);
});

test('the gateway refuses a seat that is not free any more', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const page = await open(gateway, 'ted', 'TRAINEE');
  await view(page, 'seat');
  const take = page.getByRole('button', { name: 'Take seat' });
  await expect(take).toBeEnabled();
  const answer = gateway.onPageFrame.bind(gateway);
  gateway.onPageFrame = (socket, frame) => {
    if (frame.type === 'take') gateway.session.seats[1]!.taken = true;
    return answer(socket, frame);
  };
  await take.click();
  await expect(page.getByRole('alert')).toContainText('Take seat was refused: seat "trainee" is not free');
});
