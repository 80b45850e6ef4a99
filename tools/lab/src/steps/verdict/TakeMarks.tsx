// Takes a proposal into the folder: a form for its readings, and the program that cuts its marks. Nothing moves.
import { type Project, type Schemas, send } from "../../api/client";
import { useDo } from "../../shell/doing";
import { useProject } from "../../shell/project";

export type Taking = Schemas["Taking"];

interface TakeParts {
  taking: Taking;
  /** What is measured, if the button is not that of the best. */
  title?: string;
}

export function TakeMarks({ taking, title }: TakeParts) {
  const { take } = useProject();
  const [busy, run, refusal] = useDo();
  const press = () =>
    void run(async () => {
      take(await send<Project>("POST", "next", { choose: taking.choose, digest: taking.digest }));
      location.hash = taking.program ? "#/cut" : "#/readings";
    });
  const { program, marks } = taking;
  return (
    <>
      {title === undefined ? (
        <button type="button" class="primary" disabled={busy} onClick={press}>
          {program
            ? `Take these ${marks} marks; nothing moves yet`
            : `Take these ${marks} readings`}
        </button>
      ) : (
        <button type="button" aria-label={`Take: ${title}`} disabled={busy} onClick={press}>
          Take
        </button>
      )}
      {refusal}
    </>
  );
}
