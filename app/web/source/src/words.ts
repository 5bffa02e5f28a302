// Numbers in words.

const COUNTS = ["No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine", "Ten"];
const WINDS = ["north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"];

export function count(number: number): string {
  return COUNTS[number] ?? String(number);
}

export function metres(value: number): string {
  if (value >= 10000) return `${Math.round(value / 1000)} km`;
  if (value >= 1000) return `${(value / 1000).toFixed(1)} km`;
  return `${value < 10 ? Math.max(1, Math.round(value)) : Math.round(value)} m`;
}

export function percent(share: number): string {
  if (share > 0.99) return "over 99 %";
  return share < 0.01 ? "under 1 %" : `${Math.round(100 * share)} %`;
}

/** How sure a probability of being here is. */
export function likely(probability: number): string {
  if (probability >= 0.9) return "very likely here";
  if (probability >= 0.7) return "likely here";
  if (probability >= 0.4) return "perhaps here";
  return "only one guess of several";
}

export function wind(degrees: number): string {
  return WINDS[Math.round((((degrees % 360) + 360) % 360) / 45) % 8];
}

export function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
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
