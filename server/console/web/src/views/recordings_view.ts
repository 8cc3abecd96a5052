import { LoadedRecording } from '../app/loaded_recording';
import type { Page, View } from '../app/page';
import { fetchList, fetchOutline } from '../app/recording_client';
import type { Drawn } from '../logic/state_window';
import type { RecordingList } from '../protocol/recordings';
import { t } from '../strings/strings';
import { el } from './dom';
import { PlayerView } from './player_view';
import { RecordingListPanel } from './recording_list';

/** Time until the list is asked for again while the gateway reads a folder [ms]. */
const kAgain_ms = 500;

/** Recordings of the gateway, and the player. */
export class RecordingsView implements View {
  readonly node: HTMLElement;
  private readonly list: RecordingListPanel;
  private readonly player: PlayerView;
  private asked = 0;
  private loaded = false;

  constructor(private readonly page: Page) {
    this.list = new RecordingListPanel(
      ({ id }) => void this.open(id),
      () => void this.reload(),
    );
    this.player = new PlayerView((id) => void this.compare(id));
    this.node = el('div', { class: 'view recordings-view' }, this.list.node, this.player.node);
  }

  shown(): void {
    if (!this.loaded) void this.reload();
  }

  update(): void {
    this.player.update();
  }

  frame(_: Drawn | null, now_ms: number): void {
    this.player.frame(now_ms);
  }

  /** Handles a key of the player. @return whether it had a meaning */
  key(event: KeyboardEvent): boolean {
    return this.player.key(event);
  }

  /** Reads the colours again after a change between light and dark. */
  recolour(): void {
    this.player.recolour();
  }

  private async reload(): Promise<void> {
    this.list.say(t('recordings.loading'));
    try {
      let list: RecordingList;
      do {
        list = await fetchList();
        this.list.show(list);
        this.player.offer(list.recordings);
        if (list.to_read > 0) await new Promise((resolve) => setTimeout(resolve, kAgain_ms));
      } while (list.to_read > 0 && this.node.isConnected);
      this.loaded = list.to_read === 0;
    } catch (error) {
      this.list.say(error instanceof Error ? error.message : String(error));
    }
  }

  private async open(id: string): Promise<void> {
    const recording = await this.load(id);
    if (!recording) return;
    this.player.open(recording);
    this.player.node.scrollIntoView({ block: 'start' });
    this.player.focus();
  }

  private async compare(id: string): Promise<void> {
    if (id === '') return this.player.setOther(null);
    const recording = await this.load(id);
    if (recording) this.player.setOther(recording);
  }

  /** Returns a recording, or null if it cannot be read or the person chose another one meanwhile. */
  private async load(id: string): Promise<LoadedRecording | null> {
    this.asked += 1;
    const number = this.asked;
    try {
      const outline = await fetchOutline(id, (share) =>
        this.list.say(t('recordings.preparing', { percent: Math.round(share * 100) })),
      );
      this.list.say('');
      return number === this.asked ? new LoadedRecording(outline) : null;
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.list.say(why);
      this.page.report('error', why);
      return null;
    }
  }
}
