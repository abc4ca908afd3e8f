#!/bin/bash
# Installs what is missing, for `make` and for the container image. A second run finds everything
# in place: it needs neither network nor root and ends at once.
#
#   docker/install.sh system   the packages of docker/system-packages.txt
#   docker/install.sh run      these, and .venv from requirements.lock
#   docker/install.sh dev      these, and .venv from requirements-dev.lock
#   docker/install.sh warm     compiles what the worker compiles once, into the data folder
#   docker/install.sh gl       prints the OpenGL platform to draw with: osmesa or egl
#
# PYTHON=/path/to/python chooses the interpreter a new .venv is made from.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { echo "texloom: $*" >&2; }
fail() { for line in "$@"; do say "$line"; done; exit 1; }

# --- Python --------------------------------------------------------------------------------------

runs() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; }
makes_venvs() { "$1" -c 'import ensurepip, venv' >/dev/null 2>&1; }

# The newest of the versions the locks are tried with, else any other python3 from 3.11 on; one that
# can make a venv goes before one that cannot.
choose_python() {
  local candidates=(python3.13 python3.12 python3.11 python3) candidate
  if [[ -n "${PYTHON:-}" ]]; then
    runs "$PYTHON" || fail "PYTHON=$PYTHON is not a Python 3.11 or newer."
    candidates=("$PYTHON")
  fi
  for candidate in "${candidates[@]}"; do
    if runs "$candidate" && makes_venvs "$candidate"; then echo "$candidate"; return; fi
  done
  for candidate in "${candidates[@]}"; do
    if runs "$candidate"; then echo "$candidate"; return; fi
  done
  fail "No Python 3.11 or newer found (tried ${candidates[*]})." \
    "Install one (Debian 12, Ubuntu 24.04 and later have it as python3)," \
    "or name one: make run PYTHON=/path/to/python3"
}

# --- System packages -----------------------------------------------------------------------------

listed_packages() { sed 's/#.*//' docker/system-packages.txt | awk 'NF {print $1}'; }
installed() { [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]; }
apt_has() { [[ "$(LC_ALL=C apt-cache policy "$1" 2>/dev/null)" =~ 'Candidate: '[^\(] ]]; }
apt_has_lists() { compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null; }

# A fresh machine may still be busy with its own upgrades: wait for it.
apt_options=(-o DPkg::Lock::Timeout=300)

as_root() {
  if [[ $EUID -eq 0 ]]; then "$@"; return; fi
  command -v sudo >/dev/null || fail "Not root, and there is no sudo. Let an administrator run:" \
    "  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
  sudo "$@"
}

find_missing() {
  missing=()
  local package
  for package in $(listed_packages); do
    if [[ $package == python3-venv ]] && makes_venvs "$python"; then continue; fi
    installed "$package" || missing+=("$package")
  done
}

install_system_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "this is no Debian or Ubuntu: install Mesa's OSMesa or EGL yourself, as in" \
      "docker/system-packages.txt"
    return
  fi
  local missing package obtainable=()
  find_missing
  [[ ${#missing[@]} -gt 0 ]] || return 0
  # Only OSMesa is missing and apt has none: known since the first run, and `gl` says so.
  if [[ ${missing[*]} == libosmesa6 ]] && apt_has_lists && ! apt_has libosmesa6; then return 0; fi
  say "missing system packages: ${missing[*]}"
  say "refreshing the package lists (apt-get update)"
  as_root apt-get "${apt_options[@]}" update >&2 ||
    say "apt-get update had errors; going on with the lists there are"
  for package in "${missing[@]}"; do
    if apt_has "$package"; then
      obtainable+=("$package")
    elif [[ $package == libosmesa6 ]]; then
      say "this distribution has no OSMesa (libosmesa6): drawing with EGL instead"
    else
      fail "apt knows no package $package. Are the package sources (/etc/apt) complete?"
    fi
  done
  [[ ${#obtainable[@]} -gt 0 ]] || return 0
  say "installing ${obtainable[*]} (about 250 MB on a bare machine)"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get "${apt_options[@]}" install -y --no-install-recommends "${obtainable[@]}" >&2 ||
    fail "apt-get could not install ${obtainable[*]}: see above, then run make again."
}

# --- .venv ---------------------------------------------------------------------------------------

# What .venv was made from: a changed lock, project, Python or folder means installing again.
venv_key() {
  {
    cat requirements.lock requirements-dev.lock pyproject.toml
    .venv/bin/python -VV
    pwd
  } | sha256sum | cut -d' ' -f1
}

install_venv() {
  local level=$1 lock=$2 stamp=.venv/installed done_level done_key
  if ! runs .venv/bin/python; then
    say "making .venv with $("$python" -V) ($python)"
    rm -rf .venv
    "$python" -m venv .venv || fail "$python could not make a venv: install its venv package" \
      "(apt-get install python3-venv), or choose another: make run PYTHON=/path/to/python3"
  fi
  read -r done_level done_key 2>/dev/null <"$stamp" || true
  if [[ ${done_key:-} == "$(venv_key)" && (${done_level:-} == "$level" || $done_level == dev) ]]
  then return 0; fi
  rm -f "$stamp"
  say "installing $lock into .venv (a few minutes the first time)"
  .venv/bin/python -m pip install --disable-pip-version-check --require-hashes -r "$lock" >&2 ||
    fail "pip could not install $lock: see above. Is the package registry reachable" \
      "(pip config list)? Then run make again; what is already downloaded is kept."
  .venv/bin/python -m pip install --disable-pip-version-check --quiet \
    --no-deps --no-build-isolation --no-index --editable . >&2 ||
    fail "pip could not add this folder to .venv: see above."
  echo "$level $(venv_key)" >"$stamp"
}

# --- Caches and OpenGL ---------------------------------------------------------------------------

# Numba kernels and shaders are compiled for one data folder, processor and state of the sources.
warm() {
  local data=${TEXLOOM_DATA:-data} key
  key=$({
    find worker api_schemas -type f \( -name '*.py' -o -name '*.glsl' \) -print0 | sort -z |
      xargs -0 cat
    cat .venv/installed
    grep -m1 'model name' /proc/cpuinfo || true
    echo "${TEXLOOM_GL:-}"
  } | sha256sum | cut -d' ' -f1)
  [[ "$(cat "$data/warmed" 2>/dev/null)" != "$key" ]] || return 0
  say "compiling kernels and shaders (about a minute, once)"
  .venv/bin/python -m worker.warm >&2 || fail "the warm-up failed: see above."
  mkdir -p "$data"
  echo "$key" >"$data/warmed"
}

gl_platform() {
  if [[ -n "${TEXLOOM_GL:-}" ]]; then echo "$TEXLOOM_GL"; return; fi
  # The very question PyOpenGL asks when it loads the platform.
  if .venv/bin/python -c 'import ctypes.util as c, sys; sys.exit(not c.find_library("OSMesa"))'
  then echo osmesa; else say "no OSMesa on this machine: drawing with EGL"; echo egl; fi
}

case "${1:-}" in
  system | run | dev)
    if runs .venv/bin/python; then python=.venv/bin/python; else python=$(choose_python); fi
    install_system_packages
    if [[ $1 == run ]]; then install_venv run requirements.lock; fi
    if [[ $1 == dev ]]; then install_venv dev requirements-dev.lock; fi
    ;;
  warm) warm ;;
  gl) gl_platform ;;
  *) fail "usage: docker/install.sh system|run|dev|warm|gl" ;;
esac
