import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** What the page of a fast lesson offers to its test. */
export interface FastLesson {
  /** Hands `states` states to the page, 1/60 s of virtual time each, with a frame of the screen for every second one. */
  run: (states: number) => Promise<void>;
  /** Lets virtual time pass without states [s]. */
  skip: (seconds: number) => void;
  trouble: (text: string) => void;
  mark: (text: string) => void;
  states: number;
  acknowledged: number;
}

interface Session {
  t: number;
  seats: { heard: boolean; trips: number }[];
  marks: object[];
  step: (dt: number) => void;
  state: (n: number, dropped: number, person: string, role: string) => object;
  scene: () => object;
  notes: (person: string) => object;
  event: (text: string) => void;
  events: object[];
}

/**
 * Runs inside the page, before its own code. Replaces the clock, the frames of the screen and the WebSocket by a session in
 * virtual time: each state is a text that the page reads, checks and shows as one of the gateway. Only the rasterization
 * of the picture is left out.
 */
function install(MockSession: new (options: object) => Session, sessionId: string): void {
  const later = window.setTimeout.bind(window);
  const realNow = performance.now.bind(performance);
  const session = new MockSession({ seats: 8 });
  let frames: FrameRequestCallback[] = [];
  let now = 0;
  let socket: Source | null = null;
  performance.now = () => now;
  window.requestAnimationFrame = (callback) => frames.push(callback);
  const nothing = (): void => undefined;
  Object.assign(WebGL2RenderingContext.prototype, { drawElements: nothing, drawArrays: nothing, clear: nothing });

  class Source {
    static readonly OPEN = 1;
    readyState = 1;
    onopen: () => void = nothing;
    onmessage: (event: { data: string }) => void = nothing;
    onclose: () => void = nothing;
    constructor() {
      // eslint-disable-next-line @typescript-eslint/no-this-alias
      socket = this;
      later(() => {
        this.onopen();
        this.tell({
          type: 'hello',
          protocol: 1,
          release: '0.0.0',
          person: 'ina',
          role: 'OPERATOR',
          may: ['stop', 'pause', 'resume', 'authority', 'remove', 'drain', 'create', 'seat', 'score'],
          sessions: [{ id: sessionId, name: 'contact', state: 'RUNNING' }],
        });
        this.tell(session.scene());
        this.tell(session.notes('ina'));
      }, 0);
    }
    tell(message: object): void {
      this.onmessage({ data: JSON.stringify(message) });
    }
    send(text: string): void {
      const frame = JSON.parse(text) as { type: string; id?: number; n?: number };
      if (frame.type === 'ack') lesson.acknowledged = frame.n ?? 0;
      else if (frame.id !== undefined)
        later(() => this.tell({ type: 'reply', id: frame.id ?? null, ok: true, text: '' }), 0);
    }
    close(): void {
      this.readyState = 3;
    }
  }
  (window as unknown as { WebSocket: unknown }).WebSocket = Source;

  const lesson: FastLesson = {
    states: 0,
    acknowledged: 0,
    run: async (states) => {
      let sliced = realNow();
      for (let i = 0; i < states; i += 1) {
        session.step(1 / 60);
        now += 1000 / 60;
        lesson.states += 1;
        socket?.tell(session.state(lesson.states, 0, 'ina', 'OPERATOR'));
        if (lesson.states % 2 !== 0) continue;
        const due = frames;
        frames = [];
        for (const frame of due) frame(now);
        // The browser lays out and paints what has changed.
        if (realNow() - sliced < 100) continue;
        await new Promise((resolve) => later(resolve, 0));
        sliced = realNow();
      }
    },
    skip: (seconds) => {
      session.t += seconds;
      now += seconds * 1000;
    },
    trouble: (text) => {
      session.event(text);
      socket?.tell(session.events.at(-1) ?? {});
      session.seats.forEach((seat, i) => {
        seat.trips += 1;
        seat.heard = !seat.heard || i > 2;
      });
    },
    mark: (text) => {
      session.marks.push({ t: session.t, text, person: 'eva' });
      socket?.tell(session.notes('ina'));
    },
  };
  (window as unknown as { lesson: FastLesson }).lesson = lesson;
}

/** Returns the script that makes a page a fast lesson. */
export function fastLessonScript(): string {
  const source = readFileSync(fileURLToPath(new URL('../mock/session.mjs', import.meta.url)), 'utf8');
  return `(() => { ${source.replace(/^export /gm, '')}\n(${install.toString()})(MockSession, kSession); })();`;
}
