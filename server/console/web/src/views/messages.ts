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

  show(level: Notice['level'], text: string): void {
    const same = [...this.node.children].find((child) => child.firstChild?.textContent === text);
    same?.remove();
    const node = el(
      'div',
      { class: `message ${level}`, role: level === 'error' ? 'alert' : undefined },
      el('p', {}, text),
      button('✕', () => node.remove(), { 'aria-label': t('notices.dismiss'), class: 'quiet' }),
    );
    this.node.append(node);
    while (this.node.childElementCount > kShown) this.node.firstElementChild?.remove();
    if (level === 'info') setTimeout(() => node.remove(), kInfoTime);
  }
}
