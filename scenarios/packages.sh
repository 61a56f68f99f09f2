# Sourced by quickstart.sh and tests/run.sh: install_packages build|all
#
# Installs what packages.txt lists and this machine lacks. With everything there it needs neither
# root nor a network.
install_packages() {
  local list wanted missing=() package
  list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"
  if [ "$1" = all ]; then
    wanted=$(sed '/^#/d' "$list")
  else
    wanted=$(sed '/^# tests/,$d; /^#/d' "$list")
  fi
  for package in $wanted; do
    # Other makers' nodejs brings npm along, and cannot stand beside Debian's.
    [ "$package" = npm ] && command -v npm >/dev/null && continue
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -q '^installed' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "shoal: these packages are missing: ${missing[*]}; install them as root, or install sudo" >&2
      return 1
    }
    as_root=(sudo)
  fi
  echo "shoal: installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends "${missing[@]}" >/dev/null
}
