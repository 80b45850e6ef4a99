// One action at a time, started by a control; a refusal is shown at that control.
import type { ComponentChild, ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import { lineOf } from "../api/client";
import { Trouble } from "../controls/Trouble";

/** Whether an action is running, which control started it, and why the last was refused. */
export type Doing = [
  busy: boolean,
  run: (work: () => Promise<unknown>) => Promise<void>,
  refusal: ComponentChild,
];

/** Clears all refusals: one control's action may have fixed the reason for another's. */
const clearings = new Set<() => void>();

export function useDo(): Doing {
  const [busy, setBusy] = useState(false);
  const [line, setLine] = useState("");
  useEffect(() => {
    const clear = () => setLine("");
    clearings.add(clear);
    return () => {
      clearings.delete(clear);
    };
  }, []);
  const run = async (work: () => Promise<unknown>) => {
    setBusy(true);
    try {
      await work();
      for (const clear of clearings) clear();
    } catch (error) {
      setLine(lineOf(error));
    }
    setBusy(false);
  };
  return [busy, run, <Trouble key="refusal">{line}</Trouble>];
}

interface DoParts {
  work: () => Promise<unknown>;
  children: ComponentChildren;
  /** Whether it is the next thing to do on the screen. */
  isNext?: boolean | undefined;
  disabled?: boolean;
  /** A label for screen readers, if the text alone says too little. */
  label?: string;
  /** The button's text while it works. */
  meanwhile?: string;
}

/** A button for an action, which cannot be started twice; a refusal is shown beside it. */
export function Do({ work, children, isNext, disabled, label, meanwhile }: DoParts) {
  const [busy, run, refusal] = useDo();
  return (
    <>
      <button
        type="button"
        class={isNext ? "primary" : ""}
        disabled={busy || disabled}
        aria-label={label}
        onClick={() => void run(work)}
      >
        {(busy && meanwhile) || children}
      </button>
      {refusal}
    </>
  );
}
