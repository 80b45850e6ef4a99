// The error of each fit: before it, after it, and on marks that took no part.
import type { Schemas } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { namedLength, type Unit } from "../../controls/lengths";

type Round = Schemas["Round"];

export function Errors({ rounds, units }: { rounds: Round[]; units: Unit }) {
  const most = Math.max(...rounds.map(({ before }) => before ?? 0), 0.1);
  const shown = (mm: number | null) => (mm === null ? "–" : namedLength(mm, units, 2));
  return (
    <table class="rounds">
      <thead>
        <tr>
          <th scope="col">fit</th>
          <th scope="col">error before and after</th>
          <th scope="col">marks left out</th>
        </tr>
      </thead>
      <tbody>
        {rounds.map((round) => (
          <tr key={round.at + round.machine}>
            <th scope="row">
              {new Date(round.at).toLocaleDateString(undefined, { dateStyle: "medium" })}
              <br />
              {round.machine}, {round.count} readings
              <br />
              {round.effects}
            </th>
            <td class="bars">
              <Bar share={(round.before ?? 0) / most} colour="var(--before)" />
              {shown(round.before)}
              <Bar share={(round.rms ?? 0) / most} colour="var(--after)" />
              {shown(round.rms)}
            </td>
            <td>{shown(round.left_out)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
