// Whether this page is on a phone: loaded over the network, not on the computer itself.
const OF_COMPUTER = ["127.0.0.1", "localhost"];
const KINDS = ["iPhone", "iPad", "Android"] as const;

export const isPhone = !OF_COMPUTER.includes(location.hostname);

/** The kind of phone, as far as its browser tells. */
export function kindOfPhone(): (typeof KINDS)[number] | "phone" {
  return KINDS.find((kind) => navigator.userAgent.includes(kind)) ?? "phone";
}
