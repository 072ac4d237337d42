// Runs a task and reads its log with MCAP's own readers: by the index, and as a stream with every CRC checked.
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
for (const channel of channelOf.values()) assert.equal(schemaOf(channel).encoding, 'jsonschema');
const properties = JSON.parse(text(schemaOf(channelOf.get('/tick')).data)).properties;

/** The schema with every field required and no other one allowed. */
function exact(schema) {
  if (schema === null || typeof schema !== 'object') return schema;
  if (Array.isArray(schema)) return schema.map(exact);
  const inside = Object.fromEntries(Object.entries(schema).map(([key, value]) => [key, exact(value)]));
  return schema.properties ? {...inside, required: Object.keys(schema.properties), additionalProperties: false} : inside;
}
const ajv = new Ajv({strict: false});
const judges = new Map([schemas.Log, schemas.FrameTransforms, schemas.SceneUpdate].map((schema) => [schema.title, ajv.compile(exact(schema))]));

let messages = 0;
let last = null;
const shown = new Map();
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const content = JSON.parse(text(message.data));
  if (channel.topic !== '/tick') {
    const judge = judges.get(schemaOf(channel).name);
    assert.ok(judge(content), `${channel.topic}: ${ajv.errorsText(judge.errors)}`);
    shown.set(channel.topic, [...(shown.get(channel.topic) ?? []), {content, time: message.logTime, tick: last}]);
    continue;
  }
  last = content;
  assert.ok(Math.abs(content.time * 1e9 - Number(message.logTime)) <= 1, `time of record ${messages}`);
  for (const name of Object.keys(content)) assert.ok(name in properties, `${name} is in the schema`);
  messages += 1;
}
assert.ok(messages > 1000, `${messages} records`);
const others = [...shown.values()].reduce((sum, list) => sum + list.length, 0);
assert.equal(BigInt(messages + others), reader.statistics.messageCount);
assert.equal(messages, info.records);

// Where the robot is, as the records have it, stamped with the time of the run.
const moves = shown.get('/tf');
assert.ok(moves.length > 40 * last.time && moves.length < 60 * last.time, `${moves.length} transforms in ${last.time} s`);
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
assert.equal(streamed, messages + others);
console.log(`${run.outcome}: ${messages} records, ${attachments} files, read by @mcap/core`);
