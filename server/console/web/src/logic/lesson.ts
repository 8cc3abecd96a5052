import { kSeatsMax, type SeatOffer, type Ticket } from '../protocol/messages';
import { isName } from '../protocol/names';

export const kPeopleMax = 2 * kSeatsMax;
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
  /** `name`: the text is none; `twice`: another person before has it; `many`: the session has too many people. */
  why: 'name' | 'twice' | 'many';
}

/** Returns all mistakes of a lesson before it is sent; the server checks again. */
export function lessonMistakes(lesson: Lesson): LessonMistake[] {
  const mistakes: LessonMistake[] = [];
  const add = (field: LessonMistake['field'], index: number | null, why: LessonMistake['why']): void => {
    mistakes.push({ field, index, why });
  };
  if (!isName(lesson.scene)) add('scene', null, 'name');
  if (!isName(lesson.name)) add('name', null, 'name');
  if (lesson.people.length > kPeopleMax) add('people', null, 'many');
  const names = new Set<string>();
  const seats = new Set<string>();
  lesson.people.forEach(({ name, seat, workstation }, index) => {
    if (!isName(name)) add('person', index, 'name');
    else if (names.has(name)) add('person', index, 'twice');
    if (seat !== '' && !isName(seat)) add('seat', index, 'name');
    else if (seats.has(seat)) add('seat', index, 'twice');
    if (workstation !== undefined && !isName(workstation)) add('workstation', index, 'name');
    names.add(name);
    if (seat !== '') seats.add(seat);
  });
  return mistakes;
}

/** The wishes of a person who fills a row; null: none, so that the desk proposes. */
export interface RowWish {
  role: string | null;
  seat: string | null;
}

/**
 * Proposes seat and role of each row: the first free seat of the scene, of the wished role if there is one. Rows beyond
 * the seats are consoles.
 */
export function proposeSeats(seats: readonly SeatOffer[], rows: readonly RowWish[]): { role: string; seat: string }[] {
  const taken = new Set(rows.map(({ seat }) => seat));
  return rows.map(({ role, seat }) => {
    const found =
      seat !== null
        ? seats.find(({ name }) => name === seat)
        : seats.find((offer) => !taken.has(offer.name) && (role === null || offer.role === role));
    if (seat === null && found) taken.add(found.name);
    return { seat: seat ?? found?.name ?? '', role: role ?? found?.role ?? 'EVALUATOR' };
  });
}

/** One step with which the holder of a ticket joins: words, and a command to copy. */
export interface Step {
  key:
    | 'desk.open'
    | 'desk.sign_in'
    | 'desk.look'
    | 'desk.device'
    | 'desk.installed'
    | 'desk.save'
    | 'desk.join'
    | 'desk.watch'
    | 'desk.control';
  command: string | null;
}

/** Whether a browser can use the ticket: it takes no seat with a ticket, and has the gateway's workstation only. */
export function isForBrowser(ticket: Ticket): boolean {
  return ticket.here && ticket.seat === '';
}

/** Three steps with which the holder of a ticket joins: in a browser, at a seat with a device, or at a console. */
export function stepsOf(ticket: Ticket, server: string): readonly Step[] {
  if (isForBrowser(ticket))
    return [
      { key: 'desk.open', command: null },
      { key: 'desk.sign_in', command: null },
      { key: 'desk.look', command: null },
    ];
  const file = `${ticket.person}.ticket`;
  const save: Step = { key: 'desk.save', command: `(umask 077; echo '${ticket.ticket}' > ${file})` };
  const reach = `--server ${server} --ticket-file ${file}`;
  if (ticket.seat !== '')
    return [
      { key: 'desk.device', command: 'tandem-client doctor' },
      save,
      { key: 'desk.join', command: `tandem-client join ${reach} --seat ${ticket.seat} --device sim` },
    ];
  const watches = ticket.role === 'TRAINEE' || ticket.role === 'OBSERVER' || ticket.role === 'RECORDER';
  return [
    { key: 'desk.installed', command: 'tandem-client --version' },
    save,
    watches
      ? { key: 'desk.watch', command: `tandem-client watch ${reach}` }
      : { key: 'desk.control', command: `tandem-client control ${reach}` },
  ];
}

/** Whether a host is reachable from its own computer only. */
export function isLoopback(host: string): boolean {
  return /^(localhost|127(\.\d+){3}|\[?::1\]?)$/.test(host);
}

/**
 * Returns the address at which clients reach the server. If the gateway reaches it on its own computer, that computer has
 * the name by which this browser reached the gateway.
 */
export function serverAddress(server: string, pageHost: string): string {
  const [, host = '', port = ''] = /^(.*):(\d+)$/.exec(server) ?? [];
  return isLoopback(host) && !isLoopback(pageHost) ? `${pageHost}:${port}` : server;
}

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
