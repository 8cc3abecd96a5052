import type { State } from '../protocol/messages';
import { object, text } from '../protocol/json';
import { readList, readOutline, readPiece, type Outline, type RecordingList } from '../protocol/recordings';
import { readScores, type Scores } from '../protocol/scores';
import { t } from '../strings/strings';

const kPoll_ms = 400;

/** The gateway refused or could not answer; the message is for the person. */
export class RecordingError extends Error {}

interface Answer {
  status: number;
  body: unknown;
}

async function ask(path: string): Promise<Answer> {
  let reply: Response;
  let body: unknown;
  try {
    reply = await fetch(path, { cache: 'no-store', credentials: 'same-origin' });
    body = await reply.json();
  } catch {
    throw new RecordingError(t('recordings.unreachable'));
  }
  if (!reply.ok) throw new RecordingError(text(object(body).problem) || t('recordings.unreachable'));
  return { status: reply.status, body };
}

/** Repeats a request while the gateway prepares its answer. @param report share that is done, 0 to 1 */
async function askUntilReady(path: string, report: (share: number) => void): Promise<unknown> {
  for (;;) {
    const { status, body } = await ask(path);
    if (status !== 202) return body;
    const share = object(body).progress;
    report(typeof share === 'number' ? share : 0);
    await new Promise((resolve) => setTimeout(resolve, kPoll_ms));
  }
}

export async function fetchList(): Promise<RecordingList> {
  return readList((await ask('/recordings')).body);
}

export async function fetchOutline(id: string, report: (share: number) => void): Promise<Outline> {
  const outline = readOutline(await askUntilReady(`/recordings/${encodeURIComponent(id)}`, report));
  if (!outline) throw new RecordingError(t('recordings.unreadable'));
  return outline;
}

export async function fetchPiece(id: string, piece: number): Promise<State[]> {
  return readPiece(await askUntilReady(`/recordings/${encodeURIComponent(id)}/pieces/${piece}`, () => undefined));
}

export async function fetchScores(id: string): Promise<Scores> {
  const scores = readScores(await askUntilReady(`/recordings/${encodeURIComponent(id)}/scores`, () => undefined));
  if (!scores) throw new RecordingError(t('recordings.unreadable'));
  return scores;
}
