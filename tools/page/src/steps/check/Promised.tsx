// How far off each check mark may be, and is.
import type { Schemas } from "../../api/client";
import { Head } from "../../controls/Head";
import { namedLength, type Unit } from "../../controls/lengths";

interface PromisedParts {
  marks: Schemas["CheckAnswer"]["marks"];
  units: Unit;
}

export function Promised({ marks, units }: PromisedParts) {
  return (
    <table class="checked">
      <Head
        names={["mark", "promised within", "off from what was promised", "off from the target"]}
      />
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
