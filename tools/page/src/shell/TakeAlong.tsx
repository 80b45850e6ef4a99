// A button that downloads a file from the lab: a report, a sheet to print, a table, the folder.
import type { ComponentChildren } from "preact";
import { takeAlong } from "../api/client";
import { Do } from "./doing";

interface TakeAlongParts {
  name: "report.html" | "marks.pdf" | "readings.csv" | "folder.zip";
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
