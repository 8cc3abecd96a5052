import { test as base, type Page } from '@playwright/test';

import { startMock, type MockGateway } from '../mock/gateway.mjs';

export type Options = Parameters<typeof startMock>[0];

interface Fixtures {
  /** Starts a mock gateway; it ends with the test. */
  start: (options?: Options) => Promise<MockGateway>;
  /** Opens the page with a token of its own and waits for the first state. */
  open: (gateway: MockGateway, person?: string, role?: string) => Promise<Page>;
}

export const test = base.extend<Fixtures>({
  // eslint-disable-next-line no-empty-pattern
  start: async ({}, use) => {
    const started: MockGateway[] = [];
    await use(async (options = {}) => {
      const gateway = await startMock(options);
      started.push(gateway);
      return gateway;
    });
    for (const gateway of started) await gateway.stop();
  },
  open: async ({ browser }, use) => {
    const pages: Page[] = [];
    const errors: string[] = [];
    await use(async (gateway, person, role) => {
      const context = await browser.newContext();
      const page = await context.newPage();
      pages.push(page);
      // A violation of the content security policy is an error of the console as well.
      page.on('pageerror', (error) => errors.push(error.message));
      page.on('console', (message) => {
        if (message.type() === 'error' && !/WebSocket|Failed to load resource/.test(message.text()))
          errors.push(message.text());
      });
      await page.goto(gateway.entry(person, role));
      await base.expect(page.locator('.delay')).toContainText('Delay');
      return page;
    });
    for (const page of pages) await page.context().close();
    base.expect(errors).toEqual([]);
  },
});

export { expect } from '@playwright/test';

export const view = (page: Page, name: string): Promise<void> => page.locator(`[data-view=${name}]`).click();
