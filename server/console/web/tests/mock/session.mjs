/** A simulated session for tests and development: hands on curves, one tool, a wall, authority, stops, notes. */

export const kSession = '00112233445566778899aabbccddeeff';
const kWall = 0.012;
const kStiffness = 800;
const kCoupling = 200;
const kAnnouncement = 50;
const kTickHz = 1000;

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

/** Moves in steps of one state; the gateway of the tests calls `step` 60 times per second, or as fast as a test likes. */
export class MockSession {
  constructor({ seats = 2, evaluators = ['eva'], freeSeat = false, duration = null } = {}) {
    this.t = 0;
    this.duration = duration;
    this.version = 1;
    this.stop = null;
    this.stops = 0;
    this.over = false;
    this.drained = null;
    this.events = [];
    this.marks = [];
    this.sheets = [];
    this.orders = [];
    this.recording = null;
    this.noRecording = '';
    this.shed = 0;
    this.evaluators = evaluators;
    this.seats = Array.from({ length: seats }, (_, i) => ({
      name: i === 0 ? 'trainer' : seats === 2 ? 'trainee' : `trainee${i}`,
      role: i === 0 ? 'INSTRUCTOR' : 'TRAINEE',
      device: i === 0 ? 'TOUCH' : 'OMEGA_3',
      taken: !(freeSeat && i === seats - 1),
      person: freeSeat && i === seats - 1 ? null : `ws-${i + 1}`,
      owner: null,
      wish: [0, 0, 0],
      pressed: false,
      heard: true,
      gate: 'ON',
      trips: 0,
      rtt: 0.7 + 0.4 * i,
      loss: 0,
      x: [0, 0, 0],
      f: [0, 0, 0],
    }));
    this.wanted = this.seats.map((_, i) => (i === 0 ? 1 : 0));
    this.applied = [...this.wanted];
    this.transfer = null;
    this.tool = { x: [0, 0, 0], f: [0, 0, 0], depth: 0, touching: false };
    this.event('the session runs');
  }

  event(text) {
    this.events.push({
      type: 'event',
      session: kSession,
      number: this.events.length + 1,
      t: this.t,
      text,
    });
    if (this.events.length > 200) this.events.shift();
  }

  get phase() {
    if (this.over) return 'OVER';
    if (this.stop) return this.stop.kind === 'PAUSE' ? 'PAUSED' : 'STOPPED';
    return this.seats.some((seat) => seat.taken) ? 'RUNNING' : 'WAITING';
  }

  step(dt = 1 / 60) {
    this.t += dt;
    if (this.drained !== null && this.t >= this.drained) this.over = true;
    this.stepTransfer(dt);
    const runs = this.phase === 'RUNNING';
    let target = [0, 0, 0];
    this.seats.forEach((seat, i) => {
      const intended = this.intended(seat, i);
      const alpha = this.applied[i] ?? 0;
      if (seat.taken) target = target.map((value, axis) => value + alpha * intended[axis]);
      seat.intended = intended;
    });
    if (runs) this.stepTool(target, dt);
    this.seats.forEach((seat) => this.stepSeat(seat, runs));
  }

  intended(seat, index) {
    if (seat.owner !== null) return seat.pressed ? seat.wish : [...seat.x];
    const phase = 0.9 * this.t + index * 0.8;
    return [0.022 * Math.sin(phase), 0.015 * Math.cos(0.7 * phase), 0.012 * Math.sin(1.3 * phase)];
  }

  stepTransfer(dt) {
    if (this.transfer) {
      this.transfer.ticks -= Math.round(dt * kTickHz);
      if (this.transfer.ticks <= 0) this.transfer = null;
      return;
    }
    this.applied = this.applied.map((share, i) => share + clamp(this.wanted[i] - share, -2 * dt, 2 * dt));
  }

  stepTool(target, dt) {
    const { tool } = this;
    const share = 1 - Math.exp(-dt / 0.05);
    const free = tool.x.map((value, axis) => value + (target[axis] - value) * share);
    tool.touching = free[0] > kWall;
    tool.depth = Math.max(0, free[0] - kWall) * 0.3;
    tool.x = [tool.touching ? kWall + tool.depth : free[0], free[1], free[2]];
    tool.f = [-kStiffness * tool.depth, 0, 0];
  }

  stepSeat(seat, runs) {
    if (!seat.taken) {
      seat.f = [0, 0, 0];
      return;
    }
    seat.gate = seat.gate === 'LATCHED' ? 'LATCHED' : runs ? 'ON' : 'OFF';
    seat.x = seat.x.map((value, axis) => value + (0.75 * seat.intended[axis] + 0.25 * this.tool.x[axis] - value) * 0.4);
    const force = this.tool.x.map((value, axis) => (runs ? kCoupling * (value - seat.x[axis]) : 0));
    const size = Math.hypot(...force);
    const limited = size > 3.3 ? 3.3 / size : 1;
    seat.f = force.map((value) => value * limited);
  }

  scene() {
    return {
      type: 'scene',
      session: kSession,
      name: 'contact',
      tick_hz: kTickHz,
      dof: 3,
      law: 'REPLICA',
      duration_s: this.duration,
      seats: this.seats.map(({ name, role, device }) => ({
        name,
        kind: 'MASTER',
        role,
        required: true,
        device,
        force_limit_n: 3.3,
      })),
      tools: [
        {
          name: 'tool0',
          mass_kg: 0.05,
          walls: [{ axis: 0, at_m: kWall, stiffness_n_m: kStiffness, from_below: true }],
          tissues: [{ axis: 2, at_m: -0.03, stiffness_n_m: 200 }],
        },
      ],
    };
  }

  /** State for one person: `yours` says whether that person may resume. */
  state(n, dropped, person, role) {
    const may = (by) => role === 'INSTRUCTOR' || role === 'OPERATOR' || by === person;
    return {
      type: 'state',
      n,
      dropped,
      wall_us: Math.round(performance.now() * 1000),
      t: this.t,
      phase: this.phase,
      stop: this.stop && { ...this.stop, yours: may(this.stop.by) },
      version: this.version,
      shed: this.shed,
      held: '',
      recording: this.recording,
      no_recording: this.recording === null ? this.noRecording : '',
      seats: this.seats.map((seat, i) => ({
        taken: seat.taken,
        heard: seat.heard,
        person: seat.person,
        engaged: seat.taken && (seat.owner === null || seat.pressed) && this.phase === 'RUNNING',
        gate: seat.taken ? seat.gate : null,
        x: seat.taken ? seat.x : null,
        f: seat.taken ? seat.f : null,
        alpha: [this.applied[i]],
        rtt_ms: seat.taken ? seat.rtt + 0.2 * Math.sin(this.t * 3) ** 2 : null,
        loss_percent: seat.taken ? seat.loss : null,
        gap_ms: seat.taken ? 1.1 + seat.rtt / 3 : null,
        age_ms: seat.taken ? 1 : null,
        margin_j: seat.taken ? 0.05 - 0.01 * Math.sin(this.t) : null,
        trips: seat.taken ? seat.trips : null,
        late: seat.taken ? 0 : null,
      })),
      tools: [
        {
          x: this.tool.x,
          v: [0, 0, 0],
          f: this.tool.f,
          depth_m: this.tool.depth,
          touching: this.tool.touching,
          wanted: this.wanted,
          applied: this.applied,
          transfer: this.transfer && { ...this.transfer },
        },
      ],
    };
  }

  /** Notes that `person` may see: others' sheets after the own one on the same form is closed. */
  notes(person) {
    const closed = (other) =>
      this.sheets.some(
        (own) => own.person === person && own.sheet === other.sheet && own.of === other.of && own.closed,
      );
    const sheets = this.sheets.filter((sheet) => sheet.person === person || (sheet.closed && closed(sheet)));
    return { type: 'notes', marks: this.marks, sheets };
  }

  /** Returns an empty text, or why the order is refused. */
  order(frame, person, role) {
    this.orders.push({ person, ...frame });
    if (this.orders.length > 100) this.orders.shift();
    switch (frame.order) {
      case 'stop':
      case 'pause':
        this.stops += 1;
        this.stop = { number: this.stops, kind: frame.order.toUpperCase(), by: person, why: frame.why };
        this.event(`${person} ${frame.order === 'stop' ? 'stops' : 'pauses'} the session: ${frame.why}`);
        return '';
      case 'resume':
        if (!this.stop || this.stop.number !== frame.stop) return `stop ${frame.stop} is not active`;
        if (role !== 'INSTRUCTOR' && this.stop.by !== person) return 'only the instructor may end this stop';
        this.stop = null;
        this.event(`${person} resumes the session`);
        return '';
      case 'authority':
        return this.setAuthority(frame, person);
      case 'remove': {
        const seat = this.seats.find((known) => known.name === frame.seat);
        if (!seat?.taken) return `nobody has seat "${frame.seat}"`;
        seat.taken = false;
        seat.person = null;
        seat.owner = null;
        this.event(`${person} removes seat ${frame.seat}: ${frame.why}`);
        return '';
      }
      case 'drain':
        this.drained = this.t + frame.grace_s;
        this.event(`${person} drains the server, grace time ${frame.grace_s} s`);
        return '';
      case 'record':
        if ((this.recording !== null) === frame.on) return 'it is recorded already, or no recording runs';
        this.recording = frame.on
          ? { by_server: true, by_recorders: 0, pseudonyms: false, dropped: 0, trouble: '' }
          : null;
        return '';
      default:
        return `"order" is ${frame.order}; it must be stop, pause, resume, authority, remove or drain`;
    }
  }

  setAuthority(frame, person) {
    if (frame.version !== this.version)
      return `the authority has version ${this.version}, not ${frame.version}; look at the new values and repeat`;
    if (this.phase !== 'RUNNING') return 'authority moves while the session runs only; resume it first';
    const sum = frame.alpha.reduce((a, b) => a + b, 0);
    if (frame.alpha.length !== this.seats.length || Math.abs(sum - 1) > 1e-9) return 'the shares must have the sum 1';
    const gains = frame.alpha.map((share, i) => share - this.wanted[i]);
    const to = gains.indexOf(Math.max(...gains));
    if (!this.seats[to].taken) return `seat "${this.seats[to].name}" is free; it cannot get authority`;
    this.version += 1;
    this.wanted = [...frame.alpha];
    this.transfer = { by: person, to: this.seats[to].name, alpha: frame.alpha[to], ticks: kAnnouncement };
    this.event(`${person} gives the tool to ${this.seats[to].name} (${Math.round(frame.alpha[to] * 100)} %)`);
    return '';
  }
}
