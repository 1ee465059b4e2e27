// The built page in Chromium, once: what it shows is what the command says. nightly/page.test.mjs does more with it.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import {address, launch} from '../browser.mjs';
import {digits} from '../page/numbers.js';

const command = process.env.ZIPACT ?? new URL('../../build/zipact', import.meta.url).pathname;
const folder = mkdtempSync(join(tmpdir(), 'zipact-page-'));
const native = (study, values) => JSON.parse(execFileSync(
  command, [study, ...Object.entries(values).flatMap(([key, text]) => ['--set', `${key}=${text}`]), '-o', folder, '--json', '--quiet', '--no-plots'],
  {encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']}));

test('a network: plots of each member and body with units; the pointer turns a body', {timeout: 300e3}, async () => {
  const browser = await launch(), trouble = [];
  try {
    const page = await browser.newPage({viewport: {width: 1280, height: 900}});
    page.on('console', (message) => message.type() === 'log' || trouble.push(message.text()));
    page.on('pageerror', (error) => trouble.push(String(error)));
    await page.goto(`${address}#slow=1`);
    const label = (id) => page.getAttribute(`#${id}`, 'aria-label'), legend = (id) => page.$$eval(`figure:has(#${id}) .parts li`, (items) => items.map(({textContent}) => textContent));
    const until = (id, words) => page.waitForFunction(([i, w]) => new RegExp(w).test(document.getElementById(i).getAttribute('aria-label')), [id, words], {timeout: 120e3, polling: 200});
    assert.deepEqual(await legend('plot-time'), []);
    await page.click('button:text-is("Joint")');
    await until('plot-voltages', 'now 1: 5.00, 2: 0.00 kilovolts');
    assert.match(await label('plot-time'), /^Openings over time, now 1: [0-9.]+, 2: [0-9.]+ millimetres/);
    assert.deepEqual([await legend('plot-time'), await legend('plot-voltages'), await legend('plot-bodies')], [['member 1', 'member 2'], ['member 1', 'member 2'], ['body 1']]);
    assert.deepEqual([await page.isHidden('#of-chart'), await page.isHidden('#n-stroke'), await page.isVisible('#plot-bodies')], [true, true, true]);
    const angle = async () => Number((await label('plot-bodies')).match(/now 1: (\S+) degrees/)[1].replace('−', '-'));
    await page.waitForTimeout(2500);
    const still = await angle(), {x, y, width} = await page.locator('#picture').boundingBox();
    await page.mouse.move(x + width / 2, y + 10);
    for (let down = 10; !(await page.evaluate(() => document.getElementById('picture').classList.contains('loaded'))); down += 6) {
      assert.ok(down < 400, 'the forearm is under the pointer');
      await page.mouse.move(x + width / 2, y + down);
    }
    await page.mouse.down();
    await page.mouse.move(x + 0.9 * width, y + 200, {steps: 5});
    await page.waitForTimeout(2500);
    const pulled = await angle();
    await page.mouse.up();
    assert.ok(pulled > still + 0.3, `${still}, pulled ${pulled} degrees`);
    await page.click('button:text-is("The paper’s")');
    await page.waitForFunction(() => document.getElementById('of-bodies').hidden);
    assert.deepEqual([await legend('plot-time'), await page.isVisible('#n-stroke'), await page.textContent('#time-title')], [[], true, 'Stroke over time']);
  } finally {
    await browser.close();
  }
  assert.deepEqual(trouble, []);
});

test('an actuator with a supply: its numbers, its zip, its controls', {timeout: 300e3}, async () => {
  const values = {'liquid.model': 'none', 'mesh.nodes': '21'}, supply = {'source.supply': 'converter_10kv'};
  const run = native('actuate', {...values, ...supply}), rest = native('equilibrium', {...values, 'drive.voltage': '12 kV'}); // of rest without the supply
  const browser = await launch(), trouble = [];
  try {
    const page = await browser.newPage({viewport: {width: 900, height: 600}}), text = (id) => page.textContent(`#${id}`);
    const until = (look, given) => page.waitForFunction(look, given, {timeout: 120e3, polling: 200});
    page.on('console', (message) => message.type() === 'log' || trouble.push(message.text()));
    page.on('pageerror', (error) => trouble.push(String(error)));
    page.on('request', (request) => /^(file|blob|data):/.test(request.url()) || trouble.push(`asks for ${request.url()}`));
    await page.goto(`${address}#${new URLSearchParams({...values, ...supply})}&slow=5`.replaceAll('+', ''));
    for (const note of ['time-note', 'voltage-note'])
      await until((id) => document.getElementById(id).textContent && !document.getElementById(id).classList.contains('due'), note);
    assert.deepEqual([await text('time-note'), await text('voltage-note')], [run.message, rest.message]);
    const shown = {
      zip: 1e3 * run.zip_time_s, closed: 1e3 * (run.closed_from_s ?? NaN), stress: run.max_stress_Pa / 1e6, yields: run.yield_margin,
      breaks: run.breakdown_margin, allowed: run.allowed_voltage_V / 1e3, pullin: rest.pull_in_voltage_V / 1e3, letgo: rest.release_voltage_V / 1e3,
    };
    for (const [name, value] of Object.entries(shown)) assert.equal(await text(`n-${name}`), digits(value), name);

    const auto = page.locator('.slider .auto');
    assert.ok(await auto.isHidden(), 'damping is auto');
    await page.fill('#any-key', 'damping.internal=20 us');
    await page.keyboard.press('Enter');
    assert.equal(await page.getAttribute('#damping-internal', 'aria-valuetext'), '20 µs');
    await auto.click();
    assert.match(await page.getAttribute('#damping-internal', 'aria-valuetext'), /^auto/);
    await page.fill('#any-key', 'ribbon.lenght=1');
    await page.keyboard.press('Enter');
    assert.equal(await text('refusal'), 'ribbon.lenght=1: unknown key; did you mean ribbon.length?');

    await page.selectOption('#source-supply', 'none');
    await until(() => Number(document.getElementById('n-contraction').textContent) > 99);
    assert.equal(await text('n-voltage'), '10.00');
    assert.doesNotMatch(await text('command'), /source/);
    await page.click('#undo');
    assert.match(await text('command'), /source\.supply=converter_10kv/);
    assert.ok(await page.isHidden('#alert'));
  } finally {
    await browser.close();
    rmSync(folder, {recursive: true});
  }
  assert.deepEqual(trouble, []);
});
