import { kRoles, proposeSeats, type LessonPerson, type RowWish } from '../logic/lesson';
import type { SeatOffer } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { button, el, labelled, nameField, select, setText } from './dom';

interface Row {
  node: HTMLElement;
  name: HTMLInputElement;
  role: HTMLSelectElement;
  seat: HTMLInputElement;
  workstation: HTMLInputElement;
  drop: HTMLButtonElement;
  /** What the person chose; the desk proposes the rest. */
  wish: RowWish;
}

export type PersonField = 'name' | 'seat' | 'workstation';

/** The people of a new lesson. Each row begins with the first free seat of the scene. */
export class PersonRows {
  readonly node = el('div', { class: 'people' });
  private readonly seatList = el('datalist', { id: 'scene-seats' });
  private rows: Row[] = [];
  private offers: readonly SeatOffer[] = [];
  private workstation = '';

  /** @param rule  words about names, beside the rows */
  constructor(
    count: number,
    private readonly rule: HTMLElement,
  ) {
    this.node.append(this.seatList);
    for (let i = 0; i < count; i += 1) this.add();
  }

  /** Seats of the chosen scene; empty: not known. */
  setSeats(offers: readonly SeatOffer[]): void {
    if (offers === this.offers) return;
    this.offers = offers;
    this.seatList.replaceChildren(...offers.map(({ name }) => el('option', { value: name })));
    this.propose();
  }

  /** Workstation of new rows, and of those that named none yet. */
  setWorkstation(name: string): void {
    if (name === this.workstation) return;
    for (const { workstation } of this.rows)
      if (workstation.value === this.workstation || workstation.value === '') workstation.value = name;
    this.workstation = name;
  }

  add(): HTMLInputElement {
    const name = nameField(this.rule, { required: true });
    const seat = nameField(this.rule, { list: 'scene-seats' });
    const workstation = nameField(this.rule);
    workstation.value = this.workstation;
    const role = select(
      kRoles.map((known) => [known, word('role', known)] as const),
      'TRAINEE',
      (chosen) => {
        row.wish.role = chosen;
        this.propose();
      },
    );
    seat.addEventListener('input', () => {
      row.wish.seat = seat.value.trim();
      // The scene decides about the role of a seat.
      if (this.offers.some((offer) => offer.name === row.wish.seat)) row.wish.role = null;
      this.propose();
    });
    const drop = button('✕', () => this.drop(row), { class: 'quiet' });
    const row: Row = {
      node: el('div', { class: 'row person' }),
      name,
      role,
      seat,
      workstation,
      drop,
      wish: { role: null, seat: null },
    };
    row.node.append(labelled('', name), labelled('', role), labelled('', seat), labelled('', workstation), drop);
    this.rows.push(row);
    this.node.append(row.node);
    this.number();
    this.propose();
    return name;
  }

  people(): LessonPerson[] {
    return this.rows.map((row) => {
      const workstation = row.workstation.value.trim();
      const person = { name: row.name.value.trim(), role: row.role.value, seat: row.seat.value.trim() };
      return workstation === '' ? person : { ...person, workstation };
    });
  }

  field(index: number, field: PersonField): HTMLInputElement | undefined {
    return this.rows[index]?.[field];
  }

  private drop(row: Row): void {
    const at = this.rows.indexOf(row);
    this.rows = this.rows.filter((other) => other !== row);
    row.node.remove();
    this.number();
    this.propose();
    // Otherwise the keyboard would begin at the top of the page again.
    (this.rows[at] ?? this.rows[at - 1])?.name.focus();
  }

  /** Labels have the number of the row, which changes when a row before it is removed. */
  private number(): void {
    this.rows.forEach((row, i) => {
      for (const [control, key] of [
        [row.name, 'desk.person'],
        [row.role, 'desk.role'],
        [row.seat, 'desk.seat'],
        [row.workstation, 'desk.workstation'],
      ] as const) {
        const label = control.closest('label')?.firstElementChild;
        if (label) setText(label, t(key, { n: i + 1 }));
      }
      row.drop.setAttribute('aria-label', t('desk.drop', { n: i + 1 }));
    });
  }

  private propose(): void {
    const proposed = proposeSeats(
      this.offers,
      this.rows.map(({ wish }) => wish),
    );
    this.rows.forEach((row, i) => {
      const { seat, role } = proposed[i] ?? { seat: '', role: 'TRAINEE' };
      if (row.wish.seat === null) row.seat.value = seat;
      row.role.value = role;
    });
  }
}
