// How far off each check mark may be, and is.
import type { Schemas } from "../../api/client";
import { namedLength, type Unit } from "../../controls/lengths";
import { Table } from "../../controls/Table";

interface PromisedParts {
  marks: Schemas["CheckAnswer"]["marks"];
  units: Unit;
}

export function Promised({ marks, units }: PromisedParts) {
  return (
    <Table
      class="checked"
      names={["mark", "promised within", "off from what was promised", "off from the target"]}
      rows={marks.map(({ name, ...mm }) => [
        name,
        ...[mm.promised, mm.off, mm.error].map((each) => namedLength(each, units, 2)),
      ])}
    />
  );
}
