// Edits that the server has not confirmed yet, stored in this browser by folder, so that no crash, reload or dead
// server loses what was typed.

import { store, stored, storedNames } from "../api/stored";

/** The edited value of a place, and its value before the edit. */
export interface Edit {
  value: unknown;
  was: unknown;
}

const PREFIX = "plumb-edit";
let folder = "";
const edits = new Map<string, Edit>(); // of this tab, by place; the storage holds a copy for the next tab
const listeners = new Set<() => void>();
const underWay = new Set<string>(); // places whose value is on its way to the server

/** Names the folder whose edits these are, and takes up what an earlier tab left behind. */
export function openOutbox(key: string): void {
  if (key === folder) return;
  folder = key;
  edits.clear();
  for (const name of storedNames(storedAs(""))) {
    const edit = stored<Edit>(name);
    const place = name.slice(storedAs("").length);
    if (edit && !edits.has(place)) edits.set(place, edit);
  }
  tell();
}

/** The edit of a place that still waits, if any. */
export function editOf(place: string): Edit | undefined {
  return edits.get(place);
}

/** Keeps an edit until it is confirmed. */
export function keep(place: string, edit: Edit): void {
  edits.set(place, edit);
  store(storedAs(place), edit);
  tell();
}

/** Forgets the edit of a place: it is saved, or given up. */
export function forget(place: string): void {
  edits.delete(place);
  store(storedAs(place), undefined);
  tell();
}

/** Whether a value of this place is being sent, so that it is not known what is stored. */
export function isUnderWay(place: string): boolean {
  return underWay.has(place);
}

/** Notes that a value of this place is being sent, or was answered. */
export function setUnderWay(place: string, is: boolean): void {
  if (is) underWay.add(place);
  else underWay.delete(place);
  tell();
}

/** The places whose edits wait. */
export function waitingPlaces(): string[] {
  return [...edits.keys()];
}

/** Calls back after each change; returns a function that stops it. */
export function listen(callback: () => void): () => void {
  listeners.add(callback);
  return () => listeners.delete(callback);
}

function storedAs(place: string): string {
  return `${PREFIX}:${folder}:${place}`;
}

function tell(): void {
  for (const callback of [...listeners]) callback();
}
