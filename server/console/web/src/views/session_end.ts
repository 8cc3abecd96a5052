import type { Page } from '../app/page';
import { t } from '../strings/strings';
import { confirmOrder } from './dom';

/** Ends a session after the person confirmed it by the name of the session. */
export async function endSession(page: Page, session: string, name: string): Promise<void> {
  const what = t('desk.end_of', { name });
  if (!(await confirmOrder(what, t('desk.end_explain', { name }), what, t('who.cancel')))) return;
  const reply = await page.order(what, { order: 'end', session });
  if (reply.ok) page.model.given.ended(session);
}
