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

// Tests that state speeds of the page, or listen to its sound, run alone after all others.
const alone = /(delay|first_picture|gateway|load|sound)\.spec\.ts$/;
// Looks, speeds and a lesson of twelve hours take half as long as all others: only with `./test --full`.
const full = ['full', 'nightly'].includes(process.env.TANDEM_COUNTS ?? 'reduced');
const long = full ? [] : [/(appearance|delay|first_picture|lesson|load)\.spec\.ts$/];

export default defineConfig({
  testDir: 'tests/pages',
  outputDir: 'test-results',
  workers: 2,
  projects: [
    { name: 'together', testIgnore: [alone, ...long] },
    { name: 'alone', testMatch: alone, testIgnore: long, workers: 1, retries: 0, dependencies: ['together'] },
  ],
  // A pause of the computer is not a fault of the page. `check` prints how many tests needed this.
  retries: 1,
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
