// Which mark somebody meant by a click or a touch.
const REACH = 44; // [CSS px] a finger is no needle

/** The index of the place nearest to a click, within a finger's reach; places in units of the SVG. */
export function nearest(
  event: MouseEvent,
  drawing: SVGSVGElement | null,
  places: readonly (readonly [number, number] | undefined)[],
): number | undefined {
  const turned = drawing?.getScreenCTM();
  if (!turned) return undefined;
  let [best, least]: [number | undefined, number] = [undefined, REACH];
  places.forEach((place, i) => {
    if (!place) return;
    const at = new DOMPoint(...place).matrixTransform(turned);
    const gap = Math.hypot(at.x - event.clientX, at.y - event.clientY);
    if (gap < least) [best, least] = [i, gap];
  });
  return best;
}
