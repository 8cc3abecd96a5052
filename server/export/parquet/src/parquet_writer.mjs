// Writes Parquet files from a stream of columns. tandem-server passes this program to node on standard input, and the
// stream on descriptor 3.
//
// The stream is a sequence of messages: 4 bytes length (little-endian), JSON of that length, then for `rows` the columns.
//   {"file": PATH, "columns": [{"name", "type", "shape"}], "metadata": {KEY: TEXT}}   begins a file
//   {"rows": N, "texts": {COLUMN: [...]}}                                             a row group; the bytes of its columns follow
//   {"end": true}                                                                     completes the file
// A column has type FLOAT, DOUBLE, INT64, BOOLEAN (a byte each) or STRING (in `texts`), and a shape: [] for one value per
// row, [n] for a list, [n, m] for a list of lists. Numbers are little-endian. The stream may end only between two files.
import fs from 'node:fs'
import { ParquetWriter, fileWriter } from 'hyparquet-writer'

const kStream = 3

/** Reads exactly `size` bytes; undefined at the end of the stream if `mayEnd`. */
function read(size, mayEnd = false) {
  const bytes = new Uint8Array(size)
  let filled = 0
  while (filled < size) {
    const got = fs.readSync(kStream, bytes, filled, size - filled, null)
    if (got === 0) {
      if (mayEnd && filled === 0) return undefined
      throw new Error('the stream ended within a message')
    }
    filled += got
  }
  return bytes
}

function readMessage(mayEnd) {
  const head = read(4, mayEnd)
  if (head === undefined) return undefined
  const size = new DataView(head.buffer).getUint32(0, true)
  return JSON.parse(new TextDecoder().decode(read(size)))
}

const kBytes = { FLOAT: 4, DOUBLE: 8, INT64: 8, BOOLEAN: 1 }

/** The numbers of a column as an array of their JavaScript type. */
function numbers(type, bytes) {
  if (type === 'FLOAT') return new Float32Array(bytes.buffer)
  if (type === 'DOUBLE') return new Float64Array(bytes.buffer)
  if (type === 'INT64') return new BigInt64Array(bytes.buffer)
  return Array.from(bytes, value => value !== 0)
}

/** Cuts flat values into nested lists of the given shape, one per row. */
function nested(values, shape) {
  if (shape.length === 0) return values
  const [size, ...inner] = shape
  const rest = nested(values, inner)
  const lists = []
  for (let at = 0; at < rest.length; at += size) lists.push(Array.from(rest.slice(at, at + size)))
  return lists
}

/** Schema elements of a column: plain, or lists of three levels as Arrow writes them. */
function schemaOf({ name, type, shape }) {
  const plain = type === 'STRING' ? { type: 'BYTE_ARRAY', converted_type: 'UTF8', logical_type: { type: 'STRING' } } : { type }
  if (shape.length === 0) return [{ name, ...plain, repetition_type: 'OPTIONAL' }]
  const elements = []
  for (let level = 0; level < shape.length; ++level) {
    elements.push({ name: level === 0 ? name : 'element', repetition_type: 'OPTIONAL', num_children: 1, converted_type: 'LIST', logical_type: { type: 'LIST' } })
    elements.push({ name: 'list', repetition_type: 'REPEATED', num_children: 1 })
  }
  elements.push({ name: 'element', ...plain, repetition_type: 'OPTIONAL' })
  return elements
}

function writeFile({ file, columns, metadata }) {
  const pairs = Object.entries(metadata).map(([key, value]) => ({ key, value }))
  const writer = new ParquetWriter({
    writer: fileWriter(file),
    schema: [{ name: 'schema', num_children: columns.length }, ...columns.flatMap(schemaOf)],
    kvMetadata: pairs.length > 0 ? pairs : undefined, // an empty list has a type that strict readers reject
    createdBy: 'tandem-server',
    statistics: false, // readers use none of lists of numbers, and NaN has no order
  })
  for (;;) {
    const message = readMessage()
    if (message.end) break
    const columnData = columns.map(({ name, type, shape }) => {
      const perRow = shape.reduce((product, size) => product * size, 1)
      const flat = type === 'STRING' ? message.texts[name] : numbers(type, read(message.rows * perRow * kBytes[type]))
      return { name, data: Array.from(nested(flat, shape)) }
    })
    writer.write({ columnData, rowGroupSize: message.rows })
  }
  writer.finish()
}

try {
  for (let message = readMessage(true); message !== undefined; message = readMessage(true)) writeFile(message)
} catch (error) {
  process.stderr.write(`${error.errno ? `errno ${-error.errno} ` : ''}${error.message}\n`)
  process.exitCode = 1
}
