// The token for the server: it comes in the address that `plumb lab` prints, and stays in this browser.
const NAME = "plumb-token";

/** Stores the token and removes it from the address bar, where others could read it. */
export function takeToken(): void {
  const address = new URL(location.href);
  const token = address.searchParams.get("token");
  if (!token) return;
  sessionStorage.setItem(NAME, token);
  localStorage.setItem(NAME, token); // for a second tab
  address.searchParams.delete("token");
  history.replaceState(null, "", address);
}

/** The token; empty if this browser never opened the printed address. */
export function token(): string {
  return sessionStorage.getItem(NAME) ?? localStorage.getItem(NAME) ?? "";
}
