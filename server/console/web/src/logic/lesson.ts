import { kSeatsMax, type Ticket } from '../protocol/messages';

/** Names of sessions, persons and seats: the rule of the server. */
const kName = /^[A-Za-z0-9_-]{1,32}$/;
export const kRoles = ['INSTRUCTOR', 'TRAINEE', 'EVALUATOR', 'OBSERVER', 'RECORDER'] as const;

export interface LessonPerson {
  name: string;
  role: string;
  /** Empty: a console without a seat. */
  seat: string;
  /** Computer at which the person joins; absent: the one of the person's name. */
  workstation?: string;
}

export interface Lesson {
  scene: string;
  name: string;
  people: readonly LessonPerson[];
}

export interface LessonMistake {
  /** Field of the lesson, or of person number `index`. */
  field: 'scene' | 'name' | 'person' | 'seat' | 'workstation' | 'people';
  index: number | null;
}

export function isName(text: string): boolean {
  return kName.test(text);
}

/** Returns all mistakes of a lesson before it is sent; the server checks again. */
export function lessonMistakes(lesson: Lesson): LessonMistake[] {
  const mistakes: LessonMistake[] = [];
  if (!isName(lesson.scene)) mistakes.push({ field: 'scene', index: null });
  if (!isName(lesson.name)) mistakes.push({ field: 'name', index: null });
  if (lesson.people.length > 2 * kSeatsMax) mistakes.push({ field: 'people', index: null });
  const names = new Set<string>();
  const seats = new Set<string>();
  lesson.people.forEach((person, index) => {
    if (!isName(person.name) || names.has(person.name)) mistakes.push({ field: 'person', index });
    if (person.seat !== '' && (!isName(person.seat) || seats.has(person.seat))) mistakes.push({ field: 'seat', index });
    if (person.workstation !== undefined && !isName(person.workstation)) mistakes.push({ field: 'workstation', index });
    names.add(person.name);
    if (person.seat !== '') seats.add(person.seat);
  });
  return mistakes;
}

/** Steps with which the holder of a ticket joins: at a seat with a device, or at a console. */
export function stepsOf(ticket: Ticket): readonly ('desk.step1' | 'desk.step2' | 'desk.step3' | StepWithoutSeat)[] {
  if (ticket.seat !== '') return ['desk.step1', 'desk.step2', 'desk.step3'];
  const watches = ticket.role === 'TRAINEE' || ticket.role === 'OBSERVER' || ticket.role === 'RECORDER';
  return ['desk.console1', 'desk.console2', watches ? 'desk.watch3' : 'desk.control3'];
}
type StepWithoutSeat = 'desk.console1' | 'desk.console2' | 'desk.watch3' | 'desk.control3';

/** Returns the link of a ticket. The part behind # stays in the browser: neither server nor log sees the ticket. */
export function ticketLink(origin: string, ticket: Ticket): string {
  return `${origin}/#ticket=${encodeURIComponent(ticket.ticket)}&name=${encodeURIComponent(ticket.person)}`;
}

/** Returns ticket and name from the part of an address behind #, or null. */
export function ticketOfHash(hash: string): { ticket: string; name: string } | null {
  const values = new URLSearchParams(hash.replace(/^#/, ''));
  const ticket = values.get('ticket');
  return ticket ? { ticket: ticket.slice(0, 4096), name: (values.get('name') ?? '').slice(0, 64) } : null;
}
