// A value that somebody edits and the server keeps: shown at once, kept in this browser until the server has it, sent
// again when the server was away, and brought together with what another tab saved in the meantime.
import { useEffect, useReducer, useRef, useState } from "preact/hooks";
import { type Clash, type Merged, merge, same, withPlace } from "./merge";
import { editOf, forget, isUnderWay, keep, listen } from "./outbox";
import { type Sending, useSending } from "./sending";

/** Where a value stands between the person and the disk. */
export interface Kept<Value> {
  value: Value; // what to show
  put: (next: Value | ((value: Value) => Value)) => void;
  waiting: boolean; // the server does not have it yet
  refused: string; // why the server does not take it; the value stays for mending
  clashes: Clash[]; // what another tab changed too; nothing is sent before they are settled
  settle: (clash: Clash, mine: boolean) => void;
}

export interface KeptParts<Value> {
  place: string; // its name in the outbox: the id of the screen, or "choices"
  saved: Value; // what the server has, as far as this page knows
  /** Sends the value with the newest digests, takes the answer, and returns what is saved now. */
  save: (value: Value) => Promise<Value>;
  /** Asks for what is on disk now, so that `saved` becomes that. */
  reload: () => Promise<unknown>;
  /** How long to wait after the last change [ms]; a quarter of a second for what is typed. */
  pause?: number;
}

export function useKept<Value>(parts: KeptParts<Value>): Kept<Value> {
  useOutbox();
  const { place, saved } = parts;
  const edit = editOf(place) as { value: Value; was: Value } | undefined;
  const underWay = isUnderWay(place);
  const merged = edit && !underWay ? merge(edit.was, edit.value, saved) : unmerged(edit, saved);
  const { value, clashes } = merged;
  const [refusal, setRefusal] = useState<{ value: Value; line: string }>();
  const refused = refusal && same(refusal.value, value) ? refusal.line : "";
  // What was typed and taken back while a save is under way has to be sent after it.
  const done = edit !== undefined && !underWay && clashes.length === 0 && same(value, saved);
  useEffect(() => {
    if (done) forget(place);
  }, [done, place]);

  const sending: Sending<Value> = {
    ...parts,
    value,
    ready: edit !== undefined && !done && clashes.length === 0 && !refused,
    refuse: (value, line) => setRefusal({ value, line }),
  };
  useSending(sending);
  // Somebody may type twice before the next picture, so the second edit builds on the first.
  const newest = useRef({ value, saved, clashes });
  newest.current = { value, saved, clashes };
  return {
    value,
    put: (next) => {
      const { value, saved, clashes } = newest.current;
      const changed = next instanceof Function ? next(value) : next;
      newest.current.value = changed;
      setRefusal(undefined);
      const before = editOf(place);
      // What is saved is not in the value yet.
      const isBehind = clashes.length > 0 || isUnderWay(place);
      keep(place, { value: changed, was: isBehind && before ? before.was : saved });
    },
    waiting: edit !== undefined && !done,
    refused,
    clashes,
    settle: ({ path, theirs }, mine) => {
      if (!edit) return;
      if (mine) keep(place, { value, was: withPlace(edit.was, path, theirs) });
      else keep(place, { value: withPlace(value, path, theirs), was: edit.was });
    },
  };
}

/** What to show while nobody knows what is saved: the edit, or else what was saved last. */
function unmerged<Value>(edit: { value: Value } | undefined, saved: Value): Merged<Value> {
  return { value: edit ? edit.value : saved, clashes: [] };
}

/** Whether choices are on their way: what goes by them has to wait. */
export function useChoosing(): boolean {
  useOutbox();
  return editOf("choices") !== undefined;
}

/** Renders again when an edit comes or goes. */
export function useOutbox(): void {
  const [, change] = useReducer((count: number, _: undefined) => count + 1, 0);
  useEffect(() => listen(() => change(undefined)), []);
}
