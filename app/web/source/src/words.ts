// Measures and probabilities in words, and sentences.

import { decimal, language, t } from "./language";

export function metres(value: number): string {
  if (value >= 10000) return `${Math.round(value / 1000)} km`;
  if (value >= 1000) return `${decimal(value / 1000, 1)} km`;
  return `${value < 10 ? Math.max(1, Math.round(value)) : Math.round(value)} m`;
}

export function percent(share: number): string {
  if (share > 0.99) return t("overPercent", { percent: 99 });
  return share < 0.01 ? t("underPercent", { percent: 1 }) : `${Math.round(100 * share)} %`;
}

/** How sure a probability of being here is. */
export function likely(probability: number): string {
  if (probability >= 0.9) return t("veryLikely");
  if (probability >= 0.7) return t("likely");
  if (probability >= 0.4) return t("perhaps");
  return t("guess");
}

export function sentence(text: string): string {
  return text.charAt(0).toLocaleUpperCase(language) + text.slice(1);
}

/** The sentences of a text, with their places in its characters, as the service counts them. */
export function sentences(text: string): { text: string; start: number; end: number }[] {
  return [...text.matchAll(/(?:[^.!?\n]|[.!?](?!\s|$))+[.!?]*/g)]
    .filter((match) => /[\p{L}\p{N}]/u.test(match[0]))
    .map((match) => {
      const start = [...text.slice(0, match.index)].length;
      return { text: match[0].trim(), start, end: start + [...match[0]].length };
    });
}
