// Whether the page is at rest: nothing is asked of the server, nothing waits for its turn and nothing is left to draw.
// <html data-rest> says so, for whoever looks at the page from outside: a test, or a screenshot.
import { options } from "preact";

const PRESSES = [
  "pointerdown",
  "click",
  "keydown",
  "input",
  "change",
  "submit",
  "hashchange",
  "resize",
];
const page = document.documentElement;
let works = 0; // under way
let stirs = 0; // so far
let looks = false;

/** Something begins; it returns what ends it. */
export function begin(): () => void {
  let isOver = false;
  works += 1;
  stir();
  return () => {
    if (isOver) return;
    isOver = true;
    works -= 1;
    stir();
  };
}

/** Does something after a pause [ms]; what it returns takes that back. */
export function later(work: () => void, ms: number): () => void {
  const end = begin();
  const timer = setTimeout(() => {
    work();
    end();
  }, ms);
  return () => {
    clearTimeout(timer);
    end();
  };
}

/** Begins to watch: whatever is drawn or pressed ends the rest. */
export function watchRest(): void {
  const { diffed } = options;
  options.diffed = (node) => {
    stir();
    diffed?.(node);
  };
  for (const press of PRESSES) addEventListener(press, stir, { capture: true });
  stir();
}

function stir(): void {
  stirs += 1;
  delete page.dataset.rest;
  if (!looks) void look();
}

/** Says that the page is at rest once two pictures in a row have brought nothing new. */
async function look(): Promise<void> {
  looks = true;
  let before: number;
  do {
    before = stirs;
    await picture();
    await picture();
  } while (works === 0 && (before !== stirs || fades()));
  looks = false;
  if (works === 0) page.dataset.rest = "";
}

/** After the next picture, and after what it has set off. */
function picture(): Promise<void> {
  return new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
}

function fades(): boolean {
  return document
    .getAnimations()
    .some((each) => each.playState === "running" && each.effect?.getTiming().iterations === 1);
}
