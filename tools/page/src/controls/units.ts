// The unit in which lengths are shown and typed, for all components inside.
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Unit } from "./lengths";

export const Units = createContext<Unit>("mm");
export const useUnits = () => useContext(Units);
