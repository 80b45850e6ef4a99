// One thing at a time, asked for by a control; what is refused stands at that control.
import type { ComponentChild, ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";

/** Whether something is being done, what does it, and why the last was refused: to be shown at the control. */
export type Doing = [
  busy: boolean,
  run: (work: () => Promise<unknown>) => Promise<void>,
  refusal: ComponentChild,
];

/** Takes each refusal away: what one control did may have mended what another was refused for. */
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
      setLine(error instanceof Error ? error.message : String(error));
    }
    setBusy(false);
  };
  return [busy, run, line && <Refusal line={line} />];
}

export function Refusal({ line }: { line: string }) {
  return (
    <span class="refusal" role="alert">
      {line}
    </span>
  );
}

interface DoParts {
  work: () => Promise<unknown>;
  children: ComponentChildren;
  /** Whether the screen wants it next. */
  isNext?: boolean | undefined;
  disabled?: boolean;
  /** What is heard, where the words alone say too little. */
  label?: string;
  /** What the button says while it works. */
  meanwhile?: string;
}

/** A button that does something: never twice at once, and why it was refused stands beside it. */
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
