import type { Page } from '@playwright/test';

import type { MockGateway } from '../mock/gateway.mjs';
import { expect, test, view } from './fixture';

/** Reach of the pad per axis [m]. */
const kReach = 0.06;

async function seated(page: Page): Promise<void> {
  await view(page, 'seat');
  await page.getByRole('button', { name: 'Take seat' }).click();
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainee.');
}

const hand = (gateway: MockGateway): { wish: number[]; pressed: boolean } => gateway.session.seats[1]!;
/** Intended place of the hand [mm]: to the right, away, up. */
const millimetres = (gateway: MockGateway): number[] => hand(gateway).wish.map((x) => Math.round(x * 1000));
/** The two coordinates that the pad moves: to the right and up [mm]. */
const onPad = (gateway: MockGateway): number[] => [millimetres(gateway)[0] ?? NaN, millimetres(gateway)[2] ?? NaN];

test('a finger moves and holds the hand; the page does not scroll', async ({ start, browser }) => {
  const gateway = await start({ freeSeat: true });
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const page = await context.newPage();
  await page.goto(gateway.entry('ted', 'TRAINEE'));
  await seated(page);
  await page.locator('.pad').scrollIntoViewIfNeeded();
  const box = (await page.locator('.pad').boundingBox())!;
  const scrolled = await page.evaluate(() => scrollY);
  const [x, y, half] = [box.x + box.width / 2, box.y + box.height / 2, Math.min(box.width, box.height) / 2];
  const devtools = await context.newCDPSession(page);
  const touch = async (
    type: 'touchStart' | 'touchMove' | 'touchEnd' | 'touchCancel',
    ...points: number[][]
  ): Promise<void> => {
    const touchPoints = points.map(([px, py], id) => ({ x: px ?? 0, y: py ?? 0, id }));
    await devtools.send('Input.dispatchTouchEvent', { type, touchPoints });
  };
  await touch('touchStart', [x, y]);
  await expect.poll(() => hand(gateway).pressed).toBe(true);
  for (let i = 1; i <= 10; i += 1) await touch('touchMove', [x + (i / 20) * half, y - (i / 20) * half]);
  // Half of the way to the edge is half of the reach, to the right and up.
  await expect.poll(() => onPad(gateway)).toEqual([30, 30]);
  expect(hand(gateway).pressed).toBe(true);
  // A second finger takes nothing over, and its end does not release the hand.
  await touch('touchStart', [x + half / 2, y - half / 2], [x - half / 2, y]);
  await touch('touchMove', [x + half / 2, y - half / 2], [x - half / 2, y + 20]);
  await touch('touchMove', [x + half / 2, y - half / 2]);
  await page.waitForTimeout(200);
  expect([onPad(gateway), hand(gateway).pressed]).toEqual([[30, 30], true]);
  await touch('touchEnd');
  await expect.poll(() => hand(gateway).pressed).toBe(false);
  expect(await page.evaluate(() => scrollY)).toBe(scrolled);
  // A touch that the browser takes away, for example for a gesture of the system, releases as well.
  await touch('touchStart', [x, y]);
  await expect.poll(() => hand(gateway).pressed).toBe(true);
  await touch('touchCancel');
  await expect.poll(() => hand(gateway).pressed).toBe(false);
  await context.close();
});

/** Sets what `navigator.getGamepads` returns; null: no gamepad is connected. */
async function gamepad(page: Page, axes: number[] | null, button = false): Promise<void> {
  await page.evaluate(
    ([sticks, pressed]) => {
      const pad = sticks && {
        connected: true,
        axes: sticks,
        buttons: [{ pressed, touched: pressed, value: pressed ? 1 : 0 }],
      };
      navigator.getGamepads = () => [null, pad as unknown as Gamepad | null];
    },
    [axes, button] as const,
  );
}

test('a gamepad moves the hand with its sticks and holds it with its first button', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const page = await open(gateway, 'ted', 'TRAINEE');
  await seated(page);
  await gamepad(page, [0, 0, 0, 0], true);
  await expect(page.locator('.seat-panel')).toContainText('Gamepad connected.');
  await expect.poll(() => hand(gateway).pressed).toBe(true);
  const begin = [...hand(gateway).wish];
  // Left stick to the right, right stick away: to the limit of the reach, at 0.12 m/s.
  await gamepad(page, [1, 0, 0, -1], true);
  await expect.poll(() => millimetres(gateway).slice(0, 2)).toEqual([kReach * 1000, kReach * 1000]);
  expect(Math.abs((hand(gateway).wish[2] ?? 0) - (begin[2] ?? 0))).toBeLessThan(1e-9);
  // Left stick down.
  await gamepad(page, [0, 1, 0, 0], true);
  await expect.poll(() => millimetres(gateway)[2]).toBe(-kReach * 1000);
  // Deflections in the dead zone, and values that are no number, move nothing.
  const held = [...hand(gateway).wish];
  await gamepad(page, [0.1, -0.1, 0, NaN], true);
  await page.waitForTimeout(300);
  expect(hand(gateway).wish).toEqual(held);
  await gamepad(page, [0, 0, 0, 0], false);
  await expect.poll(() => hand(gateway).pressed).toBe(false);
});

test('a gamepad that is unplugged releases the hand', async ({ start, open }) => {
  const gateway = await start({ freeSeat: true });
  const page = await open(gateway, 'ted', 'TRAINEE');
  await seated(page);
  await gamepad(page, [0, 0, 0, 0], true);
  await expect.poll(() => hand(gateway).pressed).toBe(true);
  await gamepad(page, null);
  await expect.poll(() => hand(gateway).pressed).toBe(false);
});
