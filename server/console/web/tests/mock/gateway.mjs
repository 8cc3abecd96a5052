/** A gateway for tests: serves the built page with the headers of tandem-console and speaks its protocol on /live. */
import { randomBytes } from 'node:crypto';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { WebSocketServer } from 'ws';

import { kSession, MockSession } from './session.mjs';

const kDist = fileURLToPath(new URL('../../dist', import.meta.url));
const kTypes = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
};
const kHeaders = {
  'Content-Security-Policy':
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; " +
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
  'X-Content-Type-Options': 'nosniff',
  'Referrer-Policy': 'same-origin',
};
const kMay = {
  INSTRUCTOR: ['stop', 'pause', 'resume', 'authority', 'remove', 'record', 'seat', 'invite'],
  TRAINEE: ['stop', 'pause', 'resume', 'seat', 'invite'],
  EVALUATOR: ['stop', 'pause', 'score'],
  OBSERVER: [],
  OPERATOR: ['stop', 'pause', 'resume', 'authority', 'remove', 'drain', 'create', 'record', 'seat', 'invite', 'score'],
};
const offer = (name, role) => ({ name, role });
const kSceneSeats = {
  contact: [offer('trainer', 'INSTRUCTOR'), offer('trainee', 'TRAINEE')],
  evaluation: [1, 2, 3].map((n) => offer(`trainee${n}`, 'TRAINEE')),
};
const kRight = {
  stop: 'stop',
  pause: 'pause',
  resume: 'resume',
  authority: 'authority',
  remove: 'remove',
  record: 'record',
  drain: 'drain',
};
const kUnacknowledged = 3;
const kFramesPerSecond = 120;

/** One page: its rights, its window of states and its rate. */
class PageSocket {
  constructor(gateway, socket, person, role) {
    Object.assign(this, { gateway, socket, person, role, n: 0, acknowledged: 0, dropped: 0, frames: [], events: 0 });
    this.may = gateway.may[role] ?? [];
    socket.on('message', (data, binary) => this.onFrame(binary ? '' : data.toString()));
    socket.on('close', () => gateway.left(this));
    this.watched = { id: kSession, name: 'contact' };
    this.greet();
    this.sendScene();
    this.send(gateway.session.notes(person));
  }

  greet() {
    const { gateway, person, role, may } = this;
    this.send({
      type: 'hello',
      protocol: 1,
      release: '0.0.0',
      person,
      role,
      may,
      sessions: gateway.sessions.map((session) => ({ ...session, state: gateway.session.phase })),
      scenes: ['contact', 'two_by_two', 'evaluation'],
      scene_seats: may.includes('create') ? kSceneSeats : {},
      scene_durations_s: may.includes('create') ? { contact: 20 } : {},
      workstation: gateway.workstation,
      play: gateway.play,
    });
  }

  /** All sessions of the mock gateway have the same hands; a created one has its own id and name. */
  sendScene() {
    this.send({ ...this.gateway.session.scene(), session: this.watched.id, name: this.watched.name });
  }

  send(message) {
    if (this.socket.readyState === 1) this.socket.send(JSON.stringify(message));
  }

  reply(id, text) {
    this.send({ type: 'reply', id, ok: text === '', text });
  }

  period() {
    const { session } = this.gateway;
    for (const event of session.events.filter((known) => known.number > this.events)) {
      this.events = event.number;
      this.send(event);
    }
    if (this.gateway.silent) return;
    if (this.n - this.acknowledged >= kUnacknowledged) {
      this.dropped += 1;
      return;
    }
    this.n += 1;
    this.send(session.state(this.n, this.dropped, this.person, this.role));
    const seat = session.seats.find((known) => known.owner === this);
    if (seat) {
      this.send({ type: 'seat', seat: seat.name, f: seat.f, x: seat.x, engaged: seat.pressed, phase: session.phase });
    }
  }

  onFrame(text) {
    const now = Date.now();
    this.frames = this.frames.filter((at) => now - at < 1000);
    this.frames.push(now);
    this.gateway.framesMax = Math.max(this.gateway.framesMax, this.frames.length);
    if (this.frames.length > kFramesPerSecond) return this.socket.close(1008, 'more than 120 frames within one second');
    let frame;
    try {
      frame = JSON.parse(text);
    } catch {
      return this.socket.close(1008, 'the frame is no JSON object');
    }
    this.gateway.onPageFrame(this, frame);
  }
}

export class MockGateway {
  constructor(options) {
    this.session = new MockSession(options);
    this.sessions = [{ id: kSession, name: 'contact' }];
    // A gateway with a ticket of its own lists the session of this ticket only.
    this.listsAll = options.listsAll ?? true;
    this.may = options.may ?? kMay;
    this.role = options.role ?? 'INSTRUCTOR';
    this.person = options.person ?? 'ina';
    this.workstation = options.workstation ?? null;
    this.tickets = new Map(
      Object.entries(options.tickets ?? { 'ticket-eva': ['eva', 'EVALUATOR'], 'ticket-ted': ['ted', 'TRAINEE'] }),
    );
    this.seatTickets = options.seatTickets ?? {};
    this.play = options.play ?? null;
    this.tokens = new Set(['first']);
    this.cookies = new Map();
    this.pages = new Set();
    this.silent = false;
    this.framesMax = 0;
    this.port = options.port ?? 0;
  }

  async start() {
    this.server = createServer((request, response) => void this.onRequest(request, response));
    this.sockets = new WebSocketServer({ noServer: true, maxPayload: 16384 });
    this.server.on('upgrade', (request, socket, head) => {
      const who = this.whoIs(request);
      const origin = request.headers.origin === `http://${request.headers.host}`;
      if (request.url !== '/live' || !who || !origin) {
        socket.end('HTTP/1.1 403 Forbidden\r\nConnection: close\r\n\r\n');
        return;
      }
      this.sockets.handleUpgrade(request, socket, head, (opened) => {
        this.pages.add(new PageSocket(this, opened, ...who));
      });
    });
    await new Promise((resolve) => this.server.listen(this.port, '127.0.0.1', resolve));
    this.port = this.server.address().port;
    this.timer = setInterval(() => this.period(), 1000 / 60);
    return this;
  }

  get url() {
    return `http://127.0.0.1:${this.port}`;
  }

  /** Address with a token of one use; `role` and `person` are those of the new page. */
  entry(person = this.person, role = this.role) {
    const token = randomBytes(8).toString('hex');
    this.tokens.add(token);
    this.cookieOf = { ...this.cookieOf, [token]: [person, role] };
    return `${this.url}/?token=${token}`;
  }

  /** Ends the gateway as a killed process would. Cookies stay, as those of a gateway that is started again. */
  async stop() {
    clearInterval(this.timer);
    for (const page of this.pages) page.socket.terminate();
    this.pages.clear();
    this.server.closeAllConnections();
    await new Promise((resolve) => this.server.close(resolve));
  }

  period() {
    this.session.step();
    for (const page of this.pages) page.period();
  }

  left(page) {
    this.pages.delete(page);
    for (const seat of this.session.seats) if (seat.owner === page) this.free(seat);
  }

  free(seat) {
    Object.assign(seat, { owner: null, taken: false, person: null, pressed: false });
  }

  list(sessions) {
    this.sessions = sessions;
    for (const page of this.pages) page.greet();
  }

  /** Tells all pages what became of the connection to the server. */
  tellServer(server) {
    const [level, text] = {
      lost: ['error', 'the connection to the server was lost (it ended); trying again'],
      gone: ['error', 'the connection to the server was lost (it ended); sign in again with a new ticket'],
      back: ['info', 'the connection to the server is back'],
    }[server];
    for (const page of this.pages) page.send({ type: 'notice', level, text, server });
  }

  tellNotes() {
    for (const page of this.pages) page.send(this.session.notes(page.person));
  }

  onPageFrame(page, frame) {
    const { session } = this;
    const refuse = (right) => `role ${page.role} may not ${right}; ask an instructor`;
    switch (frame.type) {
      case 'ack':
        if (frame.n > page.n) return page.reply(null, '"n" names a state that was never sent');
        page.acknowledged = Math.max(page.acknowledged, frame.n);
        return undefined;
      case 'watch': {
        const wanted = this.sessions.find(({ id }) => id === frame.session);
        page.reply(frame.id, wanted ? '' : 'unknown session');
        page.watched = wanted ?? page.watched;
        return page.sendScene();
      }
      case 'order':
        return this.onOrder(page, frame);
      case 'mark':
        if (!page.may.includes('score')) return page.reply(frame.id, refuse('mark'));
        session.marks.push({ t: frame.t, text: frame.text, person: page.person });
        page.reply(frame.id, '');
        return this.tellNotes();
      case 'sheet':
        return this.onSheet(page, frame);
      case 'take': {
        const seat = session.seats.find((known) => known.name === frame.seat);
        if (!page.may.includes('seat')) return page.reply(frame.id, refuse('take a seat'));
        if (!seat || seat.taken) return page.reply(frame.id, `seat "${frame.seat}" is not free`);
        // A person of the printed URL may invite, and needs no ticket for a seat.
        if (!page.may.includes('invite') && frame.ticket !== this.seatTickets[frame.seat])
          return page.reply(frame.id, 'a ticket for this seat is needed; ask the operator of the server for one');
        Object.assign(seat, { taken: true, person: page.person, owner: page, gate: 'ON' });
        return page.reply(frame.id, '');
      }
      case 'leave': {
        for (const seat of session.seats) if (seat.owner === page) this.free(seat);
        page.reply(frame.id, '');
        return page.send({ type: 'seat', seat: '', f: null, x: null, engaged: false, phase: session.phase });
      }
      case 'pointer': {
        const seat = session.seats.find((known) => known.owner === page);
        if (seat) Object.assign(seat, { wish: frame.x, pressed: frame.pressed });
        return undefined;
      }
      default:
        return page.reply(frame.id ?? null, `"type" is ${frame.type}; it is unknown`);
    }
  }

  onOrder(page, frame) {
    const right = kRight[frame.order] ?? 'create';
    if (!page.may.includes(right))
      return page.reply(frame.id, `role ${page.role} may not give the order ${frame.order}`);
    if (frame.order === 'create') {
      page.reply(frame.id, '');
      const tickets = frame.people.map((person) => {
        const ticket = randomBytes(16).toString('hex');
        this.tickets.set(ticket, [person.name, person.role]);
        const { name, role, seat, workstation = name } = person;
        // The mock gateway has the workstation of its option, else that of the role's consoles: "page".
        return { person: name, workstation, role, seat, here: workstation === (this.workstation ?? 'page'), ticket };
      });
      const server = '127.0.0.1:7000';
      const id = randomBytes(16).toString('hex');
      page.send({ type: 'tickets', session: id, name: frame.name, server, tickets });
      if (this.listsAll) this.list([...this.sessions, { id, name: frame.name }]);
      return undefined;
    }
    if (frame.order === 'end') {
      page.reply(frame.id, '');
      return this.list(this.sessions.filter(({ id }) => id !== frame.session || id === kSession));
    }
    return page.reply(frame.id, this.session.order(frame, page.person, page.role));
  }

  onSheet(page, frame) {
    const { sheets } = this.session;
    if (!page.may.includes('score')) return page.reply(frame.id, `role ${page.role} may not score`);
    const own = sheets.find(
      (known) => known.person === page.person && known.sheet === frame.sheet && known.of === frame.of,
    );
    if (own?.closed) return page.reply(frame.id, 'this sheet is closed');
    const { sheet, of, scores, closed } = frame;
    if (own) Object.assign(own, { scores, closed });
    else sheets.push({ sheet, of, person: page.person, scores, closed });
    page.reply(frame.id, '');
    return this.tellNotes();
  }

  whoIs(request) {
    const cookie = /(?:^|; )tandem=([0-9a-f]+)/.exec(request.headers.cookie ?? '')?.[1];
    return cookie === undefined ? undefined : this.cookies.get(cookie);
  }

  cookie(who) {
    const secret = randomBytes(16).toString('hex');
    this.cookies.set(secret, who);
    return `tandem=${secret}; Path=/; HttpOnly; SameSite=Strict`;
  }

  async onRequest(request, response) {
    const url = new URL(request.url, this.url);
    const answer = (status, body, headers = {}) => {
      response.writeHead(status, { ...kHeaders, 'Cache-Control': 'no-store', ...headers });
      response.end(body);
    };
    if (request.method === 'POST' && url.pathname === '/join') return this.onJoin(request, answer);
    if (request.method !== 'GET') return answer(405, 'only GET is supported\n');
    if (url.pathname === '/join') return answer(200, 'a form\n');
    const token = url.searchParams.get('token');
    if (token !== null) {
      if (!this.tokens.delete(token)) return answer(403, 'the token is wrong, used or expired\n');
      const who = this.cookieOf?.[token] ?? [this.person, this.role];
      return answer(303, '', { Location: '/', 'Set-Cookie': this.cookie(who) });
    }
    const path = normalize(url.pathname === '/' ? '/index.html' : url.pathname);
    try {
      const body = gzipSync(await readFile(join(kDist, path)));
      const type = kTypes[extname(path)] ?? 'application/octet-stream';
      return answer(200, body, { 'Content-Type': type, 'Content-Encoding': 'gzip' });
    } catch {
      return answer(404, 'no such file\n');
    }
  }

  async onJoin(request, answer) {
    let body = '';
    for await (const part of request) body += part;
    const json = { 'Content-Type': 'application/json' };
    const { ticket } = JSON.parse(body);
    const who = this.tickets.get(ticket);
    if (!who) {
      const text = 'the ticket is wrong, used or expired; ask the operator for a new one';
      return answer(403, JSON.stringify({ text }), json);
    }
    this.tickets.delete(ticket);
    return answer(204, undefined, { 'Set-Cookie': this.cookie(who) });
  }
}

/** Starts a gateway on a free port of this computer. */
export function startMock(options = {}) {
  return new MockGateway(options).start();
}
