#!/bin/sh
# Makes sure that a Chromium is there for the tests: the system's if it has one,
# else from the system's packages.
set -eu
found() { node -e 'import("./scripts/chromium.mjs").then((m) => process.exit(m.findChromium() ? 0 : 1))'; }
if found; then exit 0; fi
if command -v apt-get >/dev/null; then
  as_root=""
  [ "$(id -u)" = 0 ] || as_root="sudo"
  echo "Installing Chromium from the system's packages ..."
  $as_root apt-get update -q >/dev/null
  # Ubuntu calls it chromium-browser.
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -yq --no-install-recommends chromium fonts-liberation >/dev/null ||
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -yq --no-install-recommends chromium-browser fonts-liberation >/dev/null
fi
found || {
  echo "The tests need a Chromium: install one, or name it in the environment variable CHROMIUM." >&2
  exit 1
}
