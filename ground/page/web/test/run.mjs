// The tests that need no browser: bundled, because Node reads no TypeScript, and run by Node's own runner.

import { spawnSync } from 'node:child_process';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const home = dirname(fileURLToPath(import.meta.url));
const out = join(home, 'bundle');
await build({
  entryPoints: { core_test: join(home, 'core_test.ts'), messages: join(home, '../src/messages.ts') },
  outdir: out,
  outExtension: { '.js': '.mjs' },
  bundle: true,
  platform: 'node',
  format: 'esm',
  logLevel: 'warning',
});
const done = spawnSync(process.execPath, ['--test', join(out, 'core_test.mjs'), join(home, 'messages_test.mjs')], { stdio: 'inherit' });
process.exit(done.status ?? 1);
