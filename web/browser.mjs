// Debian's Chromium without a window, and where the built page is.
import {chromium} from 'playwright-core';

export const address = new URL('dist/index.html', import.meta.url).href;

export const launch = () => chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
         '--disable-component-update', '--disable-sync'],
});
