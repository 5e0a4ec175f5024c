// Elements, made and found. Text goes in as text only: nothing that came over the wire is ever read as markup.

type Child = Node | string;

interface Options {
  class?: string;
  title?: string;
  text?: string;
  attributes?: Record<string, string>;
}

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  options: Options = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (options.class !== undefined) made.className = options.class;
  if (options.title !== undefined) made.title = options.title;
  if (options.text !== undefined) made.textContent = options.text;
  for (const [name, value] of Object.entries(options.attributes ?? {})) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** The element that index.html promises. */
export function found<T extends HTMLElement = HTMLElement>(id: string): T {
  const it = document.getElementById(id);
  if (it === null) throw new Error(`index.html has no element ${id}`);
  return it as T;
}

/** Writes only what changed: a browser lays out again after every write. */
export function say(into: Element, words: string): void {
  if (into.textContent !== words) into.textContent = words;
}

export function show(it: HTMLElement, shown: boolean): void {
  if (it.hidden === shown) it.hidden = !shown;
}

export function mark(it: Element, name: string, value: string): void {
  if (it.getAttribute(name) !== value) it.setAttribute(name, value);
}

export function css_color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function is_still(): boolean {
  return window.matchMedia('(prefers-reduced-motion: reduce)').matches;
}
