import type { Page, View } from '../app/page';
import { AlarmList } from './alarm_list';
import { el } from './dom';
import { ScorePanel } from './score_panel';
import { SheetForm } from './sheet_form';
import { Timeline } from './timeline';

/** The evaluator's side: picture, marks on the timeline and rating sheets. */
export class EvaluatorView implements View {
  readonly node: HTMLElement;
  readonly timeline: Timeline;
  private readonly slot = el('div', { class: 'slot' });
  private readonly parts: View[];

  constructor(private readonly page: Page) {
    this.timeline = new Timeline(page);
    const sheet = new SheetForm(page);
    const alarms = new AlarmList(page);
    const scores = new ScorePanel(page);
    this.parts = [this.timeline, sheet, alarms, scores];
    this.node = el(
      'div',
      { class: 'view evaluator-view' },
      el('div', { class: 'column' }, this.slot, this.timeline.node, alarms.node),
      el('div', { class: 'column' }, sheet.node, scores.node),
    );
  }

  shown(): void {
    this.slot.append(this.page.pictureHost);
  }

  update(): void {
    for (const part of this.parts) part.update();
  }
}
