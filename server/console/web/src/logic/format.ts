/** Text for an unknown value. */
export const kUnknown = '–';

/** Returns a number with a fixed number of digits, or a dash if it is unknown. Never "-0". */
export function fixed(value: number | null | undefined, digits: number, unit = ''): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return kUnknown;
  const text = value.toFixed(digits);
  const shown = Number(text) === 0 ? (0).toFixed(digits) : text;
  return unit ? `${shown}\u202f${unit}` : shown;
}

/** Returns a share in [0, 1] as percent without digits. */
export function percent(share: number | null | undefined): string {
  return fixed(share === null || share === undefined ? null : share * 100, 0, '%');
}

/** Returns a session time as m:ss.s, or h:mm:ss from an hour on. */
export function clock(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return kUnknown;
  const tenths = Math.max(0, Math.floor(seconds * 10 + 1e-6));
  const whole = Math.floor(tenths / 10);
  const pad = (n: number): string => String(n).padStart(2, '0');
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return h > 0 ? `${h}:${pad(m)}:${pad(s)}` : `${m}:${pad(s)}.${tenths % 10}`;
}
