// The project that all screens share: what is on disk, and how a screen changes it.
import { createContext } from "preact";
import { useCallback, useContext, useRef, useState } from "preact/hooks";
import { type Choices, LOOK_MS, lineOf, type Project, Refusal, send } from "../api/client";
import { useFresh, usePolling } from "./fresh";
import { useKept } from "./kept";
import { openOutbox } from "./outbox";

/** What a screen sees of the project, and what it may do with it. */
export interface Shared {
  project: Project;
  /** Shows an answer that holds the whole project. */
  take: (project: Project) => void;
  /** Changes choices: shown at once, kept in the browser until they are saved. */
  choose: (change: Partial<Choices>) => void;
  /** Reads again what is on disk. */
  reload: () => Promise<void>;
  /** What went wrong last; empty if nothing. */
  trouble: string;
  setTrouble: (line: string | ((before: string) => string)) => void;
}

export const ProjectContext = createContext<Shared | null>(null);

/** The project; only for screens inside of the lab. */
export function useProject(): Shared {
  const shared = useContext(ProjectContext);
  if (!shared) throw new Error("outside of the lab");
  return shared;
}

let told: Promise<unknown> = Promise.resolve(); // what was sent before has been answered

/** Sends something that answers with the project as it then is; what is sent later waits for the answer. */
export function useTell(): (
  path: string,
  body?: unknown,
  method?: "POST" | "DELETE",
) => Promise<void> {
  const { take } = useProject();
  return (path, body, method = "POST") => {
    const answer = told.then(() => send<Project>(method, path, body));
    told = answer.catch(() => undefined);
    return answer.then(take);
  };
}

const LOOK_AGAIN_MS = 3000; // so work of another tab or of the command line shows up
const UNPAIRED = 401;
export const SILENT = "The lab does not answer";

/** What the frame knows: the project once it is loaded, and choices that may still wait. */
export interface Loaded {
  shared: Shared | undefined;
  trouble: string;
  /** This phone is not paired, or no longer: the server does not answer it. */
  isStranger: boolean;
  reload: () => Promise<void>;
}

/** Loads the project and keeps it fresh. */
export function useSharedProject(): Loaded {
  const [trouble, setTrouble] = useState("");
  const [isStranger, setStranger] = useState(false);
  const seen = ({ key }: Project) => {
    openOutbox(key);
    setStranger(false);
  };
  const { state: project, take, load } = useFresh<Project>("project", LOOK_MS, seen);
  const reload = useCallback(
    () =>
      load().then(
        () => setTrouble((line) => (line.startsWith(SILENT) ? "" : line)),
        (error) => {
          const isUnpaired = error instanceof Refusal && error.status === UNPAIRED;
          setStranger(isUnpaired);
          setTrouble(isUnpaired ? "" : lineOf(error));
        },
      ),
    [load],
  );
  usePolling(reload, LOOK_AGAIN_MS);
  const newest = useRef(project);
  newest.current = project;
  const choices = useKept<Choices>({
    place: "choices",
    saved: project?.choices ?? ({} as Choices), // nothing is chosen before the project is loaded
    save: async (value) => {
      const body = { choices: value, read: newest.current?.choices_digest };
      const answer = await send<Project>("PUT", "choices", body);
      newest.current = answer;
      take(answer);
      return answer.choices;
    },
    reload,
    pause: 0,
  });
  const shared = project && {
    project: { ...project, choices: choices.value },
    take,
    choose: (change: Partial<Choices>) => choices.put((value) => ({ ...value, ...change })),
    reload,
    trouble: trouble || choices.refused,
    setTrouble,
  };
  return { shared, trouble, isStranger, reload };
}
