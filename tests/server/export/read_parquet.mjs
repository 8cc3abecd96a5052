// Prints a Parquet file as JSON with a reader that shares no code with the writer: {"schema", "metadata", "rows"}.
// read_parquet.mjs FILE PACKAGES, where PACKAGES has the npm packages parquet-wasm (Rust) and apache-arrow.
import fs from 'node:fs'
import { createRequire } from 'node:module'
const [file, packages] = process.argv.slice(2)
const require = createRequire(packages + '/')
const { readParquet, readSchema } = require('parquet-wasm')
const { tableFromIPC } = require('apache-arrow')
const bytes = new Uint8Array(fs.readFileSync(file))
const table = tableFromIPC(readParquet(bytes).intoIPCStream())
const plain = (value) =>
  value === null || value === undefined ? null
  : typeof value === 'bigint' ? Number(value)
  : typeof value === 'number' && Number.isNaN(value) ? 'NaN'
  : typeof value === 'object' ? Array.from(value, plain)
  : value
const rows = table.toArray().map((row) => Object.fromEntries(table.schema.fields.map(({ name }) => [name, plain(row[name])])))
console.log(JSON.stringify({
  schema: Object.fromEntries(table.schema.fields.map(({ name, type }) => [name, String(type)])),
  metadata: Object.fromEntries(tableFromIPC(readSchema(bytes).intoIPCStream()).schema.metadata),
  rows,
}))
