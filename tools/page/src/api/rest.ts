// Whether the page is at rest: no request is open, no timer is pending and nothing is left to draw. <html data-rest>
// says so to tests and screenshots.
import { options } from "preact";

const PRESSES = "pointerdown click keydown input change submit hashchange resize".split(" ");
const page = document.documentElement;
let works = 0; // under way
let stirs = 0; // so far
let looks = false;

/** Marks the beginning of some work; returns a function that marks its end. */
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

/** Runs something after a pause [ms]; returns a function that cancels it. */
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

/** Begins to watch: any drawing or press ends the rest. */
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

/** Marks the page as at rest once two frames in a row have changed nothing. */
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

/** After the next frame and everything that it triggers. */
function picture(): Promise<void> {
  return new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
}

function fades(): boolean {
  return document
    .getAnimations()
    .some((each) => each.playState === "running" && each.effect?.getTiming().iterations === 1);
}
