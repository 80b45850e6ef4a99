// Saves of a form: its readings, distances and tape. Each waits for the one before.
import { lineOf, type Schemas, send } from "../api/client";
import { useProject } from "../shell/project";

export type Form = Schemas["ReadingsAnswer"];
type Distance = Form["distances"][number];
const forms = new Map<string, Succession<Form>>(); // of this tab, by file

/** The saves of the form in a file. */
export function savesOf(file: string): Succession<Form> {
  const saves = forms.get(file) ?? new Succession<Form>();
  forms.set(file, saves);
  return saves;
}

/** Saves a part of a form, which may go by the form that the saves before it left. */
export function useSave(
  form: Form,
  take: (form: Form) => void,
): (path: string, part: (now: Form) => object) => Promise<void> {
  const { setTrouble, reload } = useProject();
  const { file } = form;
  return async (path, part) => {
    try {
      const put = (now: Form) =>
        send<Form>("PUT", path, { file, digest: now.digest, ...part(now) });
      take(await savesOf(file).save(form, put));
      setTrouble("");
      await reload();
    } catch (error) {
      await reload(); // to show what was saved elsewhere
      setTrouble(lineOf(error));
    }
  };
}

/** Saves another length of a distance; without a length it is removed. */
export function useSaveDistance(
  form: Form,
  take: (form: Form) => void,
): (old: Distance, length: number | undefined) => Promise<void> {
  const save = useSave(form, take);
  return (old, length) =>
    save("distances", ({ distances }) => {
      const ends = old.between.join("\n");
      const alike = distances.filter(({ between }) => between.join("\n") === ends);
      // A save before this may have left it another length.
      const now = alike.find((each) => each.length === old.length) ?? alike[0];
      const instead = length === undefined ? [] : [{ ...old, length }];
      return { distances: distances.flatMap((each) => (each === now ? instead : [each])) };
    });
}

// Saves of the same thing from this tab: each waits for the answer to the save before it, and names the state that it
// left. Saves made elsewhere are not part of it, so the server still refuses to overwrite them unseen.

interface Saved {
  digest: string;
}

class Succession<State extends Saved> {
  private readonly after = new Map<string, State>(); // what this tab replaced a state by, by digest
  private line: Promise<unknown> = Promise.resolve();

  /** Saves in turn; `save` gets the state that the saves before it left of what is known. */
  save(known: State, save: (now: State) => Promise<State>): Promise<State> {
    const turn = this.line.then(async () => {
      const now = this.newest(known);
      const answer = await save(now);
      this.learn(answer);
      if (answer.digest !== now.digest) this.after.set(now.digest, answer);
      return answer;
    });
    this.line = turn.catch(() => undefined);
    return turn;
  }

  /** This state is there now, so nothing replaced it. */
  learn(state: State): void {
    this.after.delete(state.digest);
  }

  private newest(known: State): State {
    let now = known;
    for (;;) {
      const next = this.after.get(now.digest);
      if (!next) return now;
      now = next;
    }
  }
}
