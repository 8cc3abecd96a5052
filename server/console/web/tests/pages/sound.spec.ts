import type { Page } from '@playwright/test';

import { expect, test, view } from './fixture';

/** What the page's sound was within a time. */
interface Heard {
  /** Largest amplitude; full scale is 1. */
  peak: number;
  /** Frequency with the largest amplitude [Hz]; 0 in silence. */
  frequency: number;
}

declare global {
  interface Window {
    listen: (milliseconds: number) => Promise<Heard>;
  }
}

/** Runs before the code of the page: puts an analyser between the page's sound and the output of the computer. */
function tap(): void {
  let analyser: AnalyserNode | null = null;
  const connect = AudioNode.prototype.connect as (this: AudioNode, to: AudioNode) => AudioNode;
  AudioNode.prototype.connect = function (this: AudioNode, to: AudioNode): AudioNode {
    if (!(to instanceof AudioDestinationNode)) return connect.call(this, to);
    if (analyser?.context !== this.context) {
      analyser = new AnalyserNode(this.context, { fftSize: 4096, smoothingTimeConstant: 0 });
      connect.call(analyser, to);
    }
    return connect.call(this, analyser);
  } as typeof AudioNode.prototype.connect;
  window.listen = async (milliseconds) => {
    const heard: Heard = { peak: 0, frequency: 0 };
    let loudest = -Infinity;
    for (const end = performance.now() + milliseconds; performance.now() < end; ) {
      await new Promise((resolve) => setTimeout(resolve, 15));
      // A closed context plays nothing.
      if (!analyser || analyser.context.state === 'closed') continue;
      const wave = new Float32Array(analyser.fftSize);
      analyser.getFloatTimeDomainData(wave);
      heard.peak = Math.max(heard.peak, ...wave.map(Math.abs));
      const spectrum = new Float32Array(analyser.frequencyBinCount);
      analyser.getFloatFrequencyData(spectrum);
      spectrum.forEach((level, i) => {
        if (level <= loudest || level < -70) return;
        loudest = level;
        heard.frequency = (i * (analyser?.context.sampleRate ?? 0)) / 4096;
      });
    }
    return heard;
  };
}

const listen = (page: Page, milliseconds = 1500): Promise<Heard> =>
  page.evaluate((ms) => window.listen(ms), milliseconds);
const kSilent = 1e-4;
/** Width of one line of the spectrum at 48 kHz, twice [Hz]. */
const kResolution = 24;

test('contact and force limits are heard when sound is on, and not when it is off', async ({ start, browser }) => {
  const gateway = await start();
  const { session } = gateway;
  // The session stands still; the test alone touches and presses.
  session.step = () => (session.t += 1 / 60);
  const context = await browser.newContext();
  await context.addInitScript(tap);
  const page = await context.newPage();
  await page.goto(gateway.entry());
  await expect(page.locator('.delay')).toContainText('Delay');
  const touch = async (): Promise<Heard> => {
    const heard = listen(page);
    await page.waitForTimeout(300);
    session.tool.touching = true;
    const result = await heard;
    session.tool.touching = false;
    return result;
  };
  const sound = page.getByRole('checkbox', { name: 'Sound' });
  expect((await touch()).peak).toBe(0);
  await sound.check();
  expect((await listen(page, 500)).peak).toBeLessThan(kSilent);
  const contact = await touch();
  expect(contact.peak).toBeGreaterThan(0.05);
  expect(Math.abs(contact.frequency - 190)).toBeLessThan(kResolution);
  expect((await listen(page, 500)).peak).toBeLessThan(kSilent);

  // The force of a seat at its limit: a high tone, repeated as long as it lasts.
  session.seats[1]!.f = [3.3, 0, 0];
  for (let i = 0; i < 2; i += 1) {
    const limit = await listen(page, 1200);
    expect(limit.peak).toBeGreaterThan(0.03);
    expect(Math.abs(limit.frequency - 980)).toBeLessThan(kResolution);
  }
  await sound.uncheck();
  expect((await listen(page, 1200)).peak).toBe(0);
  session.seats[1]!.f = [0, 0, 0];
  await context.close();
});

test('the force on the own hand is heard: louder and higher with the force', async ({ start, browser }) => {
  const gateway = await start({ freeSeat: true });
  const { session } = gateway;
  session.step = () => (session.t += 1 / 60);
  const context = await browser.newContext();
  await context.addInitScript(tap);
  const page = await context.newPage();
  await page.goto(gateway.entry('ted', 'TRAINEE'));
  await page.getByRole('checkbox', { name: 'Sound' }).check();
  await view(page, 'seat');
  await page.getByRole('button', { name: 'Take seat' }).click();
  await expect(page.locator('.seat-panel')).toContainText('You have seat trainee.');
  const at = async (newtons: number): Promise<Heard> => {
    session.seats[1]!.f = [0, newtons, 0];
    await page.waitForTimeout(500);
    return listen(page, 500);
  };
  expect((await at(0)).peak).toBeLessThan(1e-3);
  const [light, strong] = [await at(0.8), await at(2.4)];
  expect(light.peak).toBeGreaterThan(0.01);
  expect(strong.peak).toBeGreaterThan(2 * light.peak);
  // 180 Hz without force, 540 Hz at the limit of 3.3 N.
  expect(Math.abs(light.frequency - 267)).toBeLessThan(kResolution);
  expect(Math.abs(strong.frequency - 442)).toBeLessThan(kResolution);
  // Another view shows no own hand, so that nothing is heard of it.
  await view(page, 'live');
  await page.waitForTimeout(500);
  expect((await listen(page, 500)).peak).toBeLessThan(1e-3);
  await context.close();
});
