// The planned marks on the sheet: drag, tap to add, take away; arrow keys and Delete do the same.
import { useRef, useState } from "preact/hooks";
import { namedLength } from "../../controls/lengths";
import { Spot } from "../../sheet/Marks";
import { Sheet } from "../../sheet/Sheet";
import { useScale } from "../../sheet/scale";
import { pointIn } from "../../sheet/useZoom";
import { useProject } from "../../shell/project";
import type { Place } from "./plan";

const STEP = 25; // [mm] of an arrow key; with Shift a fifth
const EDGE = 60; // [mm] that a mark stays off the sheet's edge
const MOVES: Record<string, Place> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

interface MapParts {
  sheet: readonly [number, number];
  places: Place[];
  /** Distances that are taped, by the place of their marks. */
  spans: [number, number][];
  /** Shows places while they are dragged. */
  show: (places: Place[]) => void;
  /** Keeps them. */
  keep: (places: Place[]) => void;
}

export function MarksMap({ sheet, places, spans, show, keep }: MapParts) {
  const { project } = useProject();
  const [selected, setSelected] = useState<number>();
  const inside = ([x, y]: Place): Place => [
    Math.round(Math.max(-sheet[0] / 2 + EDGE, Math.min(sheet[0] / 2 - EDGE, x))),
    Math.round(Math.max(-sheet[1] / 2 + EDGE, Math.min(sheet[1] / 2 - EDGE, y))),
  ];
  const moved = (index: number, place: Place) =>
    places.map((old, i) => (i === index ? inside(place) : old));
  const remove = (index: number) => {
    keep(places.filter((_, i) => i !== index));
    setSelected(undefined);
  };
  const add = (place: Place) => keep([...places, inside(place)]);
  return (
    <>
      <Sheet
        size={sheet}
        label="The planned marks; each can be moved"
        name="marks"
        units={project.choices.units ?? "mm"}
        marks={places.map((target, index) => ({ name: String(index + 1), target }))}
        acts
      >
        <Ground add={add} />
        <Spans places={places} spans={spans} />
        {places.map((place, index) => (
          <Movable
            key={index}
            place={place}
            name={String(index + 1)}
            selected={selected === index}
            select={() => setSelected(index)}
            show={(to) => show(moved(index, to))}
            keep={(to) => keep(moved(index, to))}
            remove={() => remove(index)}
          />
        ))}
      </Sheet>
      <p class="more-marks">
        <button type="button" onClick={() => add([0, 0])}>
          Add a mark in the middle
        </button>{" "}
        {selected !== undefined && places[selected] && (
          <button type="button" onClick={() => remove(selected)}>
            Take mark {selected + 1} away
          </button>
        )}
      </p>
    </>
  );
}

/** The place on the sheet [mm] at which somebody points. */
function usePointed(): (event: MouseEvent) => Place | undefined {
  const { back } = useScale();
  return (event) => {
    const svg = (event.currentTarget as SVGElement).ownerSVGElement;
    return svg ? [...back(pointIn(svg, event))] : undefined;
  };
}

/** The bare sheet: a tap adds a mark. */
function Ground({ add }: { add: (place: Place) => void }) {
  const { plot } = useScale();
  const pointed = usePointed();
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the button below does it by keyboard
    <rect
      class="ground"
      x={plot.left}
      y={plot.top}
      width={plot.right - plot.left}
      height={plot.bottom - plot.top}
      onClick={(event) => {
        const place = pointed(event);
        if (place) add(place);
      }}
    />
  );
}

function Spans({ places, spans }: { places: Place[]; spans: [number, number][] }) {
  const { at } = useScale();
  const lines = spans.map(([first, second]) => {
    const [from, to] = [places[first], places[second]];
    return from && to ? `M${at(from).join(" ")}L${at(to).join(" ")}` : "";
  });
  return <path class="to-span" d={lines.join("")} />;
}

interface MovableParts {
  place: Place;
  name: string;
  selected: boolean;
  select: () => void;
  show: (place: Place) => void;
  keep: (place: Place) => void;
  remove: () => void;
}

function Movable({ place, name, selected, select, show, keep, remove }: MovableParts) {
  const { at, px } = useScale();
  const pointed = usePointed();
  const { project } = useProject();
  const unit = project.choices.units ?? "mm";
  const dragged = useRef(false);
  const [x, y] = at(place);
  const press = (event: KeyboardEvent) => {
    const way = MOVES[event.key];
    if (event.key === "Delete" || event.key === "Backspace") remove();
    else if (way) {
      const step = event.shiftKey ? STEP / 5 : STEP;
      keep([place[0] + way[0] * step, place[1] + way[1] * step]);
    } else return;
    event.preventDefault();
  };
  return (
    // biome-ignore lint/a11y/useSemanticElements: a button of HTML has no place in a drawing
    <g
      class={selected ? "movable selected" : "movable"}
      tabindex={0}
      role="button"
      aria-label={`Mark ${name} at x ${namedLength(place[0], unit, 0)}, y ${namedLength(place[1], unit, 0)}; arrow keys move it, Delete takes it away`}
      onFocus={select}
      onKeyDown={press}
      onPointerDown={(event) => {
        event.stopPropagation(); // the mark moves, not the sheet
        event.currentTarget.setPointerCapture(event.pointerId);
        dragged.current = false;
        select();
      }}
      onPointerMove={(event) => {
        if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
        const to = pointed(event);
        if (!to || Math.hypot(to[0] - place[0], to[1] - place[1]) * px < 3) return;
        dragged.current = true;
        show(to);
      }}
      onPointerUp={() => dragged.current && keep(place)}
    >
      <circle class="touch" cx={x} cy={y} r={22} />
      <Spot look="done" at={[x, y]} />
      <text x={x} y={y - 11} text-anchor="middle">
        {name}
      </text>
    </g>
  );
}
