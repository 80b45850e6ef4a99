// The cells of the marks, in rows as on the sheet; on a phone only the open mark's, and the sheet opens others.
import { useUnits } from "../controls/units";
import { useProject } from "../shell/project";
import { Cell } from "./Cell";
import { pasted } from "./paste";
import { useNarrow } from "./useNarrow";
import type { Form, TypedForm } from "./useReadings";

const FEW = 4; // marks whose cells a phone shows all at once

interface GridParts {
  form: Form;
  readings: TypedForm;
  doubted: ReadonlySet<number>;
}

export function Grid({ form, readings, doubted }: GridParts) {
  const { key } = useProject().project;
  const { kept, open, pick } = readings;
  const { edges, file, marks } = form;
  const [upright, across] = edges.split("-") as [string, string];
  const units = useUnits();
  const order = [...marks].sort(
    ({ target: [x, y] }, { target: [x2, y2] }) => y2 - y || x - x2, // a repeat comes after its first
  );
  const isFolded = useNarrow() && marks.length > FEW;
  const next = (index: number) => {
    const after = order[order.findIndex((mark) => mark.index === index) + 1];
    if (after) pick(after.index);
  };
  return (
    <div class="cells tiles">
      <p class="from soft">
        In each cell: {units} from the <b>{across}</b> edge, then from the <b>{upright}</b> edge.
        {isFolded && " Touch a mark on the sheet to open it."}
      </p>
      {order.map((mark, i) => {
        const { index, name } = mark;
        if (isFolded && index !== open) return null;
        return (
          <Cell
            key={`${file}/${index}/${edges}`}
            mark={mark}
            value={kept.value[index]}
            units={units}
            from={[across, upright]}
            edges={edges}
            place={{ key, file, index }}
            doubted={doubted.has(index)}
            again={order.findIndex((other) => other.name === name) < i}
            next={() => next(index)}
            change={(value) =>
              kept.put((typed) => {
                const { [index]: _, ...others } = typed;
                return value ? { ...others, [index]: value } : others;
              })
            }
            paste={(text) => {
              const more = pasted(text, marks, index, units);
              if (more) kept.put((typed) => ({ ...typed, ...more }));
              return more !== undefined;
            }}
          />
        );
      })}
    </div>
  );
}
