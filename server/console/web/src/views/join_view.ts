import { kOptionalNamePattern, kTicketLength } from '../logic/sign_in';
import { kNameMax } from '../protocol/names';
import { t } from '../strings/strings';
import { el, labelled, panel, setDisabled, setText } from './dom';

/** The form for a ticket, shown when the gateway does not know this browser. */
export class JoinView {
  readonly node: HTMLElement;
  private readonly ticket = el('input', {
    type: 'password',
    autocomplete: 'off',
    required: true,
    maxlength: kTicketLength,
  });
  private readonly name = el('input', {
    type: 'text',
    autocomplete: 'nickname',
    maxlength: kNameMax,
    pattern: kOptionalNamePattern,
  });
  private readonly go = el('button', { type: 'submit', class: 'primary' }, t('join.go'));
  private readonly problem = el('p', { class: 'problem', role: 'alert' });

  constructor(
    prefilled: { ticket: string; name: string } | null,
    private readonly joined: () => void,
  ) {
    this.ticket.value = prefilled?.ticket ?? '';
    this.name.value = prefilled?.name ?? '';
    this.node = el(
      'div',
      { class: 'view join-view' },
      panel(
        t('join.title'),
        'join-panel',
        el('p', {}, t('join.explain')),
        el(
          'form',
          {
            onsubmit: (event) => {
              event.preventDefault();
              void this.send();
            },
          },
          labelled(t('join.ticket'), this.ticket),
          labelled(t('join.name'), this.name),
          this.go,
        ),
        this.problem,
      ),
    );
  }

  private async send(): Promise<void> {
    setDisabled(this.go, true);
    setText(this.problem, '');
    try {
      const response = await fetch('/join', {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify({ ticket: this.ticket.value, name: this.name.value }),
      });
      if (response.ok) {
        this.ticket.value = '';
        this.joined();
      } else {
        setText(this.problem, await problemOf(response));
      }
    } catch {
      setText(this.problem, t('join.failed'));
    }
    setDisabled(this.go, false);
  }
}

async function problemOf(response: Response): Promise<string> {
  try {
    const answer: unknown = await response.json();
    if (typeof answer === 'object' && answer !== null && 'text' in answer && typeof answer.text === 'string') {
      return answer.text.slice(0, 500);
    }
  } catch {
    // A gateway that refuses before it reads the body answers with plain text.
  }
  return `${t('join.failed')} (${response.status})`;
}
