// The page: makes its parts and lets them go.

import { Commands } from './commands';
import { Connection } from './connection';
import { found } from './dom';
import { Header } from './header';
import { HurtPanel } from './hurt';
import { Inset } from './inset';
import { Keys } from './keys';
import { Log } from './log';
import { Plots } from './plots';
import { Processes } from './processes';
import { Retune } from './retune';
import { Stage } from './scene/stage';
import { Swarm } from './swarm';
import { Theme } from './theme';
import { TimeSync } from './time_sync';

// #quality=best, besides the token: as beautiful as it gets, however slow, for pictures of the page.
const held = new URLSearchParams(location.hash.slice(1)).get('quality') === 'best';

const swarm = new Swarm();
const theme = new Theme();
const connection = new Connection(swarm);
const time = new TimeSync();
connection.begin();  // first, so that the others know whether there is a token

const log = new Log(swarm);
new Header(swarm, time);
const stage = Stage.begin(swarm, theme, held);
new Inset(swarm, theme);
new Plots(swarm, theme);
new Processes(swarm, theme);
const commands = new Commands(swarm, connection, log);
const retune = new Retune(swarm, connection, commands);
new HurtPanel(swarm, connection, log);
const keys = new Keys({ swarm, stage, commands, retune, theme });

found('view-top').addEventListener('click', () => stage?.above());
found('view-reset').addEventListener('click', () => stage?.reset());
found('follow').addEventListener('click', () => keys.toggle_follow());
found('theme').addEventListener('click', () => theme.toggle());
swarm.on('hello', () => {
  document.body.dataset['recording'] = String(swarm.hello?.takes_orders === false);
});
swarm.on('online', () => {
  if (swarm.online) time.again();
});
time.begin();
