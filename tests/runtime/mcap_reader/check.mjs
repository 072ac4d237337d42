// Runs a task and reads its log with MCAP's own readers: by the index, and as a stream with every CRC checked.
// usage: node check.mjs ZWANG TASK FOLDER
import {McapIndexedReader, McapStreamReader} from '@mcap/core';
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
const [schema] = [...reader.schemasById.values()];
const properties = JSON.parse(text(schema.data)).properties;
assert.equal(schema.encoding, 'jsonschema');

let messages = 0;
for await (const message of reader.readMessages()) {
  const tick = JSON.parse(text(message.data));
  assert.ok(Math.abs(tick.time * 1e9 - Number(message.logTime)) <= 1, `time of record ${messages}`);
  for (const name of Object.keys(tick)) assert.ok(name in properties, `${name} is in the schema`);
  messages += 1;
}
assert.ok(messages > 1000, `${messages} records`);
assert.equal(BigInt(messages), reader.statistics.messageCount);
assert.equal(messages, info.records);
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
assert.equal(streamed, messages);
console.log(`${run.outcome}: ${messages} records, ${attachments} files, read by @mcap/core`);
