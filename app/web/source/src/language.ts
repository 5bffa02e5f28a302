// The language of the page: the one chosen on it, or else the first of the browser's that has a catalogue.

import de from "./languages/de.json";
import en from "./languages/en.json";
import es from "./languages/es.json";
import fi from "./languages/fi.json";
import fr from "./languages/fr.json";
import sv from "./languages/sv.json";

type Catalogue = typeof en;
export type Key = { [K in keyof Catalogue]: Catalogue[K] extends string ? K : never }[keyof Catalogue];

const CATALOGUES = { en, fi, sv, de, fr, es } satisfies Record<string, Catalogue>;
export type Language = keyof typeof CATALOGUES;

/** Each language by its own name. */
export const LANGUAGES: Record<Language, string> = { en: "English", fi: "Suomi", sv: "Svenska", de: "Deutsch", fr: "Français", es: "Español" };
const STORED = "hereabouts-language";

export const language: Language = [stored(), ...navigator.languages].map((tag) => tag.toLowerCase().split("-")[0]).find(isLanguage) ?? "en";
const catalogue: Catalogue = CATALOGUES[language];

/** A text of the page, with values in the place of its `{names}`. */
export function t(key: Key, values: Record<string, string | number> = {}): string {
  return catalogue[key].replace(/\{(\w+)\}/g, (_, name: string) => String(values[name]));
}

/** A number in words, up to ten. */
export function count(number: number): string {
  return catalogue.counts[number] ?? String(number);
}

/** The compass direction of a bearing. */
export function direction(degrees: number): string {
  return catalogue.directions[Math.round((((degrees % 360) + 360) % 360) / 45) % 8];
}

export function decimal(value: number, digits: number): string {
  return value.toLocaleString(language, { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

/** Replaces the English of index.html: `data-text` and `data-label` name the texts and labels. */
export function translatePage(): void {
  document.documentElement.lang = language;
  for (const element of document.querySelectorAll<HTMLElement>("[data-text]")) element.textContent = t(element.dataset.text as Key);
  for (const element of document.querySelectorAll<HTMLElement>("[data-label]")) element.setAttribute("aria-label", t(element.dataset.label as Key));
}

export function store(chosen: string): void {
  try {
    localStorage.setItem(STORED, chosen);
  } catch {
    // The browser stores nothing for this page.
  }
}

function stored(): string {
  try {
    return localStorage.getItem(STORED) ?? "";
  } catch {
    return "";
  }
}

function isLanguage(tag: string): tag is Language {
  return Object.hasOwn(CATALOGUES, tag);
}
