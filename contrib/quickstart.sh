#!/usr/bin/env bash
# Sets up a fresh Debian machine, builds Signorini, and runs an example or the tests. Safe to call again.
#   contrib/quickstart.sh run [FILE.prm] [more options of signorini]
#   contrib/quickstart.sh test [options of cmake]
#   contrib/quickstart.sh packages     (only installs what a build needs)
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$top/build/release
packages=(g++ cmake ninja-build ccache libdeal.ii-dev libgmsh-dev libcgal-dev libeigen3-dev libsuitesparse-dev libopenblas0-serial python3 python3-numpy python3-matplotlib)
# Debian's deal.II from version 13 on links with mold.
[ "$(. /etc/os-release; echo "${VERSION_ID:-0}" | cut -d. -f1)" -ge 13 ] && [ "$(. /etc/os-release; echo "${ID:-}")" = debian ] && packages+=(mold)
usage() { sed -n '3,5s/^# *//p' "${BASH_SOURCE[0]}"; exit 2; }

install_missing() {
  local missing=() p
  for p in "$@"; do
    dpkg-query -W -f='${Status}' "$p" 2>/dev/null | grep -q 'ok installed' || missing+=("$p")
  done
  [ ${#missing[@]} -eq 0 ] && return
  command -v apt-get >/dev/null || { echo "quickstart: these Debian packages are missing: ${missing[*]}; there is no apt-get here to install them." >&2; exit 1; }
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "quickstart: please install as root: apt-get install ${missing[*]}" >&2; exit 1; }
    sudo=(sudo)
  fi
  echo "quickstart: installing ${missing[*]}"
  { "${sudo[@]}" apt-get update -q && "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"; } >/tmp/signorini-apt.$$.log 2>&1 ||
    { tail -n 20 /tmp/signorini-apt.$$.log >&2; echo "quickstart: the packages could not be installed; see above." >&2; exit 1; }
  rm -f /tmp/signorini-apt.$$.log
}

# build TARGET [options of cmake]
build() {
  local target=$1
  shift
  # Several sources at a time are half the work. A folder that is there keeps its way: who changes single sources builds without.
  [ -f "$build/CMakeCache.txt" ] || set -- -DSIGNORINI_UNITY=ON "$@"
  cmake -G Ninja -S "$top" -B "$build" -DCMAKE_BUILD_TYPE=Release "$@"
  ninja -C "$build" "$target"
}

case "${1:-}" in
  run)
    shift
    file=${1:-$top/prm/hertz/hertz.prm}
    [ $# -gt 0 ] && shift
    install_missing "${packages[@]}"
    build signorini_program -DSIGNORINI_TESTS=OFF -DSIGNORINI_PYTHON=OFF
    folder=${SIGNORINI_OUTPUT:-output}
    "$build/signorini" "$file" --output "$folder" "$@"
    hertz=$(dirname "$file")/hertz.json
    options=()
    [ "$(basename "$file")" = hertz.prm ] && [ -f "$hertz" ] && options=(--hertz "$hertz")
    /usr/bin/python3 "$top/contrib/plots/plot_pressure.py" "$folder" "${options[@]}"
    echo "quickstart: results in $folder (pressure.png, summary.json, bodies.pvd for ParaView)"
    if [ -f "$folder/report.html" ]; then echo "quickstart: open $(realpath "$folder")/report.html in a browser"; fi
    ;;
  test)
    shift
    install_missing "${packages[@]}" libgtest-dev libpsurface-dev doxygen universal-ctags pybind11-dev python3-dev python3-scipy python3-vtk9 xvfb xauth \
      python3-sphinx python3-myst-parser python3-sphinx-rtd-theme codespell hunspell hunspell-en-gb hunspell-en-us gmsh git chromium
    build all -DSIGNORINI_TESTS=ON -DSIGNORINI_PYTHON=ON "$@"
    ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)"
    ;;
  packages) install_missing "${packages[@]}" ;;
  *) usage ;;
esac
