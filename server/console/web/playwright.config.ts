import { existsSync } from 'node:fs';

import { defineConfig } from '@playwright/test';

// The browser of the system; no browser is downloaded. TANDEM_CHROMIUM names another one.
const candidates = [
  process.env.TANDEM_CHROMIUM,
  '/usr/bin/chromium',
  '/usr/bin/chromium-browser',
  '/usr/bin/google-chrome',
];
const chromium = candidates.find((path) => path !== undefined && existsSync(path));

export default defineConfig({
  testDir: 'tests/pages',
  outputDir: 'test-results',
  workers: 1,
  timeout: 60_000,
  expect: { timeout: 10_000 },
  reporter: [['list']],
  use: {
    launchOptions: {
      executablePath: chromium ?? '',
      // Software rendering: results do not depend on a graphics processor.
      args: [
        '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader',
        '--no-sandbox',
        '--autoplay-policy=no-user-gesture-required',
      ],
    },
    locale: 'en-GB',
    viewport: { width: 1280, height: 720 },
  },
});
