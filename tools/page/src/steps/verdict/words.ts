// The names of the verdict's parts, from the server's schema.
import type { Schemas } from "../../api/client";

export type VerdictAnswer = Schemas["VerdictAnswer"];
export type VerdictParts = Schemas["Verdict"];
export type Card = Schemas["Suspect"];
export type NextAnswer = Schemas["NextAnswer"];
