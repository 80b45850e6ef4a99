// Asks what a plan could tell a moment after it was changed.
import { send } from "../../api/client";
import { type Asked, useAsked } from "../../shell/asked";
import type { Layout, Place } from "./plan";

const MOMENT_MS = 250;

export function usePreview(
  layout: Layout.Id,
  places: Place[],
  settings: string,
): Asked<Layout.Plan> {
  const plan = { layout, places: layout === "own" ? places : [] };
  return useAsked(
    () => send<Layout.Plan>("POST", "preview", plan),
    JSON.stringify([plan, settings]),
    MOMENT_MS,
  );
}
