// The key to the server: it comes in the address that `plumb lab` printed, and stays in this browser.
const NAME = "plumb-token";

/** Keeps the token of the address and takes it out of the address line, so nobody reads it there. */
export function takeToken(): void {
  const address = new URL(location.href);
  const token = address.searchParams.get("token");
  if (!token) return;
  sessionStorage.setItem(NAME, token);
  localStorage.setItem(NAME, token); // for a second tab
  address.searchParams.delete("token");
  history.replaceState(null, "", address);
}

/** The token; empty if this browser was never at the printed address. */
export function token(): string {
  return sessionStorage.getItem(NAME) ?? localStorage.getItem(NAME) ?? "";
}
