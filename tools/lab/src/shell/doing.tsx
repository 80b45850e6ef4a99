// One thing at a time, asked for by a control; what is refused stands at that control.
import type { ComponentChild } from "preact";
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
