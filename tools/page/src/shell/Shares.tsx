// Provides the project, the chosen unit and the sheet's size to everything inside.
import type { ComponentChildren } from "preact";
import { Units } from "../controls/lengths";
import { SheetSize, Stamp } from "../sheet/scale";
import { ProjectContext, type Shared } from "./project";

export function Shares({ shared, children }: { shared: Shared; children: ComponentChildren }) {
  const { machine, choices, files } = shared.project;
  const { settings = "" } = choices;
  return (
    <ProjectContext.Provider value={shared}>
      <Units.Provider value={choices.units ?? "mm"}>
        <SheetSize.Provider value={machine?.sheet ?? [2440, 1220]}>
          <Stamp.Provider value={settings && `${settings} ${(files[settings] ?? "").slice(0, 8)}`}>
            {children}
          </Stamp.Provider>
        </SheetSize.Provider>
      </Units.Provider>
    </ProjectContext.Provider>
  );
}
