import type { Notice } from '../protocol/messages';
import { t } from '../strings/strings';
import { button, el } from './dom';

const kShown = 4;
/** Messages without a problem leave by themselves [ms]; a refusal stays until it is dismissed. */
const kInfoTime = 4000;

/** Short messages: what was done, what was refused and why. Read aloud by screen readers. */
export class Messages {
  readonly node = el('div', {
    class: 'messages',
    role: 'log',
    'aria-live': 'polite',
    'aria-label': t('notices.title'),
  });

  /** @param topic  a message replaces those of the same topic; empty: none */
  show(level: Notice['level'], text: string, topic = ''): void {
    for (const child of [...this.node.children]) {
      const known = child instanceof HTMLElement ? (child.dataset.topic ?? '') : '';
      if (child.firstChild?.textContent === text || (topic !== '' && known === topic)) child.remove();
    }
    const node = el(
      'div',
      { class: `message ${level}`, role: level === 'error' ? 'alert' : undefined, 'data-topic': topic || undefined },
      el('p', {}, text),
      button('✕', () => node.remove(), { 'aria-label': t('notices.dismiss'), class: 'quiet' }),
    );
    this.node.append(node);
    while (this.node.childElementCount > kShown) this.node.firstElementChild?.remove();
    if (level === 'info') setTimeout(() => node.remove(), kInfoTime);
  }
}
