// The best next measurement: where on the sheet, how long, and how likely it settles the question.
import { Progress } from "../../controls/Progress";
import type { Mark } from "../../sheet/marks";
import { Sheet } from "../../sheet/Sheet";
import { useAnswer } from "../../shell/answer";
import { useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import { TakeMarks } from "./TakeMarks";
import type { NextAnswer, Size, VerdictParts } from "./words";

interface NextParts {
  sheet: Size;
  marks: VerdictParts["marks"];
  /** Whether somebody asked for it; this outlasts a verdict that is worked out again. */
  wanted: boolean;
}

export function NextStep({ sheet, marks, wanted }: NextParts) {
  const { answer, refused } = useAnswer<NextAnswer>("next", wanted);
  const { project } = useProject();
  const isVirtual = useMachine().kind === "virtual";
  if (!wanted) return null;
  if (refused) return <p class="trouble">{refused}</p>;
  if (answer?.nothing) return <p>Nothing that can be proposed would tell more.</p>;
  const next = answer?.next;
  if (!next) return <Progress share={answer?.share ?? 0} label="The next measurement" />;
  return (
    <section class="next" aria-label="The next measurement">
      <h2>Next: {next.headline}</h2>
      <div class="pair">
        <ol>
          {next.steps.map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ol>
        {next.marks.length > 0 && (
          <Sheet
            size={sheet}
            label="Where to measure next"
            name="next"
            units={project.choices.units ?? "mm"}
            marks={[
              ...marks.map(({ name, target }): Mark => ({ name, target, look: "faint" })),
              ...next.marks.map(
                ({ target }, index): Mark => ({ name: `${index + 1}`, target, look: "next" }),
              ),
            ]}
          />
        )}
      </div>
      {next.taking ? (
        <TakeMarks taking={next.taking} />
      ) : (
        <p class="take">
          <a class="button primary" href={`#/known/${next.by_hand}`}>
            {isVirtual ? "Measure it" : "Type what you measured"}
          </a>
        </p>
      )}
      <Others next={next} />
      <details class="command">
        <summary>In a terminal</summary>
        <code>{answer.command}</code>
      </details>
    </section>
  );
}

function Others({ next }: { next: NonNullable<NextAnswer["next"]> }) {
  const all = [...next.others, ...(next.ordinary ? [next.ordinary] : [])];
  if (all.length === 0) return null;
  const canTake = all.some((other) => other.taking);
  return (
    <table>
      <thead>
        <tr>
          <th scope="col">other ways</th>
          <th scope="col">what it promises</th>
          {canTake && <td />}
        </tr>
      </thead>
      <tbody>
        {all.map((other) => (
          <tr key={other.title}>
            <th scope="row">
              {other.title} <small>{Math.round(other.minutes)} minutes</small>
            </th>
            <td>{other.promise}</td>
            {canTake && (
              <td>{other.taking && <TakeMarks taking={other.taking} title={other.title} />}</td>
            )}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
