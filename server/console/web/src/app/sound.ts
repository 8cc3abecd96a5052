import type { Scene, State } from '../protocol/messages';
import { isClipping } from '../logic/limits';

/** Contact, force limit and the own force as sound. Off until the person switches it on. */
export class Sound {
  private context: AudioContext | null = null;
  private own: { tone: OscillatorNode; gain: GainNode } | null = null;
  private touching: boolean[] = [];
  private nextLimit = 0;

  get on(): boolean {
    return this.context !== null;
  }

  /** Call within a click: browsers start sound by an action of the person only. */
  switch(on: boolean): void {
    if (on === this.on) return;
    if (on) {
      this.context = new AudioContext();
    } else {
      void this.context?.close();
      this.context = null;
      this.own = null;
    }
  }

  /** Contact: a short low tone when a tool begins to touch. Limit: a high tone twice per second while a force is limited. */
  update(state: State, scene: Scene | null, now_ms: number): void {
    const before = this.touching;
    this.touching = state.tools.map((tool) => tool.touching === true);
    if (!this.context) return;
    if (this.touching.some((touches, i) => touches && before[i] === false)) this.beep(190, 0.08, 0.25);
    const clipping = state.seats.some((seat, i) => isClipping(seat, scene?.seats[i]));
    if (clipping && now_ms >= this.nextLimit) {
      this.nextLimit = now_ms + 500;
      this.beep(980, 0.06, 0.12);
    }
  }

  /** The force on the own hand as a quiet tone: pitch and loudness rise with the share of the limit. Null is silent. */
  ownForce(share: number | null): void {
    const context = this.context;
    if (!context) return;
    if (!this.own) {
      const tone = new OscillatorNode(context, { type: 'sine', frequency: 220 });
      const gain = new GainNode(context, { gain: 0 });
      tone.connect(gain).connect(context.destination);
      tone.start();
      this.own = { tone, gain };
    }
    const level = Math.min(1, Math.max(0, share ?? 0));
    this.own.tone.frequency.setTargetAtTime(180 + 360 * level, context.currentTime, 0.03);
    this.own.gain.gain.setTargetAtTime(0.12 * level, context.currentTime, 0.03);
  }

  private beep(frequency: number, seconds: number, loudness: number): void {
    const context = this.context;
    if (!context) return;
    const tone = new OscillatorNode(context, { type: 'sine', frequency });
    const gain = new GainNode(context, { gain: loudness });
    gain.gain.setTargetAtTime(0, context.currentTime + seconds * 0.5, seconds * 0.2);
    tone.connect(gain).connect(context.destination);
    tone.start();
    tone.stop(context.currentTime + seconds * 2);
  }
}
