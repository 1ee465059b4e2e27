// The built page in Firefox (Debian's firefox-esr), driven by WebDriver BiDi; skipped where there is none.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {createServer} from 'node:net';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import {WebSocket} from '../../websocket.mjs';
import {address} from '../../browser.mjs';

const firefox = process.env.FIREFOX ?? '/usr/bin/firefox-esr';
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const {port} = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Commands of WebDriver BiDi => answers. */
class Session {
  #socket;
  #waiting = new Map();

  static async open(port) {
    for (let tries = 0; ; tries++) {
      try {
        const session = new Session();
        session.#socket = await WebSocket.open('127.0.0.1', port, '/session', (text) => session.#hear(JSON.parse(text)));
        await session.ask('session.new', {capabilities: {}});
        return session;
      } catch (error) {
        if (tries > 100) throw error;
        await wait(200);
      }
    }
  }

  ask(method, params) {
    const id = this.#waiting.size + 1;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, {resolve, reject});
      this.#socket.send(JSON.stringify({id, method, params}));
    });
  }

  #hear({id, type, result, message}) {
    if (type === 'success') this.#waiting.get(id).resolve(result);
    else if (type === 'error') this.#waiting.get(id).reject(new Error(message));
  }

  close() {
    this.#socket.end();
  }
}

test('the page in Firefox: it zips; the chart, undo, a link and the tour work', {skip: !existsSync(firefox), timeout: 120e3}, async () => {
  const profile = mkdtempSync(join(tmpdir(), 'zipact-firefox-')), port = await freePort();
  const browser = spawn(firefox, ['--headless', '--no-remote', '--profile', profile, '--remote-debugging-port', String(port)], {stdio: 'ignore'});
  const over = new Promise((resolve) => browser.once('exit', resolve));
  try {
    const session = await Session.open(port);
    const {context} = await session.ask('browsingContext.create', {type: 'tab'});
    await session.ask('browsingContext.navigate', {context, url: `${address}#liquid.model=none`, wait: 'complete'});
    const run = async (expression) => {
      const {result, exceptionDetails} = await session.ask('script.evaluate', {expression, target: {context}, awaitPromise: true});
      assert.equal(exceptionDetails, undefined, exceptionDetails?.text);
      return result.value;
    };
    const until = async (expression) => {
      for (const end = Date.now() + 60e3; !(await run(expression)); await wait(100)) assert.ok(Date.now() < end, expression);
    };
    await until("Number(document.getElementById('n-contraction')?.textContent) > 99");
    await until("/^pulls in at /.test(document.getElementById('voltage-note').textContent)");
    await until("/up to \\d/.test(document.getElementById('plot-chart').getAttribute('aria-label'))");
    assert.equal(await run("document.getElementById('alert').hidden"), true);
    const command = "document.getElementById('command').textContent", first = await run(command);
    await run("[...document.querySelectorAll('#presets button')].find((button) => button.textContent === 'Too heavy').click()");
    const heavy = await run(command);
    assert.notEqual(heavy, first);
    await until("location.hash.includes('load.mass')");
    const link = await run('location.href');
    await run("document.getElementById('undo').click()");
    assert.equal(await run(command), first);
    await run("document.getElementById('redo').click()");
    assert.equal(await run(command), heavy);
    await session.ask('browsingContext.navigate', {context, url: 'about:blank', wait: 'complete'});
    await session.ask('browsingContext.navigate', {context, url: link, wait: 'complete'});
    await until(`${command} !== ''`);
    assert.equal(await run(command), heavy);
    await run("document.getElementById('tour').click()");
    assert.match(await run("document.querySelector('#guide h2').textContent"), /^1 of 5: /);
    if (process.env.SCREENSHOT) {
      const {data} = await session.ask('browsingContext.captureScreenshot', {context});
      (await import('node:fs')).writeFileSync(process.env.SCREENSHOT, Buffer.from(data, 'base64'));
    }
    session.close();
  } finally {
    browser.kill();
    await over;
    rmSync(profile, {recursive: true, force: true});
  }
});
