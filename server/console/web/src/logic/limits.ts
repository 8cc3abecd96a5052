import type { SceneSeat, SeatState } from '../protocol/messages';

/** Bands of `tandem-client link-test`: green is sufficient for stiff contact, amber for slow motion. */
export type Band = 'green' | 'amber' | 'red' | 'unknown';

/** Green up to `green`, amber up to `amber`, both inclusive. Source: netsim/quality/bands.h. */
export interface BandLimits {
  green: number;
  amber: number;
}
export const kRoundTripLimits: BandLimits = { green: 20, amber: 100 };
export const kGapLimits: BandLimits = { green: 5, amber: 50 };
export const kLossLimits: BandLimits = { green: 0.1, amber: 10 };
/** Age of the newest sample of a seat [ms]: the same limits as a gap. */
export const kAgeLimits: BandLimits = kGapLimits;
/** Shares of the force limit: amber from 80 %, red from the limit on. */
export const kForceAmber = 0.8;
export const kForceRed = 0.999;

const kOrder: readonly Band[] = ['unknown', 'green', 'amber', 'red'];

export function bandOf(value: number | null, limits: BandLimits): Band {
  if (value === null || !Number.isFinite(value)) return 'unknown';
  return value <= limits.green ? 'green' : value <= limits.amber ? 'amber' : 'red';
}

export function worst(bands: readonly Band[]): Band {
  return bands.reduce<Band>((a, b) => (kOrder.indexOf(b) > kOrder.indexOf(a) ? b : a), 'unknown');
}

export function forceMagnitude(seat: Pick<SeatState, 'f'>): number | null {
  return seat.f === null ? null : Math.hypot(...seat.f);
}

/** Share of the force limit in [0, ...), or null if force or limit is unknown. */
export function forceShare(seat: SeatState, scene: SceneSeat | undefined): number | null {
  const force = forceMagnitude(seat);
  const limit = scene?.force_limit_n ?? null;
  return force === null || limit === null || !(limit > 0) ? null : force / limit;
}

export function forceBand(share: number | null): Band {
  if (share === null) return 'unknown';
  return share >= kForceRed ? 'red' : share >= kForceAmber ? 'amber' : 'green';
}

/** The device cannot show the whole force: it is limited. */
export function isClipping(seat: SeatState, scene: SceneSeat | undefined): boolean {
  return forceBand(forceShare(seat, scene)) === 'red';
}

/** Energy left before passivity control adds damping [J]. */
export function marginBand(margin_j: number | null): Band {
  if (margin_j === null) return 'unknown';
  return margin_j > 0.005 ? 'green' : margin_j > 0 ? 'amber' : 'red';
}

export function gateBand(gate: string | null): Band {
  if (gate === null) return 'unknown';
  if (gate === 'LATCHED' || gate === 'FAULT') return 'red';
  return gate === 'ON' ? 'green' : 'amber';
}

/** Device temperature [°C]: amber from 50, red from 65. */
export function temperatureBand(celsius: number | null): Band {
  return celsius === null ? 'unknown' : celsius < 50 ? 'green' : celsius < 65 ? 'amber' : 'red';
}

/** Link quality in the words of `link-test`: the worst of loss, gap and round trip. */
export function linkBand(seat: SeatState): Band {
  return worst([
    bandOf(seat.rtt_ms, kRoundTripLimits),
    bandOf(seat.loss_percent, kLossLimits),
    bandOf(seat.gap_ms, kGapLimits),
  ]);
}
