// The history of a machine: the error of each fit, and how each number went.
import type { Schemas } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { namedLength, useUnits } from "../../controls/lengths";
import { Table } from "../../controls/Table";

export function Errors({ fits }: { fits: Schemas["DiaryFit"][] }) {
  const units = useUnits();
  const most = Math.max(...fits.map((fit) => fit.before_mm ?? 0), 0.1);
  const shown = (mm: number | null) => (mm === null ? "–" : namedLength(mm, units, 2));
  return (
    <Table
      class="rounds"
      names={["fit", "error before and after", "marks left out"]}
      rows={fits.map((fit) => [
        <>
          {new Date(fit.at).toLocaleDateString(undefined, { dateStyle: "medium" })}
          <br />
          {fit.machine}, {fit.readings} readings
          <br />
          {fit.said}
        </>,
        <div key={fit.at} class="bars">
          <Bar share={(fit.before_mm ?? 0) / most} colour="var(--before)" />
          {shown(fit.before_mm)}
          <Bar share={(fit.rms_mm ?? 0) / most} colour="var(--after)" />
          {shown(fit.rms_mm)}
        </div>,
        shown(fit.left_out_mm),
      ])}
    />
  );
}

const LINE = { stroke: "var(--act)", "vector-effect": "non-scaling-stroke" } as const;

/** How a number changed from fit to fit, with its 95 % interval. */
export function Course({ course }: { course: Schemas["Course"] }) {
  const { points } = course;
  const ends = points.flatMap(({ low, high }) => [low, high]);
  const [least, most] = [Math.min(...ends), Math.max(...ends)];
  const up = (value: number) => 90 - (80 * (value - least)) / (most - least || 1);
  const across = (index: number) => (100 * (index + 0.5)) / points.length;
  const last = points.at(-1);
  return (
    <figure class={course.has_moved ? "course box moved" : "course box"}>
      <figcaption>
        {course.noun}: <b>{last?.said}</b> {course.unit}
        {course.has_moved && " – has moved"}
      </figcaption>
      {points.length > 1 && (
        <svg viewBox="0 0 100 100" preserveAspectRatio="none" role="img" aria-label={said(course)}>
          <path
            {...LINE}
            d={points.map(({ low, high }, i) => `M${across(i)} ${up(low)}V${up(high)}`).join("")}
          />
          <path
            {...LINE}
            stroke-width={5}
            d={points.map(({ value }, i) => `M${across(i) - 2} ${up(value)}h4`).join("")}
          />
        </svg>
      )}
    </figure>
  );
}

function said(course: Schemas["Course"]): string {
  return `${course.noun}: ${course.points.map((point) => point.said).join(", then ")} ${course.unit}`;
}
