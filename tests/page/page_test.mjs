// The page in a real browser: Debian's Chromium without a window, drawing with the processor.
//
//     node page_test.mjs --page DIRECTORY [--pictures DIRECTORY]      against the made-up swarm (mock_server.mjs)
//     node page_test.mjs --url ADDRESS [--pictures DIRECTORY]         against a server that runs: the address it printed
//
// With --url the server is not killed and started again, since it is not this test's. Exit code: 0 good, 1 failed, 77
// skipped because there is no Chromium. Checks wait for what must happen, for so long at most.

import { spawn } from 'node:child_process';
import { existsSync, mkdirSync } from 'node:fs';
import { createServer } from 'node:net';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import puppeteer from 'puppeteer-core';
import { take_pictures } from './pictures.mjs';

const words = process.argv.slice(2);
const option = (name) => (words.includes(`--${name}`) ? words[words.indexOf(`--${name}`) + 1] : undefined);
const kChromium = option('chromium') ?? '/usr/bin/chromium';
const kMock = option('mock') ?? join(dirname(fileURLToPath(import.meta.url)), '../../ground/page/web/test/mock_server.mjs');
const kWithin_ms = 20000;
const kFlags = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--enable-precise-memory-info', '--js-flags=--expose-gc'];

let failures = 0;
async function check(what, act) {
  const begun = performance.now();
  try {
    const said = await act();
    console.log(`ok    ${what}${said === undefined ? '' : `: ${said}`} (${((performance.now() - begun) / 1000).toFixed(1)} s)`);
  } catch (error) {
    ++failures;
    console.log(`FAIL  ${what}: ${error.message.split('\n')[0]}`);
  }
}

function need(good, what) {
  if (!good) throw new Error(what);
}

// ------------------------------------------------------------------------------------------------------------ servers

function free_port() {
  return new Promise((done) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });
}

/** A made-up swarm of its own; `kill` is the way a server dies. */
async function mock(port, ...more) {
  const child = spawn(process.execPath, [kMock, option('page'), '--port', String(port), '--token', 'secret', ...more], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise((done, fail) => {
    child.stdout.once('data', (words) => done(String(words).trim()));
    child.once('exit', () => fail(new Error('the mock server did not start')));
  });
  const gone = new Promise((done) => child.once('exit', done));
  return { url, kill: async () => (child.kill('SIGKILL'), gone) };
}

// --------------------------------------------------------------------------------------------------------- the browser

const noises = [];
let quiet = false;  // while the server is away, the browser itself says that it cannot reach it

async function open(browser, url, { width = 1440, height = 900, scheme = 'light', touch = false } = {}) {
  const page = await browser.newPage();
  page.on('console', (line) => ['error', 'warn', 'warning'].includes(line.type()) && !quiet && noises.push(`${line.type()}: ${line.text()}`));
  page.on('pageerror', (error) => noises.push(`exception: ${error.message}`));
  await page.setViewport({ width, height, deviceScaleFactor: touch ? 2 : 1, isMobile: touch, hasTouch: touch });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  await page.goto(url, { waitUntil: 'domcontentloaded' });
  return page;
}

const until = (page, what, ...more) => page.waitForFunction(what, { timeout: kWithin_ms, polling: 100 }, ...more);
const text = (page, id) => page.$eval(`#${id}`, (found) => found.textContent);
const alive = (page) => until(page, () => document.getElementById('connection').textContent.match(/live|recording/));

/** Whether a carrier's label goes from where it is. */
async function carriers_move(page) {
  const places = () => page.$$eval('.label.carrier', (all) => all.map((one) => one.style.transform));
  await until(page, () => document.querySelectorAll('.label.carrier').length > 0);
  const before = await places();
  await until(page, (was) => [...document.querySelectorAll('.label.carrier')].every((one, i) => one.hidden || one.style.transform !== was[i]), before);
  return `${before.length} of them`;
}

/** Whether ink other than axes and grid came onto every plot: the canvas has many more than the colours of an empty one. */
async function plots_fill(page) {
  const keys = await page.$$eval('.plot', (all) => all.map((one) => one.dataset.plot));
  for (const key of keys) {
    await page.$eval(`[data-plot=${key}]`, (plot) => plot.scrollIntoView({ block: 'center' }));
    await until(page, (of) => /\d/.test(document.querySelector(`[data-plot=${of}] .plot-says`)?.textContent ?? ''), key);
    const colours = await page.$eval(`[data-plot=${key}] canvas`, (canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const seen = new Set();
      for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      return seen.size;
    });
    need(colours > 0, `plot ${key} is empty`);
  }
  await page.evaluate(() => scrollTo(0, 0));
  return keys.join(', ');
}

/** Presses a button twice, as a person confirms, and waits for the reply's toast. */
async function command(page, id) {
  await page.click(`#${id}`);
  await until(page, (which) => document.getElementById(which).dataset.armed === 'true', id);
  const before = await page.$$eval('#log li', (all) => all.length);
  await page.keyboard.press('Enter');
  await until(page, (count) => document.querySelectorAll('#log li').length > count && document.querySelector('.toast') !== null, before);
  return page.$eval('.toast:last-child', (toast) => ({ good: toast.dataset.good === 'true', text: toast.textContent }));
}

/** Pictures per second over some seconds, as the page itself counts them. */
async function pace(page) {
  const rates = [];
  for (let i = 0; i < 6; ++i) {
    await page.evaluate(() => new Promise((done) => setTimeout(done, 1000)));
    rates.push(Number(await page.$eval('body', (body) => body.dataset.fps)));
  }
  return Math.max(...rates.slice(2));
}

// ---------------------------------------------------------------------------------------------------------- the checks

async function watch_and_command(browser, url, owns) {
  const page = await open(browser, url);
  await check('the page finds its server and says what is', async () => {
    await alive(page);
    await until(page, () => /load hangs within .* mm|ready|No coordinator|[a-z]/.test(document.getElementById('headline').textContent));
    return text(page, 'headline');
  });
  await check('carriers move', () => carriers_move(page));
  await check('plots fill', () => plots_fill(page));
  await check('the token left the address', async () => need(!(await page.url()).includes('token'), page.url()));
  await check('text of the wire stays text', async () => {
    const within = ['log', 'processes', 'missing-list', 'headline', 'toasts'];
    const made = await page.evaluate((ids) => ids.flatMap((id) => [...document.querySelectorAll(`#${id} :is(img, script, a, iframe, em, u)`)]).length, within);
    need(made === 0, 'markup came over the wire');
  });
  await check('pictures per second, software rendering', async () => {
    const rate = await pace(page);
    if (rate < 15) console.log(`      below the 15 that are wanted of a machine with nothing else to do`);
    return rate;
  });
  await check('a command goes through, with its reply', async () => {
    const reply = await command(page, 'release');
    need(reply.good, reply.text);
    await until(page, () => Number.parseInt(document.getElementById('pace').textContent, 10) < 100);
    const back = await command(page, 'engage');
    need(back.good, back.text);
    return reply.text;
  });
  await check('Escape takes a command back', async () => {
    await page.click('#freeze');
    await until(page, () => document.getElementById('freeze').dataset.armed === 'true');
    await page.keyboard.press('Escape');
    await until(page, () => document.getElementById('freeze').dataset.armed === 'false');
  });
  await check('keys: help, a carrier, dark', async () => {
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press('?');
    await until(page, () => document.getElementById('help').open);
    await page.keyboard.press('Escape');
    await until(page, () => !document.getElementById('help').open);
    await page.keyboard.press('2');
    await until(page, () => document.querySelectorAll('#processes tr[data-selected=true]').length === 1);
    const paper = await page.$eval('html', (html) => html.dataset.paper);
    await page.keyboard.press('d');
    await until(page, (was) => document.documentElement.dataset.paper !== was, paper);
    await page.keyboard.press('d');
    await page.keyboard.press('Escape');
  });
  await check('a mission is checked before it may be flown', async () => {
    await page.click('#retune');
    await until(page, () => document.getElementById('retune-dialog').open);
    await page.$eval('#retune-mission', (field) => ((field.value = 'nonsense'), field.dispatchEvent(new Event('input'))));
    await until(page, () => document.getElementById('retune-judged').dataset.kind === 'bad');
    need(await page.$eval('#retune-confirm', (button) => button.disabled), 'a file that cannot be read may be flown');
    const words = await text(page, 'retune-verdict');
    await page.click('#retune-cancel');
    return words.split('\n')[0];
  });
  if (owns) {
    await check('a killed agent shows, and what came of it', async () => {
      await page.select('#hurt-who', 'agent 2');
      await page.click('[data-hurt=KILL]');
      await until(page, () => [...document.querySelectorAll('#processes tr')].some((row) => row.textContent.includes('agent 2') && row.dataset.well === 'false'));
      await until(page, () => document.getElementById('outcome').dataset.any === 'true' && /mm/.test(document.getElementById('outcome-moved').textContent));
      await until(page, () => document.querySelector('.label.carrier[data-carrier="2"]').dataset.bad === 'true');
      return `${await text(page, 'outcome-what')}: the load moved ${await text(page, 'outcome-moved')}`;
    });
    await check('started again, it is well', async () => {
      await page.click('[data-hurt=RESTART]');
      await until(page, () => [...document.querySelectorAll('#processes tr')].every((row) => !row.textContent.includes('agent 2') || row.dataset.well === 'true'));
    });
  }
  await check('memory does not grow over a minute', async () => {
    const used = () => page.evaluate(() => (globalThis.gc?.(), performance.memory.usedJSHeapSize / 1e6));
    const before = await used();
    await page.evaluate((ms) => new Promise((done) => setTimeout(done, ms)), Number(option('minute') ?? 60) * 1000);
    return `${before.toFixed(1)} MB, then ${(await used()).toFixed(1)} MB`;
  });
  return page;
}

async function wrong_token(browser, url) {
  await check('a wrong token is refused, and the page says so', async () => {
    const page = await open(browser, url.replace(/token=.*/, 'token=wrong'));
    await alive(page);
    quiet = true;  // the browser itself reports an answer of 403
    const reply = await command(page, 'release');
    quiet = false;
    need(!reply.good && /token/.test(reply.text), reply.text);
    await page.close();
    return reply.text;
  });
  await check('without a token the page watches', async () => {
    const context = await browser.createBrowserContext();
    const page = await open(context, url.replace(/#.*/, ''));
    await alive(page);
    need(await page.$eval('#command-buttons', (buttons) => buttons.hidden), 'commands are offered');
    need(!(await page.$eval('#token-form', (form) => form.hidden)), 'no way to tell the token');
    await page.type('#token-field', url);
    await page.keyboard.press('Enter');
    await until(page, () => !document.getElementById('command-buttons').hidden);
    await context.close();
  });
}

async function phone(browser, url) {
  await check('a phone: no scrolling sideways', async () => {
    const page = await open(browser, url, { width: 360, height: 740, touch: true });
    await alive(page);
    await until(page, () => document.querySelectorAll('.label.carrier').length > 0);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    need(wide <= 360, `${wide} pixels wide`);
    await page.close();
  });
}

async function server_dies(page, server, port) {
  await check('a server that is gone is said, and the next one found', async () => {
    quiet = true;
    const first = await page.$$eval('#log li', (all) => all.length);
    await server.kill();
    await until(page, () => /server is gone/.test(document.getElementById('headline').textContent));
    const again = await mock(port);
    await alive(page);
    await until(page, () => /load hangs/.test(document.getElementById('headline').textContent));
    await until(page, (count) => document.querySelectorAll('#log li').length < count, first);
    await carriers_move(page);
    await page.close();  // else it would look for the one that goes now
    quiet = false;
    await again.kill();
  });
}

/** Printed, not judged: what a machine makes of it is the machine's. */
async function crowd(browser) {
  await check('forty-eight carriers move; pictures per second, software rendering', async () => {
    const server = await mock(await free_port(), '--n', '48');
    const page = await open(browser, server.url);
    await alive(page);
    const moved = await carriers_move(page);
    const rate = await pace(page);
    await page.close();
    await server.kill();
    return `${moved}, ${rate}`;
  });
}

async function recording(browser) {
  await check('a recording takes no orders, and the page offers none', async () => {
    const server = await mock(await free_port(), '--recording');
    const page = await open(browser, server.url);
    await alive(page);
    need((await text(page, 'connection')) === 'recording', await text(page, 'connection'));
    await until(page, () => document.getElementById('commands').hidden && document.getElementById('hurt').hidden);
    await page.close();
    await server.kill();
  });
}

// -------------------------------------------------------------------------------------------------------------- the run

async function main() {
  if (!existsSync(kChromium)) {
    console.log(`SKIPPED: there is no ${kChromium}`);
    return 77;
  }
  const port = await free_port();
  const server = option('url') === undefined ? await mock(port) : undefined;
  const url = option('url') ?? server.url;
  const browser = await puppeteer.launch({ executablePath: kChromium, headless: true, args: kFlags });
  try {
    const page = await watch_and_command(browser, url, server !== undefined || words.includes('--owns'));
    await wrong_token(browser, url);
    await phone(browser, url);
    const pictures = option('pictures');
    if (pictures !== undefined) {
      mkdirSync(pictures, { recursive: true });
      await check('pictures', () => take_pictures(browser, open, alive, url, pictures, server === undefined ? undefined : () => free_port().then((other) => mock(other, '--n', '48'))));
    }
    if (server !== undefined) {
      await page.bringToFront();
      await server_dies(page, server, port);
      await recording(browser);
      await crowd(browser);
    }
    await check('no errors and no warnings in the console', async () => need(noises.length === 0, noises.join(' | ')));
  } finally {
    await browser.close();
    await server?.kill();
  }
  console.log(failures === 0 ? 'page: good' : `page: ${failures} failed`);
  return failures === 0 ? 0 : 1;
}

process.exit(await main());
