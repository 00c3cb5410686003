# SPDX-License-Identifier: MIT
# Finds and installs packages. Sourced by cmake/run.

# announce LINE…: what is about to be installed. A step of test --ci writes to a file, so it announces on descriptor 3 as well.
announce() {
  printf '%s\n' "$@"
  if [[ ${SHAFTCULL_STEP:-} ]]; then printf '%s\n' "$@" >&3; fi
}

# stop LINE…: ends the command with these lines as its error.
stop() {
  printf '%s\n' "$@" >&2
  exit 1
}

# installed PACKAGE STATES: whether a package is there, for this machine's own architecture unless it names another one. STATES are
# lines package:architecture:state of all packages.
installed() {
  local architecture=${1#*:}
  if [[ $1 != *:* ]]; then architecture=$([[ $2 =~ $'\n'dpkg:([a-z0-9]+):installed$'\n' ]] && echo "${BASH_REMATCH[1]}" || true); fi
  [[ $2 == *$'\n'"${1%%:*}":@(all|"$architecture"):installed$'\n'* ]]
}

# missing PACKAGE[:COMMAND | :ARCHITECTURE]… prints those that are not there, each once.
missing() {
  local package command states
  states=$'\n'$(dpkg-query -W -f='${Package}:${Architecture}:${db:Status-Status}\n' 2>/dev/null || true)$'\n'
  for package in "$@"; do
    command=
    if [[ $package == *:* && ${package#*:} != "$foreign_architecture" ]]; then
      command=${package#*:}
      package=${package%%:*}
    fi
    if [[ $command ]] && command -v "$command" >/dev/null; then continue; fi
    if command -v apt-get >/dev/null; then
      installed "$package" "$states" || echo "$package"
    elif [[ $command ]]; then
      echo "$command"
    fi
  done | awk '!seen[$0]++'
}

# apt_get ARGUMENT…: apt-get with root's rights, for one command at a time. Before it installs, it asks if there is somebody to ask.
apt_get() {
  local as_root=()
  if command -v flock >/dev/null; then
    mkdir -p "$root/build"
    exec 8>>"$root/build/apt.lock"
    flock 8
  fi
  if [[ $EUID -ne 0 ]]; then as_root=(sudo); fi
  if [[ $1 == install && (! -t 0 || ${CI:-}) ]]; then
    as_root+=(env DEBIAN_FRONTEND=noninteractive)
    set -- install -qy "${@:2}"
  fi
  local status=0
  "${as_root[@]}" apt-get "$@" || status=$?
  exec 8>&-
  return $status
}

# install_missing installs the packages that are missing. Without what is needed, the command ends.
install_missing() {
  local needed optional
  mapfile -t needed < <(missing "${packages[@]}")
  mapfile -t optional < <(missing "${optional_packages[@]}")
  if ! command -v apt-get >/dev/null; then
    [[ ${#needed[@]} -gt 0 ]] || return 0
    stop "cmake/run: not found: ${needed[*]}." \
      "This system has no apt-get. Please install, in its own way: $needed_elsewhere." \
      "Then run the same command again."
  fi
  local all=("${needed[@]}" "${optional[@]}")
  [[ ${#all[@]} -gt 0 ]] || return 0
  local by_hand="apt-get update && apt-get install --no-install-recommends ${all[*]}"
  if [[ $foreign_architecture ]]; then by_hand="dpkg --add-architecture $foreign_architecture && $by_hand"; fi
  if [[ ! $may_install || ($EUID -ne 0 && ! -x $(command -v sudo)) ]]; then
    [[ ${#needed[@]} -gt 0 ]] || { echo "cmake/run: goes on without ${optional[*]}" && return 0; }
    stop "cmake/run: packages are missing, and $([[ $may_install ]] && echo "only root can install them" || echo "--no-install was given"). As root, run:" \
      "  $by_hand" "Then run the same command again."
  fi
  announce "./cmake/run ${command_line[*]} needs Debian packages that are not installed: ${needed[*]:-none}."
  if [[ ${#optional[@]} -gt 0 ]]; then announce "It can do more with: ${optional[*]}."; fi
  announce "It installs them now, $([[ $EUID -eq 0 ]] && echo "as root" || echo "with sudo"): $by_hand" \
    "To install nothing: ./cmake/run --no-install ${command_line[*]}"
  if ! { { [[ ! $foreign_architecture ]] || add_architecture; } && apt_get update -q &&
    apt_get install --no-install-recommends "${all[@]}"; }; then
    [[ ${#needed[@]} -gt 0 ]] || { echo "cmake/run: goes on without ${optional[*]}" && return 0; }
    stop "" "cmake/run: the packages could not be installed; the messages above say why. Nothing was configured or built." \
      "apt-get needs the network, or a mirror or cache that it knows, and root's rights. By hand, as root:" "  $by_hand" \
      "Then run the same command again."
  fi
}

add_architecture() {
  local as_root=()
  if [[ $EUID -ne 0 ]]; then as_root=(sudo); fi
  "${as_root[@]}" dpkg --add-architecture "$foreign_architecture"
}

# install_known TESTS PACKAGE… installs those of the packages that this system has. Nothing is removed for them. Some of these
# tests are skipped without them.
install_known() {
  command -v apt-get >/dev/null || return 0
  local tests=$1 package wanted known=()
  shift
  mapfile -t wanted < <(missing "$@")
  for package in "${wanted[@]}"; do
    if apt-cache show "$package" >/dev/null 2>&1; then known+=("$package"); fi
  done
  [[ ${#known[@]} -gt 0 ]] || return 0
  if [[ $may_install && ($EUID -eq 0 || -x $(command -v sudo)) ]]; then
    announce "Tests of $tests use Debian packages that are not installed; they are installed now: ${known[*]}"
    if apt_get install --no-remove --no-install-recommends "${known[@]}"; then return 0; fi
  fi
  echo "cmake/run: goes on without ${known[*]}, so some tests of $tests are skipped"
}

# unpack_libcxx VERSION… puts these versions of libc++ below build/libcxx. They are not installed: Debian's packages of them
# exclude each other.
unpack_libcxx() {
  command -v dpkg-deb >/dev/null || return 0
  local version work package
  for version in "$@"; do
    if [[ -d $root/build/libcxx/$version ]]; then continue; fi
    work=$root/build/libcxx/$version.part
    rm -rf "$work" && mkdir -p "$work"
    if (cd "$work" && apt-get download -q "libc++-$version-dev" "libc++abi-$version-dev" >/dev/null 2>&1 &&
      for package in *.deb; do dpkg-deb -x "$package" . && rm "$package"; done); then
      mv "$work" "$root/build/libcxx/$version"
    else
      rm -rf "$work"
      echo "cmake/run: goes on without libc++ $version, so a test of embedding is skipped"
    fi
  done
}
