// Scenarios in an editor: yaml-language-server finds the schema by the first line of an example, has nothing against any
// example, marks mistakes, and completes keys and words.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {readdirSync, readFileSync} from 'node:fs';
import {after, before, test} from 'node:test';
import {fileURLToPath} from 'node:url';

const examples = new URL('../../../examples/', import.meta.url);
const server = spawn(process.execPath, [fileURLToPath(new URL('../../node_modules/yaml-language-server/bin/yaml-language-server', import.meta.url)), '--stdio'],
  {stdio: ['pipe', 'pipe', 'ignore']});
const waiting = new Map(); // number of a request, or address of a document => what takes the answer
let received = Buffer.alloc(0), requests = 0;

function take(message) {
  if (message.method === 'textDocument/publishDiagnostics') {
    waiting.get(message.params.uri)?.(message.params.diagnostics);
  } else if (message.method && message.id !== undefined) { // the server asks for settings: there are none
    send({id: message.id, result: message.method === 'workspace/configuration' ? message.params.items.map(() => null) : null});
  } else if (message.id !== undefined) {
    waiting.get(message.id)?.(message.result);
  }
}

server.stdout.on('data', (piece) => {
  received = Buffer.concat([received, piece]);
  for (;;) {
    const end = received.indexOf('\r\n\r\n');
    if (end < 0) return;
    const length = Number(/Content-Length: (\d+)/i.exec(received.subarray(0, end).toString())[1]);
    if (received.length < end + 4 + length) return;
    const text = received.subarray(end + 4, end + 4 + length).toString();
    received = received.subarray(end + 4 + length);
    take(JSON.parse(text));
  }
});
before(async () => {
  await request('initialize', {processId: null, rootUri: examples.href, capabilities: {}});
  send({method: 'initialized', params: {}});
});
after(() => server.kill());

function send(message) {
  const text = JSON.stringify({jsonrpc: '2.0', ...message});
  server.stdin.write(`Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`);
}

function request(method, params) {
  const id = ++requests;
  const answer = new Promise((resolve) => waiting.set(id, resolve));
  send({id, method, params});
  return answer;
}

/** What the server says of a text that stands at `uri`: a list of sentences. */
async function mistakes(uri, text) {
  const answer = new Promise((resolve) => waiting.set(uri, resolve));
  send({method: 'textDocument/didOpen', params: {textDocument: {uri, languageId: 'yaml', version: 1, text}}});
  return (await answer).map((each) => each.message);
}

const modeline = '# yaml-language-server: $schema=../docs/scenario.schema.json\n';

test('an editor has nothing against any example', async () => {
  const names = readdirSync(examples, {recursive: true}).filter((name) => name.endsWith('.yaml'));
  assert.ok(names.length > 40);
  for (const name of names) {
    const place = new URL(name, examples);
    assert.deepEqual(await mistakes(place.href, readFileSync(place, 'utf8')), [], name);
  }
});

for (const [what, text, said] of [
  ['a key that is none', 'load.mas: 8 g\n', /load\.mas is not allowed/],
  ['a word that is none of the key', 'contact:\n  model: sticky\n', /Value is not accepted.*unilateral/s],
  ['a number that is out of range', 'ribbon.poisson_ratio: 0.7\n', /0\.49/],
  ['a unit of another dimension', 'load.mass: 8 mm\n', /give a number with a unit from 0 g to 1000000 g/],
])
  test(`an editor marks ${what}`, async () => {
    const found = await mistakes(new URL(`wrong-${what.length}.yaml`, examples).href, modeline + text);
    assert.match(found.join('\n'), said);
  });

test('an editor completes keys and words, and shows help', async () => {
  const uri = new URL('completed.yaml', examples).href;
  await mistakes(uri, `${modeline}electro:\n  model: plates\n  \nload.mass: 8 g\n`);
  const labels = async (line, character) => {
    const answer = await request('textDocument/completion', {textDocument: {uri}, position: {line, character}});
    return (answer.items ?? answer).map((each) => each.label);
  };
  assert.ok((await labels(3, 2)).includes('breakdown_cap'));
  assert.ok((await labels(2, 9)).includes('field'));
  const hover = await request('textDocument/hover', {textDocument: {uri}, position: {line: 4, character: 3}});
  assert.match(JSON.stringify(hover.contents), /mass that hangs on the actuator.*0 g to 1000000 g.*8 g/);
});
