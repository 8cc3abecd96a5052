import type { Page, View } from '../app/page';
import type { Drawn } from '../logic/state_window';
import { fixed } from '../logic/format';
import { freeSeats, proposedSeat } from '../logic/seat_choice';
import { kTicketLength } from '../logic/sign_in';
import { kPointerRate, kReach, PointerDevice, type Plane } from '../logic/pointer_device';
import { t } from '../strings/strings';
import { button, el, fillSelect, labelled, panel, select, setDisabled, setText } from './dom';
import { SeatPad } from './seat_pad';

/** A seat in the browser: the pointer moves the intended hand of a simulated device that the gateway runs. */
export class SeatView implements View {
  readonly node: HTMLElement;
  private readonly device = new PointerDevice();
  private readonly pad = new SeatPad(this.device);
  private readonly slot = el('div', { class: 'slot' });
  private readonly choice = select([], '', (seat) => (this.chosen = seat));
  private readonly ticketHelp = el('p', { class: 'note', id: 'seat-ticket-help' });
  private readonly ticket = el('input', {
    type: 'password',
    autocomplete: 'off',
    maxlength: kTicketLength,
    'aria-describedby': this.ticketHelp.id,
  });
  private readonly ticketField = labelled(t('seat.ticket'), this.ticket);
  private readonly take: HTMLButtonElement;
  private readonly leave: HTMLButtonElement;
  private readonly hold: HTMLButtonElement;
  private readonly words = el('p', { role: 'status' });
  private readonly force = el('meter', {
    min: 0,
    max: 1,
    low: 0.8,
    high: 0.999,
    optimum: 0,
    'aria-label': t('seat.force'),
  });
  private readonly forceText = el('output');
  private readonly gamepad = el('p', { class: 'note' }, t('seat.gamepad'));
  private readonly depth: HTMLInputElement;
  private readonly depthLabel: HTMLElement;
  private options = '';
  /** Seat that the person chose; a list that loses it shows it again when it is free. */
  private chosen = '';
  private sent_ms = 0;
  private last_ms = 0;
  private seat = '';

  constructor(private readonly page: Page) {
    this.take = button(t('seat.take'), () => this.takeSeat(), { class: 'primary' });
    this.leave = button(t('seat.leave'), () => void this.page.request(t('seat.leave'), { type: 'leave' }));
    this.hold = button(t('seat.hold'), () => this.device.grip('button', !this.device.pressed), {
      'aria-pressed': 'false',
    });
    // A page without focus gets neither keys nor frames of the screen that would release the hand.
    window.addEventListener('blur', () => this.release());
    document.addEventListener('visibilitychange', () => this.release());
    const plane = select(
      [
        ['front', t('seat.front')],
        ['above', t('seat.above')],
      ],
      'front',
      (value) => {
        this.device.plane = value as Plane;
        setText(this.depthLabel, t(value === 'front' ? 'seat.depth_front' : 'seat.depth_above'));
      },
    );
    const reach = kReach * 1000;
    this.depth = el('input', {
      type: 'range',
      min: -reach,
      max: reach,
      step: 1,
      value: '0',
      oninput: () => this.moveDepth(Number(this.depth.value) / 1000),
    });
    const depth = labelled(t('seat.depth_front'), this.depth);
    this.depthLabel = depth.querySelector('span') ?? depth;
    this.node = el(
      'div',
      { class: 'view seat-view' },
      el(
        'div',
        { class: 'column' },
        panel(
          t('seat.title'),
          'seat-panel',
          el('div', { class: 'row' }, labelled(t('seat.choose'), this.choice), this.ticketField, this.take, this.leave),
          this.ticketHelp,
          this.words,
          this.pad.canvas,
          el('div', { class: 'row' }, this.hold, labelled(t('seat.plane'), plane), depth),
          el('div', { class: 'force' }, el('span', {}, t('seat.force')), this.force, this.forceText),
          el('p', { class: 'note' }, t('seat.explain')),
          this.gamepad,
        ),
      ),
      el('div', { class: 'column' }, this.slot),
    );
  }

  shown(): void {
    this.slot.append(this.page.pictureHost);
  }

  hidden(): void {
    this.release();
    this.page.sound.ownForce(null);
  }

  update(): void {
    const { model } = this.page;
    const own = model.ownSeat?.seat ?? '';
    if (own !== this.seat) {
      this.seat = own;
      // The device continues where the hand is: a jump of the intention would be a jump of the force.
      if (model.ownSeat?.x) this.device.moveTo(model.ownSeat.x);
    }
    const free = freeSeats(model.scene, model.state);
    const key = free.map((seat) => seat.name).join('\n');
    if (key !== this.options) {
      this.options = key;
      fillSelect(
        this.choice,
        free.map((seat) => [seat.name, seat.name] as const),
        proposedSeat(free, this.chosen, model.hello?.play ?? null),
      );
    }
    const may = model.may('seat');
    const granted = model.granted('seat');
    this.take.hidden = this.leave.hidden = !granted;
    const needsTicket = this.needsTicket() && own === '';
    this.ticketField.hidden = this.ticketHelp.hidden = !needsTicket;
    setDisabled(this.ticket, !may || free.length === 0);
    const [session, seat] = [model.scene?.name ?? '', this.choice.value];
    setText(this.ticketHelp, needsTicket ? t('seat.ticket_help', { session, seat }) : '');
    setDisabled(this.take, !may || own !== '' || free.length === 0);
    setDisabled(this.choice, !may || own !== '' || free.length === 0);
    setDisabled(this.leave, own === '' || !may);
    setDisabled(this.hold, own === '');
    setDisabled(this.depth, own === '');
    this.hold.setAttribute('aria-pressed', String(this.device.pressed));
    const hand = t(this.device.pressed ? 'seat.held' : 'seat.released');
    setText(
      this.words,
      own !== ''
        ? `${t('seat.yours', { seat: own })} ${hand}`
        : t(!granted ? 'seat.not_allowed' : free.length === 0 ? 'seat.none_free' : 'seat.take_first'),
    );
  }

  frame(_: Drawn | null, now_ms: number): void {
    const { model } = this.page;
    const own = model.ownSeat;
    this.readGamepad((now_ms - this.last_ms) / 1000);
    this.last_ms = now_ms;
    if (own?.seat && now_ms - this.sent_ms >= 1000 / kPointerRate) {
      this.sent_ms = now_ms;
      this.page.connection.signal({ type: 'pointer', x: this.device.x, pressed: this.device.pressed });
    }
    const limit = model.scene?.seats.find((seat) => seat.name === own?.seat)?.force_limit_n ?? null;
    const newtons = own?.f ? Math.hypot(...own.f) : null;
    const share = newtons === null || limit === null ? null : newtons / limit;
    this.force.value = Math.min(1, share ?? 0);
    setText(this.forceText, fixed(newtons, 2, 'N'));
    const vertical = this.device.plane === 'front' ? 1 : 2;
    if (document.activeElement !== this.depth)
      this.depth.value = String(Math.round((this.device.x[vertical] ?? 0) * 1000));
    this.pad.draw(own, share);
    this.page.sound.ownForce(own ? share : null);
  }

  /** Releases the hand at once: a hidden view or page sends no further frames of the pointer. */
  private release(): void {
    this.device.release();
    if (this.page.model.ownSeat?.seat) {
      this.page.connection.signal({ type: 'pointer', x: this.device.x, pressed: false }, true);
    }
  }

  private takeSeat(): void {
    const seat = this.choice.value;
    if (!seat) return;
    if (!this.needsTicket()) return void this.page.request(t('seat.take'), { type: 'take', seat });
    const ticket = this.ticket.value.trim();
    if (ticket === '') {
      this.ticket.focus();
      return this.page.report('error', t('order.refused', { what: t('seat.take'), why: t('seat.ticket_missing') }));
    }
    void this.page.request(t('seat.take'), { type: 'take', seat, ticket }).then((reply) => {
      if (reply.ok) this.ticket.value = '';
    });
  }

  /** The gateway's own right serves persons of its printed URL and their invitations only; they may invite. */
  private needsTicket(): boolean {
    return this.page.model.granted('seat') && !this.page.model.granted('invite');
  }

  private moveDepth(distance: number): void {
    const axis = this.device.plane === 'front' ? 1 : 2;
    this.device.step(axis, distance - this.device.x[axis]);
  }

  private readGamepad(dt_s: number): void {
    const pad = navigator.getGamepads?.().find((found) => found !== null && found.connected) ?? null;
    setText(this.gamepad, t(pad ? 'seat.gamepad_on' : 'seat.gamepad') + (pad ? ` ${t('seat.gamepad')}` : ''));
    // A gamepad that is unplugged holds nothing.
    this.device.grip('gamepad', pad?.buttons[0]?.pressed ?? false);
    if (!pad) return;
    const axis = (index: number): number => pad.axes[index] ?? 0;
    this.device.stick([axis(0), -axis(3), -axis(1)], dt_s);
  }
}
