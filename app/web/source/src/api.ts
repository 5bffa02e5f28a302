// The service, asked by the page: public paths only, relative, so that a prefix of a proxy stays.

import { language, t } from "./language";
import type { components } from "./schema";

type Schemas = components["schemas"];
export type Answer = Schemas["LocalizeResponse"];
export type Candidate = Schemas["Candidate"];
export type Evidence = Schemas["Evidence"];
export type Info = Schemas["InfoResponse"];
export type Asked = Schemas["LocalizeRequest"];
export type Described = Schemas["DescribeResponse"];
export type Correction = Schemas["CorrectionRequest"];
export type JobState = Schemas["JobState"];
export type Measured = Schemas["EvaluateRequest"];

const KEPT = "hereabouts-key";

/** Why there is no answer, for people. */
export class Problem extends Error {
  constructor(
    readonly title: string,
    message: string,
    readonly code: string,
    readonly requestId: string | null = null,
    readonly retryAfter: number | null = null,
  ) {
    super(message);
  }
}

/** What went wrong, in a sentence. */
export function describeError(error: unknown): string {
  return error instanceof Problem ? `${error.title}. ${error.message}` : String((error as Error)?.message ?? error);
}

export function setKey(key: string): void {
  sessionStorage.setItem(KEPT, key.trim());
}

export async function info(): Promise<Info> {
  return (await call("info")).json();
}

export async function points(map: string, part: number): Promise<ArrayBuffer> {
  return (await call(`maps/${encodeURIComponent(map)}/points?part=${part}`)).arrayBuffer();
}

export async function localize(asked: Asked, signal: AbortSignal): Promise<Answer> {
  return (await send("localize", asked, signal)).json();
}

export async function describe(position: [number, number], signal?: AbortSignal): Promise<Described> {
  return (await send("describe", { position }, signal)).json();
}

export async function correct(correction: Correction): Promise<void> {
  await send("corrections", correction);
}

/** Sends a CSV table; the answer is the table with positions. */
export async function localizeTable(table: string, column: string, signal: AbortSignal): Promise<string> {
  const headers = { "Content-Type": "text/csv", Accept: "text/csv" };
  return (await call(`localize/batch?text=${encodeURIComponent(column)}`, { method: "POST", body: table, headers, signal })).text();
}

/** Starts an evaluation and follows it; the last state is the result. */
export async function* evaluate(asked: Measured, signal: AbortSignal, accept: (job: string) => void): AsyncGenerator<JobState> {
  const accepted = await (await send("evaluate", asked)).json(); // never aborted: it could not be cancelled then
  accept(accepted.job);
  const stream = await call(`evaluate/${accepted.job}/events`, { signal });
  const reader = stream.body!.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    text += part.value;
    const events = text.split(/\r?\n\r?\n/);
    text = events.pop()!;
    for (const event of events) {
      const data = event.split(/\r?\n/).filter((line) => line.startsWith("data:")).map((line) => line.slice(5)).join("\n");
      if (data) yield JSON.parse(data);
    }
  }
}

export async function cancel(job: string): Promise<void> {
  await call(`evaluate/${job}`, { method: "DELETE" });
}

function send(path: string, body: unknown, signal?: AbortSignal): Promise<Response> {
  return call(path, { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json" }, signal });
}

async function call(path: string, request: RequestInit = {}): Promise<Response> {
  const headers = new Headers(request.headers);
  headers.set("Accept-Language", language);
  const key = sessionStorage.getItem(KEPT);
  if (key && !/^[\x21-\x7e]+$/.test(key)) {
    sessionStorage.removeItem(KEPT);
    throw new Problem(t("keyWrong"), t("keyWrongAdvice"), "key_wrong");
  }
  if (key) headers.set("Authorization", `Bearer ${key}`);
  let response: Response;
  try {
    response = await fetch(path, { ...request, headers });
  } catch (error) {
    if (request.signal?.aborted) throw error;
    throw new Problem(t("unreachable"), t("unreachableAdvice"), "unreachable");
  }
  if (response.ok) return response;
  throw await problemOf(response);
}

async function problemOf(response: Response): Promise<Problem> {
  const said = await response.json().catch(() => ({}));
  return new Problem(
    said.title ?? t("serviceAnswered", { status: response.status }),
    said.detail ?? t("tryLater"),
    said.code ?? String(response.status),
    said.request_id ?? response.headers.get("x-request-id"),
    Number(response.headers.get("retry-after")) || null,
  );
}
