// Sends an edited value to the server: soon after the last key, again without an answer, and once more when the screen
// closes. A refused value is not sent again before it is changed.
import { useEffect, useReducer, useRef } from "preact/hooks";
import { Refusal } from "../api/client";
import { later } from "../api/rest";
import type { KeptParts } from "./kept";
import { editOf, forget, isUnderWay, keep, setUnderWay } from "./outbox";
import { rebased, same } from "./rebase";

const PAUSE_MS = 250; // after the last key
const AGAIN_MS = 3000; // after a server that did not answer
const CHANGED = 409;

export interface Sending<Value> extends KeptParts<Value> {
  value: Value;
  ready: boolean; // there is something to send, and nothing that forbids it
  refuse: (value: Value, line: string) => void;
}

const sends = new Map<string, Promise<boolean>>(); // under way, by place

export function useSending<Value>(sending: Sending<Value>): void {
  const newest = useRef(sending);
  newest.current = sending;
  const failed = useRef(false);
  const [tries, tried] = useReducer((count: number, _: undefined) => count + 1, 0);
  const send = useRef(async () => {
    if (isUnderWay(newest.current.place) || !newest.current.ready) return;
    failed.current = !(await sent(newest.current));
    tried(undefined);
  });
  const { place, ready, value } = sending;
  const text = JSON.stringify(value);
  const underWay = isUnderWay(place);
  // A new text, or a try that came back, starts the clock again.
  useEffect(() => {
    if (!ready || underWay) return;
    const pause = failed.current ? AGAIN_MS : (newest.current.pause ?? PAUSE_MS);
    return later(() => void send.current(), pause);
  }, [place, ready, underWay, text, tries]);
  const shown = useRef(sending);
  // What waits goes out when another place is shown, and when the screen closes.
  useEffect(() => () => void leave(shown.current), [place]);
  useEffect(() => {
    shown.current = sending;
  });
}

/** Sends what waits for a place that is not shown any more, after what is under way to it. */
async function leave<Value>(left: Sending<Value>): Promise<void> {
  if (!left.ready) return;
  const before = sends.get(left.place);
  if (!before) return void sent(left);
  await before;
  const edit = editOf(left.place) as { value: Value; was: Value } | undefined;
  if (edit && !isUnderWay(left.place)) void sent({ ...left, value: edit.value, saved: edit.was });
}

/** Sends the value; `sends` knows of it until it is answered. */
function sent<Value>(sending: Sending<Value>): Promise<boolean> {
  const { place } = sending;
  const way = answered(sending).finally(() => sends.delete(place));
  sends.set(place, way);
  return way;
}

/** Sends the value; false without an answer, so that it has to be sent again. */
async function answered<Value>(sending: Sending<Value>): Promise<boolean> {
  const { place, value, saved: before, save, reload, refuse } = sending;
  setUnderWay(place, true);
  // What is sent may hold more than what was typed: what others saved in the meantime.
  keep(place, { value, was: before });
  try {
    const saved = await save(value);
    // Together with what follows, so that no half-updated frame is drawn.
    setUnderWay(place, false);
    const now = editOf(place);
    // If typing went on meanwhile, it continues from what is saved now, which may be more than was sent.
    if (now && !same(now.value, value))
      keep(place, { value: rebased({ was: value, value: now.value as Value }, saved), was: saved });
    else forget(place);
  } catch (error) {
    setUnderWay(place, false);
    const status = error instanceof Refusal ? error.status : 0;
    if (status === CHANGED) await reload();
    else if (status >= 400 && status < 500) refuse(value, (error as Refusal).message);
    else return false;
  }
  return true;
}
