import type { Page, View } from '../app/page';
import type { Alarm } from '../logic/alarms';
import { clock } from '../logic/format';
import { t } from '../strings/strings';
import { el, panel } from './dom';

/** Rows that are shown; the log itself keeps more. */
const kRowsShown = 40;

export function alarmText(alarm: Alarm): string {
  return t(`alarm.${alarm.kind}`, { seat: alarm.seat || '–', detail: alarm.detail }).trim();
}

function endText({ over, until }: Alarm): string {
  if (!over) return t('alarms.lasting');
  return until === null ? t('alarms.over') : t('alarms.until', { t: clock(until) });
}

function row(className: string, time: string, text: string, until: string): HTMLLIElement {
  return el('li', { class: className }, el('time', {}, time), el('span', {}, text), el('small', {}, until));
}

/** Alarms and events in words with their session time, newest first. */
export class AlarmList implements View {
  readonly node: HTMLElement;
  private readonly alarms = el('ol', { class: 'log' });
  private readonly events = el('ol', { class: 'log' });
  private rendered = '';

  constructor(private readonly page: Page) {
    const scroll = (label: string, list: HTMLElement): HTMLElement =>
      el('div', { class: 'scroll log-box', tabindex: 0, role: 'group', 'aria-label': label }, list);
    this.node = el(
      'div',
      { class: 'logs' },
      panel(t('alarms.title'), 'alarms-panel', scroll(t('alarms.title'), this.alarms)),
      panel(t('events.title'), 'events-panel', scroll(t('events.title'), this.events)),
    );
  }

  update(): void {
    const { model } = this.page;
    const alarms = model.alarms.list().slice(0, kRowsShown);
    const events = model.events.toArray().slice(-kRowsShown).reverse();
    const key = JSON.stringify([alarms.map((a) => [a.number, a.over, a.until, a.detail]), events.map((e) => e.number)]);
    if (key === this.rendered) return;
    this.rendered = key;
    this.alarms.replaceChildren(
      ...(alarms.length > 0
        ? alarms.map((alarm) =>
            row(`${alarm.level}${alarm.over ? '' : ' lasting'}`, clock(alarm.t), alarmText(alarm), endText(alarm)),
          )
        : [el('li', { class: 'empty' }, t('alarms.none'))]),
    );
    this.events.replaceChildren(
      ...(events.length > 0
        ? events.map((event) => row('event', clock(event.t), event.text, ''))
        : [el('li', { class: 'empty' }, t('events.none'))]),
    );
  }
}
