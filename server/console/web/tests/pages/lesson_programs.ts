import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import type { Browser, Page } from '@playwright/test';

import { addressOf, expect, type Program } from './programs';

type Run = (name: string, ...args: string[]) => Program;

/** A message of the gateway, as it came. */
export interface Message {
  type: string;
  [key: string]: unknown;
}

/** A person with a page of their own. */
export interface Person {
  page: Page;
  /** Messages that the page received, the newest last. */
  received: Message[];
  /** Sends a frame past all controls of the page and returns the reply. */
  sendByHand: (frame: Record<string, unknown>) => Promise<Message>;
}

/** A server with keys and one enrolled workstation, and a gateway where persons sign in with tickets. */
export class LessonPrograms {
  private next = 900;

  private constructor(
    private readonly run: Run,
    private readonly place: string,
    readonly server: string,
    readonly host: Program,
    readonly url: string,
    readonly gateway: Program,
  ) {}

  static async start(run: Run, place: string, scene: string): Promise<LessonPrograms> {
    const state = join(place, 'state');
    const own = join(place, 'own');
    await run('tandem-server', 'init', '--state', state).ended();
    const config = join(place, 'lesson.textproto');
    writeFileSync(
      config,
      `version: 1 listen: "127.0.0.1:0" state: "state" session { name: "lesson" scene: "${scene}" duration_s: 3600 }`,
    );
    const host = run('tandem-server', 'serve', config);
    const server = await addressOf(host);
    const code = await run('tandem-server', 'enroll', 'desk', '--state', state).said(/^(tandem:\S+)$/m);
    await run('tandem-client', 'enroll', code, '--state', own).ended();
    const gateway = run('tandem-console', '--sign-in', '--server', server, '--state', own, '--listen', '127.0.0.1:0');
    const url = await gateway.said(/ticket: (http:\S+?)\/join/);
    return new LessonPrograms(run, place, server, host, url, gateway);
  }

  ticket(...right: string[]): Promise<string> {
    const words = ['--session', 'lesson', '--workstation', 'desk', '--state', join(this.place, 'state')];
    return this.run('tandem-server', 'ticket', ...words, ...right).said(/^(ticket:\S+)$/m);
  }

  /** Takes a seat with a simulated device. */
  async join(seat: string): Promise<void> {
    const words = ['--server', this.server, '--state', join(this.place, 'own'), '--device', 'sim'];
    this.run('tandem-client', 'join', ...words, '--seat', seat, '--ticket', await this.ticket('--seat', seat));
  }

  /** Signs in at the page, in a browser profile of its own. */
  async person(browser: Browser, name: string, role: string): Promise<Person> {
    const context = await browser.newContext();
    await context.addInitScript(() => {
      const Real = window.WebSocket;
      window.WebSocket = class extends Real {
        constructor(url: string | URL, protocols?: string | string[]) {
          super(url, protocols);
          (window as unknown as { socket: WebSocket }).socket = this;
        }
      };
    });
    const page = await context.newPage();
    const received: Message[] = [];
    page.on('websocket', (socket) =>
      socket.on('framereceived', ({ payload }) => {
        received.push(JSON.parse(String(payload)) as Message);
        if (received.length > 2000) received.splice(0, 1000);
      }),
    );
    await page.goto(this.url);
    await page.getByLabel('Ticket').fill(await this.ticket('--role', role));
    await page.getByLabel('Your name').fill(name);
    await page.getByRole('button', { name: 'Join' }).click();
    await expect(page.locator('.delay')).toContainText('Delay', { timeout: 20_000 });
    const sendByHand = async (frame: Record<string, unknown>): Promise<Message> => {
      const id = (this.next += 1);
      await page.evaluate(
        (text) => (window as unknown as { socket: WebSocket }).socket.send(text),
        JSON.stringify({ ...frame, id }),
      );
      const reply = (): Message | undefined =>
        received.find((message) => message.type === 'reply' && message.id === id);
      await expect.poll(reply).toBeDefined();
      return reply()!;
    };
    return { page, received, sendByHand };
  }
}
