// The game as the server has it, and the steps that change it.
import { useEffect } from "preact/hooks";
import type { Schemas } from "../api/client";
import { useProject } from "../shell/project";
import { useWatched } from "../shell/watched";

export type PracticeState = Schemas["PracticeAnswer"];
export type Game = Schemas["Game"];

const LOOK_MS = 400; // while the machine works

/** The game, and how to take a step of it. */
export interface Play {
  practice: PracticeState | undefined;
  step: (name: string, body?: unknown) => Promise<void>;
  busy: boolean;
  silent: boolean;
}

export function usePractice(): Play {
  const { setTrouble, reload } = useProject();
  const { state, silent, press, busy } = useWatched<PracticeState>({
    path: "practice",
    works: isAtWork,
    oftenMs: LOOK_MS,
    trouble: setTrouble,
  });
  const works = state !== undefined && isAtWork(state);
  useEffect(() => {
    if (works) return () => void reload(); // the marks are there
  }, [works, reload]);
  const step = async (name: string, body?: unknown) => {
    await press(name, body);
    await reload();
  };
  return { practice: state, silent, step, busy: busy || works };
}

function isAtWork(practice: PracticeState): boolean {
  return practice.doing != null;
}
