// The best next measurement: where on the sheet, how long, and how likely it settles the question.
import type { Schemas } from "../../api/client";
import { Progress } from "../../controls/Progress";
import { Table } from "../../controls/Table";
import type { Mark } from "../../sheet/marks";
import { Sheet } from "../../sheet/Sheet";
import { Do } from "../../shell/doing";
import { useMachine } from "../../shell/machine";
import { useTell } from "../../shell/project";

export type NextAnswer = Schemas["NextAnswer"];

/** The proposal as far as it is worked out, or why there is none. */
interface Asked {
  answer: NextAnswer | undefined;
  refused: string;
}

interface NextParts {
  marks: Schemas["Verdict"]["marks"];
  next: Asked;
}

export function NextStep({ marks, next: { answer, refused } }: NextParts) {
  if (refused) return <p class="trouble">{refused}</p>;
  if (!answer?.headline)
    return <Progress share={answer?.share ?? 0} label="The next measurement" />;
  const [best] = answer.offers;
  if (!best) return <p>{answer.headline}</p>;
  const { proposal: next, taking } = best;
  return (
    <section class="next" aria-label="The next measurement">
      <h2>{answer.headline}</h2>
      <div class="pair tiles">
        <ol>
          {next.steps.map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ol>
        {next.marks.length > 0 && (
          <Sheet
            label="Where to measure next"
            marks={[
              ...marks.map(({ name, target }): Mark => ({ name, target, look: "faint" })),
              ...next.marks.map(
                ({ target }, index): Mark => ({ name: `${index + 1}`, target, look: "next" }),
              ),
            ]}
          />
        )}
      </div>
      {taking && <p>{taking.said}</p>}
      <Others {...answer} />
      <details class="command">
        <summary>In a terminal</summary>
        <code>{answer.command}</code>
      </details>
    </section>
  );
}

/** The button of the screen once something is proposed. */
export function NextAct({ next: { answer, refused } }: { next: Asked }) {
  const isVirtual = useMachine().kind === "virtual";
  const next = answer?.offers[0];
  if (refused || !next) return null;
  if (next.taking) return <TakeMarks taking={next.taking} />;
  return (
    <a class="button primary" href={`#/known/${next.proposal.checks[0]?.name ?? ""}`}>
      {isVirtual ? "Measure it" : "Type what you measured"}
    </a>
  );
}

function Others({ offers: [, ...others], ordinary, promises }: NextAnswer) {
  const all = ordinary ? [...others, { proposal: ordinary, taking: null }] : others;
  if (all.length === 0) return null;
  const canTake = all.some((other) => other.taking);
  return (
    <Table
      names={["other ways", promises, ...(canTake ? [""] : [])]}
      rows={all.map(({ proposal: { title, minutes, promise }, taking }) => [
        <>
          {title} <small>{Math.round(minutes)} minutes</small>
        </>,
        promise,
        ...(canTake ? [taking && <TakeMarks taking={taking} title={title} />] : []),
      ])}
    />
  );
}

/** Adds a proposal to the folder: a form for its readings, and the program that cuts its marks. Nothing moves. */
interface TakeParts {
  taking: Schemas["Taking"];
  /** What is measured, if it is not the best proposal. */
  title?: string;
}

function TakeMarks({ taking, title }: TakeParts) {
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
