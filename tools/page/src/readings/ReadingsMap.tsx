// The readings on the sheet: an arrow from where each mark was sent to where it is.
import { useMemo } from "preact/hooks";
import { lengthText, useUnits } from "../controls/lengths";
import { Sheet } from "../sheet/Sheet";
import { useScale } from "../sheet/scale";
import type { Pair } from "../sheet/view";
import type { Form } from "./useReadings";

interface MapParts {
  form: Form;
  doubted: ReadonlySet<number>;
  /** The mark whose fields are open. */
  open: number;
  /** Opens the fields of a mark. */
  pick: (index: number) => void;
}

export function ReadingsMap({ form, doubted, open, pick }: MapParts) {
  const units = useUnits();
  const read = form.marks.filter((mark) => mark.place);
  const [width, height] = form.sheet;
  const [upright, across] = form.edges.split("-");
  const zero = [
    across === "left" ? -width / 2 : width / 2,
    upright === "top" ? height / 2 : -height / 2,
  ] as const;
  const key = [...doubted].join();
  const [marks, states] = useMemo(() => {
    const all = form.marks.map(({ index, name, target, place, read: typed }) => ({
      name,
      target,
      measured: place,
      isDoubted: doubted.has(index),
      ...(typed ? { also: typed.map((mm) => lengthText(mm, units)).join(" | ") } : {}),
    }));
    const errors = form.marks.map(({ target, place }) =>
      place ? ([place[0] - target[0], place[1] - target[1]] as const) : null,
    );
    return [all, [{ title: "readings", errors }]];
  }, [form, key, units]);
  return (
    <Sheet
      size={form.sheet}
      label={`${read.length} readings on the sheet`}
      marks={marks}
      {...(read.length > 0 ? { states } : {})}
      origin={{ zero, way: [across === "left" ? 1 : -1, upright === "top" ? -1 : 1] }}
      press={(mark) => pick(form.marks[mark]?.index ?? mark)}
    >
      <Edges size={form.sheet} zero={zero} to={form.marks[open]?.target} />
    </Sheet>
  );
}

interface EdgesParts {
  size: Pair;
  zero: Pair;
  to: Pair | undefined;
}

/** The edges that the tape measures from, and how it lies to a mark. */
function Edges({ size: [width, height], zero: [x, y], to }: EdgesParts) {
  const { at } = useScale();
  const [[left, up], [right, down]] = [at([-width / 2, height / 2]), at([width / 2, -height / 2])];
  const [across, along] = at([x, y]);
  const [tx, ty] = at(to ?? [x, y]);
  return (
    <>
      <path
        class="edges"
        stroke-width={3}
        d={`M${left} ${along}H${right}M${across} ${up}V${down}`}
      />
      <path class="edges" stroke-dasharray={4} d={`M${across} ${ty}H${tx}V${along}`} />
      {to && <circle class="lit" cx={tx} cy={ty} r={13} />}
    </>
  );
}
