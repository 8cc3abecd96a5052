import type { Page, View } from '../app/page';
import type { Recording } from '../protocol/messages';
import { t } from '../strings/strings';
import { button, confirmOrder, el, setAttribute, setDisabled, setText } from './dom';

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
  private readonly why = el('span', { class: 'visually-hidden', id: 'no-recording' });
  // A button that says why it does nothing stays in the order of the Tab key.
  private readonly change = button('', () => void this.order(), { class: 'record' });

  constructor(private readonly page: Page) {
    this.sign.append(el('span', { class: 'recording-dot', 'aria-hidden': 'true' }), this.text);
    this.node = el('span', { class: 'recording-mark' }, this.sign, this.change, this.why);
  }

  private async order(): Promise<void> {
    const state = this.page.model.state;
    const on = !state?.recording?.by_server;
    if (on && state?.noRecording) return this.page.report('warning', state.noRecording);
    if (!on) {
      const what = t('recording.stop');
      if (!(await confirmOrder(what, t('recording.stop_explain'), what, t('who.cancel')))) return;
    }
    void this.page.order(t(on ? 'recording.start' : 'recording.stop'), { order: 'record', on });
  }

  update(): void {
    const { model } = this.page;
    const recording = model.state?.recording ?? null;
    this.sign.hidden = recording === null;
    if (recording) setText(this.text, words(recording));
    this.change.hidden = !model.granted('record');
    setText(this.change, t(recording?.by_server ? 'recording.stop' : 'recording.start'));
    const why = recording?.by_server ? '' : (model.state?.noRecording ?? '');
    setText(this.why, why);
    this.why.hidden = this.change.hidden || why === '';
    setAttribute(this.change, 'aria-disabled', why === '' ? null : 'true');
    setAttribute(this.change, 'aria-describedby', why === '' ? null : this.why.id);
    setAttribute(this.change, 'title', why === '' ? null : why);
    setDisabled(this.change, !model.may('record') || !model.state || model.state.phase === 'OVER');
  }
}
