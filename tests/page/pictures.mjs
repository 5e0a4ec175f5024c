// Pictures of the page, for people: desktop in light and dark, a phone, many carriers.

import { join } from 'node:path';

const kSettle_ms = 9000;

/** `many` starts a server with forty-eight carriers, where there is one to start. */
export async function take_pictures(browser, open, alive, url, folder, many) {
  const best = (address) => address.replace('#', '#quality=best&');
  const taken = [];
  const take = async (name, address, options) => {
    const page = await open(browser, best(address), options);
    await page.bringToFront();
    await alive(page);
    await page.evaluate((ms) => new Promise((done) => setTimeout(done, ms)), kSettle_ms);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    await page.close();
    taken.push(name);
  };
  await take('desktop-light', url, {});
  await take('desktop-dark', url, { scheme: 'dark' });
  await take('whole-light', url, { height: 1520 });
  await take('phone', url, { width: 360, height: 740, touch: true });
  const crowd = await many?.();
  if (crowd !== undefined) {
    await take('many-light', crowd.url, {});
    await take('many-dark', crowd.url, { scheme: 'dark' });
    await crowd.kill();
  }
  return taken.join(', ');
}
