// An edited value that the server stores: shown at once, kept in this browser until the server has it, sent again after
// the server was away, and merged into what the file holds by then.
import { useEffect, useReducer, useRef, useState } from "preact/hooks";
import { editOf, forget, isUnderWay, keep, listen } from "./outbox";
import { collides, type Edited, rebased, same } from "./rebase";
import { type Sending, useSending } from "./sending";

/** The state of a value between the editor and the disk. */
export interface Kept<Value> {
  value: Value; // what to show
  put: (next: Value | ((value: Value) => Value)) => void;
  waiting: boolean; // the server does not have it yet
  refused: string; // why the server does not accept it; the value stays to be corrected
  changed: boolean; // the file has changed; nothing is sent before that is settled
  settle: (mine: boolean) => void;
}

export interface KeptParts<Value> {
  place: string; // its name in the outbox: the id of the screen, or "choices"
  saved: Value; // what the server has, as far as this page knows
  /** Sends the value with the newest digests, takes the answer, and returns what is saved now. */
  save: (value: Value) => Promise<Value>;
  /** Asks for what is on disk now, so that `saved` becomes that. */
  reload: () => Promise<unknown>;
  /** Whether to ask when the file has changed in the same place; otherwise what was typed wins. */
  asks?: boolean;
  /** How long to wait after the last change [ms]; a quarter of a second for what is typed. */
  pause?: number;
}

export function useKept<Value>(parts: KeptParts<Value>): Kept<Value> {
  useOutbox();
  const { place, saved, asks } = parts;
  const edit = editOf(place) as Edited<Value> | undefined;
  const underWay = isUnderWay(place);
  const value = shownValue(edit, saved, underWay);
  const [refusal, setRefusal] = useState<{ value: Value; line: string }>();
  const refused = refusal && same(refusal.value, value) ? refusal.line : "";
  // What was typed and taken back while a save is under way has to be sent after it.
  const done = edit !== undefined && !underWay && same(value, saved);
  const changed = !!asks && edit !== undefined && !underWay && !done && collides(edit, saved);
  useEffect(() => {
    if (done) forget(place);
  }, [done, place]);

  const sending: Sending<Value> = {
    ...parts,
    value,
    ready: edit !== undefined && !done && !changed && !refused,
    refuse: (value, line) => setRefusal({ value, line }),
  };
  useSending(sending);
  // Two edits may come before the next frame, so the second builds on the first.
  const newest = useRef({ value, saved, changed });
  newest.current = { value, saved, changed };
  return {
    value,
    put: (next) => {
      const { value, saved, changed } = newest.current;
      const typed = next instanceof Function ? next(value) : next;
      newest.current.value = typed;
      setRefusal(undefined);
      const before = editOf(place);
      // What is saved is not in the value yet.
      const isBehind = changed || isUnderWay(place);
      keep(place, { value: typed, was: isBehind && before ? before.was : saved });
    },
    waiting: edit !== undefined && !done,
    refused,
    changed,
    settle: (mine) => (mine ? keep(place, { value, was: saved }) : forget(place)),
  };
}

/** What to show: during a save it is not known what is stored. */
function shownValue<Value>(edit: Edited<Value> | undefined, saved: Value, underWay: boolean) {
  if (!edit) return saved;
  return underWay ? edit.value : rebased(edit, saved);
}

/** Whether choices are being saved: what depends on them has to wait. */
export function useChoosing(): boolean {
  useOutbox();
  return editOf("choices") !== undefined;
}

/** Renders again when an edit comes or goes. */
export function useOutbox(): void {
  const [, change] = useReducer((count: number, _: undefined) => count + 1, 0);
  useEffect(() => listen(() => change(undefined)), []);
}
