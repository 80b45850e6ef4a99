// The cells in the order of the marks on the sheet; on a phone the open mark's cell, and a map of all to pick from.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { useProject } from "../shell/project";
import { Cell } from "./Cell";
import { isAgain, layoutOf } from "./layout";
import { MarkPicker } from "./MarkPicker";
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
  const { project } = useProject();
  const units = project.choices.units ?? "mm";
  const { edges } = form;
  const [upright, across] = edges.split("-") as [string, string];
  const layout = layoutOf(form.marks);
  const { kept } = readings;
  const isFolded = useNarrow() && form.marks.length > FEW;
  const { open, pick } = useOpenMark(form);
  const spots = isFolded
    ? layout.spots.filter((spot) => spot.marks.some((mark) => mark.index === open))
    : layout.spots;
  const order = layout.spots.flatMap((spot) => spot.marks.map((mark) => mark.index));
  const next = (index: number) => {
    const after = order[order.indexOf(index) + 1];
    if (after !== undefined) pick(after);
  };
  return (
    <div class="cells tiles">
      <p class="from soft">
        In each cell: {units} from the <b>{across}</b> edge, then from the <b>{upright}</b> edge.
      </p>
      {spots.map((spot) => (
        <div key={`${spot.row}/${spot.column}`}>
          {spot.marks.map((mark) => (
            <Cell
              key={`${form.file}/${mark.index}/${edges}`}
              mark={mark}
              value={kept.value[mark.index]}
              units={units}
              from={[across, upright]}
              edges={edges}
              place={{ key: project.key, file: form.file, index: mark.index }}
              doubted={doubted.has(mark.index)}
              again={isAgain(form.marks, form.marks.indexOf(mark))}
              next={() => next(mark.index)}
              change={(value) =>
                kept.put((typed) => {
                  const { [mark.index]: _, ...others } = typed;
                  return value ? { ...others, [mark.index]: value } : others;
                })
              }
              paste={(text) => {
                const more = pasted(text, form.marks, mark.index, units);
                if (more) kept.put((typed) => ({ ...typed, ...more }));
                return more !== undefined;
              }}
            />
          ))}
        </div>
      ))}
      {isFolded && (
        <MarkPicker
          form={form}
          layout={layout}
          typed={kept.value}
          doubted={doubted}
          open={open}
          pick={pick}
        />
      )}
    </div>
  );
}

/** The mark that is typed now: at first a mark that waits. Who picks another can type at once. */
function useOpenMark(form: Form) {
  const [picked, setPicked] = useState<{ file: string; index: number }>();
  const begin = useRef({ file: "", index: 0 });
  if (begin.current.file !== form.file) {
    const waiting = form.marks.find((mark) => !mark.read) ?? form.marks[0];
    begin.current = { file: form.file, index: waiting?.index ?? 0 };
  }
  // At once, so that the next key is for it.
  useLayoutEffect(() => {
    if (picked) document.querySelector<HTMLElement>(`#mark-${picked.index} input`)?.focus();
  }, [picked]);
  return {
    open: picked?.file === form.file ? picked.index : begin.current.index,
    pick: (index: number) => setPicked({ file: form.file, index }),
  };
}
