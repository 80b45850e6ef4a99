// The server's types for layouts and plans.
import type { Schemas } from "../../api/client";

export type Place = [number, number]; // [mm] machine frame

export namespace Layout {
  export type Layout = Schemas["LayoutAnswer"];
  export type Plan = Schemas["PlanAnswer"];
  export type Advice = Schemas["AdviceAnswer"];
  export type Id = Layout["id"];
}
