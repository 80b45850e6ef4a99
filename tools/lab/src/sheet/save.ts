// A drawing of the sheet as a file: SVG with its colours written in, on light paper, or PNG at twice its size.
import { saved } from "../api/client";

const WRITTEN = [
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-width",
  "stroke-opacity",
  "stroke-dasharray",
  "paint-order",
  "opacity",
  "font-size",
  "font-family",
  "font-weight",
  "text-anchor",
];
const TITLE_PX = 26; // above the drawing

/** The drawing as text, with a title. */
function textOf(drawing: SVGSVGElement, title: string): string {
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  // Next to the drawing the styles of the page reach it too.
  copy.style.cssText = "position: absolute; visibility: hidden; background: var(--paper)";
  copy.classList.add("on-light-paper");
  drawing.after(copy);
  for (const part of [copy, ...copy.querySelectorAll("*")]) {
    const style = getComputedStyle(part);
    for (const name of WRITTEN) part.setAttribute(name, style.getPropertyValue(name));
  }
  const background = getComputedStyle(copy).backgroundColor;
  copy.remove();
  for (const part of [copy, ...copy.querySelectorAll("*")]) part.removeAttribute("class");
  const { width, height } = drawing.viewBox.baseVal;
  copy.removeAttribute("style");
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("viewBox", `0 ${-TITLE_PX} ${width} ${height + TITLE_PX}`);
  copy.setAttribute("width", String(width));
  copy.setAttribute("height", String(height + TITLE_PX));
  const sheet = `<rect y="${-TITLE_PX}" width="${width}" height="${height + TITLE_PX}" fill="${background}"/>`;
  copy.insertAdjacentHTML(
    "afterbegin",
    `<title></title>${sheet}<text x="8" y="-8" font-size="12" font-family="sans-serif"></text>`,
  );
  for (const place of copy.querySelectorAll(":scope > title, :scope > text[y='-8']"))
    place.textContent = title;
  return new XMLSerializer().serializeToString(copy);
}

export function saveSvg(drawing: SVGSVGElement, name: string, title: string): void {
  saved(new Blob([textOf(drawing, title)], { type: "image/svg+xml" }), `${name}.svg`);
}

export async function savePng(drawing: SVGSVGElement, name: string, title: string): Promise<void> {
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(textOf(drawing, title))}`;
  await picture.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2 * picture.width, 2 * picture.height];
  canvas.getContext("2d")?.drawImage(picture, 0, 0, canvas.width, canvas.height);
  const content = await new Promise<Blob | null>((done) => canvas.toBlob(done));
  if (content) saved(content, `${name}.png`);
}

export function saveCsv(text: string, name: string): void {
  saved(new Blob([text], { type: "text/csv" }), `${name}.csv`);
}
