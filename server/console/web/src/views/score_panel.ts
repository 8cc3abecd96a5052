import type { Page, View } from '../app/page';
import type { LiveScores } from '../protocol/messages';
import { t } from '../strings/strings';
import { el, panel } from './dom';
import { scoreTables } from './score_table';

/** Scores of the running session so far, for roles that may score. */
export class ScorePanel implements View {
  readonly node: HTMLElement;
  private readonly tables = el('div', { class: 'score-tables' });
  private known: LiveScores | null | undefined;

  constructor(private readonly page: Page) {
    this.node = panel(t('scores.live'), 'live-scores-panel', this.tables);
  }

  update(): void {
    const { model } = this.page;
    this.node.hidden = !model.granted('score');
    if (model.scores === this.known) return;
    this.known = model.scores;
    this.tables.replaceChildren(
      ...(model.scores ? scoreTables(model.scores.scores) : [el('p', { class: 'note' }, t('scores.waiting'))]),
    );
  }
}
