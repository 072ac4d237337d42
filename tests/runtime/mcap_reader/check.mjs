// Runs a task and reads its log with MCAP's own readers: by the index, and as a stream with every CRC checked.
// The blocks of records are unpacked as docs/logs.md tells it, and compared with the records that are shown as JSON.
// Channels with Foxglove's schemas are judged by those of @foxglove/schemas.
// usage: node check.mjs ZWANG TASK FOLDER
import schemas from '@foxglove/schemas/jsonschema.js';
import {McapIndexedReader, McapStreamReader} from '@mcap/core';
import {Ajv} from 'ajv';
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {resolve} from 'node:path';
import {decompress} from 'fzstd';

const [zwang, task, folder] = process.argv.slice(2);
const run = JSON.parse(execFileSync(zwang, ['run', task, '--log', folder, '--format', 'json'], {encoding: 'utf8'}));
const log = `${folder}/log.mcap`;
const info = JSON.parse(execFileSync(zwang, ['info', log, '--format', 'json'], {encoding: 'utf8'}));
const bytes = readFileSync(log);
const text = (data) => new TextDecoder().decode(data);
const decompressHandlers = {zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size)))};

const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
};
const reader = await McapIndexedReader.Initialize({readable, decompressHandlers});
const schemaOf = (channel) => reader.schemasById.get(channel.schemaId);
const channelOf = new Map([...reader.channelsById.values()].map((channel) => [channel.topic, channel]));
for (const channel of channelOf.values()) {
  assert.equal(schemaOf(channel).encoding, 'jsonschema');
  assert.equal(channel.messageEncoding, channel.topic === '/records' ? 'zwang.block' : 'json');
}

/** What Foxglove's reader of schemas asks for, else it shows nothing of the channel (parseJsonSchema of Foxglove Studio 1.48). */
function checkReadable(schema, where) {
  assert.equal(typeof schema.type, 'string', `${where} has one type`);
  if (schema.type === 'array') checkReadable(schema.items, `${where}[]`);
  else if (schema.type === 'object') for (const [name, one] of Object.entries(schema.properties)) checkReadable(one, `${where}.${name}`);
  else assert.ok(['boolean', 'string', 'number', 'integer'].includes(schema.type), `${where} is ${schema.type}`);
}
for (const {name, data} of reader.schemasById.values()) checkReadable(JSON.parse(text(data)), name);

const properties = JSON.parse(text(schemaOf(channelOf.get('/records')).data)).properties;
const names = Object.keys(properties);

/** A record an array, one number a column, as docs/logs.md tells it. */
function unpack(data) {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const [count, columns] = [view.getUint32(0, true), view.getUint32(4, true)];
  assert.equal(columns, names.length);
  let at = 8;
  const number = () => view.getBigUint64((at += 8) - 8, true);
  const column = (all) => {
    const kind = view.getUint8(at++);
    if (kind === 0) return Array(count).fill(0x7ff8000000000000n);
    if (kind === 1) return Array(count).fill(number());
    if (kind === 2) return all[view.getUint16((at += 2) - 2, true)];
    const [order, width] = [kind >> 4, kind & 15];
    const numbers = Array.from({length: count}, (_, i) => (i < order ? number() : 0n));
    for (let plane = width - 1; plane >= 0; plane -= 1)
      for (let i = order; i < count; i += 1) numbers[i] |= BigInt(view.getUint8(at++)) << BigInt(8 * plane);
    for (let i = order; i < count; i += 1) numbers[i] = (numbers[i] >> 1n) ^ -(numbers[i] & 1n);
    for (let from = order; from > 0; from -= 1)
      for (let i = from; i < count; i += 1) numbers[i] = BigInt.asUintN(64, numbers[i] + numbers[i - 1]);
    return numbers;
  };
  const all = [];
  while (all.length < columns) all.push(column(all));
  assert.equal(at, data.byteLength);
  const double = (bits) => new Float64Array(new BigUint64Array([bits]).buffer)[0];
  return Array.from({length: count}, (_, i) => all.map((bits) => double(bits[i])));
}

/** What JSON makes of a record: blanks and what is infinite left out, words in the place of their numbers. */
function shownOf(record) {
  const cells = names.map((name, i) => {
    const words = properties[name].enum;
    return [name, words ? (words[record[i]] ?? '') : record[i]];
  });
  return Object.fromEntries(cells.filter((_, i) => Number.isFinite(record[i])));
}

/** The schema with every field required and no other one allowed. */
function exact(schema) {
  if (schema === null || typeof schema !== 'object') return schema;
  if (Array.isArray(schema)) return schema.map(exact);
  const inside = Object.fromEntries(Object.entries(schema).map(([key, value]) => [key, exact(value)]));
  return schema.properties ? {...inside, required: Object.keys(schema.properties), additionalProperties: false} : inside;
}
const ajv = new Ajv({strict: false});
const judges = new Map([schemas.Log, schemas.FrameTransforms, schemas.SceneUpdate].map((schema) => [schema.title, ajv.compile(exact(schema))]));

const records = [];
const ticks = new Map();
const shown = new Map();
let blocks = 0;
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  if (channel.topic === '/records') {
    assert.equal(message.sequence, records.length);
    for (const record of unpack(message.data)) {
      if (records.length === message.sequence)
        assert.ok(Math.abs(record[0] * 1e9 - Number(message.logTime)) <= 1, `time of record ${records.length}`);
      records.push(record);
    }
    blocks += 1;
    continue;
  }
  const content = JSON.parse(text(message.data));
  if (channel.topic === '/tick') {
    assert.ok(Math.abs(content.time * 1e9 - Number(message.logTime)) <= 1, `time of tick ${ticks.size}`);
    ticks.set(message.logTime, content);
    continue;
  }
  const judge = judges.get(schemaOf(channel).name);
  assert.ok(judge(content), `${channel.topic}: ${ajv.errorsText(judge.errors)}`);
  shown.set(channel.topic, [...(shown.get(channel.topic) ?? []), {content, time: message.logTime}]);
}
const messages = records.length;
assert.ok(messages > 1000, `${messages} records`);
const byTime = new Map(records.map((record) => [record[0], record]));
const last = records.at(-1)[0];
assert.ok(ticks.size > 8 * last && ticks.size < 12 * last, `${ticks.size} records shown in ${last} s`);
for (const tick of ticks.values()) assert.deepEqual(tick, shownOf(byTime.get(tick.time)));
const byStamp = new Map(records.map((record) => [BigInt(Math.round(record[0] * 1e9)), record]));
for (const list of shown.values()) for (const one of list) one.tick = shownOf(byStamp.get(one.time));
const others = [...shown.values()].reduce((sum, list) => sum + list.length, blocks + ticks.size);
assert.equal(BigInt(others), reader.statistics.messageCount);
assert.equal(messages, info.records);

// Where the robot is, as the records have it, stamped with the time of the run.
const moves = shown.get('/tf');
assert.ok(moves.length > 40 * last && moves.length < 60 * last, `${moves.length} transforms in ${last} s`);
for (const {content, time, tick} of moves) {
  const [base] = content.transforms;
  assert.equal(base.parent_frame_id, 'world');
  assert.equal(BigInt(base.timestamp.sec) * 1000000000n + BigInt(base.timestamp.nsec), time);
  for (const axis of ['x', 'y']) assert.equal(base.translation[axis], tick[`truth.base.${axis}`]);
  const {x, y, z, w} = base.rotation;
  const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  assert.ok(Math.abs(yaw - tick['truth.base.yaw']) < 1e-9, `yaw ${yaw}`);
}
// Each entity hangs in a frame that some transform leads to.
const [{content: scene}] = shown.get('/scene');
const frames = new Set(['world', ...[moves[0], shown.get('/tf_static')[0]].flatMap(({content}) => content.transforms.map((one) => one.child_frame_id))]);
assert.ok(scene.entities.length > 4);
for (const entity of scene.entities) assert.ok(frames.has(entity.frame_id), entity.frame_id);
// A force is an arrow at the face of the wall, as long as the page draws it, while the plant measures it.
const [wallFace, flush] = [0.972, 1e-3];  // [m] of specs/scenes/wall.yaml; what a contact gives way
const pressed = shown.get('/forces');
assert.ok(pressed.length > 50, `${pressed.length} messages of forces`);
for (const {content, time, tick} of pressed) {
  assert.equal(content.deletions.length, 1, 'arrows of before are gone');
  assert.equal(content.entities.length, tick['truth.wall.force'] > 0 ? 1 : 0);
  for (const {arrows: [arrow], lifetime, timestamp} of content.entities) {
    assert.equal(BigInt(timestamp.sec) * 1000000000n + BigInt(timestamp.nsec), time);
    assert.deepEqual(lifetime, {sec: 0, nsec: 0}, 'until the next message');
    const length = arrow.shaft_length + arrow.head_length;
    assert.ok(Math.abs(length - 0.25 * Math.log10(1 + 2 * tick['truth.wall.force'])) < 1e-9, `${length} m`);
    // The wall looks along -x: so does the force on the robot.
    const {x, y, z, w} = arrow.pose.orientation;
    assert.ok(Math.abs(1 - 2 * (y * y + z * z) + 1) < 1e-6 && Math.abs(x) + Math.abs(w) < 1e-3, 'along -x');
    const {x: at} = arrow.pose.position;
    assert.ok(Math.abs(at - wallFace) < flush, `${at} m`);
  }
}
const told = shown.get('/log').map(({content}) => content.message);
for (const {from, to} of run.transitions.filter((one) => one.from)) assert.ok(told.includes(`${from} -> ${to}`), `${from} -> ${to}`);
assert.equal(told.at(-1), run.verdict);

assert.equal(info.whole, true);

// A log names its files from a folder of its own choice: the one from which the task is the fact `task`.
assert.ok(resolve(task).endsWith(info.facts.task), `${info.facts.task} is the task`);
const seenFrom = resolve(task).slice(0, -info.facts.task.length);
let attachments = 0;
for await (const attachment of reader.readAttachments()) {
  assert.equal(text(attachment.data), readFileSync(resolve(seenFrom, attachment.name), 'utf8'));
  attachments += 1;
}
assert.equal(attachments, info.files.length);
const metadata = {};
for await (const record of reader.readMetadata()) metadata[record.name] = Object.fromEntries(record.metadata);
assert.deepEqual(metadata.zwang, info.facts);
assert.equal(metadata['zwang.conclusion'].outcome, run.outcome);
assert.deepEqual(JSON.parse(metadata['zwang.conclusion'].report).limits, run.limits);

const stream = new McapStreamReader({decompressHandlers, validateCrcs: true});
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) streamed += record.type === 'Message' ? 1 : 0;
assert.ok(stream.done());
assert.equal(streamed, others);
console.log(`${run.outcome}: ${messages} records, ${attachments} files, read by @mcap/core`);
