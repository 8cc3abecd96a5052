import { isForBrowser, isLoopback, serverAddress, stepsOf, ticketLink } from '../logic/lesson';
import type { Ticket, Tickets } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { el } from './dom';
import { qrCode } from './qr_code';

/** Workstation that a server with ephemeral keys has for all clients of its user. */
const kLocal = 'local';

/** A command whose options stay in one line each; copied, it is one line. */
function commandBox(command: string): HTMLElement {
  const words = command
    .split(' ')
    .map((word, i) => el('span', { class: word.length < 24 ? 'word' : undefined }, i ? ' ' : '', word));
  return el('pre', {}, el('code', {}, ...words));
}

function title(ticket: Ticket): string {
  return t(isForBrowser(ticket) ? 'desk.steps_browser' : ticket.seat === '' ? 'desk.steps_console' : 'desk.steps');
}

/** Link and QR code; a ticket of another workstation has none, because the gateway cannot use it. */
function browserPart(ticket: Ticket): HTMLElement[] {
  if (!isForBrowser(ticket)) return [];
  const link = ticketLink(location.origin, ticket);
  return [
    el('div', {}, qrCode(link, t('desk.qr', { person: ticket.person }))),
    el('p', {}, el('a', { href: link }, t('desk.link'))),
    ...(isLoopback(location.hostname) ? [el('p', { class: 'note' }, t('desk.here_only'))] : []),
  ];
}

function card(ticket: Ticket, server: string): HTMLElement {
  const words = {
    workstation:
      ticket.workstation === kLocal
        ? t('desk.server_computer')
        : t('desk.workstation_named', { name: ticket.workstation || ticket.person }),
    role: word('role', ticket.role),
    person: ticket.person,
  };
  const host = server.replace(/:\d+$/, '');
  const browser = isForBrowser(ticket);
  return el(
    'article',
    { class: 'ticket', 'aria-label': t('desk.ticket_of', { person: ticket.person }) },
    el(
      'h3',
      {},
      ticket.person,
      ' ',
      el('small', {}, [word('role', ticket.role), ticket.seat].filter(Boolean).join(', ')),
    ),
    el('p', {}, t(browser ? 'desk.for_browser' : 'desk.at', words)),
    ...browserPart(ticket),
    el('h4', {}, title(ticket)),
    el(
      'ol',
      {},
      ...stepsOf(ticket, server).map(({ key, command }) =>
        el('li', {}, t(key, words), command === null ? null : commandBox(command)),
      ),
    ),
    browser || !isLoopback(host) ? null : el('p', { class: 'note' }, t('desk.server_here_only', { server })),
    browser ? el('p', { class: 'note' }, t('desk.ticket_text'), ' ', el('code', {}, ticket.ticket)) : null,
  );
}

/** Returns a page per person: the ticket, and three steps with which the person joins. */
export function ticketCards({ server, tickets }: Tickets): HTMLElement {
  const address = serverAddress(server, location.hostname);
  return el('div', { class: 'ticket-grid' }, ...tickets.map((ticket) => card(ticket, address)));
}
