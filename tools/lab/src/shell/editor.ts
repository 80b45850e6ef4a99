// Which tab edits the folder: the live line says it. This tab takes over what an earlier tab left unsaved.
import { useEffect, useReducer } from "preact/hooks";
import { send } from "../api/client";
import { tab } from "../api/tab";

let editor = "";
const listeners = new Set<() => void>();

/** Whether another tab edits the folder. */
export function isReadOnly(): boolean {
  return editor !== "" && editor !== tab();
}

/** Whether this tab edits the folder; not before the live line has said so. */
export function isEditor(): boolean {
  return editor === tab();
}

export function setEditor(now: string): void {
  editor = now;
  for (const callback of [...listeners]) callback();
}

/** Calls back when the right to edit goes to another tab; returns what ends that. */
export function listenToEditor(callback: () => void): () => void {
  listeners.add(callback);
  return () => listeners.delete(callback);
}

export function useReadOnly(): boolean {
  const [, change] = useReducer((count: number, _: undefined) => count + 1, 0);
  useEffect(() => listenToEditor(() => change(undefined)), []);
  return isReadOnly();
}

export async function takeOver(): Promise<void> {
  const answer = await send<{ editor: string }>("POST", "editor");
  setEditor(answer.editor);
}
