// A table of descriptions: a CSV file is sent in parts, and comes back with positions.

import * as api from "./api";
import { fill, h, save } from "./dom";
import { t } from "./language";

const ROWS_PER_REQUEST = 100; // so that progress moves and cancelling is quick
const MOST_TRIES = 5; // of a part, while the service is busy
const DELIMITERS = [",", ";", "\t"];

export class Table {
  readonly element = h("details", { id: "table" });
  private readonly column = h("select", { id: "column", required: true });
  private readonly start = h("button", { type: "submit", className: "first" }, t("locateRows"));
  private readonly form = h("form", { hidden: true, className: "row", onsubmit: (event: Event) => (event.preventDefault(), void this.run()) }, h("label", { for: "column" }, t("textColumn")), this.column, this.start);
  private readonly result = h("div", { "aria-live": "polite" });
  private file = { name: "", mark: "", header: "", rows: [] as string[] };
  private running: AbortController | null = null;

  constructor(private readonly limits: () => api.Info["limits"] | undefined) {
    const file = h("input", { type: "file", accept: ".csv,.tsv,.txt,text/csv", onchange: () => (void this.open(file.files?.[0]), (file.value = "")) });
    this.element.append(h("summary", {}, t("tableTitle")), h("p", { className: "small" }, t("tableAdvice")), h("div", { className: "row" }, h("label", { className: "button" }, t("chooseFile"), file)), this.form, this.result);
    addEventListener("dragover", (event) => event.dataTransfer?.types.includes("Files") && event.preventDefault());
    addEventListener("drop", (event) => {
      const dropped = event.dataTransfer?.files[0];
      if (!dropped) return;
      event.preventDefault();
      void this.open(dropped);
    });
  }

  /** Reads a file and asks for its column of texts. */
  private async open(file: File | undefined): Promise<void> {
    if (!file) return;
    this.running?.abort();
    this.element.open = true;
    this.form.hidden = true;
    try {
      const text = decode(await file.arrayBuffer());
      const mark = text.startsWith("\ufeff") ? "\ufeff" : "";
      const [header, ...rows] = records(text.slice(mark.length));
      if (!rows.length) throw new Error(t("fileNoRows"));
      this.file = { name: file.name, mark, header, rows };
      const names = fields(header);
      fill(this.column, names.length > 1 && h("option", { value: "" }, t("chooseData")), ...names.map((name) => h("option", { value: name }, name)));
      this.form.hidden = false;
      fill(this.result, h("p", { className: "small" }, file.name));
      this.column.focus();
    } catch (error) {
      fill(this.result, h("p", { role: "alert" }, (error as Error).message));
    }
    this.element.scrollIntoView({ block: "nearest" });
  }

  private async run(): Promise<void> {
    if (this.running) return this.running.abort();
    const running = (this.running = new AbortController());
    const { file } = this;
    const answered: string[] = []; // the header first
    this.start.textContent = t("cancel");
    let done = 0;
    let error = "";
    try {
      while (done < file.rows.length) {
        this.progress(file.name, done, file.rows.length);
        const part = this.part(file.rows, done);
        const [header, ...rows] = records(await this.send([file.header, ...part].join("\n"), running.signal));
        answered.push(...(done ? rows : [header, ...rows]));
        done += part.length;
      }
    } catch (problem) {
      error = running.signal.aborted ? t("cancelled") : api.describeError(problem);
    }
    this.running = null;
    this.start.textContent = t("locateRows");
    if (file !== this.file) return; // another file was opened meanwhile
    const name = file.name.replace(/(\.\w+)?$/, "-places.csv");
    fill(
      this.result,
      error && h("p", { role: "alert" }, error),
      done > 0 && h("button", { type: "button", onclick: () => save(name, "text/csv", `${file.mark}${answered.join("\r\n")}\r\n`) }, t("saveRows", { done, total: file.rows.length })),
    );
  }

  /** As many of the next rows as one request takes. */
  private part(rows: string[], first: number): string[] {
    const limits = this.limits();
    let last = first + Math.min(ROWS_PER_REQUEST, limits?.max_rows ?? ROWS_PER_REQUEST);
    while (last > first + 1 && rows.slice(first, last).join("\n").length > (limits?.max_bytes ?? Infinity)) last = Math.ceil((first + last) / 2) - 1;
    return rows.slice(first, Math.max(last, first + 1));
  }

  /** Sends a part, again where the service is busy. */
  private async send(part: string, signal: AbortSignal): Promise<string> {
    for (let tries = 1; ; tries++) {
      try {
        return await api.localizeTable(part, this.column.value, signal);
      } catch (error) {
        if (!(error instanceof api.Problem && error.retryAfter && tries < MOST_TRIES)) throw error;
        await new Promise((resolve) => setTimeout(resolve, 1000 * error.retryAfter!));
        signal.throwIfAborted();
      }
    }
  }

  private progress(stage: string, done: number, total: number): void {
    fill(this.result, h("progress", { "aria-label": t("progress"), max: total, value: done }), h("p", { className: "small" }, t("progressOf", { stage, done, total })));
  }
}

function decode(bytes: ArrayBuffer): string {
  try {
    return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
  } catch {
    throw new Error(t("fileNotUtf8"));
  }
}

/** The delimiter that the first line has most of. */
function delimiterOf(text: string): string {
  const line = text.split(/[\r\n]/, 1)[0];
  const counts = DELIMITERS.map((delimiter) => line.split(delimiter).length);
  return DELIMITERS[counts.indexOf(Math.max(...counts))];
}

/** The records of a CSV text as they are written, without blank lines; a quote opens only where a field begins. */
function records(text: string): string[] {
  const delimiter = delimiterOf(text);
  const found: string[] = [];
  let [start, isQuoted, isFresh] = [0, false, true];
  for (let n = 0; n <= text.length; n++) {
    const letter = text[n] ?? "\n";
    const ends = n === text.length || (!isQuoted && (letter === "\n" || letter === "\r"));
    if (ends) {
      if (text.slice(start, n).trim()) found.push(text.slice(start, n));
      start = n + 1;
    } else if (letter === '"') isQuoted = !isQuoted && (isFresh || text[n - 1] === '"');
    isFresh = ends || (!isQuoted && letter === delimiter);
  }
  return found;
}

/** The fields of a record. */
function fields(record: string): string[] {
  const delimiter = delimiterOf(record);
  const names: string[] = [];
  let open: string | null = null;
  for (const piece of record.split(delimiter)) {
    open = open === null ? piece : open + delimiter + piece;
    if (open.split('"').length % 2 === 0) continue; // a quote is still open
    names.push(open.replace(/^\s*"([^]*)"\s*$/, "$1").replaceAll('""', '"'));
    open = null;
  }
  return names;
}
