#!/bin/sh
# Makes sure that the browsers are there that the tests use: the system's if it
# has them, else from the system's packages.
#   install_browsers.sh           Chromium, Firefox and, on Linux, WebKitGTK with a screen
#   install_browsers.sh chromium  Chromium alone
set -eu
missing() {
  node -e 'import("./scripts/browsers.mjs").then((m) => {
    for (const { name, packages } of m.missingBrowsers(process.argv[1])) console.log(name + ":" + packages);
  })' "${1:-}"
}
if [ -z "$(missing "${1:-}")" ]; then exit 0; fi
if command -v apt-get >/dev/null; then
  as_root=""
  [ "$(id -u)" = 0 ] || as_root="sudo"
  $as_root apt-get update -q >/dev/null
  # Package names differ between Debian and Ubuntu: the first that installs is taken.
  missing "${1:-}" | while IFS=: read -r name packages; do
    echo "Installing $name from the system's packages ..."
    for package in $(echo "$packages" | tr ',' ' '); do
      if $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -yq --no-install-recommends "$package" fonts-liberation </dev/null >/dev/null; then
        break
      fi
    done
  done
fi
still="$(missing "${1:-}" | cut -d: -f1)"
[ -z "$still" ] || {
  echo "The tests need what is not on this machine; install it, or name it in an environment variable:" >&2
  echo "$still" >&2
  exit 1
}
