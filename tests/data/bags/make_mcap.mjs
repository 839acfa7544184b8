// Writes the MCAP files of this folder with the reference implementation of the format.
//
//   npm install @mcap/core @foxglove/wasm-zstd lz4js
//   node make_mcap.mjs
import { McapWriter, TempBuffer } from "@mcap/core";
import zstd from "@foxglove/wasm-zstd";
import lz4 from "lz4js";
import { writeFileSync } from "node:fs";

// Fields of a message in CDR, the lowest byte first.
class Cdr {
  constructor() {
    this.bytes = [0, 1, 0, 0];
  }
  align(size) {
    while ((this.bytes.length - 4) % size !== 0) this.bytes.push(0);
    return this;
  }
  u8(value) {
    this.bytes.push(value);
    return this;
  }
  u32(value) {
    this.align(4);
    for (let i = 0; i < 4; ++i) this.bytes.push((value >>> (8 * i)) & 255);
    return this;
  }
  f64(value) {
    this.align(8);
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, value, true);
    for (let i = 0; i < 8; ++i) this.bytes.push(view.getUint8(i));
    return this;
  }
  text(value) {
    this.u32(value.length + 1);
    for (const c of value) this.u8(c.charCodeAt(0));
    return this.u8(0);
  }
  header(i) {
    return this.u32(1700000000).u32(i * 100000000).text("camera");
  }
  array() {
    return Uint8Array.from(this.bytes);
  }
}

function image(i, encoding, pixelBytes, pixel) {
  const cdr = new Cdr().header(i).u32(12).u32(16).text(encoding).u8(0);
  cdr.u32(16 * pixelBytes).u32(12 * 16 * pixelBytes);
  for (let y = 0; y < 12; ++y) {
    for (let x = 0; x < 16; ++x) for (const byte of pixel(x, y)) cdr.u8(byte);
  }
  return cdr.array();
}

function cameraInfo() {
  const cdr = new Cdr().header(0).u32(12).u32(16).text("plumb_bob").u32(5);
  for (let i = 0; i < 5; ++i) cdr.f64(0);
  for (const k of [14.5, 0, 7.5, 0, 14.5, 5.5, 0, 0, 1]) cdr.f64(k);
  for (const r of [1, 0, 0, 0, 1, 0, 0, 0, 1]) cdr.f64(r);
  for (const p of [14.5, 0, 7.5, 0, 0, 14.5, 5.5, 0, 0, 0, 1, 0]) cdr.f64(p);
  return cdr.array();
}

async function write(name, options) {
  const buffer = new TempBuffer();
  const writer = new McapWriter({ writable: buffer, chunkSize: 1000, ...options });
  await writer.start({ profile: "ros2", library: "" });
  const channels = {};
  for (const [topic, type] of [
    ["/camera/color/image_raw", "sensor_msgs/msg/Image"],
    ["/camera/depth/image_rect_raw", "sensor_msgs/msg/Image"],
    ["/camera/color/camera_info", "sensor_msgs/msg/CameraInfo"],
  ]) {
    const schemaId = await writer.registerSchema({
      name: type, encoding: "ros2msg", data: new Uint8Array(),
    });
    channels[topic] = await writer.registerChannel({
      topic, schemaId, messageEncoding: "cdr", metadata: new Map(),
    });
  }
  const add = (topic, i, data) =>
    writer.addMessage({
      channelId: channels[topic], sequence: i, data,
      logTime: 1700000000000000000n + BigInt(i) * 100000000n,
      publishTime: 1700000000000000000n + BigInt(i) * 100000000n,
    });
  await add("/camera/color/camera_info", 0, cameraInfo());
  for (let i = 0; i < 3; ++i) {
    const grey = 40 * (i + 1);
    await add("/camera/color/image_raw", i, image(i, "rgb8", 3, () => [grey, grey, grey]));
    await add("/camera/depth/image_rect_raw", i, image(i, "16UC1", 2, (x, y) => {
      const depth = 1000 * (i + 1) + x + 20 * y;
      return [depth & 255, depth >> 8];
    }));
  }
  await writer.end();
  writeFileSync(name, buffer.get());
}

await zstd.isLoaded;
await write("none.mcap", {});
await write("unchunked.mcap", { useChunks: false });
await write("lz4.mcap", { compressChunk: (data) => ({ compression: "lz4", compressedData: lz4.compress(data) }) });
await write("zstd.mcap", {
  compressChunk: (data) => ({ compression: "zstd", compressedData: zstd.compress(data) }),
});
