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

export default defineConfig({
  testDir: 'tests/pages',
  outputDir: 'test-results',
  workers: 2,
  projects: [
    { name: 'together', testIgnore: alone },
    { name: 'alone', testMatch: alone, workers: 1, dependencies: ['together'] },
  ],
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
