// A recording, read by others: by the format's own library in both of its ways, checksums and all, and each message by
// the type that stands in the file. What they read is held against what our own reader says of the same file.
//
//   node judge.mjs RECORDING SAID      exit code 1 and a list where they differ

import { readFileSync } from "node:fs";
import { isDeepStrictEqual } from "node:util";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";

const [path, saidPath] = process.argv.slice(2);
const file = readFileSync(path);
const said = JSON.parse(readFileSync(saidPath, "utf8"));
const decompressHandlers = await loadDecompressHandlers();
const complaints = [];
const complain = (words) => complaints.push(words);

// ------------------------------------------------------------------------------------------- one message, by its type

const codecs = new Map();
function codecOf(schema) {
  if (!codecs.has(schema.id)) {
    const definitions = parse(new TextDecoder().decode(schema.data), { ros2: true });
    codecs.set(schema.id, { reader: new MessageReader(definitions), writer: new MessageWriter(definitions) });
  }
  return codecs.get(schema.id);
}

/** Read, written again and read again it is the same, and as long: no byte was left over, none was missing. */
function decoded(topic, schema, data) {
  const { reader, writer } = codecOf(schema);
  const value = reader.readMessage(data);
  const again = writer.writeMessage(value);
  const padding = data.length - again.length; // RTPS pads to a multiple of four
  if (padding < 0 || padding > 3) complain(`${topic}: ${data.length} bytes, of which its type takes ${again.length}`);
  if (!isDeepStrictEqual(reader.readMessage(again), value)) complain(`${topic}: not the same when written again`);
  return value;
}

/** Numbers as our reader spells them: whole ones of 64 bits as text, lists as lists. */
function plain(value) {
  if (typeof value === "bigint") return value.toString();
  if (typeof value === "number" && !Number.isFinite(value)) return null; // as JSON has it
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (value !== null && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([name, inner]) => [name, plain(inner)]));
  }
  return value;
}

// ------------------------------------------------------------------------------------------------------ by the summary

const readable = {
  size: async () => BigInt(file.length),
  read: async (offset, length) => new Uint8Array(file.subarray(Number(offset), Number(offset + length))),
};
const counts = {};
const samples = {};
let messages = 0;
if (said.whole) {
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  if (reader.header.profile !== "ros2") complain(`the profile is ${reader.header.profile}`);
  if (Number(reader.statistics.messageCount) !== said.messages) complain(`${reader.statistics.messageCount} messages in the statistics`);
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    counts[channel.topic] = (counts[channel.topic] ?? 0) + 1;
    ++messages;
    if (channel.messageEncoding !== "cdr" || schema.encoding !== "ros2msg") complain(`${channel.topic}: encoded as ${channel.messageEncoding}, ${schema.encoding}`);
    const value = decoded(channel.topic, schema, message.data);
    samples[channel.topic] = plain(value); // the last one stays
  }
  const groups = [...reader.summaryOffsetsByOpcode.values()];
  const kinds = groups.map((group) => group.groupOpcode).sort((a, b) => a - b);
  if (!isDeepStrictEqual(kinds, [0x03, 0x04, 0x08, 0x0b, 0x0d])) complain(`groups of the summary: ${kinds}`);
  for (const { groupOpcode, groupStart } of groups) {
    if (file[Number(groupStart)] !== groupOpcode) complain(`no group ${groupOpcode} begins at byte ${groupStart}`);
  }
  if (!isDeepStrictEqual(counts, said.topics)) complain(`topics by the summary: ${JSON.stringify(counts)}`);
  for (const [topic, fields] of Object.entries(said.samples)) {
    for (const [name, value] of Object.entries(fields)) {
      const theirs = samples[topic]?.[name];
      if (!isDeepStrictEqual(theirs, value)) complain(`${topic}.${name}: ${JSON.stringify(theirs)}, and we say ${JSON.stringify(value)}`);
    }
  }
}

// ------------------------------------------------------------------------------------------------------ from the front

const stream = new McapStreamReader({ validateCrcs: true, decompressHandlers });
stream.append(file);
const streamed = {};
let inStream = 0;
const topics = new Map();
const metadata = {};
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Channel") topics.set(record.id, record.topic);
  if (record.type === "Metadata") metadata[record.name] = Object.fromEntries(record.metadata);
  if (record.type !== "Message") continue;
  const topic = topics.get(record.channelId);
  streamed[topic] = (streamed[topic] ?? 0) + 1;
  ++inStream;
}
if (stream.done() !== said.whole) complain(`read to the end: ${stream.done()}, and we say ${said.whole}`);
if (!isDeepStrictEqual(streamed, said.topics)) complain(`topics from the front: ${JSON.stringify(streamed)}`);
if (!isDeepStrictEqual(metadata, said.metadata)) complain(`metadata: ${JSON.stringify(metadata)}`);

for (const complaint of complaints.slice(0, 20)) console.error(complaint);
if (complaints.length === 0) {
  console.log(`judged: ${inStream} messages from the front, ${messages} by the summary, ${codecs.size} types`);
}
process.exit(complaints.length === 0 ? 0 : 1);
