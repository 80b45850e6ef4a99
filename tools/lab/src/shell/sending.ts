// Sends an edited value to the server: soon after the last key, again while nobody answers, and once more when the
// screen closes. What the server refuses is not sent again before somebody changes it.
import { useEffect, useReducer, useRef } from "preact/hooks";
import { Refusal } from "../api/client";
import type { KeptParts } from "./kept";
import { merge, same } from "./merge";
import { editOf, forget, keep, setUnderWay } from "./outbox";

const PAUSE_MS = 250; // after the last key
const AGAIN_MS = 3000; // after a server that did not answer
const CHANGED = 409;

export interface Sending<Value> extends KeptParts<Value> {
  value: Value;
  ready: boolean; // there is something to send, and nothing that forbids it
  refuse: (value: Value, line: string) => void;
}

export function useSending<Value>(sending: Sending<Value>): void {
  const newest = useRef(sending);
  newest.current = sending;
  const busy = useRef(false);
  const failed = useRef(false);
  const [tries, tried] = useReducer((count: number, _: undefined) => count + 1, 0);
  const send = useRef(async () => {
    if (busy.current || !newest.current.ready) return;
    busy.current = true;
    failed.current = !(await answered(newest.current));
    busy.current = false;
    tried(undefined);
  });
  const { ready, value } = sending;
  const text = JSON.stringify(value);
  // A new text, or a try that came back, starts the clock again.
  useEffect(() => {
    if (!ready) return;
    const pause = failed.current ? AGAIN_MS : (newest.current.pause ?? PAUSE_MS);
    const timer = setTimeout(() => void send.current(), pause);
    return () => clearTimeout(timer);
  }, [ready, text, tries]);
  useEffect(() => () => void send.current(), []);
}

/** Sends the value; false if nobody answered, so that it is to be sent again. */
async function answered<Value>(sending: Sending<Value>): Promise<boolean> {
  const { place, value, saved: before, save, reload, refuse } = sending;
  setUnderWay(place, true);
  // What is sent may hold more than what was typed: what others saved in the meantime.
  keep(place, { value, was: before });
  try {
    const saved = await save(value);
    // In the same breath as what follows, so that no picture is drawn of half of it.
    setUnderWay(place, false);
    const now = editOf(place);
    // Who typed on in the meantime goes on from what is saved now, which may be more than what was sent.
    if (now && !same(now.value, value))
      keep(place, { value: merge(value, now.value as Value, saved).value, was: saved });
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
