import type { Page, View } from '../app/page';
import { AlarmList } from './alarm_list';
import { AuthorityPanel } from './authority_panel';
import { el } from './dom';
import { ScorePanel } from './score_panel';
import { SeatCards } from './seat_cards';
import { WhoPanel } from './who_panel';

/** The instructor's side: picture, authority, persons, seats and alarms. */
export class InstructorView implements View {
  readonly node: HTMLElement;
  private readonly slot = el('div', { class: 'slot' });
  private readonly parts: View[];

  constructor(private readonly page: Page) {
    const authority = new AuthorityPanel(page);
    const who = new WhoPanel(page);
    const cards = new SeatCards(page);
    const alarms = new AlarmList(page);
    const scores = new ScorePanel(page);
    this.parts = [authority, who, cards, alarms, scores];
    this.node = el(
      'div',
      { class: 'view instructor-view' },
      el('div', { class: 'column' }, this.slot, who.node),
      el('div', { class: 'column' }, authority.node, alarms.node),
      el('div', { class: 'column wide' }, cards.node, scores.node),
    );
  }

  shown(): void {
    this.slot.append(this.page.pictureHost);
  }

  update(): void {
    for (const part of this.parts) part.update();
  }
}
