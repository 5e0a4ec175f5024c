// Makes the page: one index.html with everything in it, which asks no other server for anything.
//
//     node build.mjs DIRECTORY
//
// writes into DIRECTORY index.html, the same as index.html.gz, and csp.txt: the header Content-Security-Policy that goes
// with it, which lets nothing run that is not in this file.

import { createHash } from 'node:crypto';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const home = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2];
if (target === undefined) {
  console.error('build.mjs: say where to: node build.mjs DIRECTORY');
  process.exit(2);
}

async function bundle(entry, loader) {
  const made = await build({
    entryPoints: [join(home, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['es2021', 'chrome105', 'firefox110', 'safari16'],
    legalComments: 'none',
    charset: 'utf8',
    logLevel: 'warning',
    absWorkingDir: home,
    ...loader,
  });
  return made.outputFiles[0].text.trim();
}

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

const script = (await bundle('src/main.ts', {})).replaceAll('</script', '<\\/script');
const own = await bundle('style.css', {});
const library = await readFile(join(home, 'node_modules/uplot/dist/uPlot.min.css'), 'utf8');
const style = `${library.trim()}\n${own}`;
const page = await readFile(join(home, 'index.html'), 'utf8');
const whole = page.replace('/* STYLE */', () => style).replace('/* SCRIPT */', () => script);

const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  "img-src data:",
  "connect-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
  "frame-ancestors 'none'",
].join('; ');

const out = resolve(target);
await mkdir(out, { recursive: true });
const packed = gzipSync(whole, { level: 9 });
await writeFile(join(out, 'index.html'), whole);
await writeFile(join(out, 'index.html.gz'), packed);
await writeFile(join(out, 'csp.txt'), `${policy}\n`);
console.log(`page: ${Math.round(whole.length / 1024)} kB, ${Math.round(packed.length / 1024)} kB packed, in ${target}`);
