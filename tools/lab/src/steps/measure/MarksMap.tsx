// The planned marks on the sheet: drag, tap to add, take away; arrow keys and Delete do the same.
import { useRef, useState } from "preact/hooks";
import { namedLength } from "../../controls/lengths";
import { MarkDot } from "../../sheet/MarkDot";
import { SheetMap, usePixel } from "../../sheet/SheetMap";
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
    <figure class="marks-map">
      <SheetMap sheet={sheet} label="The planned marks; each can be moved" acts>
        <Ground sheet={sheet} add={add} />
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
      </SheetMap>
      <figcaption>
        <button type="button" onClick={() => add([0, 0])}>
          Add a mark in the middle
        </button>{" "}
        {selected !== undefined && places[selected] && (
          <button type="button" onClick={() => remove(selected)}>
            Take mark {selected + 1} away
          </button>
        )}
      </figcaption>
    </figure>
  );
}

/** The place on the sheet [mm] at which somebody points. */
function pointed(event: PointerEvent | MouseEvent): Place | undefined {
  const svg = (event.currentTarget as SVGElement).ownerSVGElement;
  const matrix = svg?.getScreenCTM();
  if (!matrix) return undefined;
  const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
  return [point.x, -point.y];
}

/** The bare sheet: a tap adds a mark. */
function Ground({ sheet, add }: { sheet: readonly [number, number]; add: (place: Place) => void }) {
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the button below does it by keyboard
    <rect
      class="ground"
      x={-sheet[0] / 2}
      y={-sheet[1] / 2}
      width={sheet[0]}
      height={sheet[1]}
      onClick={(event) => {
        const place = pointed(event);
        if (place) add(place);
      }}
    />
  );
}

function Spans({ places, spans }: { places: Place[]; spans: [number, number][] }) {
  const pixel = usePixel();
  return (
    <g stroke="var(--ghost)" stroke-width={1.5 * pixel} stroke-dasharray={`${6 * pixel}`}>
      {spans.map(([first, second]) => {
        const [from, to] = [places[first], places[second]];
        if (!from || !to) return null;
        return (
          <line key={`${first}-${second}`} x1={from[0]} y1={-from[1]} x2={to[0]} y2={-to[1]} />
        );
      })}
    </g>
  );
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
  const pixel = usePixel();
  const { project } = useProject();
  const unit = project.choices.units ?? "mm";
  const dragged = useRef(false);
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
        event.currentTarget.setPointerCapture(event.pointerId);
        dragged.current = false;
        select();
      }}
      onPointerMove={(event) => {
        if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
        const to = pointed(event);
        if (!to || Math.hypot(to[0] - place[0], to[1] - place[1]) < 3 * pixel) return;
        dragged.current = true;
        show(to);
      }}
      onPointerUp={() => dragged.current && keep(place)}
    >
      <circle class="touch" cx={place[0]} cy={-place[1]} r={22 * pixel} />
      <MarkDot place={place} name={name} />
    </g>
  );
}
