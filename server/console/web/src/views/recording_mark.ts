import type { Page, View } from '../app/page';
import type { Recording } from '../protocol/messages';
import { t } from '../strings/strings';
import { button, el, setDisabled, setText } from './dom';

function words(recording: Recording): string {
  const by = recording.by_server
    ? t(recording.pseudonyms ? 'recording.server_pseudonyms' : 'recording.server')
    : t('recording.recorders', { count: String(recording.by_recorders) });
  if (recording.trouble !== '') return `${by}. ${t('recording.trouble', { why: recording.trouble })}`;
  return recording.dropped > 0 ? `${by}. ${t('recording.dropped', { count: String(recording.dropped) })}` : by;
}

/** A red dot with words while the session is recorded, for all persons; a button for roles that may record. */
export class RecordingMark implements View {
  readonly node: HTMLElement;
  private readonly text = el('span', {});
  private readonly sign = el('span', { class: 'recording', role: 'status' });
  private readonly change = button('', () => this.order(), { class: 'record' });

  constructor(private readonly page: Page) {
    this.sign.append(el('span', { class: 'recording-dot', 'aria-hidden': 'true' }), this.text);
    this.node = el('span', { class: 'recording-mark' }, this.sign, this.change);
  }

  private order(): void {
    const on = !this.page.model.state?.recording?.by_server;
    void this.page.order(t(on ? 'recording.start' : 'recording.stop'), { order: 'record', on });
  }

  update(): void {
    const { model } = this.page;
    const recording = model.state?.recording ?? null;
    this.sign.hidden = recording === null;
    if (recording) setText(this.text, words(recording));
    this.change.hidden = !model.granted('record');
    setText(this.change, t(recording?.by_server ? 'recording.stop' : 'recording.start'));
    setDisabled(this.change, !model.may('record') || !model.state || model.state.phase === 'OVER');
  }
}
