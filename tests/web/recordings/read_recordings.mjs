// Reads recordings with @mcap/core, the official reader of MCAP: read_recordings.mjs FILE.mcap...
// Prints one line per check; exit code 1 if one fails.
import { readFileSync } from "node:fs";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import schemas from "@foxglove/schemas/internal.js";
import zstd from "@foxglove/wasm-zstd";
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor/index.js";

await zstd.isLoaded;
const decompressHandlers = { zstd: (bytes, size) => new Uint8Array(zstd.decompress(bytes, Number(size))) };

let passed = 0;
let failed = 0;
function check(name, ok, detail = "") {
  if (ok) passed += 1;
  else failed += 1;
  console.log(`${ok ? "ok     " : "FAILED "} ${name}${ok ? "" : ` ${detail}`}`);
}
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/// The types of a FileDescriptorSet.
function rootOf(data) {
  const root = protobuf.Root.fromDescriptor(descriptor.FileDescriptorSet.decode(data));
  root.resolveAll();
  return root;
}

/// Parses Foxglove's own definition of every message into one root, in the package foxglove.
function foxgloveRoot() {
  const root = new protobuf.Root();
  for (const name of ["timestamp", "duration"]) root.addJSON(protobuf.common.get(`google/protobuf/${name}.proto`).nested);
  for (const schema of Object.values(schemas.foxgloveMessageSchemas)) {
    if (schema.protoEquivalent !== undefined) continue;
    const enums = Object.values(schemas.foxgloveEnumSchemas).filter((e) => e.parentSchemaName === schema.name);
    protobuf.parse(schemas.generateProto(schema, enums), root, { keepCase: true });
  }
  root.resolveAll();
  return root;
}
const official = foxgloveRoot();

/// Fields by number: name, type, rule. A nested message stands with its full name.
function shapeOf(type) {
  return Object.values(type.fields)
    .map((f) => [f.id, f.name, f.resolvedType ? f.resolvedType.fullName : f.type, f.repeated])
    .sort((a, b) => a[0] - b[0]);
}
/// A message of Foxglove with all messages in its fields.
function familyOf(type, family = new Map()) {
  if (family.has(type.fullName) || !type.fullName.startsWith(".foxglove.")) return family;
  family.set(type.fullName, type);
  for (const field of Object.values(type.fields))
    if (field.resolvedType?.fields !== undefined) familyOf(field.resolvedType, family);
  return family;
}

const readable = (bytes) => ({
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
});

/// Topics whose messages are accounted for per tick, from the metadata record `counts`.
async function countsOf(reader) {
  for await (const metadata of reader.readMetadata({ name: "counts" })) return metadata.metadata;
  return undefined;
}

async function readWhole(file, bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: readable(bytes), decompressHandlers });
  const topics = new Map([...reader.channelsById.values()].map((c) => [c.topic, c]));
  const wanted = ["/authority", "/session", "/inputs", "/link", "/events", "/marks", "/sheets", "/counts", "/view/scene", "/tf", "/log"];
  check(`${file}: has all channels of a session`, wanted.every((topic) => topics.has(topic)), [...topics.keys()]);
  check(`${file}: has a schema for every channel`, [...topics.values()].every((c) => reader.schemasById.has(c.schemaId)));

  const types = new Map();
  for (const schema of reader.schemasById.values()) types.set(schema.id, rootOf(schema.data).lookupType(schema.name));
  const counted = new Map();
  let time = 0n;
  let ordered = true;
  let decoded = true;
  let seat;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    counted.set(message.channelId, (counted.get(message.channelId) ?? 0n) + 1n);
    ordered &&= message.logTime >= time;
    time = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    const value = types.get(channel.schemaId).decode(message.data);
    decoded &&= types.get(channel.schemaId).verify(value) === null;
    if (channel.metadata.get("kind") === "seat") seat = value;
  }
  check(`${file}: every message decodes by its schema`, decoded);
  check(`${file}: messages come in the order of time`, ordered);
  check(`${file}: a seat has CRTK words`, ["measured_cp", "measured_cv", "measured_cf", "servo_cf"].every((key) => seat?.[key]?.xyz?.length === 3));
  const statistics = reader.statistics;
  check(`${file}: statistics are true`, [...reader.channelsById.keys()].every((id) => (statistics.channelMessageCounts.get(id) ?? 0n) === (counted.get(id) ?? 0n)) && statistics.channelCount === reader.channelsById.size);

  const counts = await countsOf(reader);
  const ticks = Number(counts?.get("ticks"));
  let account = ticks > 0;
  for (const [topic, text] of counts ?? []) {
    if (topic === "ticks") continue;
    const [, recorded, dropped, never] = text.match(/^recorded (\d+) dropped (\d+) never_received (\d+)$/).map(Number);
    account &&= recorded + dropped + never === ticks && BigInt(recorded) === counted.get(topics.get(topic).id);
  }
  check(`${file}: recorded + dropped + never received = ticks on every channel`, account, [...(counts ?? [])]);

  for (const schema of reader.schemasById.values()) {
    if (!schema.name.startsWith("foxglove.")) continue;
    const differ = [...familyOf(types.get(schema.id)).values()].filter((type) => {
      const other = official.lookupType(type.fullName);
      const enumsOf = (t) => (t.nestedArray ?? []).filter((n) => n.values !== undefined).map((n) => [n.name, n.values]);
      return !same(shapeOf(type), shapeOf(other)) || !same(enumsOf(type), enumsOf(other));
    });
    check(`${file}: ${schema.name} is that of @foxglove/schemas`, differ.length === 0, differ.map((t) => t.fullName));
  }
  return { channels: reader.channelsById.size, schemas: reader.schemasById.size, chunks: [...reader.chunkIndexes].sort((a, b) => Number(a.chunkStartOffset - b.chunkStartOffset)) };
}

/// Reads a stream that ends anywhere.
class Stream {
  messages = 0;
  channels = new Set();
  schemas = new Set();
  reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  add(bytes) {
    this.reader.append(bytes);
    for (let record; (record = this.reader.nextRecord()) !== undefined; ) {
      if (record.type === "Message") this.messages += 1;
      if (record.type === "Channel") this.channels.add(record.id);
      if (record.type === "Schema") this.schemas.add(record.id);
    }
  }
}

/// Cuts the file at both ends of each chunk, and at each byte of the last chunk.
function readCuts(file, bytes, whole) {
  let good = true;
  const perChunk = [];
  for (const chunk of whole.chunks) {
    const start = Number(chunk.chunkStartOffset);
    const end = start + Number(chunk.chunkLength);
    const before = new Stream();
    before.add(bytes.slice(0, start));
    const after = new Stream();
    after.add(bytes.slice(0, end));
    good &&= before.messages === (perChunk.at(-1) ?? 0) && after.messages > before.messages;
    good &&= after.channels.size === whole.channels && after.schemas.size === whole.schemas;
    perChunk.push(after.messages);
  }
  check(`${file}: a cut at each of ${whole.chunks.length} chunks gives all chunks before it, channels and schemas`, good);
  const last = whole.chunks.at(-1);
  const start = Number(last.chunkStartOffset);
  const length = Number(last.chunkLength);
  const stream = new Stream();
  stream.add(bytes.slice(0, start));
  const before = stream.messages;
  let silent = true;
  for (let k = 0; k < length - 1; ++k) {
    stream.add(bytes.slice(start + k, start + k + 1));
    silent &&= stream.messages === before;
  }
  check(`${file}: a cut at each of the ${length} bytes of the last chunk gives all chunks before it`, silent && before === (perChunk.at(-2) ?? 0));
  stream.add(bytes.slice(start + length - 1, start + length));
  check(`${file}: the last byte of the chunk gives its messages`, stream.messages === perChunk.at(-1));
}

for (const file of process.argv.slice(2)) {
  const bytes = new Uint8Array(readFileSync(file));
  const name = file.split("/").at(-1);
  try {
    readCuts(name, bytes, await readWhole(name, bytes));
  } catch (error) {
    check(`${name}: can be read`, false, error.stack);
  }
}
console.log(`${passed} passed, ${failed} failed`);
process.exitCode = failed === 0 && passed > 0 ? 0 : 1;
