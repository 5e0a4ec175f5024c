// The table of processes, which selects; and what is still missing before the flight may begin.

import { element, found, mark, say, show } from './dom';
import type { Process, Status } from './messages';
import type { Swarm } from './swarm';
import type { Theme } from './theme';
import { carrier_tone } from './tones';
import { losses, seconds } from './words';

const kColumns = ['name', 'state', 'clock', 'drift', 'missed', 'dropped', 'late', 'heard'] as const;
type Column = (typeof kColumns)[number];

interface Row {
  line: HTMLTableRowElement;
  button: HTMLButtonElement;
  dot: HTMLElement;
  cells: Record<Column, HTMLElement>;
}

/** What a cell says. Pure. */
export function cell_words(process: Process, column: Column): string {
  switch (column) {
    case 'name':
      return process.name;
    case 'state':
      return process.complaint !== '' ? `${process.state}: ${process.complaint}` : process.state;
    case 'clock':
      return process.clock_uncertainty_s < 0 ? '–' : `± ${seconds(process.clock_uncertainty_s)}`;
    case 'drift':
      return process.carrier === 0 || process.clock_uncertainty_s < 0 ? '–' : `${process.clock_drift_ppm.toFixed(1)} ppm`;
    case 'missed': {
      const sent = process.beacons_received + process.beacons_missed;
      return process.carrier === 0 || sent === 0 ? '–' : String(process.beacons_missed);
    }
    case 'dropped':
      return String(losses(process));
    case 'late':
      return seconds(process.late_s);
    case 'heard':
      return process.heard_age_s < 0 ? 'never' : process.heard_age_s < 1 ? '< 1 s' : seconds(process.heard_age_s);
  }
}

export class Processes {
  private readonly body = found('processes');
  private readonly rows = new Map<string, Row>();

  constructor(private readonly swarm: Swarm, private readonly theme: Theme) {
    swarm.on('status', () => this.draw());
    swarm.on('selection', () => this.draw());
    swarm.on('reset', () => this.clear());
    theme.on_change(() => this.draw());
  }

  private clear(): void {
    this.body.replaceChildren();
    this.rows.clear();
    this.draw_missing(undefined);
  }

  private draw(): void {
    const status = this.swarm.status;
    if (status === undefined) return;
    const names = new Set(status.processes.map((process) => process.name));
    for (const [name, row] of this.rows)
      if (!names.has(name)) {
        row.line.remove();
        this.rows.delete(name);
      }
    for (const process of status.processes) this.draw_row(process);
    this.draw_missing(status);
    const unwell = status.processes.filter((process) => !process.well).length;
    const well = unwell === 0 ? `all ${status.processes.length} well` : `${unwell} of ${status.processes.length} not well`;
    const allowed = status.skew_budget_s > 0 ? `, ${seconds(status.skew_budget_s)} allowed` : '';
    say(found('processes-count'), status.skew_s < 0 ? well : `${well} · clocks within ${seconds(status.skew_s)}${allowed}`);
    mark(found('processes-count'), 'data-bad', String(unwell > 0));
  }

  private draw_row(process: Process): void {
    const row = this.rows.get(process.name) ?? this.add_row(process.name);
    const index = this.swarm.ids.indexOf(process.carrier);
    row.dot.style.setProperty('--tone', process.carrier !== 0 && index >= 0 ? carrier_tone(index, this.theme.paper) : 'transparent');
    mark(row.line, 'data-well', String(process.well));
    const chosen = this.swarm.process === process.name || (process.carrier !== 0 && this.swarm.selected.includes(process.carrier));
    mark(row.line, 'data-selected', String(chosen));
    mark(row.button, 'aria-pressed', String(chosen));
    for (const column of kColumns) say(row.cells[column], cell_words(process, column));
    if (row.cells.state.title !== process.complaint) row.cells.state.title = process.complaint;
    const { late, duplicate, wrong_term, nonsense } = process.dropped;
    row.cells.dropped.title = `${late} late, ${duplicate} twice, ${wrong_term} of another term, ${nonsense} nonsense`;
    row.button.title = [process.address, process.plan, process.pid !== 0 ? `process ${process.pid}` : ''].filter(Boolean).join(' · ');
  }

  private add_row(name: string): Row {
    const dot = element('i', { class: 'dot' });
    const label = element('span');
    const button = element('button', { class: 'row-button', attributes: { type: 'button' } }, dot, label);
    const cells = { name: label } as unknown as Record<Column, HTMLElement>;
    const line = element('tr', {}, element('th', { attributes: { scope: 'row' } }, button));
    for (const column of kColumns.slice(1)) {
      const cell = element('td', { class: `cell-${column}` });
      cells[column] = cell;
      line.append(cell);
    }
    line.addEventListener('click', () => this.choose(name));
    this.body.append(line);
    const row = { line, button, dot, cells };
    this.rows.set(name, row);
    return row;
  }

  private choose(name: string): void {
    if (this.swarm.process === name) this.swarm.select_none();
    else this.swarm.select_process(name);
  }

  private draw_missing(status: Status | undefined): void {
    const missing = status?.missing ?? [];
    show(found('missing'), missing.length > 0);
    const words = missing.map((one) => `${one.who}: ${one.what}`);
    const list = found('missing-list');
    if (list.dataset['words'] === words.join('\n')) return;
    list.dataset['words'] = words.join('\n');
    const shown = missing.slice(0, 8).map((one) => element('li', {}, element('b', { text: one.who }), ` ${one.what}`));
    if (missing.length > 8) shown.push(element('li', { text: `and ${missing.length - 8} more` }));
    list.replaceChildren(...shown);
  }
}
