// The picture of the page in the README: node screenshot.mjs FILE.png
import {address, launch} from './browser.mjs';

const browser = await launch();
const page = await browser.newPage({viewport: {width: 1280, height: 1010}, colorScheme: 'light'});
await page.goto(`${address}#liquid.model=submerged&slow=20`);
await page.waitForFunction(() => document.getElementById('n-letgo').textContent !== '–');
await page.click('#step');
await page.waitForFunction(() => Number(document.getElementById('n-zipped').textContent) >= 12);
await page.click('#pause');
await page.waitForTimeout(300);
const numbers = await page.locator('#numbers').boundingBox();
await page.screenshot({path: process.argv[2], clip: {x: 0, y: 0, width: 1280, height: Math.ceil(numbers.y + numbers.height) + 12}});
await browser.close();
