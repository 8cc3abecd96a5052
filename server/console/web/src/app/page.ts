import type { SessionModel } from '../logic/session_model';
import type { Drawn } from '../logic/state_window';
import type { Notice, OrderBody, Reply, Request } from '../protocol/messages';
import type { Connection } from './connection';
import type { Sound } from './sound';

export type ViewName = 'live' | 'instructor' | 'evaluator' | 'seat' | 'desk' | 'recordings';

/** What the views share. */
export interface Page {
  readonly model: SessionModel;
  readonly connection: Connection;
  readonly sound: Sound;
  /** Picture with its overlay; the shown view appends it to its slot. */
  readonly pictureHost: HTMLElement;
  /** Sends an order of the lesson and reports a refusal with the words `what`. */
  order(what: string, body: OrderBody): Promise<Reply>;
  /** Sends any other request and reports a refusal with the words `what`. */
  request(what: string, body: Request): Promise<Reply>;
  report(level: Notice['level'], text: string): void;
}

/** One view or panel. */
export interface View {
  readonly node: HTMLElement;
  /** Called ten times per second while the view is shown. */
  update(): void;
  /** Called for each frame of the screen while the view is shown. */
  frame?(drawn: Drawn | null, now_ms: number): void;
  shown?(): void;
  hidden?(): void;
}
