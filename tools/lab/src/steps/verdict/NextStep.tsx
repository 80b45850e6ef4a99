// The best next measurement: where on the sheet, how long, and how likely it settles the question.
import { Progress } from "../../controls/Progress";
import { SheetMap, usePixel } from "../../sheet/SheetMap";
import { useAnswer } from "../../shell/answer";
import { useMachine } from "../../shell/machine";
import { TakeMarks } from "./TakeMarks";
import type { NextAnswer, Size, VerdictParts } from "./words";

interface NextParts {
  sheet: Size;
  before: VerdictParts["before"];
  /** Whether somebody asked for it; this outlasts a verdict that is worked out again. */
  wanted: boolean;
  want: () => void;
}

export function NextStep({ sheet, before, wanted, want }: NextParts) {
  const { answer, refused } = useAnswer<NextAnswer>("next", wanted);
  const isVirtual = useMachine().kind === "virtual";
  if (!wanted) {
    return (
      <p>
        <button type="button" class="primary" onClick={want}>
          Find the best next measurement
        </button>
      </p>
    );
  }
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
          <SheetMap sheet={sheet} label="Where to measure next">
            {before.map(({ name, place }, index) => (
              <Dot key={`${name}/${index}`} at={place} />
            ))}
            {next.marks.map(({ name, place }, index) => (
              <Dot key={`next ${name}/${index}`} at={place} number={index + 1} />
            ))}
          </SheetMap>
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

function Dot({ at, number }: { at: Size; number?: number }) {
  const pixel = usePixel();
  const [x, y] = [at[0], -at[1]];
  if (number === undefined) return <circle cx={x} cy={y} r={3 * pixel} fill="var(--ghost)" />;
  return (
    <g>
      <circle cx={x} cy={y} r={11 * pixel} fill="var(--act)" />
      <text
        x={x}
        y={y + 5 * pixel}
        font-size={14 * pixel}
        font-weight="700"
        text-anchor="middle"
        fill="var(--act-ink)"
      >
        {number}
      </text>
    </g>
  );
}
