// Elements, made in one way. Text is always text: nothing of a map, an answer or a person is ever read as markup.

// A name in Hebrew or Arabic letters, which would turn the order of what stands beside it.
const RIGHT_TO_LEFT = /([\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc](?:[\s\d'".\-\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]*[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc])?)/;

type Child = Node | string | null | undefined | false;

/** An element with properties and children; `on...` are listeners, `aria-...` and `data-...` attributes. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Record<string, unknown> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value as EventListener);
    else if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, String(value));
    else Object.assign(element, { [name]: value });
  }
  element.append(...nodes(children));
  return element;
}

export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren(...nodes(children));
}

/** Children as nodes; right-to-left names in a text are isolated. */
function nodes(children: Child[]): (Node | string)[] {
  const shown = children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false);
  return shown.flatMap<Node | string>((child) => (typeof child === "string" ? child.split(RIGHT_TO_LEFT).map((part, n) => (n % 2 ? isolate(part) : part)) : child));
}

function isolate(name: string): Element {
  const element = document.createElement("bdi");
  element.textContent = name;
  return element;
}

/** Gives a text to the browser to save. */
export function save(name: string, type: string, text: string): void {
  const link = h("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

export function byId<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}
