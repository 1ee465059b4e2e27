// No link and no slider freezes the page; its policy holds.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {createHash} from 'node:crypto';
import {readFileSync} from 'node:fs';
import {after, before, test} from 'node:test';
import {address, launch} from '../../browser.mjs';
import {Core, Refused} from '../../page/core.js';
import {Engine} from '../../page/engine.js';
import {Frame} from '../../page/frame.js';
import * as scenario from '../../page/scenario.js';

const command = process.env.ZIPACT ?? new URL('../../../build/zipact', import.meta.url).pathname;
const keys = JSON.parse(execFileSync(command, ['keys', '--json'], {encoding: 'utf8'}));
const module = new WebAssembly.Module(readFileSync(new URL('../../build/zipact.wasm', import.meta.url)));
const longest = 200; // ms of CPU of one task of the page's main thread
let browser;

before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** Open the page, with `prepare` run before its script, and do something; what it complains of fails the test. */
async function open(hash, body, prepare = '') {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}}), trouble = [];
  page.on('console', (message) => message.type() === 'log' || trouble.push(message.text()));
  page.on('pageerror', (error) => trouble.push(String(error)));
  await page.addInitScript(prepare);
  await page.goto(address + hash);
  await body(page);
  await page.close();
  assert.deepEqual(trouble, []);
}

/** CPU time of the longest task of the page's main thread while `body` works, ms, as the browser traces it. The
 * browser's own pages (chrome://...) have main threads, too: their processes do not count. */
async function longestTask(body) {
  await browser.startTracing(undefined, {categories: ['devtools.timeline', 'disabled-by-default-devtools.timeline', '__metadata']});
  let events;
  try {
    await body();
  } finally {
    events = JSON.parse(await browser.stopTracing()).traceEvents;
  }
  const ours = new Set(events.filter(({name, args}) => name === 'CommitLoad' && args.data.url.startsWith(address)).map(({pid}) => pid));
  const main = new Set(events.filter(({name, pid, args}) => name === 'thread_name' && args.name === 'CrRendererMain' && ours.has(pid))
    .map(({pid, tid}) => `${pid} ${tid}`));
  const tasks = events.filter(({name, pid, tid}) => name === 'RunTask' && main.has(`${pid} ${tid}`));
  assert.ok(tasks.length > 20 && tasks.some(({tdur}) => tdur > 0), `${tasks.length} tasks seen`);
  return tasks.reduce((most, {tdur = 0}) => Math.max(most, tdur / 1e3), 0);
}

const alert = (page) => page.textContent('[role=alert]');
const alertShown = (page) => page.waitForFunction(() => !document.querySelector('[role=alert]').hidden, null, {timeout: 90e3});
const numberShown = (page) => page.waitForFunction(() => document.getElementById('n-opening').textContent !== '–', null, {timeout: 90e3});

// -- links

test('a hostile link leaves the page responsive, with a message (it blocked the main thread for minutes)', {timeout: 180e3}, async () => {
  const cost = await longestTask(() => open('#load.mass=0&gravity=0&drive.voltage=1000kV&electro.breakdown_cap=false&insulator.thickness=1um', async (page) => {
    await alertShown(page);
    assert.match(await alert(page), /^(The solver failed: .+ Change a value to continue|Stopped after .+)\.$/);
    await page.click('text=The paper’s');
    await page.waitForFunction(() => document.querySelector('[role=alert]').hidden);
    await page.waitForFunction(() => Number(document.getElementById('n-time').textContent) > 5);
  }));
  assert.ok(cost < longest, `longest task: ${cost} ms`);
});

test('steps too short to move it: stopped, with what was asked and what to change', {timeout: 180e3}, async () => {
  const cost = await longestTask(() => open('#solver.time_step=0.000001us', async (page) => {
    await alertShown(page);
    assert.match(await alert(page), /^Stopped after 2 s of computing, which simulated only .* [pn]s\. Keys that differ from the defaults: solver\.time_step=1e-06 us\. Change one of these, or choose a preset\.$/);
  }));
  assert.ok(cost < longest, `longest task: ${cost} ms`);
});

/** mulberry32: numbers 0 .. 1 from a seed. */
function random(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t ^= t + Math.imul(t ^ (t >>> 7), 61 | t);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Any value of a key, its ends as often as what is between. */
function extreme({type, choices, min, max}, pick, next) {
  if (type === 'enum') return pick(choices).word;
  if (type === 'bool') return pick(['true', 'false']);
  if (type === 'text') return 'text';
  if (type === 'real_auto' && next() < 0.2) return 'auto';
  const low = Math.max(min, max * 1e-9), between = low * (max / low) ** next(), value = pick([min, max, between]);
  return String(type === 'int' ? Math.round(value) : value);
}

/** Scenarios that the core takes, drawn over all keys: texts, and other kinds and studies, are refused on the way. */
function* hostile(seed) {
  const next = random(seed), pick = (list) => list[Math.floor(next() * list.length)], core = new Core(module);
  for (;;) {
    const drawn = Array.from({length: 1 + Math.floor(next() * 5)}, () => pick(keys));
    const values = new Map(drawn.map((key) => [key.key, extreme(key, pick, next)]));
    try {
      core.resolve(values);
      yield values;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
  }
}

test('scenarios drawn over every key: an engine answers each within its limits', {timeout: 600e3}, () => {
  const limits = {study: 100, start: 100, frame: 8}, slack = 3e3; // ms; slack: CPU of what does not look at the clock
  const drawn = hostile(20240607);
  for (let k = 0; k < 40; k++) {
    const values = drawn.next().value, text = JSON.stringify([...values]), engine = new Engine(module, limits);
    const timed = (question, mayRefuse = /^$/) => {
      const start = process.cpuUsage(), answer = engine.answer(question), {user, system} = process.cpuUsage(start);
      assert.ok((user + system) / 1e3 < slack, `${(user + system) / 1e3} ms: ${text}`);
      assert.ok(answer.refused === undefined || mayRefuse.test(answer.refused), `${answer.refused}: ${text}`);
      return answer;
    };
    let answer = timed({values, voltage: 1e4, restart: true, span: 0}, /actuators in series/);
    if (answer.refused) continue;
    for (let frame = 0; frame < 4 && !answer.failure && !answer.stopped; frame++) answer = timed({span: 1e-3, frame: answer.frame});
    const seen = answer.failure ? null : new Frame(answer.frame);
    for (let member = 0; member < (seen?.get('members') ?? 0); member++)
      for (const [name, part] of Object.entries(seen.member(member)).filter(([name]) => name !== 'middle'))
        assert.ok(![part].flat().some(Number.isNaN), `no number in ${name}: ${text}`);
    timed({study: 'actuate', values, scalars: [], columns: ['time_s']});
    timed({study: 'equilibrium', values, scalars: [], columns: ['voltage_V']}, /study equilibrium requires/);
  }
});

test('links drawn over every key leave the page responsive', {timeout: 600e3}, async () => {
  const drawn = hostile(7), core = new Core(module);
  for (let k = 0; k < 8; k++) {
    const {value: values} = drawn.next(), hash = scenario.toAddress(values, 10);
    core.resolve(values);
    const cost = await longestTask(() => open(hash, async (page) => {
      await Promise.race([numberShown(page), alertShown(page)]);
      await page.waitForTimeout(500);
      assert.equal(await page.textContent('#command'), scenario.toCommand(core));
    }));
    assert.ok(cost < longest, `${cost} ms: ${hash}`);
  }
});

// -- engines

/** Page script: notes what study equilibrium is asked. Where `window.deaf`, its first question
 * does not arrive. */
function watchWorkers() {
  window.asked = [];
  window.ended = 0;
  const {postMessage, terminate} = Worker.prototype;
  Object.assign(Worker.prototype, {
    postMessage(question, given) {
      if (question.study === 'equilibrium') window.asked.push(question.values.get('load.mass'));
      if (question.study === 'equilibrium' && window.deaf && window.asked.length === 1) return;
      postMessage.call(this, question, given);
    },
    terminate() {
      window.ended++;
      terminate.call(this);
    },
  });
}

const restKnown = (page) => page.waitForFunction(() => {
  const note = document.getElementById('voltage-note');
  return note.textContent && !note.classList.contains('due');
}, null, {timeout: 90e3});

test('sliders while a study is busy: the newest scenario is answered, not each', {timeout: 180e3}, async () => {
  await open('#mesh.nodes=401', async (page) => {
    await page.focus('#load-mass');
    for (let k = 0; k < 30; k++) await page.keyboard.press('ArrowRight');
    assert.equal(await page.getAttribute('#load-mass', 'aria-valuetext'), '23 g');
    await restKnown(page);
    const asked = await page.evaluate(() => window.asked);
    assert.equal(asked.at(-1), '23 g');
    assert.ok(asked.length < 25, `${asked.length} questions`);
    const ours = new Core(module);
    ours.resolve(new Map([['mesh.nodes', '401'], ['load.mass', '23 g'], ['drive.voltage', '12 kV']]));
    assert.equal(await page.textContent('#voltage-note'), ours.study('equilibrium', []).message);
  }, watchWorkers);
});

test('a slider while a study takes long: the study is given up for the newest scenario', {timeout: 180e3}, async () => {
  await open('', async (page) => {
    await page.waitForTimeout(1500); // longer than one waits for an answer that is not wanted any more
    await page.focus('#load-mass');
    await page.keyboard.press('ArrowRight');
    await restKnown(page);
    assert.deepEqual(await page.evaluate(() => window.asked), [undefined, '8.5 g']);
    assert.ok(await page.evaluate(() => window.ended) >= 1);
  }, `window.deaf = true; (${watchWorkers})()`);
});

test('a worker that does not answer is ended, and another goes on', {timeout: 180e3}, async () => {
  await open('', async (page) => {
    await alertShown(page);
    assert.match(await alert(page), /^Stopped after 10 s of computing/);
    assert.equal(await page.evaluate(() => window.silent.ended), true);
    await page.click('#step');
    await page.waitForFunction(() => Number(document.getElementById('n-time').textContent) > 5);
    assert.ok(await page.isHidden('[role=alert]'));
  }, () => {
    const Real = Worker;
    window.Worker = function (...all) { // the first one, of the motion, is there and says nothing
      if (window.silent) return new Real(...all);
      window.silent = {
        postMessage({module}) {
          if (module) setTimeout(() => this.onmessage({data: {ready: true}}));
        },
        terminate() {
          this.ended = true;
        },
      };
      return window.silent;
    };
  });
});

test('a study whose worker breaks says so, and the next scenario is answered', {timeout: 180e3}, async () => {
  await open('', async (page) => {
    await page.waitForFunction(() => document.getElementById('time-note').textContent.includes('computation failed: Error: of the test'));
    await page.focus('#load-mass');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => document.getElementById('time-note').textContent.startsWith('closed after'));
  }, () => {
    const post = Worker.prototype.postMessage;
    let broken = false;
    Worker.prototype.postMessage = function (question, given) {
      if (question.study !== 'actuate' || broken) return post.call(this, question, given);
      broken = true;
      this.onmessage({data: {broken: 'Error: of the test'}});
    };
  });
});

const noWorkers = {
  'cannot be made': () => {
    window.Worker = class {
      constructor() {
        throw new Error('not from a file');
      }
    };
  },
  'fail when they load': () => {
    window.Worker = class {
      constructor() {
        setTimeout(() => this.onerror({message: 'not from a file'}));
      }

      postMessage() {}

      terminate() {}
    };
  },
};

for (const [name, prepare] of Object.entries(noWorkers)) {
  test(`workers ${name}: the page computes between frames, and says so`, {timeout: 180e3}, async () => {
    const cost = await longestTask(() => open('#slow=5', async (page) => {
      await page.waitForFunction(() => /does not start a worker .*not from a file/.test(document.getElementById('notes').textContent));
      await page.waitForFunction(() => Number(document.getElementById('n-contraction').textContent) > 99, null, {timeout: 90e3});
      assert.ok(await page.textContent('#time-note'));
    }, prepare));
    assert.ok(cost < 600, `longest task: ${cost} ms`);
  });
}

test('without workers a hostile link ends with a message, too', {timeout: 180e3}, async () => {
  await open('#solver.time_step=0.000001us', async (page) => {
    await alertShown(page);
    assert.match(await alert(page), /^Stopped after 2 s of computing, which simulated only/);
  }, noWorkers['cannot be made']);
});

// -- the policy

const built = readFileSync(new URL('../../dist/index.html', import.meta.url), 'utf8');

test('the policy names what the page holds, and nothing unsafe', () => {
  const policy = /http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(built)[1];
  const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
  const [, style] = /<style>(.*?)<\/style>/s.exec(built), [, script] = /<script type="module">(.*?)<\/script>/s.exec(built);
  assert.deepEqual(policy.split('; '), [
    "default-src 'none'", `script-src ${hash(script)} 'wasm-unsafe-eval'`, 'worker-src blob:', `style-src ${hash(style)}`,
    'img-src data:', "connect-src 'none'", "base-uri 'none'", "form-action 'none'",
  ]);
  assert.ok(built.indexOf('Content-Security-Policy') < built.indexOf('<style>'), 'before what it rules');
});

test('a script that is put in does not run, on the page or in a worker, and nothing is asked of a network', {timeout: 120e3}, async () => {
  const page = await browser.newPage(), requests = [];
  page.on('request', (request) => requests.push(request.url()));
  await page.goto(address);
  requests.length = 0;
  const found = await page.evaluate(async () => {
    const violated = [], tried = {};
    addEventListener('securitypolicyviolation', ({effectiveDirective}) => violated.push(effectiveDirective));
    const script = Object.assign(document.createElement('script'), {textContent: 'window.ran = true'});
    document.body.append(script);
    const image = document.createElement('img');
    image.setAttribute('onerror', 'window.ran = true');
    image.src = 'data:,';
    document.body.append(image);
    tried.eval = await new Promise((resolve) => setTimeout(() => { // for the browser lets evaluate itself do it
      try {
        resolve((0, eval)('"ran"'));
      } catch (error) {
        resolve(error.name);
      }
    }));
    tried.fetch = await fetch('https://example.com/').catch((error) => error.name);
    const text = 'fetch("https://example.com/").then(() => "fetched", (e) => e.name).then((f) => { try { eval("1"); postMessage("ran"); } catch (e) { postMessage(f + e.name); } })';
    const worker = new Worker(URL.createObjectURL(new Blob([text])));
    tried.worker = await new Promise((resolve) => (worker.onmessage = ({data}) => resolve(data)));
    await new Promise((resolve) => setTimeout(resolve, 300));
    return {violated: [...new Set(violated)].sort(), tried, ran: window.ran};
  });
  await page.close();
  assert.equal(found.ran, undefined);
  assert.deepEqual(found.tried, {eval: 'EvalError', fetch: 'TypeError', worker: 'TypeErrorEvalError'});
  assert.deepEqual(found.violated, ['connect-src', 'script-src', 'script-src-attr', 'script-src-elem']);
  assert.deepEqual(requests.filter((url) => !/^(data|blob):/.test(url)), []);
});
