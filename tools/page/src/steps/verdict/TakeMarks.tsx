// Adds a proposal to the folder: a form for its readings, and the program that cuts its marks. Nothing moves.
import type { Schemas } from "../../api/client";
import { Do } from "../../shell/doing";
import { useTell } from "../../shell/project";

export type Taking = Schemas["Taking"];

interface TakeParts {
  taking: Taking;
  /** What is measured, if it is not the best proposal. */
  title?: string;
}

export function TakeMarks({ taking, title }: TakeParts) {
  const tell = useTell();
  const { choose, digest, program, act } = taking;
  const work = async () => {
    await tell("next", { choose, digest });
    location.hash = program ? "#/cut" : "#/readings";
  };
  if (title !== undefined)
    return (
      <Do label={`Take: ${title}`} work={work}>
        Take
      </Do>
    );
  return (
    <Do isNext work={work}>
      {act}
    </Do>
  );
}
