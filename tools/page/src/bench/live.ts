// The bench's questions to the server: the fit of a choice, the stairs to it, and what an effect would draw.
import { useEffect, useRef, useState } from "preact/hooks";
import { lineOf, type Schemas, send } from "../api/client";
import { useAsked } from "../shell/asked";

export type Bench = Schemas["BenchAnswer"];
export type Effect = Schemas["BenchEffect"];
export type Fit = Schemas["BenchFit"];
export type Stairs = Schemas["BenchStairs"];
export type Choice = { effects: string[]; held: Record<string, number> };

const REST_MS = 250; // the steps are worked out once the slider has stopped

/** A fit and the choice it belongs to. */
export interface Fitted {
  choice: Choice;
  fit: Fit;
}

/** What the bench shows. */
export interface Live {
  now: Fitted | undefined;
  previous: Fitted | undefined; // before the last choice that was kept
  frame: Fit | undefined; // with no effect
  refusal: string;
}

/** Fits again whenever the choice changes: one fit at a time, the newest last. */
export function useLive(choice: Choice, kept: Choice, board: string): Live {
  const [now, setNow] = useState<Fitted>();
  const alone = () => send<Fit>("POST", "bench/fit", { effects: [], held: {} });
  const asked = useAsked(alone, board);
  const frame = asked.looking ? undefined : asked.answer;
  const [refusal, setRefusal] = useState("");
  const wanted = useRef<Choice | undefined>(undefined);
  const busy = useRef(false);
  const key = JSON.stringify(choice);
  useEffect(() => {
    wanted.current = choice;
    if (busy.current) return;
    busy.current = true;
    void fitNewest(wanted, setNow, setRefusal).finally(() => {
      busy.current = false;
    });
  }, [key, board]);
  const previous = usePrevious(now, kept);
  return { now, previous, frame, refusal };
}

async function fitNewest(
  wanted: { current: Choice | undefined },
  setNow: (fitted: Fitted) => void,
  setRefusal: (line: string) => void,
): Promise<void> {
  while (wanted.current) {
    const choice = wanted.current;
    wanted.current = undefined;
    try {
      setNow({ choice, fit: await send<Fit>("POST", "bench/fit", choice) });
      setRefusal("");
    } catch (error) {
      setRefusal(lineOf(error));
    }
  }
}

/** The fit before the last change; a slider still being moved does not count. */
function usePrevious(now: Fitted | undefined, kept: Choice): Fitted | undefined {
  const [previous, setPrevious] = useState<Fitted>();
  const settled = useRef<Fitted | undefined>(undefined);
  const key = JSON.stringify(kept);
  useEffect(() => {
    if (!now || JSON.stringify(now.choice) !== key) return;
    if (settled.current && JSON.stringify(settled.current.choice) !== key) {
      setPrevious(settled.current);
    }
    settled.current = now;
  }, [now, key]);
  return previous;
}

/** The steps to a choice, once it is settled; its fit says why there are none. */
export function useStairs(kept: Choice, board: string): Stairs | undefined {
  const climb = () => send<Stairs>("POST", "bench/stairs", kept);
  return useAsked(climb, JSON.stringify([kept, board]), REST_MS).answer;
}

/** The error that each further effect would leave [mm], once the choice is settled. */
export function useGains(kept: Choice, board: string): Record<string, number> | undefined {
  const gain = () => send<Record<string, number>>("POST", "bench/gains", kept);
  return useAsked(gain, JSON.stringify([kept, board]), REST_MS).answer;
}
