// idl/page.proto and messages.ts name the same messages, fields and kinds; tones.ts has the tones of gyre plot.

import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';

/** The repository: above this file, or told where this is a copy in a build. */
function repository() {
  if (process.env['GYRE_SOURCE']) return process.env['GYRE_SOURCE'];
  let folder = process.cwd();
  while (!existsSync(join(folder, 'idl/page.proto')) && dirname(folder) !== folder) folder = dirname(folder);
  return folder;
}

/** Of every message its fields with their kinds, as the schema says. */
function schema(proto) {
  const text = proto.replace(/\/\/[^\n]*/g, '').replace(/enum \w+ \{[^}]*\}/g, '');
  const out = {};
  for (const [, name, body] of text.matchAll(/message (\w+) \{([^}]*)\}/g)) {
    out[name] = {};
    for (const [, label = '', kind, field] of body.matchAll(/(repeated |optional )?(\w+) (\w+) = \d+;/g)) out[name][field] = label + kind;
  }
  return out;
}

function choices(proto) {
  return [...proto.matchAll(/enum (\w+) \{([^}]*)\}/g)].map(([, name, body]) => [name, [...body.matchAll(/([A-Z_]+) = /g)].map(([, value]) => value).join()]);
}

const root = repository();
const proto = readFileSync(join(root, 'idl/page.proto'), 'utf8');
const { messages } = await import('./bundle/messages.mjs').then((messages) => ({ messages }));

test('the same messages, fields and kinds', () => {
  const wanted = schema(proto);
  const own = Object.fromEntries(
    Object.entries(messages).map(([name, message]) => [name, Object.fromEntries(Object.entries(message.fields).map(([field, reader]) => [field, reader.kind]))]),
  );
  assert.ok(Object.keys(wanted).length >= 15);
  assert.deepEqual(own, wanted);
});

test('the same choices', () => {
  const source = readFileSync(join(root, 'ground/page/web/src/messages.ts'), 'utf8');
  const own = [...source.matchAll(/choice\('(\w+)', \[([^\]]*)\]/g)].map(([, name, values]) => [name, values.replace(/[' ]/g, '')]);
  assert.deepEqual(own.sort(), choices(proto).sort());
});

test('the same tones', () => {
  const palette = readFileSync(join(root, 'ground/plot/core/palette.cpp'), 'utf8');
  const source = readFileSync(join(root, 'ground/page/web/src/tones.ts'), 'utf8');
  const theirs = [...palette.matchAll(/\{"c\d+", "(#\w+)", "(#\w+)"\}/g)].map(([, light, dark]) => [light, dark]);
  const own = [...source.matchAll(/\['(#\w+)', '(#\w+)'\]/g)].map(([, light, dark]) => [light, dark]);
  assert.equal(theirs.length, 12);
  assert.deepEqual(own, theirs);
});
