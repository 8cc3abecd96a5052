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

test('a person with a ticket gives the ticket of the seat', async ({ start, open }) => {
  const gateway = await start({
    freeSeat: true,
    may: { TRAINEE: ['seat'] },
    seatTickets: { trainee: 'ticket:seat' },
  });
  const page = await open(gateway, 'ted', 'TRAINEE');
  await view(page, 'seat');
  const ticket = page.getByLabel('Ticket of the seat');
  await expect(ticket).toHaveAccessibleDescription(/tandem-server ticket --session contact --seat trainee/);
  const take = page.getByRole('button', { name: 'Take seat' });
  await take.click();
  await expect(page.getByRole('alert')).toContainText('the field for the ticket of the seat is empty');
  await expect(ticket).toBeFocused();
  await ticket.fill('ticket:wrong');
  await take.click();
  await expect(page.getByRole('alert').last()).toContainText('a ticket for this seat is needed');
  await expect(ticket).toHaveValue('ticket:wrong');
  await ticket.fill(' ticket:seat ');
  await take.click();
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainee.');
  await expect(ticket).toBeHidden();
});

test('persons of the printed URL have no field for a ticket', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const page = await open(gateway);
  await view(page, 'seat');
  await expect(page.getByRole('button', { name: 'Take seat' })).toBeEnabled();
  await expect(page.getByLabel('Ticket of the seat')).toBeHidden();
});

test('a trial takes its seat again after a reload, and proposes it after it was left', async ({ start, open }) => {
  const gateway = await start({ seats: 3, play: 'trainer' });
  for (const seat of gateway.session.seats) gateway.free(seat);
  const page = await open(gateway);
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainer.');
  // The seat is free again a while after the page is gone, and another seat is free before.
  const { left } = gateway;
  gateway.left = (socket) => void setTimeout(() => left.call(gateway, socket), 500);
  await page.reload();
  const free = page.getByLabel('Free seat');
  await expect(free).toHaveValue('trainee1');
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainer.');
  await page.getByRole('button', { name: 'Leave seat' }).click();
  await expect(free).toHaveValue('trainer');
  // A choice of the person stays.
  await free.selectOption('trainee2');
  await page.getByRole('button', { name: 'Take seat' }).click();
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainee2.');
  await page.getByRole('button', { name: 'Leave seat' }).click();
  await expect(free).toHaveValue('trainee2');
});
