/** Speeds that the page offers. */
export const kSpeeds = [0.25, 0.5, 1, 2, 4] as const;

/** Time of a recording that is played. It knows neither the document nor the clock of the browser. */
export class PlayerClock {
  private at: number;
  private last_ms: number | null = null;
  speed = 1;
  playing = false;

  /** @param from,to session time of the first state, and after the last one [s] */
  constructor(
    readonly from: number,
    readonly to: number,
  ) {
    this.at = from;
  }

  /** Session time that is shown [s]. */
  get t(): number {
    return this.at;
  }

  /** Goes on by the time since the last call. Time stands still while `waiting`, and playing ends at the end. */
  advance(now_ms: number, waiting: boolean): void {
    const step_ms = this.last_ms === null ? 0 : now_ms - this.last_ms;
    this.last_ms = now_ms;
    if (!this.playing || waiting || !(step_ms > 0)) return;
    this.seek(this.at + (Math.min(step_ms, 250) / 1000) * this.speed);
    if (this.at >= this.to) this.playing = false;
  }

  /** Plays or pauses. At the end, playing begins again. */
  toggle(): void {
    if (!this.playing && this.at >= this.to) this.at = this.from;
    this.playing = !this.playing;
  }

  /** @param t session time [s]; beyond the recording: its begin or end */
  seek(t: number): void {
    if (Number.isFinite(t)) this.at = Math.min(this.to, Math.max(this.from, t));
  }

  /** Pauses and moves by a time [s]. */
  step(by: number): void {
    this.playing = false;
    this.seek(this.at + by);
  }
}
