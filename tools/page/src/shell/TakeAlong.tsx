// A button that downloads a file from the lab: a report, or a sheet to print.
import type { ComponentChildren } from "preact";
import { takeAlong } from "../api/client";
import { Do } from "./doing";

interface TakeAlongParts {
  name: "report.html" | "marks.pdf";
  children: ComponentChildren;
}

export function TakeAlong({ name, children }: TakeAlongParts) {
  return (
    <p class="take-along">
      <Do work={() => takeAlong(name)} meanwhile={`Making ${name} …`}>
        {children}
      </Do>
    </p>
  );
}
