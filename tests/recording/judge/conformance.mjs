// Makes the format's own conformance files: small ones, with every combination of what a writer may do or leave out. The
// project keeps them where a clone does not bring them; these are the same bytes, as the digest says.
//
//   node conformance.mjs FOLDER     writes NAME.mcap files, and MANIFEST: per line a name, its messages, whether they can
//                                   be found by the summary, its metadata records

import { createHash } from "node:crypto";
import { mkdirSync, writeFileSync } from "node:fs";
import { crc32 } from "@foxglove/crc";
import { McapChunkBuilder, McapConstants, McapRecordBuilder } from "@mcap/core";

const { Opcode } = McapConstants;

/** Of every file's name and SHA-256, in the order of the names, as the project's own repository has them. */
const DIGEST = "eabcfbf8e6525dd4022cb979a3d1793443a31f427cc163be4ddb98e295cd8d01";

const FEATURES = ["ch", "mx", "st", "rsh", "rch", "ax", "mdx", "chx", "sum", "pad"];
const bytes = (...values) => new Uint8Array(values);
const schema = { type: "Schema", id: 1, name: "Example", encoding: "c", data: bytes(4, 5, 6) };
const channel = { type: "Channel", id: 1, topic: "example", schemaId: 1, messageEncoding: "a", metadata: new Map([["foo", "bar"]]) };
const schemaless = { ...channel, schemaId: 0, messageEncoding: "text", metadata: new Map() };
const message = (sequence, publishTime, logTime) => ({ type: "Message", channelId: 1, sequence, publishTime, logTime, data: bytes(1, 2, 3) });
const TIMES = [0n, 2n, 1n, 3n, 3n, 5n, 4n, 7n, 8n, 9n];
const INPUTS = {
  NoData: [],
  OneSchemalessMessage: [schemaless, message(10, 1n, 2n)],
  OneMessage: [schema, channel, message(10, 1n, 2n)],
  OneAttachment: [{ type: "Attachment", name: "myFile", mediaType: "application/octet-stream", logTime: 2n, createTime: 1n, data: bytes(1, 2, 3) }],
  OneMetadata: [{ type: "Metadata", name: "myMetadata", metadata: new Map([["foo", "bar"]]) }],
  TenMessages: [schema, channel, ...TIMES.map((time, i) => message(i, time, time))],
};

/** Whether a writer of these records can have these features. */
function sensible(records, has) {
  const holds = (...types) => records.some((record) => types.includes(record.type));
  if (has("ax") && !holds("Attachment")) return false;
  if (has("mdx") && !holds("Metadata")) return false;
  if (has("rsh") && !holds("Schema")) return false;
  if (has("rch") && !holds("Channel")) return false;
  if ((has("ch") || has("chx") || has("mx")) && !holds("Message", "Channel", "Schema")) return false;
  if (has("sum") && !["chx", "rsh", "rch", "mdx", "ax", "st"].some(has)) return false;
  return has("ch") || !(has("chx") || has("mx"));
}

function footer(builder, summaryStart, summaryOffsetStart, summary) {
  const head = new DataView(new ArrayBuffer(25));
  head.setUint8(0, Opcode.FOOTER);
  head.setBigUint64(1, 20n, true);
  head.setBigUint64(9, summaryStart, true);
  head.setBigUint64(17, summaryOffsetStart, true);
  const summed = Buffer.concat([summary, new Uint8Array(head.buffer)]);
  builder.writeFooter({ summaryStart, summaryOffsetStart, summaryCrc: crc32(summed) });
}

function fileOf(records, has) {
  const builder = new McapRecordBuilder({ padRecords: has("pad") });
  const place = () => BigInt(builder.length);
  builder.writeMagic();
  builder.writeHeader({ profile: "", library: "" });
  const chunk = has("ch") ? new McapChunkBuilder({ useMessageIndex: has("mx") }) : undefined;
  const indexes = { metadata: [], attachment: [], chunk: [] };
  for (const record of records) {
    const offset = place();
    if (record.type === "Attachment") {
      const length = builder.writeAttachment(record);
      indexes.attachment.push({ ...record, offset, length, dataSize: BigInt(record.data.byteLength) });
    } else if (record.type === "Metadata") {
      indexes.metadata.push({ name: record.name, offset, length: builder.writeMetadata(record) });
    } else if (chunk) {
      chunk[`add${record.type}`](record);
    } else {
      builder[`write${record.type}`](record);
    }
  }
  if (chunk) {
    const size = BigInt(chunk.buffer.byteLength);
    const { messageStartTime, messageEndTime } = chunk;
    const about = { compression: "", messageStartTime, messageEndTime, uncompressedSize: size };
    const chunkStartOffset = place();
    const chunkLength = builder.writeChunk({ ...about, uncompressedCrc: crc32(chunk.buffer), records: chunk.buffer });
    const messageIndexOffsets = new Map();
    let messageIndexLength = 0n;
    for (const index of chunk.indices) {
      messageIndexOffsets.set(index.channelId, place());
      messageIndexLength += builder.writeMessageIndex(index);
    }
    indexes.chunk.push({ ...about, compressedSize: size, chunkStartOffset, chunkLength, messageIndexLength, messageIndexOffsets });
  }
  builder.writeDataEnd({ dataSectionCrc: crc32(builder.buffer) });

  const of = (type) => records.filter((record) => record.type === type);
  const times = of("Message").map((record) => record.logTime);
  const extreme = (better) => times.reduce((best, time) => (better(time, best) ? time : best), times[0] ?? 0n);
  const begin = place();
  const groups = [];
  const group = (wanted, opcode, write) => {
    const groupStart = place();
    if (wanted) write();
    if (place() > groupStart) groups.push({ groupOpcode: opcode, groupStart, groupLength: place() - groupStart });
  };
  group(has("rsh"), Opcode.SCHEMA, () => of("Schema").forEach((record) => builder.writeSchema(record)));
  group(has("rch"), Opcode.CHANNEL, () => of("Channel").forEach((record) => builder.writeChannel(record)));
  group(has("st"), Opcode.STATISTICS, () =>
    builder.writeStatistics({
      messageCount: BigInt(times.length),
      channelCount: of("Channel").length,
      schemaCount: of("Schema").length,
      attachmentCount: of("Attachment").length,
      metadataCount: of("Metadata").length,
      chunkCount: chunk ? 1 : 0,
      messageStartTime: extreme((a, b) => a < b),
      messageEndTime: extreme((a, b) => a > b),
      channelMessageCounts: new Map(times.length > 0 ? [[1, BigInt(times.length)]] : []),
    }),
  );
  group(has("mdx"), Opcode.METADATA_INDEX, () => indexes.metadata.forEach((index) => builder.writeMetadataIndex(index)));
  group(has("ax"), Opcode.ATTACHMENT_INDEX, () => indexes.attachment.forEach((index) => builder.writeAttachmentIndex(index)));
  group(has("chx"), Opcode.CHUNK_INDEX, () => indexes.chunk.forEach((index) => builder.writeChunkIndex(index)));
  const summarised = place() > begin;
  const offsets = has("sum") ? place() : 0n;
  if (has("sum")) groups.forEach((one) => builder.writeSummaryOffset(one));
  footer(builder, summarised ? begin : 0n, offsets, builder.buffer.slice(Number(begin)));
  builder.writeMagic();
  return builder.buffer;
}

const folder = process.argv[2];
mkdirSync(folder, { recursive: true });
const digests = [];
let manifest = "";
for (const [input, records] of Object.entries(INPUTS)) {
  for (let choice = 0; choice < 1 << FEATURES.length; ++choice) {
    const chosen = FEATURES.filter((_, i) => (choice >> i) & 1);
    const has = (feature) => chosen.includes(feature);
    if (!sensible(records, has)) continue;
    const name = [input, ...chosen.sort()].join("-");
    const file = fileOf(records, has);
    writeFileSync(`${folder}/${name}.mcap`, file);
    digests.push(`${name} ${createHash("sha256").update(file).digest("hex")}\n`);
    const count = (type) => records.filter((record) => record.type === type).length;
    const indexed = has("chx") && has("rch") && (has("rsh") || count("Schema") === 0) ? 1 : 0;
    manifest += `${name} ${count("Message")} ${indexed} ${count("Metadata")}\n`;
  }
}
const digest = createHash("sha256").update(digests.sort().join("")).digest("hex");
if (digest !== DIGEST) {
  console.error(`these are not the conformance files: their digest is ${digest}`);
  process.exit(1);
}
writeFileSync(`${folder}/MANIFEST`, manifest);
