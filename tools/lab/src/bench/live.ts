// The bench's questions to the server: the fit of a choice, the stairs to it, and what an effect would draw.
import { useEffect, useRef, useState } from "preact/hooks";
import { type Schemas, send } from "../api/client";
import { later } from "../api/rest";

export type Bench = Schemas["BenchAnswer"];
export type Effect = Schemas["BenchEffect"];
export type Fit = Schemas["BenchFit"];
export type Stairs = Schemas["BenchStairs"];
export type Choice = { effects: string[]; held: Record<string, number> };

const REST_MS = 250; // the stairs are climbed when nobody moves a slider

/** A fit and the choice that it is of. */
export interface Fitted {
  choice: Choice;
  fit: Fit;
}

/** What the bench has to show. */
export interface Live {
  now: Fitted | undefined;
  previous: Fitted | undefined; // before the last choice that was kept
  frame: Fit | undefined; // with no effect
  refusal: string;
}

/** Fits a choice again whenever it changes: never two at once, and the newest last. */
export function useLive(choice: Choice, kept: Choice, board: string): Live {
  const [now, setNow] = useState<Fitted>();
  const [frame, setFrame] = useState<Fit>();
  const [refusal, setRefusal] = useState("");
  const wanted = useRef<Choice | undefined>(undefined);
  const busy = useRef(false);
  const key = JSON.stringify(choice);
  useEffect(() => {
    setFrame(undefined);
    let stale = false;
    const alone = { effects: [], held: {} };
    send<Fit>("POST", "bench/fit", alone).then(
      (answer) => stale || setFrame(answer),
      (error) => stale || setRefusal(error.message),
    );
    return () => {
      stale = true;
    };
  }, [board]);
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
      setRefusal(error instanceof Error ? error.message : String(error));
    }
  }
}

/** The fit of the choice before the last: a slider that is still being moved does not count. */
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

/** The stairs to a choice, once it rests. */
export function useStairs(kept: Choice, board: string): Stairs | undefined {
  const [stairs, setStairs] = useState<Stairs>();
  const key = JSON.stringify(kept);
  useEffect(() => {
    let stale = false;
    const giveUp = later(() => {
      send<Stairs>("POST", "bench/stairs", kept).then(
        (answer) => stale || setStairs(answer),
        () => undefined, // the fit of the same choice says why
      );
    }, REST_MS);
    return () => {
      stale = true;
      giveUp();
    };
  }, [key, board]);
  return stairs;
}
