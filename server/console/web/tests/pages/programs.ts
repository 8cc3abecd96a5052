import { spawn, type ChildProcess } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { expect, test as base, type Locator, type Page } from '@playwright/test';

/** Folder of the built programs; without it only the mock gateway is tested. */
const folder = process.env.TANDEM_PROGRAMS ?? '';

/** A program of Tandem that runs. */
export interface Program {
  child: ChildProcess;
  /** Part of its output that the expression captures, once it is there. */
  said: (expression: RegExp) => Promise<string>;
  end: (signal: NodeJS.Signals) => Promise<void>;
  /** Waits until it has ended by itself, without trouble. */
  ended: () => Promise<void>;
}

function start(name: string, ...args: string[]): Program {
  const child = spawn(`${folder}/${name}`, args, { stdio: ['ignore', 'pipe', 'pipe'] });
  let text = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (data: Buffer) => (text += data.toString()));
  return {
    child,
    said: async (expression) => {
      await expect.poll(() => text, { timeout: 20_000 }).toMatch(expression);
      return expression.exec(text)?.[1] ?? '';
    },
    end: (signal) =>
      new Promise((resolve) => {
        if (child.exitCode !== null || child.signalCode !== null) return resolve();
        child.on('exit', () => resolve());
        child.kill(signal);
      }),
    ended: async () => {
      await expect.poll(() => child.exitCode, { message: text, timeout: 20_000 }).toBe(0);
    },
  };
}

interface Fixtures {
  /** Starts a program; it ends with the test. */
  run: typeof start;
  /** A folder of this test, removed after it. */
  place: string;
}

export const test = base.extend<Fixtures>({
  // It needs the folder of the test, so that its programs have ended when the folder is removed.
  // eslint-disable-next-line @typescript-eslint/no-unused-vars
  run: async ({ place: _place }, use) => {
    const programs: Program[] = [];
    await use((name, ...args) => {
      const program = start(name, ...args);
      programs.push(program);
      return program;
    });
    for (const program of programs.reverse()) await program.end('SIGINT');
  },
  // eslint-disable-next-line no-empty-pattern
  place: async ({}, use) => {
    const made = mkdtempSync(join(tmpdir(), 'tandem-pages-'));
    await use(made);
    rmSync(made, { recursive: true, maxRetries: 10, retryDelay: 200 });
  },
});
/** Call at the begin of a file: its tests need the built programs. */
export const needPrograms = (): void => {
  test.skip(folder === '', 'TANDEM_PROGRAMS names no folder with tandem-console, tandem-server and tandem-client');
  // A page that stays open draws on, and slows the tests after it.
  test.afterEach(async ({ browser }) => {
    for (const context of browser.contexts()) await context.close();
  });
};

export { expect } from '@playwright/test';

/** Address of the server that the program runs. */
export const addressOf = (host: Program): Promise<string> => host.said(/listening on (\S+)/);
/** URL with a one-time token that a gateway printed. */
export const urlOf = (gateway: Program): Promise<string> => gateway.said(/once: (http:\S+)/);
export const phaseOf = (page: Page): Locator => page.locator('.badge[data-phase]');
