import type { Hello } from '../protocol/messages';
import type { StringKey } from '../strings/en';

/**
 * Returns the text that says why a person without the right `create` has no lesson desk, with a next step that this
 * person can take. An observer, such as anybody of the audience, has none; the person who started the gateway, who alone
 * may invite, can start it with another role; all others can sign in with another ticket.
 */
export function deskDenial({ role, may }: Pick<Hello, 'role' | 'may'>): StringKey {
  if (may.includes('invite')) return 'desk.denied_gateway';
  return role === 'OBSERVER' ? 'desk.denied_watch' : 'desk.denied_ticket';
}
