// The name of this tab: the server lets a single tab edit the folder.
const NAME = "plumb-tab";

/** The same after a reload, another in each tab. */
export function tab(): string {
  const name = sessionStorage.getItem(NAME) ?? Math.random().toString(36).slice(2);
  sessionStorage.setItem(NAME, name);
  return name;
}
