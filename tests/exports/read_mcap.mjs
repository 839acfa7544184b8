// Reads an MCAP file of `msc_vo export` with the reference implementation of the container, and decodes
// its messages by the definitions in the file alone. Prints the last message of each topic.
//
//   npm install @mcap/core @foxglove/wasm-zstd
//   node read_mcap.mjs FILE
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import zstd from "@foxglove/wasm-zstd";
import { readFileSync } from "node:fs";

const SIZES = { bool: 1, uint8: 1, int32: 4, uint32: 4, float32: 4, float64: 8 };
const GET = { bool: "getUint8", uint8: "getUint8", int32: "getInt32", uint32: "getUint32",
              float32: "getFloat32", float64: "getFloat64" };

// Fields of all types in a definition: {"std_msgs/Header": [{type, count, name}]}.
function parse(name, text) {
  const types = {};
  for (const part of ("MSG: " + name.replace("/msg/", "/") + "\n" + text).split(/^=+\n/m)) {
    const [head, ...lines] = part.trim().split("\n");
    types[head.slice(5)] = lines.filter((l) => !l.includes("=")).map((l) => {
      const [, type, count, field] = l.match(/^([\w/]+)(\[\d*\])?\s+(\w+)/);
      return { type, count, field };
    });
  }
  return types;
}

class Decoder {
  constructor(data, types) {
    if (data[0] !== 0 || data[1] !== 1) throw new Error("no little-endian CDR");
    this.view = new DataView(data.buffer, data.byteOffset + 4, data.byteLength - 4);
    this.types = types;
    this.at = 0;
  }
  value(type) {
    if (type === "string") {
      const size = this.value("uint32");
      let text = "";
      for (let i = 0; i < size - 1; ++i) text += String.fromCharCode(this.view.getUint8(this.at + i));
      if (this.view.getUint8(this.at + size - 1) !== 0) throw new Error("string without an end");
      this.at += size;
      return text;
    }
    if (!SIZES[type]) {
      return Object.fromEntries(this.types[type].map((f) => [f.field, this.field(f)]));
    }
    this.at = Math.ceil(this.at / SIZES[type]) * SIZES[type];
    const value = this.view[GET[type]](this.at, true);
    this.at += SIZES[type];
    return value;
  }
  field({ type, count }) {
    if (!count) return this.value(type);
    const size = count === "[]" ? this.value("uint32") : Number(count.slice(1, -1));
    return Array.from({ length: size }, () => this.value(type));
  }
}

await zstd.isLoaded;
const file = readFileSync(process.argv[2]);
const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, Number(size)) };
const readable = {
  size: async () => BigInt(file.length),
  read: async (offset, size) => new Uint8Array(file.subarray(Number(offset), Number(offset + size))),
};
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
const counts = {};
const last = {};
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const { topic, schemaId } = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(schemaId);
  const decoder = new Decoder(message.data, parse(schema.name, new TextDecoder().decode(schema.data)));
  const value = decoder.value(schema.name.replace("/msg/", "/"));
  if (decoder.at !== decoder.view.byteLength) throw new Error(topic + ": bytes are left over");
  counts[topic] = (counts[topic] ?? 0) + 1;
  last[topic] = { schema: schema.name, log_time: message.logTime, value };
}
// The same without the index.
const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(file);
let streamed = 0;
for (let record; (record = stream.nextRecord());) streamed += record.type === "Message" ? 1 : 0;
const { statistics, header } = reader;
console.log(header.profile, "|", header.library, "| chunks", reader.chunkIndexes.length, "| messages",
            String(statistics.messageCount), "indexed", Object.values(counts).reduce((a, b) => a + b),
            "streamed", streamed, "done", stream.done());
const short = (key, value) => typeof value === "bigint" ? String(value)
  : Array.isArray(value) && value.length > 36 ? [...value.slice(0, 2), `(${value.length})`] : value;
for (const [topic, { schema, log_time, value }] of Object.entries(last)) {
  console.log(topic, schema, counts[topic], JSON.stringify({ log_time, value }, short).slice(0, 900));
}
