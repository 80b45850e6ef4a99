// The drawing of a sheet as a file, in light colours: SVG, or PNG at twice its size, with the date and its settings.
import { useContext } from "preact/hooks";
import { isReport } from "../api/answers";
import { saved } from "../api/client";
import { Stamp } from "./scale";

const COLOURS = ["fill", "fill-opacity", "stroke", "stroke-opacity", "opacity"];
const LINES = ["stroke-width", "stroke-dasharray", "paint-order"];
const LETTERS = ["font-size", "font-family", "font-weight", "text-anchor"];
const TITLE_PX = 26; // above the drawing

export function Save({ drawing }: { drawing: { current: SVGSVGElement | null } }) {
  const stamp = useContext(Stamp);
  const text = () => drawing.current && textOf(drawing.current, titleWith(stamp));
  const save = async (as: "svg" | "png") => {
    const svg = text();
    if (!svg) return;
    const content = as === "svg" ? new Blob([svg], { type: "image/svg+xml" }) : await png(svg);
    if (content) saved(content, `sheet.${as}`);
  };
  if (isReport) return null;
  return (
    <>
      {(["svg", "png"] as const).map((as) => (
        <button
          key={as}
          type="button"
          aria-label={`${as.toUpperCase()}: save the picture`}
          onClick={() => void save(as)}
        >
          {as.toUpperCase()}
        </button>
      ))}
    </>
  );
}

function titleWith(stamp: string): string {
  return [document.title, new Date().toISOString().slice(0, 10), stamp].filter(Boolean).join(" · ");
}

/** The drawing as text, with a title. */
function textOf(drawing: SVGSVGElement, title: string): string {
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  // Placed next to the drawing, so that the page's styles apply.
  copy.style.cssText = "position: absolute; visibility: hidden; background: var(--paper)";
  copy.classList.add("on-light-paper");
  drawing.after(copy);
  const parts = [copy, ...copy.querySelectorAll("*")];
  for (const part of parts) {
    const style = getComputedStyle(part);
    for (const name of [...COLOURS, ...LINES, ...LETTERS])
      part.setAttribute(name, style.getPropertyValue(name));
  }
  const paper = getComputedStyle(copy).backgroundColor;
  copy.remove();
  for (const part of parts) part.removeAttribute("class");
  copy.removeAttribute("style");
  const { width, height } = drawing.viewBox.baseVal;
  const high = height + TITLE_PX;
  const size = { viewBox: `0 ${-TITLE_PX} ${width} ${high}`, width, height: high };
  for (const [name, value] of Object.entries(size)) copy.setAttribute(name, `${value}`);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.insertAdjacentHTML(
    "afterbegin",
    `<title></title><rect y="${-TITLE_PX}" width="${width}" height="${high}" fill="${paper}"/>
    <text x="8" y="-8" font-size="12" font-family="sans-serif"></text>`,
  );
  for (const name of ["title", "text"])
    (copy.querySelector(`:scope > ${name}`) as Element).textContent = title;
  return new XMLSerializer().serializeToString(copy);
}

async function png(svg: string): Promise<Blob | null> {
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await picture.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2 * picture.width, 2 * picture.height];
  canvas.getContext("2d")?.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => canvas.toBlob(done));
}
