// Whether this page is on a phone: it came by the network, not from the computer itself.
const OF_COMPUTER = ["127.0.0.1", "localhost"];
const KINDS = ["iPhone", "iPad", "Android"] as const;

export const isPhone = !OF_COMPUTER.includes(location.hostname);

/** What kind of phone this is, as far as its browser says it. */
export function kindOfPhone(): (typeof KINDS)[number] | "phone" {
  return KINDS.find((kind) => navigator.userAgent.includes(kind)) ?? "phone";
}
