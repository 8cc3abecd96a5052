/** Share of a seat before and after a change of authority, in [0, 1]. */
export interface ShareChange {
  seat: string;
  before: number;
  after: number;
}

/** Facts in the line of an event, as `audit_text` of server/report/audit_text.cpp writes it. */
export interface EventFacts {
  /** First word of the line: a seat, or what gave the event. */
  origin: string;
  /** Tool whose authority changes; empty: none. */
  tool: string;
  shares: readonly ShareChange[];
  /** Seat whose link is stale; empty: none. */
  stale: string;
}

/** Returns the facts, or null if the line has another form. */
export function readEventText(text: string): EventFacts | null {
  const [, origin, tool = '', rest] = /^(\S+)(?: (\S+))?(?: version \d+)? tick \d+(.*)$/.exec(text) ?? [];
  if (origin === undefined || rest === undefined) return null;
  const shares = [...rest.matchAll(/[:,] (\S+) ([\d.]+) to ([\d.]+)/g)].map(([, seat = '', before, after]) => ({
    seat,
    before: Number(before),
    after: Number(after),
  }));
  return { origin, tool, shares, stale: /; the link of (\S+) is stale$/.exec(rest)?.[1] ?? '' };
}
