// The cells of the marks, in rows as on the sheet; on a phone only the open mark's, and the sheet opens others.
import { Fragment } from "preact";
import { Trouble } from "../controls/Trouble";
import type { Kept } from "../shell/kept";
import { Cell } from "./Cell";
import { DoubtAt } from "./DoubtAt";
import type { Doubt } from "./useDoubts";
import type { Form, Typed, TypedForm } from "./useReadings";

const FEW = 4; // marks whose cells a phone shows all at once

interface GridParts {
  form: Form;
  readings: TypedForm;
  doubts: readonly Doubt[];
}

export function Grid({ form, readings, doubts }: GridParts) {
  const { kept, pick } = readings;
  const { edges, file, marks } = form;
  const [upright, across] = edges.split("-");
  const order = [...marks].sort(
    ({ target: [x, y] }, { target: [x2, y2] }) => y2 - y || x - x2, // a repeat comes after its first
  );
  const next = (index: number) => {
    const after = order[order.findIndex((mark) => mark.index === index) + 1];
    if (after) pick(after.index);
  };
  return (
    <div class={marks.length > FEW ? "cells many" : "cells"}>
      <p class="cell-names soft">
        <span class="name">mark</span>
        <span class="half">
          from the <b>{across}</b>
        </span>
        <span class="half">
          from the <b>{upright}</b>
        </span>
        <span class="off">off by</span>
      </p>
      {order.map((mark, i) => {
        const { index, name } = mark;
        const doubt = doubts.find((each) => each.is_mark && each.index === index);
        return (
          <Fragment key={`${file}/${index}/${edges}`}>
            <Cell
              {...{ mark, form, readings }}
              doubted={doubt !== undefined}
              again={order.findIndex((other) => other.name === name) < i}
              next={() => next(index)}
            />
            <DoubtAt {...{ doubt, form, readings }} />
          </Fragment>
        );
      })}
      <Changed kept={kept} />
      <Trouble>{kept.refused}</Trouble>
    </div>
  );
}

/** The file changed on disk while you were typing: which version to keep. */
function Changed({ kept }: { kept: Kept<Typed> }) {
  if (!kept.changed) return null;
  return (
    <Trouble>
      The file has changed on disk, and what you typed is not saved.{" "}
      <button type="button" onClick={() => kept.settle(true)}>
        Keep mine
      </button>{" "}
      <button type="button" onClick={() => kept.settle(false)}>
        Take the file's
      </button>
    </Trouble>
  );
}
