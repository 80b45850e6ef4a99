// The project that all screens share: what is on disk, and how a screen changes it.
import { createContext } from "preact";
import { useCallback, useContext, useEffect, useRef, useState } from "preact/hooks";
import { type Choices, get, type Project, Refusal, send } from "../api/client";
import { LOOK_MS } from "../api/patience";
import { type Kept, useKept } from "./kept";
import { editOf, openOutbox } from "./outbox";
import { same } from "./rebase";
import { Turns } from "./turns";

/** What a screen sees of the project, and what it may do with it. */
export interface Shared {
  project: Project;
  /** Shows an answer that holds the whole project. */
  take: (project: Project) => void;
  /** Changes choices: shown at once, kept in the browser until they are saved. Ends when they are. */
  choose: (change: Partial<Choices>) => Promise<void>;
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
  const { project, take, reload, isStranger } = useLoadedProject(setTrouble);
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
  const choose = useChoose(choices);
  const shared = project && {
    project: { ...project, choices: choices.value },
    take,
    choose,
    reload,
    trouble,
    setTrouble,
  };
  return { shared, trouble: trouble || choices.refused, isStranger, reload };
}

function useLoadedProject(setTrouble: (change: (line: string) => string) => void) {
  const [project, setProject] = useState<Project>();
  const [isStranger, setStranger] = useState(false);
  const turns = useRef(new Turns()).current;
  const show = useCallback((answer: Project) => {
    openOutbox(answer.key);
    setStranger(false);
    // Unchanged parts stay the same objects, so that no screen asks again for what it shows.
    setProject((before) => (same(before, answer) ? before : answer));
  }, []);
  const take = useCallback(
    (answer: Project) => {
      // A save has finished since: this answer is out of date.
      turns.overtake();
      show(answer);
    },
    [turns, show],
  );
  const reload = useCallback(async () => {
    const question = turns.begin();
    try {
      const answer = await get<Project>("project", LOOK_MS);
      if (turns.counts(question)) show(answer);
      setTrouble((line) => (line.startsWith(SILENT) ? "" : line));
    } catch (error) {
      const isUnpaired = error instanceof Refusal && error.status === UNPAIRED;
      setStranger(isUnpaired);
      setTrouble(() => (isUnpaired ? "" : error instanceof Error ? error.message : String(error)));
    }
  }, [turns, show, setTrouble]);
  useEffect(() => {
    let looks = false;
    // Unanswered requests would use up all the browser's connections.
    const look = async () => {
      if (looks) return;
      looks = true;
      await reload();
      looks = false;
    };
    void look();
    const timer = setInterval(() => document.hidden || void look(), LOOK_AGAIN_MS);
    return () => clearInterval(timer);
  }, [reload]);
  return { project, take, reload, isStranger };
}

/** Changes choices, and ends when they are saved or wait for the person. */
function useChoose(choices: Kept<Choices>): Shared["choose"] {
  const newest = useRef(choices);
  newest.current = choices;
  const callers = useRef<(() => void)[]>([]);
  useEffect(() => {
    if (editOf("choices") && !newest.current.refused) return;
    for (const done of callers.current.splice(0)) done();
  });
  return useCallback((change) => {
    newest.current.put((value) => ({ ...value, ...change }));
    return new Promise((done) => {
      callers.current.push(done);
    });
  }, []);
}
