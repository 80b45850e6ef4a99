// How far off each check mark may be, and is.
import type { Schemas } from "../../api/client";
import { namedLength, type Unit } from "../../controls/lengths";

interface PromisedParts {
  marks: Schemas["CheckAnswer"]["marks"];
  units: Unit;
}

export function Promised({ marks, units }: PromisedParts) {
  return (
    <table class="checked">
      <thead>
        <tr>
          <th scope="col">mark</th>
          <th scope="col">promised within</th>
          <th scope="col">off from what was promised</th>
          <th scope="col">off from the target</th>
        </tr>
      </thead>
      <tbody>
        {marks.map((mark) => (
          <tr key={mark.name}>
            <th scope="row">{mark.name}</th>
            <td>{namedLength(mark.promised, units, 2)}</td>
            <td>{namedLength(mark.off, units, 2)}</td>
            <td>{namedLength(mark.error, units, 2)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
