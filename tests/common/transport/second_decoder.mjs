// Second decoder of the datagrams of Tandem, written from common/transport/FORMAT.md alone, without knowledge of the
// first one. Where the two agree, the text alone determines the format. Run: node second_decoder.mjs vectors.json
// It covers the layout, the derivation of keys, and those checks of a receiver that need one datagram only. The replay
// window needs a history and the plaintext needs proto/schema/wire.proto; the vectors contain neither.

import { createDecipheriv, createHmac } from 'node:crypto';
import { readFileSync } from 'node:fs';

const VERSION = 2;
const LOWEST_TYPE = 3;
const HIGHEST_TYPE = 11;
const HEADER_BYTES = 16;
const TAG_BYTES = 16;
const SMALLEST_DATAGRAM = HEADER_BYTES + TAG_BYTES;
const LARGEST_DATAGRAM = 1200;
const COUNTER_OFFSET = 8;
const COUNTER_BYTES = 8;
const PHASES = 256;  // the header carries the key number modulo this
const CIPHERS = { 'AES-256-GCM': 'aes-256-gcm', 'ChaCha20-Poly1305': 'chacha20-poly1305' };

// Thrown where a receiver drops the datagram. A separate class, so that an error in this file (such as a TypeError)
// never counts as a rejected forgery.
class Refused extends Error {}
function demand(condition, reason) {
  if (!condition) throw new Refused(`refused: ${reason}`);
}

function expand(secret, label, length) {
  const prefix = Buffer.from([length >> 8, length & 0xff, label.length]);
  const info = Buffer.concat([prefix, Buffer.from(label, 'ascii'), Buffer.from([0x00, 0x01])]);
  return createHmac('sha256', secret).update(info).digest().subarray(0, length);
}

function deriveKey(secret0, number) {
  let secret = secret0;
  for (let n = 0; n < number; n++) secret = expand(secret, 'tandem ku', 32);
  return { number, key: expand(secret, 'tandem key', 32), iv: expand(secret, 'tandem iv', 12) };
}

function readHeader(datagram) {
  demand(datagram.length >= SMALLEST_DATAGRAM && datagram.length <= LARGEST_DATAGRAM, 'size');
  const type = datagram[0] & 0x0f;
  demand(datagram[0] >> 4 === VERSION, 'version');
  demand(type >= LOWEST_TYPE && type <= HIGHEST_TYPE, 'type');
  demand(datagram.readUInt16LE(2) === 0, 'zeros');
  return { type, phase: datagram[1], connectionId: datagram.readUInt32LE(4), counter: datagram.readBigUInt64LE(COUNTER_OFFSET) };
}

// Decrypts and authenticates only; checks no field of the header. Some forgeries are passed here directly. They show
// that the tag alone rejects what the checks of the header reject earlier.
function unseal(datagram, cipherName, { key, iv }) {
  const nonce = Buffer.from(iv);
  const firstXored = nonce.length - COUNTER_BYTES;
  for (let i = 0; i < COUNTER_BYTES; i++) nonce[firstXored + i] ^= datagram[COUNTER_OFFSET + i];

  // authTagLength is required: without it Node accepts GCM tags of as few as four bytes.
  const decipher = createDecipheriv(CIPHERS[cipherName], key, nonce, { authTagLength: TAG_BYTES });
  const tagOffset = datagram.length - TAG_BYTES;
  decipher.setAAD(datagram.subarray(0, HEADER_BYTES));
  decipher.setAuthTag(datagram.subarray(tagOffset));
  const plaintext = decipher.update(datagram.subarray(HEADER_BYTES, tagOffset));
  try {
    decipher.final();  // compares the tag; the only call here that may reject
  } catch {
    throw new Refused('refused: tag');
  }
  return plaintext;
}

// A receiver that holds a single key. The receiver of FORMAT.md holds up to three and selects one by the phase.
function receive(datagram, { cipherName, connectionId, heldKey }) {
  const header = readHeader(datagram);
  demand(header.connectionId === connectionId, 'connection id');
  demand(header.phase === heldKey.number % PHASES, 'key phase');
  return { ...header, plaintext: unseal(datagram, cipherName, heldKey) };
}

function check(condition, message) {
  if (!condition) throw new Error(message);
}

function bytesOf(hex) {
  const bytes = Buffer.from(hex, 'hex');
  // Buffer.from() stops at the first bad digit without an error.
  check(bytes.toString('hex') === hex, `not hexadecimal: ${hex}`);
  return bytes;
}

function mustOpen(entry, datagram, receiver) {
  const opened = receive(datagram, receiver);
  check(opened.type === entry.type, `type ${opened.type}, expected ${entry.type}`);
  check(opened.connectionId === entry.connection_id, `connection id ${opened.connectionId}, expected ${entry.connection_id}`);
  check(opened.counter === BigInt(entry.counter), `counter ${opened.counter}, expected ${entry.counter}`);
  check(opened.plaintext.equals(bytesOf(entry.plaintext)), 'the plaintext differs');
}

let forgeriesRefused = 0;
function mustRefuse(what, open) {
  try {
    open();
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    forgeriesRefused++;
    return;
  }
  throw new Error(`opened, but had to be refused: ${what}`);
}

function changed(datagram, change) {
  const copy = Buffer.from(datagram);
  change(copy);
  return copy;
}

function mustRefuseForgeries(datagram, receiver, secret0) {
  const { cipherName, heldKey } = receiver;

  for (let bit = 0; bit < datagram.length * 8; bit++) {
    const what = `bit ${bit % 8} of byte ${bit >> 3} flipped`;
    const flipped = changed(datagram, (copy) => { copy[bit >> 3] ^= 1 << (bit % 8); });
    mustRefuse(what, () => receive(flipped, receiver));
    if (bit < HEADER_BYTES * 8) mustRefuse(`${what}, by the tag alone`, () => unseal(flipped, cipherName, heldKey));
  }

  for (let length = 0; length < datagram.length; length++) {
    mustRefuse(`truncated to ${length} bytes`, () => receive(datagram.subarray(0, length), receiver));
  }

  // At a distance of 256 the phase is equal and only the tag distinguishes the keys. At a distance of 1 the phase check
  // would reject first. The cipher is therefore called directly, and then with the phase rewritten to match.
  for (const number of [-PHASES, -1, 1, PHASES].map((distance) => heldKey.number + distance).filter((n) => n >= 0)) {
    const neighbour = deriveKey(secret0, number);
    const relabelled = changed(datagram, (copy) => { copy[1] = number % PHASES; });
    mustRefuse(`as sent, under key ${number}`, () => unseal(datagram, cipherName, neighbour));
    mustRefuse(`relabelled, under key ${number}`, () => receive(relabelled, { ...receiver, heldKey: neighbour }));
  }

  const counter = datagram.readBigUInt64LE(COUNTER_OFFSET);
  for (const difference of [-1n, 1n, 1n << 32n, 1n << 63n]) {
    const other = BigInt.asUintN(64, counter + difference);
    const renumbered = changed(datagram, (copy) => copy.writeBigUInt64LE(other, COUNTER_OFFSET));
    mustRefuse(`counter ${other} in the header`, () => receive(renumbered, receiver));
  }
}

function main(path) {
  check(path !== undefined, 'usage: node second_decoder.mjs vectors.json');
  const { datagrams } = JSON.parse(readFileSync(path, 'utf8'));
  check(datagrams.length > 0, 'no datagrams in the file');
  for (const entry of datagrams) {
    try {
      check(Object.hasOwn(CIPHERS, entry.cipher), `unknown cipher ${entry.cipher}`);
      const secret0 = bytesOf(entry.secret_0);
      const datagram = bytesOf(entry.datagram);
      const receiver = { cipherName: entry.cipher, connectionId: entry.connection_id, heldKey: deriveKey(secret0, entry.key_number) };
      mustOpen(entry, datagram, receiver);
      mustRefuseForgeries(datagram, receiver, secret0);
    } catch (error) {
      throw new Error(`${entry.name}: ${error.message}`);
    }
  }
  console.log(`${datagrams.length} datagrams opened, ${forgeriesRefused} forgeries refused`);
}

try {
  main(process.argv[2]);
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
