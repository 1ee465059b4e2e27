// Bundles page/ and build/zipact.wasm into one file that needs no network, dist/index.html.
import {createHash} from 'node:crypto';
import {build} from 'esbuild';
import {mkdir, readFile, writeFile} from 'node:fs/promises';

const here = new URL('.', import.meta.url).pathname;
const common = {bundle: true, minify: true, write: false, format: 'esm', target: 'es2022', absWorkingDir: here, logLevel: 'warning'};

async function bundle(options) {
  const {outputFiles} = await build({...common, ...options});
  return outputFiles[0].text;
}

// import worker from 'worker:study.js': the text of a script for a Worker
const workers = {
  name: 'workers',
  setup(plugin) {
    plugin.onResolve({filter: /^worker:/}, ({path}) => ({path: path.slice('worker:'.length), namespace: 'worker'}));
    plugin.onLoad({filter: /.*/, namespace: 'worker'}, async ({path}) => ({
      contents: await bundle({entryPoints: [`page/${path}`], format: 'iife'}),
      loader: 'text',
    }));
  },
};

/** The hash of an inline script or style for the security policy of the page. */
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

const bundled = await bundle({entryPoints: ['page/main.js'], plugins: [workers], loader: {'.wasm': 'binary'}});
const script = bundled.replaceAll('</script', '<\\/script');
const style = await bundle({entryPoints: ['page/style.css']});
const page = await readFile(`${here}page/index.html`, 'utf8');
const whole = page
  .replace('script-src SCRIPT', () => `script-src ${hash(script)}`)
  .replace('style-src STYLE', () => `style-src ${hash(style)}`)
  .replace('<link rel="stylesheet" href="style.css">', () => `<style>${style}</style>`)
  .replace('<script type="module" src="main.js"></script>', () => `<script type="module">${script}</script>`);
await mkdir(`${here}dist`, {recursive: true});
await writeFile(`${here}dist/index.html`, whole);
console.log(`web/dist/index.html: ${Math.round(whole.length / 1000)} kB, nothing else needed`);
