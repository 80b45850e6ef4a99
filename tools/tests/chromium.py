"""How tests and pictures start Chromium."""

# Without these Chromium asks the network for things that are not needed here.
QUIET = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-sync"]
QUIET += ["--no-first-run", "--disable-component-update", "--disable-quic"]
