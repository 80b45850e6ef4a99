// Differences between the connected machine and the open file; undefined while one of them is unknown.
import type { Schemas } from "../api/client";
import { useMachine } from "./machine";
import { useNewest } from "./newest";
import { useProject } from "./project";

export type HeldAnswer = Schemas["HeldAnswer"];

export function useHeld(): HeldAnswer | undefined {
  const machine = useMachine();
  const { project } = useProject();
  const file = project.choices.settings ?? "";
  const known = machine.numbers_digest !== "" && file !== "";
  const state = JSON.stringify([machine.numbers_digest, file, project.files[file]]);
  const held = useNewest<HeldAnswer>(known ? "machine/held" : "", state);
  return known && held?.file === file ? held : undefined;
}
