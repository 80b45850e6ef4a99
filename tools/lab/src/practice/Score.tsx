// How a game ended: what was hidden, and how much error your numbers leave.
import type { Schemas } from "../api/client";
import { namedLength } from "../controls/lengths";
import { useProject } from "../shell/project";

export function Score({ score }: { score: Schemas["FinalScore"] }) {
  const { project } = useProject();
  const units = project.choices.units ?? "mm";
  const rows = [
    { words: "as the settings were", mm: score.before, kind: "wrong" },
    { words: "with the frame fitted", mm: score.frame, kind: "" },
    { words: "yours", mm: score.after, kind: "yours" },
    { words: "with the truth known", mm: score.best, kind: "" },
  ];
  const most = Math.max(...rows.map((row) => row.mm), 1e-9);
  return (
    <section class="score" aria-label="Score">
      <p class="hidden-was">
        Hidden was <strong>{score.hidden}</strong>.
      </p>
      <table>
        <caption>Error all over the sheet</caption>
        <tbody>
          {rows.map((row) => (
            <tr key={row.words} class={row.kind}>
              <th scope="row">{row.words}</th>
              <td class="bar">
                <svg viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true">
                  <rect width={(100 * row.mm) / most} height="10" />
                </svg>
              </td>
              <td>{namedLength(row.mm, units, 2)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p>
        You spent {counted(score.marks, "mark")}, {counted(Math.round(score.minutes), "minute")} and{" "}
        {counted(score.hints, "hint")}. False claims: {score.false.length}. The second sheet, as the
        tape reads it: {namedLength(score.second_sheet, units, 2)}.
      </p>
    </section>
  );
}

function counted(count: number, what: string): string {
  return `${count} ${what}${count === 1 ? "" : "s"}`;
}
